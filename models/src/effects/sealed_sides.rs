//! Sealed sides: a pouch closed at its sides is round there too, which costs volume, stroke and width of the wall.
//!
//! Each section of the lens, half height a, is flat in its middle and closes at either side by a quarter of a circle of radius a. That
//! takes ½πa of the width of each sheet and spans a. In finite elements of isolated pouches the sides take q times as much of section
//! and chord: more where they are flat and less as they fill, since fabric next to the seam is slack along the body.
//!
//! ```text
//! section   half area a W − ½πq a²     chord w = W − (π − 2) q a     a = r (cosφ − cosθ)     r = L/2θ
//! q = 1.05 − 0.355 a₀/W     a₀ = r (1 − cosθ)
//! E = −e σ q [ (P − χ p_b) ΔV_a + p_b ΔV_b ] per pitch
//! ΔV_a = −π I₂     ΔV_b = ∫ (ΔA − κ ΔQ) dx (1 + κD + κ²D²),  ΔA = −A' (π − 2) a + ½A'' (π − 2)² a²,  ΔQ alike
//! I₁ = ∫ a dx = r² (θ − sinθ cosθ)     I₂ = ∫ a² dx = 2r³ (sinθ − ⅓sin³θ − θ cosθ)
//! ```
//!
//! e is the edge restraint of the actuator (1 sealed, 0 freed by gussets), χ the share of the pouch inside the body (`displaced_gas`), A(w)
//! and Q(w) area and moment of area Aȳ of the body's section with a chord w (`section.rs`), with derivatives at the strip's width. The wall
//! pulls the sides apart with p_b R' cosα, so that their arcs have a radius of a + ρ₀, ρ₀ = p_b R' cosα/2P̄, and end before they are level:
//! the section then loses ½(4 − π) ρ₀² more, 1 % at P = 5 p_b, which is left out, as is q in the term of A''. Without a body the volume is
//! largest at 23.8 % of contraction for W = L (36.3 % with free sides): sealed sides cost *stroke* more than volume. Volume and contraction
//! are within 2 % of those finite elements for W/L from ⅔ to 4, and from no robot. Below P = p_b (χ + 1.05 (π − 2) A'/2W),
//! A' = R' cosα, the body's gas at the sides keeps the pouch flat. a ≤ W/π. `verification::exact::pouch::sealed_volume_m3` is its volume.

use super::entry::*;
use crate::gusset::{NARROWED, Sloped, half_height, side_share};
use crate::trig::sin_cos;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "sealed_sides",
    formula: "E = (P − χ p_b) π∫a²dx − p_b ∫(ΔA − κΔQ)dx(1 + κD + κ²D²) per pitch, a = r(cosφ − cosθ), w = W − (π − 2)a",
    sentence: "The sealed sides of a pouch are round as well, so it cannot become a free lens: it contracts less and holds less.",
    differs: "Much of the bend is missing at high pressures, where the free lens would still contract.",
    remedy: "Compare with pouches whose sides are freed by gussets, or that are wider.",
    validity: "inextensible fabric; at least two thirds as wide as long",
    reference: "derived here",
    parameters: &[SHARE.means("1: sealed sides, 0: sides that open freely")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Pouch) {
            let restraint = site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape));
            // `gussets` models these sides in more detail.
            let share = values[0] * restraint * (1.0 - site.gusset_share);
            if share > 0.0 {
                let term = SealedSides::new(share, site);
                let closes = term.closes(share);
                let effects = SideEffects { closes, narrows: share * NARROWED, ..SideEffects::SHIFT };
                site.act(term, effects);
            }
        }
    },
    ..BALANCE
};

pub(super) struct SealedSides {
    /// Restrained share of the sides per pitch, e σ/L \[1/m\].
    pub share: f64,
    pub length_m: f64,
    pub width_m: f64,
    arm_m: f64,
    /// Share χ of the pouch that is in the body.
    pub inner: f64,
    /// ΔA and ΔQ as factors of a and a².
    pub area: [f64; 2],
    pub moment: [f64; 2],
}

impl SealedSides {
    pub(super) fn new(share: f64, site: &Site) -> SealedSides {
        let (length_m, strip_m) = (site.shape.length_m, site.strip_m);
        let step = 1e-3 * strip_m;
        // A pouch too wide for the body leaves its section alone.
        let [low, middle, high] = [-step, 0.0, step].map(|more| site.drawn_in(strip_m + more));
        let sections = low.zip(middle).zip(high);
        let factors = |of: fn(&CutSection) -> f64| {
            let Some(((low, middle), high)) = &sections else { return [0.0; 2] };
            let (low, middle, high) = (of(low), of(middle), of(high));
            [
                -NARROWED * (high - low) / (2.0 * step),
                0.5 * NARROWED * NARROWED * (high - 2.0 * middle + low) / (step * step),
            ]
        };
        SealedSides {
            share: share / length_m,
            length_m,
            width_m: site.shape.width_m,
            arm_m: site.linkage.arm_m,
            inner: site.inner_share,
            area: factors(|s| s.area_m2),
            moment: factors(|s| s.area_m2 * s.centroid_m),
        }
    }

    /// At a → 0 the gas of the body resists with −½ΔA/(W a) of its pressure.
    pub(super) fn closes(&self, share: f64) -> f64 {
        let [flat, _] = side_share(self.width_m, [0.0; 2]);
        (-0.5 * share * flat * self.area[0] / self.width_m).max(0.0)
    }

    /// Length along the far side over the chord's, 1/(1 − κD) without its pole, and its slope over κ.
    pub(super) fn stretch(&self, kappa: f64) -> [f64; 2] {
        let turn = kappa * self.arm_m;
        [1.0 + turn * (1.0 + turn), self.arm_m * (1.0 + 2.0 * turn)]
    }

    /// q and its derivative by θ.
    pub(super) fn side_share(&self, theta: f64) -> Sloped {
        let middle = match theta > 0.0 {
            true => half_height(self.length_m, theta, sin_cos(0.5 * theta)),
            false => [0.0, 0.25 * self.length_m],
        };
        side_share(self.width_m, middle)
    }

    /// I₁ and I₂ with their derivatives by θ.
    pub(super) fn integrals(&self, theta: f64) -> [Sloped; 2] {
        if theta < SERIES_BELOW {
            let (half, t2) = (0.5 * self.length_m, theta * theta);
            let first = half * half * theta * (2.0 / 3.0 - t2 * (2.0 / 15.0 - t2 * 4.0 / 315.0));
            let d_first = half * half * (2.0 / 3.0 - t2 * (2.0 / 5.0 - t2 * 4.0 / 63.0));
            let second = half.powi(3) * t2 * (4.0 / 15.0 - t2 * (22.0 / 315.0 - t2 * 17.0 / 1890.0));
            let d_second = half.powi(3) * theta * (8.0 / 15.0 - t2 * (88.0 / 315.0 - t2 * 17.0 / 315.0));
            return [[first, d_first], [second, d_second]];
        }
        let (sin, cos) = sin_cos(theta);
        let per = 1.0 / theta;
        let radius = 0.5 * self.length_m * per;
        let square = radius * radius;
        let first = square * (theta - sin * cos);
        let second = 2.0 * square * radius * (sin - sin * sin * sin * (1.0 / 3.0) - theta * cos);
        let d_first = 2.0 * (square * sin * sin - first * per);
        let d_second = 2.0 * square * radius * sin * (theta - sin * cos) - 3.0 * second * per;
        [[first, d_first], [second, d_second]]
    }
}

/// Below this angle the closed forms lose more digits to cancellation than the series to truncation.
const SERIES_BELOW: f64 = 0.05;

impl Term for SealedSides {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (theta, kappa) = (at.q[actuator_q::COORDINATE], at.q[actuator_q::CURVATURE]);
        let [first, second] = self.integrals(theta);
        let [q, d_q] = self.side_share(theta);
        let gas = PI * (at.p_act_pa - self.inner * at.p_body_pa);
        let [stretch, d_stretch] = self.stretch(kappa);
        let pull = at.p_body_pa * stretch;
        let of = |factors: &[f64; 2], k: usize| factors[0] * first[k] + factors[1] * second[k];
        let body = |k: usize| of(&self.area, k) - kappa * of(&self.moment, k);
        let by_circles = self.share * (gas * second[0] - pull * body(0));
        force[actuator_q::COORDINATE] -= self.share * q * (gas * second[1] - pull * body(1)) + d_q * by_circles;
        force[actuator_q::CURVATURE] +=
            self.share * q * at.p_body_pa * (body(0) * d_stretch - of(&self.moment, 0) * stretch);
        q * by_circles
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sides() -> SealedSides {
        SealedSides {
            share: 1.0 / 0.06,
            length_m: 0.06,
            width_m: 0.06,
            arm_m: 0.07,
            inner: 0.5,
            area: [1e-2, 0.3],
            moment: [4e-4, 1e-2],
        }
    }

    #[test]
    fn series_and_closed_form_meet() {
        let sides = sides();
        let [low, high] = [SERIES_BELOW * (1.0 - 1e-12), SERIES_BELOW].map(|theta| sides.integrals(theta));
        for (series, closed) in low.as_flattened().iter().zip(high.as_flattened()) {
            assert!((series / closed - 1.0).abs() < 1e-8, "{series} {closed}");
        }
    }
}
