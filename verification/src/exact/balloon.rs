//! Mylar balloon: two flat discs sealed at the rim and inflated (Paulsen 1994).
//!
//! Meridians keep their length and pleats carry no hoop tension, so the tension of all meridians together is the same
//! everywhere, n = p π r², and its vertical part carries the pressure: sin ψ = x²/r².
//!
//! ```text
//! z' = −x²/√(r⁴ − x⁴)     s(x) = ∫₀ˣ r² du/√(r⁴ − u⁴)     R0 = s(r) = r Γ(¼)²/(4√(2π))
//! z(0) = r ∫₀¹ u² du/√(1 − u⁴) = 0.59907 r    V = (2π/3) r² R0      tension per unstressed width p r²/(2 s)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | R0, r | radius of the flat discs, of the inflated rim | m |
//! | x, z, s | distance from the axis, height above the rim's plane, distance along a meridian | m |
//! | ψ | slope of the meridian | rad |
//! | p, E t, ν | pressure, membrane stiffness, Poisson's ratio | Pa, N/m, – |
//!
//! Reference: W. H. Paulsen, American Mathematical Monthly 101 (1994) 953–958, recalled; derived again here.
//!
//! **Elastic film.** The tension p r²/(2s) is infinite at the pole, and the energy of first order in p/(E t) diverges there as
//! a logarithm: a first-order correction in closed form does not exist. [`elastic`] solves the balloon exactly for a linear film
//! that carries no compression (tension field), taut in both directions around the pole and pleated outside:
//!
//! ```text
//! d(s P_s cos ψ)/ds = P_θ − p x λ_s sin ψ      s P_s sin ψ = ½ p x²      λ_s = |dX/ds|,  λ_θ = x/s
//! taut: P_s = λ_s A (e_s + ν e_θ), P_θ = λ_θ A (e_θ + ν e_s), A = E t/(1 − ν²)     pleated: P_s = λ_s E t e_s, P_θ = 0
//! ```
//!
//! with Green strains e and x(0) = 0, ψ = π/2 at the rim. To be stretchless within 0.2 %, the radius needs
//! p R0/(E t) ≤ 3e-3, the volume ≤ 8e-4, the thickness ≤ 1.5e-4, because the pole rises about as load^0.6 (computed, ν
//! from 0 to 0.3).

use std::f64::consts::PI;

use super::KnownSections;
use super::solve::{falling_root, integral};

/// r/R0 of the stretchless balloon, `4√(2π)/Γ(¼)²`.
pub const RADIUS_RATIO: f64 = 0.762_759_763_501_813_2;

/// Whole thickness over r of the stretchless balloon, 2·∫₀¹ u² du/√(1 − u⁴).
pub const THICKNESS_RATIO: f64 = 1.198_140_234_735_592_3;

/// Height of the meridian above the rim's plane, z/r at x/r between 0 and 1.
pub fn height_ratio(distance_ratio: f64) -> f64 {
    // u = sin φ: u²/√(1 − u⁴) du = sin²φ/√(1 + sin²φ) dφ, smooth up to the rim.
    integral(|phi| phi.sin().powi(2) / (1.0 + phi.sin().powi(2)).sqrt(), distance_ratio.asin(), 0.5 * PI, 8)
}

/// Length of the meridian from the pole, s/r at x/r between 0 and 1.
pub fn meridian_ratio(distance_ratio: f64) -> f64 {
    integral(|phi| 1.0 / (1.0 + phi.sin().powi(2)).sqrt(), 0.0, distance_ratio.asin(), 8)
}

/// Volume of the stretchless balloon, `V = (2π/3) r² R0 = 1.21852 R0³` \[m³\].
pub fn volume_m3(flat_radius_m: f64) -> f64 {
    2.0 * PI / 3.0 * RADIUS_RATIO.powi(2) * flat_radius_m.powi(3)
}

/// Shape of a balloon of elastic film, in units of R0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Radius of the inflated rim over R0.
    pub radius: f64,
    /// Thickness of the balloon at its axis over R0.
    pub thickness: f64,
    /// Volume of the balloon over R0³.
    pub volume: f64,
    /// Stretch at the pole, equal in both directions.
    pub pole_stretch: f64,
}

/// Balloon of linear elastic film at `load` = p R0/(E t), 0 < load; Poisson's ratio ν of the film.
///
/// Shooting from the pole; 2000 Runge–Kutta steps give seven digits at loads from 1e-5 to 1e-2.
pub fn elastic(load: f64, poisson: f64) -> Elastic {
    // The strain at the pole scales as load^(2/3); ten times that is beyond it.
    let highest = 10.0 * load.powf(2.0 / 3.0);
    let strain = falling_root(|strain| -march(load, poisson, strain)[1], 0.0, highest);
    let [radius, _, height, volume] = march(load, poisson, strain);
    Elastic { radius, thickness: 2.0 * height, volume: 2.0 * volume, pole_stretch: 1.0 + strain }
}

/// State `[x, s P_s cos ψ, drop, volume under the drop]` at the rim, all in units of R0 and E t.
fn march(load: f64, poisson: f64, pole_strain: f64) -> [f64; 4] {
    const STEPS: u32 = 2000;
    let h = 1.0 / f64::from(STEPS);
    let stretch = 1.0 + pole_strain;
    // Around the pole the sheet is flat and equally stretched: x = λ s, P_s = λ e/(1 − ν).
    let tension = stretch * 0.5 * pole_strain * (2.0 + pole_strain) / (1.0 - poisson);
    let (x, level) = (stretch * h, tension * h);
    let mut at = [x, level, 0.25 * load * x.powi(3) / level, 0.0];
    for i in 1..STEPS {
        let s = h * f64::from(i);
        let k1 = slopes(load, poisson, s, at);
        let k2 = slopes(load, poisson, s + 0.5 * h, moved(at, k1, 0.5 * h));
        let k3 = slopes(load, poisson, s + 0.5 * h, moved(at, k2, 0.5 * h));
        let k4 = slopes(load, poisson, s + h, moved(at, k3, h));
        at = std::array::from_fn(|j| at[j] + h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]));
    }
    at
}

fn moved(at: [f64; 4], slope: [f64; 4], by: f64) -> [f64; 4] {
    std::array::from_fn(|j| at[j] + by * slope[j])
}

fn slopes(load: f64, poisson: f64, s: f64, [x, level, _, _]: [f64; 4]) -> [f64; 4] {
    let upright = 0.5 * load * x * x;
    let whole = level.hypot(upright);
    let (along, around) = film(poisson, whole / s, x / s);
    let drop = along * upright / whole;
    [along * level / whole, around - load * x * drop, drop, PI * x * x * drop]
}

/// Stretch along the meridian and hoop tension P_θ for a meridional tension P_s and hoop stretch, in units of E t.
fn film(poisson: f64, tension: f64, hoop_stretch: f64) -> (f64, f64) {
    let hoop = 0.5 * (hoop_stretch - 1.0) * (hoop_stretch + 1.0);
    let alone = stretch_under(tension, 1.0, 0.0);
    if hoop + poisson * 0.5 * (alone * alone - 1.0) <= 0.0 {
        return (alone, 0.0);
    }
    let plane = 1.0 / (1.0 - poisson * poisson);
    let along = stretch_under(tension, plane, poisson * hoop);
    (along, hoop_stretch * plane * (hoop + poisson * 0.5 * (along * along - 1.0)))
}

/// λ with `λ a (½(λ² − 1) + e) = tension`: Newton's method from above, where the cubic is convex.
fn stretch_under(tension: f64, a: f64, e: f64) -> f64 {
    let mut stretch = 1.0 + tension / a + e.abs();
    for _ in 0..12 {
        let excess = stretch * (0.5 * (stretch * stretch - 1.0) + e) - tension / a;
        stretch -= excess / (1.5 * stretch * stretch - 0.5 + e);
    }
    stretch
}

pub(super) fn known() -> KnownSections {
    let [stiff, soft] = [1e-3, 1e-2].map(|load| elastic(load, 0.3));
    let sizes = |at: &Elastic| [at.radius, at.thickness, at.volume];
    vec![
        (
            "Mylar balloon",
            vec![
                1.0 / meridian_ratio(1.0),
                2.0 * height_ratio(0.0),
                THICKNESS_RATIO * RADIUS_RATIO,
                height_ratio(0.5),
                height_ratio(0.9),
                meridian_ratio(0.5),
                volume_m3(1.0),
            ],
        ),
        ("Mylar balloon of elastic film, ν = 0.3", [&sizes(&stiff)[..], &sizes(&soft), &[soft.pole_stretch]].concat()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_constants_are_their_integrals() {
        assert!((RADIUS_RATIO * meridian_ratio(1.0) - 1.0).abs() < 1e-15);
        assert!((THICKNESS_RATIO / 2.0 - height_ratio(0.0)).abs() < 1e-15);
        let pole = integral(|x| 2.0 * PI * x * 2.0 * height_ratio(x), 0.0, 1.0, 100);
        assert!((RADIUS_RATIO.powi(3) * pole / volume_m3(1.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_stiff_film_tends_to_the_stretchless_balloon() {
        let volume = volume_m3(1.0);
        let excess = |load| elastic(load, 0.3).volume / volume - 1.0;
        let (coarse, fine) = (excess(1e-3), excess(1e-5));
        assert!(fine > 0.0 && fine < coarse / 30.0 && coarse < 0.01, "{coarse} {fine}");
    }

    #[test]
    fn radius_volume_and_thickness_are_stretchless_within_two_per_mille_below_their_loads() {
        let flat = [RADIUS_RATIO, volume_m3(1.0), THICKNESS_RATIO * RADIUS_RATIO];
        for poisson in [0.0, 0.3] {
            let [radius, volume, thickness] = [3e-3, 8e-4, 1.5e-4].map(|load| elastic(load, poisson));
            let found = [radius.radius, volume.volume, thickness.thickness];
            for i in 0..3 {
                let growth = found[i] / flat[i] - 1.0;
                assert!(growth > 1e-3 && growth < 2e-3, "{i}: {growth}");
            }
        }
    }

    #[test]
    fn film_tension_is_the_slope_of_the_plane_stress_energy_and_pleats_carry_none() {
        let (along, around) = film(0.3, 0.01, 1.002);
        let [e_s, e_t] = [along, 1.002].map(|stretch: f64| 0.5 * (stretch * stretch - 1.0));
        assert!((along * (e_s + 0.3 * e_t) / 0.91 - 0.01).abs() < 1e-15);
        assert!((around - 1.002 * (e_t + 0.3 * e_s) / 0.91).abs() < 1e-15 && around > 0.0);
        let (alone, none) = film(0.3, 0.01, 0.9);
        assert!((alone * 0.5 * (alone * alone - 1.0) - 0.01).abs() < 1e-15 && none == 0.0);
    }
}
