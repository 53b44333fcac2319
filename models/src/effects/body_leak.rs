//! The body loses pressure during a run: it was filled once and leaks.
//!
//! ```text
//! p_b = p_set e^{−r t}
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r | share of the body's pressure lost per time | 1/s |
//! | t | time since the start of the run | s |
//!
//! **Validity**: filled before every run, valve shut, outflow in proportion to the gauge pressure. Discharge of a volume.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "body_leak",
    group: Group::Supply,
    stage: Stage::Supply,
    history: true,
    formula: "p_b = p_set e^{−r t}",
    sentence: "The body leaks, so its pressure sinks from hold to hold.",
    differs: "The same actuator pressure bends the robot further, the later it is taken.",
    remedy: "Read a gauge on the body at the start and at the end of a run.",
    validity: "filled before every run, valve shut",
    reference: "discharge of a volume",
    parameters: &[Parameter {
        key: "rate_per_min",
        symbol: "r",
        unit: "1/min",
        si: 1.0 / 60.0,
        typical: 0.2,
        upper: 5.0,
        meaning: "share of the body's pressure lost per time",
        ..PLAIN
    }],
    add,
    ..BALANCE
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let rate = values[0];
    if rate != 0.0 {
        assembly.timed = true;
        assembly.body.push(Box::new(move |p, _, at| p * (-rate * at.t_s).exp()));
    }
}
