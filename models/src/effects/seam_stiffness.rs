//! Fold and seam stiffness of a pouch: every arc has to be bent against its welds.
//!
//! θ is the half arc angle. For small θ the contraction goes as θ²/6, so this is a constant moment 3kD/L₀: there it cannot be distinguished
//! from `tail_tension`.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "seam_stiffness",
    formula: "E = ½ k θ²/L₀ per metre",
    sentence: "Welds and folds of the pouches resist rolling up, like a small spring in every pouch.",
    differs: "A steady moment is missing: nothing moves at first, then the bend comes late.",
    remedy: "Measure the force of one inflated pouch at small contraction, or bend an unpressurised weld by hand.",
    validity: "elastic folds; for small bends not separable from tail_tension",
    reference: "derived here",
    parameters: &[parameter("stiffness_nm_per_rad", "k", "N m/rad", 1.0)
        .usual(0.5, [0.0, 3.0])
        .means("fold stiffness of one pouch")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Pouch) {
            let per_length = values[0] / site.shape.length_m;
            site.actuator_terms.push(ENTRY.law(Account::Wall, move |at, force| {
                let angle = at.q[actuator_q::COORDINATE];
                force[actuator_q::COORDINATE] -= per_length * angle;
                0.5 * per_length * angle * angle
            }));
        }
    },
    ..BALANCE
};
