//! The pressure sensor is not linear: right at zero and at 20 kPa, and off between and beyond.
//!
//! −c is the error of the slope near zero. An error in proportion to the pressure is `pressure_loss`.

use super::entry::*;

/// Pressure at which the sensor is right \[Pa\].
const REFERENCE_PA: f64 = 20e3;

pub(super) const ENTRY: Effect = Effect {
    name: "gauge_curve",
    formula: "P = P_set (1 + c (P_set/P_r − 1)), P_r = 20 kPa",
    sentence: "The pressure sensor is not linear.",
    differs: "The curve over pressure is bowed: off one way in its middle and the other way at its end.",
    remedy: "Compare the sensor with a second gauge at five pressures.",
    validity: "the first term beyond a straight line",
    reference: "definition",
    parameters: &[parameter("curve", "c", "-", 1.0)
        .usual(0.02, [-0.15, 0.15])
        .possible([-1.0, 1.0])
        .means("share by which the pressure is off at twice the reference")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let curve = values[0];
        assembly.supply.push(Box::new(move |p, _| (p * (1.0 + curve * (p / REFERENCE_PA - 1.0))).max(0.0)));
    },
    ..SUPPLY
};
