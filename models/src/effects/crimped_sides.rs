//! Crimped sides: the side welds keep their length while the pouch shortens, so they fold out of their line, and a weld of bonded
//! plies resists.
//!
//! A weld that is pushed out of its line by w lowers one of its two sheets and lifts the other. Their quarter circles of radius a
//! (`sealed_sides`) become arcs of ρ(1 − cosψ) = a ∓ w that gather as much width, ρ(ψ − sinψ) = (π/2 − 1) a, and the section loses
//! ½ k w² of its area:
//!
//! ```text
//! ∂²S/∂h² = −(v − ψv')/(u'v − uv'),  u = 1 − cosψ,  v = ψ − sinψ     two sheets at ψ = π/2:  k = 4/(4 − π)
//! F = 2 √(k P̄ D_w b)     E = 2 e F ε per metre     P̄ = P − χ p_b
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D_w b | bending stiffness of one side weld along the robot: that of its bonded plies, ½ E t · t² for two, times its width | N·m² |
//! | F | compression that folds a beam on the foundation k P̄, and keeps folding it | N |
//! | e | edge restraint of the actuator: 1 sealed, 0 freed by gussets | – |
//! | ε | contraction of the pouch: how much a side must hide of its length | – |
//!
//! The foundation does not depend on a. **Validity**: folds that are short beside the pouch, 2π (D_w b/k P̄)^¼ ≪ L, and not yet
//! steep, where F falls slowly; sheets at the sides with arcs of radius a. A way round in the plane of the wall, which spares up to a
//! third of ε, is not taken off, nor is the bending of the sheets beside the weld added. Beam on a foundation: Hetényi 1946, §7; foundation derived
//! here.

use super::entry::*;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "crimped_sides",
    group: Group::Actuator,
    formula: "E = 2 F ε per metre, F = 2 √(4/(4 − π) · (P − χ p_b) D_w b)",
    sentence: "The side welds are too long for a pouch that has shortened, so they fold, and bonded plies resist.",
    differs: "The bend comes late and less, most where the pull is weak: at low pressures.",
    remedy: "Look at the sides of a full pouch: one sharp fold each, in its middle. Cut the side welds narrower.",
    validity: "folds short beside the pouch, two sheets that meet at a weld",
    reference: "Hetényi 1946, §7 (beam on a foundation); foundation derived here",
    parameters: &[Parameter {
        key: "bending_nm2",
        symbol: "D_w b",
        unit: "N m2",
        typical: 5e-6,
        upper: 1e-3,
        fitted: Fitted::FromDesign,
        meaning: "bending stiffness of one side weld along the robot",
        ..PLAIN
    }],
    needs: Needs::Family(Family::Pouch),
    add,
    ..BALANCE
};

/// Curvature of the lost area over the weld's displacement.
const FOUNDATION: f64 = 4.0 / (4.0 - PI);

struct CrimpedSides {
    /// Compression of both sides over √P̄ \[m √(N)\].
    sides: f64,
    /// χ.
    inner: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    for site in assembly.active_sites(Family::Pouch) {
        let restraint = site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape));
        if values[0] * restraint > 0.0 {
            let sides = 4.0 * restraint * (FOUNDATION * values[0]).sqrt();
            let term = CrimpedSides { sides, inner: site.inner_share };
            site.act(term, Besides { unforeseen: true, ..Besides::default() });
        }
    }
}

impl Term for CrimpedSides {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let push = self.sides * (at.p_act_pa - self.inner * at.p_body_pa).max(0.0).sqrt();
        force[actuator_q::CONTRACTION] -= push;
        push * at.q[actuator_q::CONTRACTION]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Loads, Model, Scenario};

    /// Area that a side of height h loses to its arc, which gathers the width g; by bisection for the arc's angle.
    fn lost(h: f64, g: f64) -> f64 {
        let (mut low, mut high): (f64, f64) = (0.3, 5.5);
        for _ in 0..80 {
            let psi = 0.5 * (low + high);
            if (psi - psi.sin()) / (1.0 - psi.cos()) < g / h { low = psi } else { high = psi }
        }
        let rho = h / (1.0 - low.cos());
        // The arc's piece of the sheet at full height, less what lies under the arc.
        h * rho * low - 0.5 * rho * rho * (low - low.sin() * low.cos())
    }

    #[test]
    fn the_foundation_is_the_area_that_two_sheets_lose_when_their_weld_leaves_its_line() {
        let gathered = 0.5 * PI - 1.0;
        assert!((lost(1.0, gathered) - 0.25 * PI).abs() < 1e-12);
        for w in [0.01, 0.1, 0.3] {
            let more = lost(1.0 - w, gathered) + lost(1.0 + w, gathered) - 2.0 * lost(1.0, gathered);
            assert!((more / (0.5 * FOUNDATION * w * w) - 1.0).abs() < 4e-4, "{w}: {more}");
        }
    }

    #[test]
    fn a_side_is_pushed_as_hard_as_its_cheapest_waves_need() {
        let (bending, pressure) = (5e-6, 9e3);
        // Waves of slope s hide ¼ s² of the length; bending and foundation take ¼ s² (B q² + k P̄/q²).
        let need = |q: f64| bending * q * q + FOUNDATION * pressure / (q * q);
        let cheapest = (100..1000).map(|q| need(f64::from(q))).fold(f64::INFINITY, f64::min);
        let term = CrimpedSides { sides: 4.0 * (FOUNDATION * bending).sqrt(), inner: 0.5 };
        let mut force = [0.0; 4];
        term.add(&Pose::new(&[0.7, 0.08, 0.0, 0.0], 2e3, 10e3), &mut force);
        assert!((-force[1] / (2.0 * cheapest) - 1.0).abs() < 1e-4, "{force:?} {cheapest}");
    }

    #[test]
    fn stiff_welds_bend_a_sealed_robot_less_and_gussets_have_no_such_sides() {
        let tip = |robot: &str, more: &str| {
            let text = crate::shipped(robot).unwrap();
            let model = Model::new(&Scenario::parse(&format!("{text}\n{more}")).unwrap());
            let mut at = model.prediction();
            model.predict(&Loads::uniform(2e3, 10e3), &mut at).unwrap();
            at.tip.y_m
        };
        let crimped = "[effects.crimped_sides]\nbending_nm2 = 5e-6\n";
        assert!(tip("epam-textbook", crimped) < 0.97 * tip("epam-textbook", ""));
        assert_eq!(tip("cpam-textbook", crimped), tip("cpam-textbook", ""));
    }
}
