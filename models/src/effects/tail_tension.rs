//! A constant moment along the body that does not depend on the actuator: tail or tether tension, offset seams.
//!
//! `M = −ΔM tanh(κ/k₀)` with the step width k₀ of the body; ΔM is negative if it helps to bend.

use super::entry::*;
use crate::body::soft_step;

pub(super) const ENTRY: Effect = Effect {
    name: "tail_tension",
    group: Group::Body,
    formula: "E = ΔM k₀ ln cosh(κ/k₀) per metre",
    sentence: "A pull along the robot (tail, tether, offset seam) adds a constant resisting moment.",
    differs: "A steady moment is missing, alike at all pressures: largest share of the bend at low pressure.",
    remedy: "Free the tail or weigh its pull; repeat at another body pressure.",
    validity: "constant along the robot and in pressure",
    reference: "derived here",
    parameters: &[parameter("moment_nm", "ΔM", "N m", 1.0)
        .usual(0.45, [-0.3, 1.5])
        .possible(ANY)
        .means("extra resisting moment")],
    add: |values, assembly| {
        let moment = values[0];
        for site in &mut assembly.sites {
            site.body_terms.push(ENTRY.law(Account::Wall, move |at, force| {
                let (energy, slope) = soft_step(at.q[0], STEP);
                force[0] -= moment * slope;
                moment * energy
            }));
        }
    },
    ..BALANCE
};

/// Curvature over which the step sets in \[1/m\], as for the body's hinge.
const STEP: f64 = 0.05;
