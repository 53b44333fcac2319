//! The unpressurised robot is not straight: the wall springs back to a curvature κ₀, not to zero.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "initial_curvature",
    group: Group::Body,
    formula: "E = ½B(κ − κ₀)² − ½Bκ² per metre",
    sentence: "The robot is already a little bent when nothing is switched on.",
    differs: "The robot is bent at zero pressure already, and after unloading as before.",
    remedy: "Measure the markers at zero actuator pressure.",
    validity: "small κ₀; needs B > 0",
    reference: "derived here",
    parameters: &[parameter("curvature_per_m", "κ₀", "1/m", 1.0)
        .usual(0.3, [-2.0, 2.0])
        .possible(ANY)
        .by_actuator(&[("spam", 0.16), ("epam", 0.36), ("cpam", 0.48), ("fpam", 0.19)])
        .means("curvature at rest")],
    add: |values, assembly| {
        for site in &mut assembly.sites {
            let moment = site.bending.stiffness * values[0];
            site.body_terms.push(ENTRY.law(Account::Wall, move |at, force| {
                force[0] += moment;
                -moment * at.q[0]
            }));
        }
    },
    ..BALANCE
};
