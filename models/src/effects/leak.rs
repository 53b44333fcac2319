//! Leak: the actuator loses air while its pressure is held with the valve shut.
//!
//! ```text
//! dP/dt = −r P (P/P_r)^{k−1}      P_r = 20 kPa;  k = 1: P(t) = P_set e^{−r t}      t: time since the pressure was set
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r | leak rate: share of the pressure lost per second | 1/s |
//! | k | exponent of the flow: 1 through pores, ½ through a hole | - |
//!
//! **Validity**: valve shut after filling, small gauge pressure. With a regulator that goes on feeding the
//! loss is steady: use `pressure_loss`. Supply stage. Reference: discharge of a volume through a leak (k = 1: Poiseuille,
//! k = ½: Torricelli); for small r t it is 1 − r t.

use super::entry::*;

/// Pressure at which r is the share lost per second, whatever the exponent \[Pa\].
const REFERENCE_PA: f64 = 20e3;

pub(super) const ENTRY: Effect = Effect {
    name: "leak",
    group: Group::Supply,
    stage: Stage::Supply,
    history: true,
    formula: "dP/dt = −r P (P/P_r)^{k−1}, P_r = 20 kPa;  k = 1: P = P_set e^{−r t}",
    sentence: "The actuator leaks, so its pressure sinks in a hold and the robot slowly straightens.",
    differs: "The bend falls within every hold and is whole again after the next filling.",
    remedy: "Put a gauge on the actuator, shut the valve and watch it for a minute.",
    validity: "valve shut in a hold",
    reference: "discharge of a volume through pores or a hole (k = 1, ½)",
    parameters: &[
        Parameter {
            key: "rate_per_s",
            symbol: "r",
            unit: "1/s",
            typical: 0.02,
            upper: 0.5,
            meaning: "share of the pressure lost per second, at 20 kPa",
            ..PLAIN
        },
        Parameter {
            key: "exponent",
            symbol: "k",
            neutral: 1.0,
            typical: 1.0,
            lower: 0.3,
            upper: 3.0,
            possible: ABOVE_ZERO,
            meaning: "exponent of the flow through the leak",
            ..SHAPE
        },
    ],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let [rate, exponent] = [values[0], values[1]];
        if rate == 0.0 {
            return;
        }
        assembly.timed = true;
        assembly.supply.push(Box::new(move |p, at| p * left(p / REFERENCE_PA, rate * at.held_s, exponent)));
    },
};

/// Share of a pressure (over P_r) that is left after r t: 1 − (1 − k) r t u^{k−1} to the power of 1/(1 − k), or e^{−r t}.
fn left(p: f64, lost: f64, exponent: f64) -> f64 {
    let more = exponent - 1.0;
    if more == 0.0 || p <= 0.0 {
        return (-lost).exp();
    }
    (1.0 + more * lost * p.powf(more)).max(0.0).powf(-1.0 / more)
}
