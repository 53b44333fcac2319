//! The body's gauge is off: part of its set pressure never arrives, or more than that is there.
//!
//! At the moments of the hinge alone it is the constant moment πR³p₀ of `tail_tension`; with a wall, displaced gas or loads
//! near collapse it is not.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "body_pressure_offset",
    formula: "p_b = max(0, p_set − p₀)",
    sentence: "The pressure in the body differs from its gauge's reading.",
    differs: "A steady moment is missing or too much, alike at all actuator pressures.",
    remedy: "Put a gauge on the body itself, not on its supply line.",
    validity: "the same at all pressures; like tail_tension where the hinge is all that resists",
    reference: "definition",
    parameters: &[parameter("offset_kpa", "p₀", "kPa", 1e3)
        .usual(0.3, [-3.0, 1.5])
        .possible(ANY)
        .fitted(Fitted::WithBodyPressures)
        .means("set body pressure that does not arrive")],
    add: |values, assembly| {
        let offset_pa = values[0];
        assembly.body.push(Box::new(move |p, _, _| p - offset_pa));
    },
    ..SUPPLY
};
