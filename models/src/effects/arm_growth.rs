//! Arm growth: the line of action moves away from the body as the actuator swells.
//!
//! ```text
//! D = D₀ + β·lift      pouch: lift = h/2 = L₀(1 − cosθ)/(2θ)      fPAM: lift = r − r₀
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D, D₀ | arm from the taut generator to the line of action, now and at rest | m |
//! | β | 1: the actuator rests on the body and its chord rides on the inner bulge; 0: it stays in the wall | - |
//!
//! The linkage `κD = ηε` then makes the balance lose the share that goes into the growing arm:
//! `N = −U'/(ηε' − κD')`. Validity: β from geometry for external actuators (β = 1), unknown for embedded ones.
//! Derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "arm_growth",
    group: Group::Actuator,
    formula: "D = D₀ + β·lift;  pouch: lift = L₀(1 − cosθ)/(2θ);  fPAM: lift = r − r₀",
    sentence: "The swelling actuator lifts its own line of action off the body, so the same stroke bends it less.",
    differs: "The more the actuator swells, the more bend is missing: the curve over pressure flattens.",
    remedy: "Photograph the side view at full pressure and measure the distance of the pouch chord from the far wall.",
    validity: "β = 1 for actuators on the outside of the body (geometry); a free number for embedded ones",
    reference: "derived here",
    parameters: &[Parameter {
        key: "beta",
        symbol: "β",
        typical: 0.8,
        upper: 2.0,
        possible: [0.0, 2.0],
        meaning: "share of the lift that lengthens the arm",
        ..PLAIN
    }],
    needs: Needs::Actuator,
    add: |values, assembly| {
        for site in &mut assembly.sites {
            site.linkage.arm_growth += values[0];
        }
    },
    ..BALANCE
};
