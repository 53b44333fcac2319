//! The body's gauge is off: part of its set pressure never arrives, or more than that is there.
//!
//! ```text
//! p_b = max(0, p_set − p₀)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | p₀ | set body pressure that does not arrive | kPa |
//!
//! At the moments of the hinge alone it is the constant moment πR³p₀ of `tail_tension`; with a wall, displaced gas or loads
//! near collapse it is not. **Validity**: the same at all pressures. Supply stage: acts before the balance. Definition.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "body_pressure_offset",
    group: Group::Supply,
    stage: Stage::Supply,
    formula: "p_b = max(0, p_set − p₀)",
    sentence: "The pressure in the body differs from its gauge's reading.",
    differs: "A steady moment is missing or too much, alike at all actuator pressures.",
    remedy: "Put a gauge on the body itself, not on its supply line.",
    validity: "the same at all pressures; like tail_tension where the hinge is all that resists",
    reference: "definition",
    parameters: &[Parameter {
        key: "offset_kpa",
        symbol: "p₀",
        unit: "kPa",
        si: 1e3,
        typical: 0.3,
        lower: -3.0,
        upper: 1.5,
        possible: ANY,
        fitted: Fitted::WithBodyPressures,
        meaning: "set body pressure that does not arrive",
        ..PLAIN
    }],
    needs: Needs::Body,
    add: |values, assembly| {
        let offset_pa = values[0];
        assembly.body.push(Box::new(move |p, _, _| p - offset_pa));
    },
    ..BALANCE
};
