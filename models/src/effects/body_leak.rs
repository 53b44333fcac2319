//! The body loses pressure during a run: it was filled once and leaks, in proportion to its gauge pressure.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "body_leak",
    history: true,
    formula: "p_b = p_set e^{−r t}",
    sentence: "The body leaks, so its pressure sinks from hold to hold.",
    differs: "The same actuator pressure bends the robot further, the later it is taken.",
    remedy: "Read a gauge on the body at the start and at the end of a run.",
    validity: "filled before every run, valve shut",
    reference: "discharge of a volume",
    parameters: &[parameter("rate_per_min", "r", "1/min", 1.0 / 60.0)
        .usual(0.2, [0.0, 5.0])
        .means("share of the body's pressure lost per time")],
    add: |values, assembly| {
        let rate = values[0];
        if rate != 0.0 {
            assembly.timed = true;
            assembly.body.push(Box::new(move |p, _, at| p * (-rate * at.t_s).exp()));
        }
    },
    ..SUPPLY
};
