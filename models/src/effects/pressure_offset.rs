//! Dead band or sensor bias: part of the set pressure never reaches the actuator.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "pressure_offset",
    formula: "P = max(0, P_set − P₀); for P₀ < 0 P_set + min(−P₀, P_set)",
    sentence: "The pressure is off by a constant: dead band, sensor bias, or pouches that open only against the body's pressure; below zero more arrives than is set.",
    differs: "The curve over pressure is shifted sideways: the error is largest where it is steep.",
    remedy: "Put a gauge on the actuator. If it reads the set pressure, change the body's: an offset that grows with it is the pouches'.",
    validity: "constant over the range of pressures",
    reference: "definition",
    parameters: &[parameter("offset_kpa", "P₀", "kPa", 1e3)
        .usual(2.0, [-5.0, 8.0])
        .possible(ANY)
        .means("set pressure that does not arrive")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let offset = values[0];
        // A vented line stays vented, and from there the pressure rises without a jump.
        assembly.supply.push(Box::new(move |p, _| if p > 0.0 { (p - offset.max(-p)).max(0.0) } else { p }));
    },
    ..SUPPLY
};
