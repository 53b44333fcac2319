//! Fold energy: a sheet that leaves a weld at an angle folds there as the elastica does, at the ends of the lens and at its sides.
//!
//! ```text
//! U = 4 √(D T) (1 − cos ½φ) per width of each sheet at each edge
//! ends   φ = θ,  T = P r outside, (P − p_b) r inside,  r = L/2θ,  two edges of width W
//! sides  φ = ½π,  T = P̄ a,  P̄ = P − χ p_b,  two sheets on two sides:
//!        ∫ √a dx = ½π √a₀ r sinθ (1 + θ²/32 + 13 θ⁴/3072 + …),  a₀ = r (1 − cosθ)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D | bending stiffness of one sheet | N·m |
//! | T | tension across the fold | N/m |
//! | a, a₀ | half height of the lens, in its middle | m |
//!
//! Includes the work of T on the way that the round of the fold cuts short; the tension follows the pressure. **Validity**: folds
//! farther apart than √(D/T), a fraction of a millimetre at high pressures; stiff welds; 0 < θ < π. Elastica: Love 1927, §262, in
//! `exact::fold`; the sum derived here.

use super::{Effect, Fitted, Group, POSITIVE, Parameter, Stage};
use crate::actuators::Family;
use crate::assembly::Assembly;
use crate::term::{Pose, Term, actuator_q};
use crate::trig::sin_cos;
use std::f64::consts::SQRT_2;

pub(super) const ENTRY: Effect = Effect {
    name: "fold_energy",
    group: Group::Actuator,
    stage: Stage::Balance,
    history: false,
    formula: "U = 4 √(D T)(1 − cos ½φ) per width of each fold; ends φ = θ, T = P r and (P − p_b) r; sides φ = ½π, T = P̄ a",
    sentence: "The sheets must be folded at the welds, and a fabric that is stiff in bending resists.",
    differs: "The bend comes late and less, more so at low pressures and with stiff fabrics.",
    remedy: "Measure the bending length of the fabric: let a strip droop over an edge.",
    validity: "stiff welds, folds farther apart than √(D/T)",
    reference: "Love 1927, §262 (elastica); derived here",
    parameters: &[Parameter {
        key: "bending_nm",
        symbol: "D",
        unit: "N m",
        si: 1.0,
        neutral: 0.0,
        typical: 1e-4,
        lower: 0.0,
        upper: 1e-2,
        possible: POSITIVE,
        starts: &[],
        by_actuator: &[],
        fitted: Fitted::FromDesign,
        in_room: false,
        meaning: "bending stiffness of one sheet",
    }],
    family: Some(Family::Pouch),
    add,
};

struct FoldEnergy {
    /// √D \[√(N m)\].
    root: f64,
    length_m: f64,
    width_m: f64,
    /// e: sides that are folded.
    sealed: f64,
    /// χ.
    inner: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    if values[0] == 0.0 {
        return;
    }
    for site in assembly.active_sites(Family::Pouch) {
        let term = FoldEnergy {
            root: values[0].sqrt(),
            length_m: site.shape.length_m,
            width_m: site.shape.width_m,
            sealed: site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape)),
            inner: site.closed_share,
        };
        site.actuator_terms.push(Box::new(term));
    }
}

/// 1 − cos 45°, four sheets at 4, half the circle of the parabola.
const SIDES: f64 = 16.0 * (1.0 - std::f64::consts::FRAC_1_SQRT_2) * std::f64::consts::FRAC_PI_2;

impl Term for FoldEnergy {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let theta = at.q[actuator_q::COORDINATE];
        let root = |pressure: f64| pressure.max(0.0).sqrt();
        let (sin, cos) = sin_cos(0.5 * theta);
        let radius = 0.5 * self.length_m / theta;
        let scale = self.root * radius.sqrt() / self.length_m;
        let ends = 8.0 * self.width_m * (root(at.p_act_pa) + root(at.p_act_pa - at.p_body_pa));
        // √a₀ = √(2r) sin ½θ and sinθ = 2 sin ½θ cos ½θ.
        let sides = 2.0 * SQRT_2 * SIDES * self.sealed * root(at.p_act_pa - self.inner * at.p_body_pa) * radius;
        let [folded, chord] = [1.0 - cos, sin * sin * cos];
        let d_folded = 0.5 * (sin - folded / theta);
        let (t2, d_chord) = (theta * theta, sin * (cos * cos - 0.5 * sin * sin) - 1.5 * chord / theta);
        let round = 1.0 + t2 * (1.0 / 32.0 + t2 * (13.0 / 3072.0));
        let d_round = theta * (1.0 / 16.0 + t2 * (13.0 / 768.0));
        let [chord, d_chord] = [chord * round, d_chord * round + chord * d_round];
        force[actuator_q::COORDINATE] -= scale * (ends * d_folded + sides * d_chord);
        scale * (ends * folded + sides * chord)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::fold::energy_j_m;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn it_is_the_elastica_at_every_weld_and_side() {
        let (length, width, bending, p_act, p_body) = (0.057, 0.05, 6e-5, 20e3, 2e3);
        let term = FoldEnergy { root: f64::sqrt(bending), length_m: length, width_m: width, sealed: 1.0, inner: 0.5 };
        for theta in [0.2, 0.7, 1.2] {
            let radius = 0.5 * length / theta;
            let ends: f64 =
                [p_act, p_act - p_body].map(|p| 2.0 * width * energy_j_m(bending, p * radius, theta)).iter().sum();
            // Along the sides, by the middles of short pieces.
            let n = 20_000;
            let piece = |i: i32| {
                let phi = theta * ((2 * i + 1) as f64 / f64::from(n) - 1.0);
                let height = radius * (phi.cos() - theta.cos());
                energy_j_m(bending, (p_act - 0.5 * p_body) * height, FRAC_PI_2) * radius * phi.cos() * 2.0 * theta
                    / f64::from(n)
            };
            let sides = 4.0 * (0..n).map(piece).sum::<f64>();
            let computed = length * term.add(&Pose::new(&[theta, 0.0, 0.0, 0.0], p_body, p_act), &mut [0.0; 4]);
            assert!((computed / (ends + sides) - 1.0).abs() < 0.002, "{theta}: {computed} {ends} {sides}");
        }
    }
}
