//! The body is sealed, or its regulator is slow: its pressure rises as the actuator bends the robot and takes its room.
//!
//! P is the largest set pressure of any actuator. A gas of volume V that loses ΔV rises by (p_atm + p_b) ΔV/V; over the pressures of a test
//! the bend, and with it ΔV, grows nearly in proportion to P.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "sealed_body",
    formula: "p_b = p_set + c P",
    sentence: "The body is sealed, so its pressure rises as the actuator bends the robot.",
    differs: "The robot bends less the higher the pressure: the body that resists it gets harder.",
    remedy: "Read a gauge on the body without and with actuator pressure.",
    validity: "first order in the actuator's pressure",
    reference: "derived here",
    parameters: &[parameter("rise", "c", "-", 1.0)
        .usual(0.01, [0.0, 0.2])
        .possible(ANY)
        .means("rise of the body's pressure per actuator pressure")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let rise = values[0];
        if rise != 0.0 {
            assembly.body.push(Box::new(move |p, actuator_pa, _| p + rise * actuator_pa));
        }
    },
    ..SUPPLY
};
