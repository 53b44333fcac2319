//! The wall is stiffer at the base than at the tip, or the other way round.
//!
//! Divides the body into segments, as transverse loads do.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "tapered_wall",
    group: Group::Body,
    formula: "B(s) = B (1 + a (1 − 2 s/L))",
    sentence: "The wall is stiffer at the base than at the tip, or the other way round: glue, a taper, a seam that widens.",
    differs: "The bend grows steadily from one end of the robot to the other.",
    remedy: "Hang a known force on the inflated body's middle and then on its tip: do both give one stiffness?",
    validity: "linear along the body; needs B > 0",
    reference: "derived here",
    parameters: &[parameter("share", "a", "-", 1.0)
        .usual(0.3, [-0.95, 0.95])
        .possible([-1.0, 1.0])
        .means("extra stiffness at the base as a share of B")],
    add: |values, assembly| {
        let (share, length_m) = (values[0], assembly.length_m());
        if share == 0.0 {
            return;
        }
        assembly.varies = true;
        for site in &mut assembly.sites {
            let stiffness = share * site.bending.stiffness;
            site.body_terms.push(ENTRY.law(Account::Wall, move |at, force| {
                let moment = stiffness * (1.0 - 2.0 * at.s_m / length_m) * at.q[0];
                force[0] -= moment;
                0.5 * moment * at.q[0]
            }));
        }
    },
    ..BALANCE
};
