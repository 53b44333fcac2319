//! Arm growth: the line of action moves away from the body as the actuator swells.
//!
//! D₀ is the arm from the taut generator to the line of action at rest. β = 1: the actuator rests on the body and its chord rides on the
//! inner bulge; 0: it stays in the wall. The linkage `κD = ηε` then makes the balance lose the share that goes into the growing arm:
//! `N = −U'/(ηε' − κD')`.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "arm_growth",
    formula: "D = D₀ + β·lift;  pouch: lift = L₀(1 − cosθ)/(2θ);  fPAM: lift = r − r₀",
    sentence: "The swelling actuator lifts its own line of action off the body, so the same stroke bends it less.",
    differs: "The more the actuator swells, the more bend is missing: the curve over pressure flattens.",
    remedy: "Photograph the side view at full pressure and measure the distance of the pouch chord from the far wall.",
    validity: "β = 1 for actuators on the outside of the body (geometry); a free number for embedded ones",
    reference: "derived here",
    parameters: &[parameter("beta", "β", "-", 1.0)
        .usual(0.8, [0.0, 2.0])
        .possible([0.0, 2.0])
        .means("share of the lift that lengthens the arm")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        for site in &mut assembly.sites {
            site.linkage.arm_growth += values[0];
        }
    },
    ..BALANCE
};
