//! Leak: the actuator loses air while its pressure is held with the valve shut.
//!
//! t is the time since the pressure was set. k is 1 through pores (Poiseuille), ½ through a hole (Torricelli), at small gauge pressures. With
//! a regulator that goes on feeding the loss is steady: use `pressure_loss`.

use super::entry::*;

/// Pressure at which r is the share lost per second, whatever the exponent \[Pa\].
const REFERENCE_PA: f64 = 20e3;

pub(super) const ENTRY: Effect = Effect {
    name: "leak",
    history: true,
    formula: "dP/dt = −r P (P/P_r)^{k−1}, P_r = 20 kPa;  k = 1: P = P_set e^{−r t}",
    sentence: "The actuator leaks, so its pressure sinks in a hold and the robot slowly straightens.",
    differs: "The bend falls within every hold and is whole again after the next filling.",
    remedy: "Put a gauge on the actuator, shut the valve and watch it for a minute.",
    validity: "valve shut in a hold",
    reference: "discharge of a volume through pores or a hole (k = 1, ½)",
    parameters: &[
        parameter("rate_per_s", "r", "1/s", 1.0)
            .usual(0.02, [0.0, 0.5])
            .means("share of the pressure lost per second, at 20 kPa"),
        shape("exponent", "k", "-", 1.0)
            .around(1.0, [0.3, 3.0])
            .possible(ABOVE_ZERO)
            .means("exponent of the flow through the leak"),
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
    ..SUPPLY
};

/// Share of a pressure (over P_r) that is left after r t: 1 − (1 − k) r t u^{k−1} to the power of 1/(1 − k), or e^{−r t}.
fn left(p: f64, lost: f64, exponent: f64) -> f64 {
    let more = exponent - 1.0;
    if more == 0.0 || p <= 0.0 {
        return (-lost).exp();
    }
    (1.0 + more * lost * p.powf(more)).max(0.0).powf(-1.0 / more)
}
