//! Steady pressure drop between regulator and actuator.
//!
//! ```text
//! P = P_set (1 − f)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f | share of the set pressure that is lost | - |
//!
//! Validity: steady flow; looks like a stiffer body. Supply stage: acts before the balance. Definition.

use super::{Effect, Group, Parameter, Stage};
use crate::assembly::Assembly;

pub(super) const ENTRY: Effect = Effect {
    name: "pressure_loss",
    group: Group::Supply,
    stage: Stage::Supply,
    history: false,
    formula: "P = P_set (1 − f)",
    sentence: "A constant share of the set pressure is lost on the way to the actuator.",
    differs: "The curve over pressure is stretched sideways by the same factor everywhere.",
    remedy: "Put a gauge on the actuator while air flows.",
    validity: "steady flow; looks like a stiffer body",
    reference: "definition",
    parameters: &[Parameter {
        key: "fraction",
        symbol: "f",
        unit: "-",
        si: 1.0,
        neutral: 0.0,
        typical: 0.15,
        lower: 0.0,
        upper: 0.8,
        starts: &[],
        by_actuator: &[],
        meaning: "share of the set pressure that is lost",
    }],
    family: None,
    add,
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let lost = values[0];
    assembly.supply.push(Box::new(move |p, _| p * (1.0 - lost)));
}
