//! Geometry of a lens with gussets: how far its side folds open, and what that adds to its section (law and symbols: the
//! effect `gussets`).

use crate::root::halved;
use crate::trig::sin_cos;
use std::f64::consts::{FRAC_PI_2, PI};

/// Width that a pair of quarter circles takes of the chord, over a.
pub(crate) const NARROWED: f64 = PI - 2.0;
/// Sheet that a quarter circle takes beyond its width, over a.
pub(crate) const GATHERED: f64 = FRAC_PI_2 - 1.0;

/// What a round side takes of section and chord, over what quarter circles take: where a pouch is flat, and how much less per a₀/W.
/// Calibrated on volume and contraction of six isolated pouches in finite elements, W/L from ⅔ to 4 (48 elements along: `verification/tests/pouches.rs`).
const FLAT_SIDE: f64 = 1.05;
const FILLED_SIDE: f64 = 0.355;

/// q = 1.05 − 0.355 a₀/W of a half height a₀ in the middle of a pouch \[m\], with its slope over what a₀ has its slope over.
pub(crate) fn side_share(width_m: f64, [height_m, slope]: Sloped) -> Sloped {
    let per_width = FILLED_SIDE / width_m;
    [FLAT_SIDE - per_width * height_m, -per_width * slope]
}

/// Half height of the middle of a lens, a₀ = r (1 − cosθ) \[m\], from sine and cosine of ½θ.
pub(crate) fn half_height(length_m: f64, theta: f64, (sin, cos): (f64, f64)) -> Sloped {
    let per_theta = 1.0 / theta;
    let height = length_m * per_theta * sin * sin;
    [height, length_m * per_theta * sin * cos - height * per_theta]
}

/// Half height of a sealed pouch that narrows the wall as much as this one, whose half height is `a` and fold has opened by `u`.
pub(crate) fn narrowed(a: f64, u: f64) -> f64 {
    a - 2.0 / NARROWED * (u - a + a * (u / a).cos())
}

/// By how much the wall's chord is shorter than its sheet in the middle of a pouch \[m\].
pub(crate) fn narrowing_m(length_m: f64, fold_m: f64, theta: f64) -> f64 {
    let [[a, _], [u, _]] = GussetLens::new(length_m, theta).side(fold_m, 0.0).of_theta;
    NARROWED * narrowed(a, u)
}

/// ∫(4au − πa²) dx, ∫b dx and ∫b² dx over a pouch, b of [`narrowed`].
pub(crate) type PouchSums = [Sloped; 3];

/// A number and its slope over θ.
pub(crate) type Sloped = [f64; 2];

fn times([x, dx]: Sloped, [y, dy]: Sloped) -> Sloped {
    [x * y, dx * y + x * dy]
}

pub(crate) struct GussetLens {
    theta: f64,
    length_m: f64,
    half: (f64, f64),
}

/// Its side at φ = tθ.
struct GussetSide {
    /// Half height a of the section and opening u of the fold \[m\], with slopes over θ.
    of_theta: [Sloped; 2],
    /// cosφ, by which a step of t is a step along the body.
    along: Sloped,
    /// M² − B² where B > 0: the fold is open where it is not negative.
    spare: f64,
}

impl GussetLens {
    pub(crate) fn new(length_m: f64, theta: f64) -> GussetLens {
        GussetLens { theta, length_m, half: sin_cos(0.5 * theta) }
    }

    fn side(&self, fold_m: f64, t: f64) -> GussetSide {
        let (sin, cos) = self.half;
        let (sin_k, cos_k) = sin_cos(0.5 * self.theta * t);
        // Of ½(θ + φ) and ½(θ − φ), which keep their digits for small angles.
        let (sin_u, cos_u) = (sin * cos_k + cos * sin_k, cos * cos_k - sin * sin_k);
        let (sin_v, cos_v) = (sin * cos_k - cos * sin_k, cos * cos_k + sin * sin_k);
        let (du, dv) = (0.5 * (1.0 + t), 0.5 * (1.0 - t));
        let (per, v) = (1.0 / self.theta, self.theta * dv);
        let radius = 0.5 * self.length_m * per;
        let a = 2.0 * radius * sin_u * sin_v;
        let d_a = 2.0 * radius * (cos_u * sin_v * du + sin_u * cos_v * dv) - a * per;
        let (run, d_run) = (cos_u * sin_v, cos_u * cos_v * dv - sin_u * sin_v * du);
        let hidden = 4.0 * radius * radius * (v - run) * (v + run);
        let d_hidden = 8.0 * radius * radius * (v * dv - run * d_run) - 2.0 * hidden * per;
        let taut = 2.0 * fold_m - GATHERED * a;
        let spare = if taut > 0.0 { hidden - taut * taut } else { 0.0 };
        let half_per = 0.5 / taut;
        let opened = if spare < 0.0 {
            let d_opened = GATHERED * d_a * (0.5 + hidden * half_per / taut) + d_hidden * half_per;
            [fold_m + spare * half_per, d_opened]
        } else {
            [fold_m, 0.0]
        };
        let along = [cos_k * cos_k - sin_k * sin_k, -2.0 * t * sin_k * cos_k];
        GussetSide { of_theta: [[a, d_a], opened], along, spare }
    }

    /// Half angle θ₀ at which the fold is open to its bottom in the middle of the pouch; π where it stays held.
    pub(crate) fn opens(length_m: f64, fold_m: f64) -> f64 {
        halved([0.0, PI], HALVINGS, |theta| GussetLens::new(length_m, theta).side(fold_m, 0.0).spare < 0.0)[1]
    }

    /// Up to which t the fold is open to its bottom.
    fn open_to(&self, fold_m: f64) -> f64 {
        if self.side(fold_m, 0.0).spare < 0.0 {
            return 0.0;
        }
        let is_held = |t: f64| self.side(fold_m, t).spare < 0.0;
        halved([0.0, 1.0], HALVINGS, |t| !is_held(t))[0]
    }

    /// The integrals in parts: where the fold is held, halved, and where it is open, ever finer towards the place where it begins to
    /// be held: there the half height of a shallow fold is of the size of its depth.
    pub(crate) fn sums(&self, fold_m: f64) -> PouchSums {
        let open = self.open_to(fold_m);
        let cuts = OPEN_CUTS.map(|share| share * open).into_iter().chain([0.5 * (1.0 + open), 1.0]);
        let (mut sums, mut from) = ([[0.0; 2]; 3], 0.0);
        for to in cuts {
            let width = to - from;
            for [t, weight] in GAUSS {
                let side = self.side(fold_m, from + t * width);
                let dx = side.along.map(|cos| self.length_m * weight * width * cos);
                for (sum, gain) in sums.iter_mut().zip(side.gains()) {
                    let [value, slope] = times(gain, dx);
                    *sum = [sum[0] + value, sum[1] + slope];
                }
            }
            from = to;
        }
        sums
    }
}

/// Ends of the parts where the fold is open, over all of it.
const OPEN_CUTS: [f64; 5] = [0.5, 0.75, 0.9, 0.97, 1.0];
const HALVINGS: usize = 50;
/// Gauss's points and weights on [0, 1].
const GAUSS: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_71, 0.173_927_422_568_726_93],
    [0.330_009_478_207_571_87, 0.326_072_577_431_273_07],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
];

impl GussetSide {
    /// 4au − πa², b and b².
    fn gains(&self) -> PouchSums {
        let [[a, d_a], [u, d_u]] = self.of_theta;
        let (sin, cos) = sin_cos(u / a);
        let d_b = d_a - 2.0 / NARROWED * (d_u * (1.0 - sin) - d_a * (1.0 - cos - sin * u / a));
        let b = [narrowed(a, u), d_b];
        [times([4.0 * a, 4.0 * d_a], [u - 0.25 * PI * a, d_u - 0.25 * PI * d_a]), b, times(b, b)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: f64 = 0.057;

    #[test]
    fn a_flap_that_is_held_is_as_long_from_corner_to_root_as_its_fabric() {
        for (fold, theta, t) in [(0.024, 0.6, 0.0), (0.024, 1.3, 0.4), (0.018, 0.9, 0.8)] {
            let GussetSide { of_theta: [[a, _], [u, _]], spare, .. } = GussetLens::new(LENGTH, theta).side(fold, t);
            assert!(spare < 0.0);
            let (radius, phi) = (0.5 * LENGTH / theta, t * theta);
            // Side by half circle: its sheet is u longer than the strip is wide, from the middle to the root.
            let moved = u - (FRAC_PI_2 - 1.0) * a;
            let fabric = (radius * (theta - phi)).hypot(fold - u);
            let space = (radius * (theta.sin() - phi.sin())).hypot(fold + moved);
            assert!((fabric / space - 1.0).abs() < 1e-12, "{fabric} {space}");
        }
    }

    #[test]
    fn a_section_has_the_area_of_its_polygon_and_its_weld_lies_half_a_width_along_its_sheet() {
        let (half_width, a, u) = (0.0285, 0.014, 0.006);
        // Flat, then half a circle about the flat's end.
        let flat = half_width + u - FRAC_PI_2 * a;
        let n = 20_000;
        let at = |i: i32| (f64::from(i) / f64::from(n) * PI).sin_cos();
        let beside: f64 = (0..n)
            .map(|i| {
                let ([(sin, cos), (next_sin, next_cos)], flat) = ([at(i), at(i + 1)], flat);
                0.5 * (2.0 * flat + a * (sin + next_sin)) * a * (cos - next_cos)
            })
            .sum();
        let section = 2.0 * beside;
        let sealed = 4.0 * a * half_width - PI * a * a;
        assert!((section / (sealed + 4.0 * a * u) - 1.0).abs() < 1e-7, "{section}");
        // The wall's sheet, from the bottom up the side.
        let turned = (half_width - flat) / a;
        let weld = flat + a * turned.sin();
        assert!((NARROWED * narrowed(a, u) - 2.0 * (half_width - weld)).abs() < 1e-15);
        assert!((narrowed(a, 0.0) / a - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_flat_pouch_opens_by_a_seventh_of_its_half_height() {
        let GussetSide { of_theta: [[a, _], [u, _]], .. } = GussetLens::new(LENGTH, 1e-4).side(0.024, 0.3);
        assert!((u / a / (0.5 * GATHERED) - 1.0).abs() < 1e-3, "{}", u / a);
    }

    #[test]
    fn few_points_integrate_as_well_as_thousands() {
        for (fold, theta) in [(0.024, 0.42), (0.024, 1.43), (0.012, 1.01)] {
            let (lens, n) = (GussetLens::new(LENGTH, theta), 4000);
            let mut fine = [0.0; 3];
            for i in 0..n {
                let side = lens.side(fold, (f64::from(i) + 0.5) / f64::from(n));
                let dx = side.along[0] * LENGTH / f64::from(n);
                fine.iter_mut().zip(side.gains()).for_each(|(sum, gain)| *sum += gain[0] * dx);
            }
            for (few, many) in lens.sums(fold).iter().zip(fine) {
                assert!((few[0] / many - 1.0).abs() < 1e-5, "{fold} {theta}: {few:?} {many}");
            }
        }
    }
}
