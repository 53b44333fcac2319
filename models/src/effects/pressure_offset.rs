//! Dead band or sensor bias: part of the set pressure never reaches the actuator.
//!
//! ```text
//! P = max(0, P_set − P₀)          P₀ ≥ 0
//! P = P_set + min(−P₀, P_set)      P₀ < 0: nothing arrives where nothing is set
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P₀ | set pressure that does not arrive | kPa |
//!
//! Validity: constant over the range of pressures. Supply stage: acts before the balance. Definition.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "pressure_offset",
    group: Group::Supply,
    stage: Stage::Supply,
    formula: "P = max(0, P_set − P₀); for P₀ < 0 P_set + min(−P₀, P_set)",
    sentence: "The pressure is off by a constant: dead band, sensor bias, or pouches that open only against the body's pressure; below zero more arrives than is set.",
    differs: "The curve over pressure is shifted sideways: the error is largest where it is steep.",
    remedy: "Put a gauge on the actuator. If it reads the set pressure, change the body's: an offset that grows with it is the pouches'.",
    validity: "constant over the range of pressures",
    reference: "definition",
    parameters: &[Parameter {
        key: "offset_kpa",
        symbol: "P₀",
        unit: "kPa",
        si: 1e3,
        typical: 2.0,
        lower: -5.0,
        upper: 8.0,
        possible: ANY,
        meaning: "set pressure that does not arrive",
        ..PLAIN
    }],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let offset = values[0];
        // A vented line stays vented, and from there the pressure rises without a jump.
        assembly.supply.push(Box::new(move |p, _| if p > 0.0 { (p - offset.max(-p)).max(0.0) } else { p }));
    },
    ..BALANCE
};
