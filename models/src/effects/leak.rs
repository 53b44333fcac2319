//! Leak: the actuator loses air while its pressure is held with the valve shut.
//!
//! ```text
//! P(t) = P_set e^{−r t}      t: time since the pressure was set
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r | leak rate: share of the pressure lost per second | 1/s |
//!
//! **Validity**: valve shut after filling, small gauge pressure, laminar leak. With a regulator that goes on feeding the
//! loss is steady: use `pressure_loss`. Supply stage. Reference: discharge of a volume through a laminar leak; for small
//! r t it is 1 − r t.

use super::*;

pub(super) const ENTRY: Effect = Effect {
    name: "leak",
    group: Group::Supply,
    stage: Stage::Supply,
    history: true,
    formula: "P = P_set e^{−r t}",
    sentence: "The actuator leaks, so its pressure sinks in a hold and the robot slowly straightens.",
    differs: "The bend falls within every hold and is whole again after the next filling.",
    remedy: "Put a gauge on the actuator, shut the valve and watch it for a minute.",
    validity: "valve shut in a hold; laminar leak",
    reference: "discharge of a volume through a laminar leak",
    parameters: &[Parameter {
        key: "rate_per_s",
        symbol: "r",
        unit: "1/s",
        typical: 0.02,
        upper: 0.5,
        meaning: "share of the pressure lost per second",
        ..PLAIN
    }],
    needs: Needs::Actuator,
    add,
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let rate = values[0];
    if rate == 0.0 {
        return;
    }
    assembly.timed = true;
    assembly.supply.push(Box::new(move |p, held_s| p * (-rate * held_s).exp()));
}
