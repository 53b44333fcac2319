//! Gussets: folded sides of a pouch open as far as the diagonals of their folds allow, which the welds across hold.
//!
//! Fold, wall and sheet are welded together at both ends of a pouch, where the fold keeps its depth f. In between the sides are round,
//! half circles of radius a, as `sealed_sides`; what a fold has given by then, u, moves each of them outwards. The rest, f − u, is a
//! flap of two layers with the pouch's gas on both sides: nothing holds it but its length. From a corner at an end to its root
//! at the side the flap is flat fabric before and a straight line at most after:
//!
//! ```text
//! M² + (f − u)² ≥ (B − (f − u))²     u = f − (B² − M²)/(2B), f where M ≥ B     B = 2f − (½π − 1) a
//! M² = r² [(θ − φ)² − (sinθ − sinφ)²]     length along the robot that the pouch has hidden up to there, squared
//! section  a W − q (½πa² − 2 a u)     chord  W − q [(π − 2) a − 2a (u/a − 1 + cos(u/a))]
//! ```
//!
//! a, r, θ and φ are half height, radius, half angle and place of the lens. Without a fold it is the sealed pouch. A flat pouch opens a
//! seventh of its half height, u = (π − 2) a/4, and a deep fold opens late: a shallow one can hold more. The wall's sheet reaches up the side
//! by W/2, so its weld is the end of the chord. Half circles are taken from sections of finite elements, where a free membrane would dent at
//! the flap. The welds sit below the middle of the pouch, which displaces less of the body's gas than `displaced_gas` assumes; this is left
//! out.

use super::entry::*;
use super::sealed_sides::SealedSides;
use crate::gusset::{GATHERED, narrowed};
use crate::gusset_table::GussetTable;

pub(super) const ENTRY: Effect = Effect {
    name: "gussets",
    formula: "sealed_sides with 4 a u more of section, u = min(f, f − (B² − M²)/(2B)), B = 2f − (½π − 1) a, M² = r²[(θ − φ)² − (sinθ − sinφ)²]",
    sentence: "Side gussets are welded shut at both ends of a pouch, so they open only as far as their diagonals allow.",
    differs: "Folded pouches hold less than free ones and bend less, most at low pressures and where they are short.",
    remedy: "Try another depth of the folds: a shallower one opens earlier.",
    validity: "inextensible fabric, round sides; pouches with side folds",
    reference: "derived here",
    parameters: &[SHARE.means("1: folds that their ends hold, 0: sides that open freely")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Pouch) {
            if values[0] * site.shape.fold_m > 0.0 {
                site.gusset_share = values[0];
                let sealed = SealedSides::new(values[0], site);
                // As with sealed sides; a flat pouch narrows by less.
                let closes = sealed.closes(values[0]) * narrowed(1.0, 0.5 * GATHERED);
                let table = GussetTable::new(sealed.length_m, site.shape.fold_m);
                site.act(Gussets { sealed, table }, SideEffects { closes, ..SideEffects::SHIFT });
            }
        }
    },
    ..BALANCE
};

struct Gussets {
    sealed: SealedSides,
    table: GussetTable,
}

impl Term for Gussets {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (theta, kappa) = (at.q[actuator_q::COORDINATE], at.q[actuator_q::CURVATURE]);
        let [section, first, second] = self.table.sums(theta);
        let [q, d_q] = self.sealed.side_share(theta);
        let gas = at.p_act_pa - self.sealed.inner * at.p_body_pa;
        let [stretch, d_stretch] = self.sealed.stretch(kappa);
        let of = |factors: &[f64; 2], k: usize| factors[0] * first[k] + factors[1] * second[k];
        let body = |k: usize| of(&self.sealed.area, k) - kappa * of(&self.sealed.moment, k);
        let (share, pull) = (self.sealed.share, at.p_body_pa * stretch);
        let by_circles = share * (gas * section[0] + pull * body(0));
        force[actuator_q::COORDINATE] += share * q * (gas * section[1] + pull * body(1)) + d_q * by_circles;
        force[actuator_q::CURVATURE] +=
            share * q * at.p_body_pa * (body(0) * d_stretch - of(&self.sealed.moment, 0) * stretch);
        -q * by_circles
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Loads, Model, Scenario};
    use std::f64::consts::PI;

    const LENGTH_M: f64 = 0.06;
    const WIDTH_M: f64 = 0.06;

    /// Volume of a lens with free sides, W L₀² (θ − sinθ cosθ)/(2θ²) \[m³\].
    fn lens_m3(theta: f64) -> f64 {
        WIDTH_M * LENGTH_M * LENGTH_M * (theta - theta.sin() * theta.cos()) / (2.0 * theta * theta)
    }

    /// q of a pouch as wide as long.
    fn share(theta: f64) -> f64 {
        1.05 - 0.355 * LENGTH_M / (2.0 * theta) * (1.0 - theta.cos()) / WIDTH_M
    }

    /// With sealed sides πq ∫ a² dx less, ∫ a² dx = 2r³ (sinθ − ⅓ sin³θ − θ cosθ) \[m³\].
    fn sealed_m3(theta: f64) -> f64 {
        let r = LENGTH_M / (2.0 * theta);
        let squares = 2.0 * r.powi(3) * (theta.sin() - theta.sin().powi(3) / 3.0 - theta * theta.cos());
        lens_m3(theta) - share(theta) * PI * squares
    }

    fn shipped(robot: &str, more: &str) -> Model {
        Model::new(&Scenario::parse(&format!("{}\n{more}", crate::shipped(robot).unwrap())).unwrap())
    }

    /// The term of a cPAM with folds of that depth, without effects that change its size.
    fn term(fold_m: f64) -> Gussets {
        let model = shipped("cpam-textbook", "");
        let sealed = SealedSides::new(1.0, &model.assembly().sites[0]);
        Gussets { table: GussetTable::new(sealed.length_m, fold_m), sealed }
    }

    /// Gas of a pouch by ∂E/∂P.
    fn volume(term: &Gussets, theta: f64) -> f64 {
        assert_eq!(term.sealed.length_m, LENGTH_M);
        lens_m3(theta) - term.add(&Pose::new(&[theta, 0.0, 0.0, 0.0], 0.0, 1.0), &mut [0.0; 4]) * LENGTH_M
    }

    #[test]
    fn shallower_and_shallower_folds_end_in_a_sealed_pouch() {
        for theta in [0.2, 0.8, 1.3] {
            let sealed = sealed_m3(theta);
            let more = [1e-3, 1e-5, 1e-7].map(|fold_m| volume(&term(fold_m), theta) / sealed - 1.0);
            assert!(more[0] > more[1] && more[1] > more[2] && more[2].abs() < 1e-5, "{theta}: {more:?}");
            // A shallow fold opens to its bottom almost everywhere: 4qf more of each section.
            let lens = lens_m3(theta) / WIDTH_M;
            assert!(((more[1] * sealed) / (2.0 * 1e-5 * share(theta) * lens) - 1.0).abs() < 2e-2, "{theta}: {more:?}");
        }
    }

    #[test]
    fn force_is_the_slope_of_energy_with_folds_held_everywhere_and_open_in_the_middle() {
        for (fold_m, theta) in [(0.024, 0.3), (0.024, 1.2), (0.014, 1.2), (0.006, 0.9)] {
            let term = term(fold_m);
            let energy =
                |theta: f64, kappa: f64| term.add(&Pose::new(&[theta, 0.0, 0.0, kappa], 2e3, 1e4), &mut [0.0; 4]);
            let mut force = [0.0; 4];
            term.add(&Pose::new(&[theta, 0.0, 0.0, 3.0], 2e3, 1e4), &mut force);
            let h = 1e-5;
            let by_theta = (energy(theta + h, 3.0) - energy(theta - h, 3.0)) / (2.0 * h);
            let by_kappa = (energy(theta, 3.0 + h) - energy(theta, 3.0 - h)) / (2.0 * h);
            assert!((force[0] / -by_theta - 1.0).abs() < 1e-6, "{fold_m} {theta}: {} {by_theta}", force[0]);
            assert!((force[3] / -by_kappa - 1.0).abs() < 1e-6, "{fold_m}: {} {by_kappa}", force[3]);
        }
    }

    #[test]
    fn the_deepest_fold_is_not_the_best() {
        let tip = |fold: &str| {
            let text = crate::shipped("cpam").unwrap().replace("fold_mm = 24 ", &format!("fold_mm = {fold} "));
            let model = Model::new(&Scenario::parse(&text).unwrap());
            let mut at = model.prediction();
            model.predict(&Loads::uniform(2e3, 30e3), &mut at).unwrap();
            at.tip.y_m
        };
        assert!(tip("18") > tip("24") && tip("18") > tip("12"));
    }
}
