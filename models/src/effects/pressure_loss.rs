//! Steady pressure drop between regulator and actuator: air leaves through a leak and loses pressure in the hose.
//!
//! ```text
//! P = P_set − f P_r (P_set/P_r)ⁿ      P_r = 20 kPa;  n = 1: P_set (1 − f)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f | share of the set pressure that is lost at P_r | - |
//! | n | exponent of the loss: hose ΔP ~ qᵃ (a = 1 laminar, 2 turbulent), leak q ~ Pᵇ (b = 1 pores, ½ a hole), n = a b | - |
//!
//! **Validity**: steady flow, small gauge pressures. With n = 1 it looks like a stiffer body. Supply stage: acts before the balance.
//! Reference: Hagen–Poiseuille and orifice flow in series, incompressible.

use super::entry::*;

/// Pressure at which the lost share is f \[Pa\].
const REFERENCE_PA: f64 = 20e3;

pub(super) const ENTRY: Effect = Effect {
    name: "pressure_loss",
    group: Group::Supply,
    stage: Stage::Supply,
    formula: "P = P_set − f P_r (P_set/P_r)ⁿ, P_r = 20 kPa",
    sentence: "A leak takes part of the set pressure.",
    differs: "The curve over pressure is stretched sideways, by the same factor everywhere if n = 1.",
    remedy: "Put a gauge on the actuator while air flows.",
    validity: "steady flow; looks like a stiffer body if n = 1",
    reference: "laminar or turbulent hose (n = 1, 2 times) and a leak through pores or a hole (1, ½), in series",
    parameters: &[
        Parameter {
            key: "fraction",
            symbol: "f",
            typical: 0.15,
            upper: 0.8,
            possible: [0.0, 1.0],
            meaning: "share of the set pressure that is lost at 20 kPa",
            ..PLAIN
        },
        Parameter {
            key: "exponent",
            symbol: "n",
            neutral: 1.0,
            typical: 1.0,
            lower: 0.5,
            upper: 2.0,
            possible: [0.5, 2.0],
            starts: &[0.5, 1.5],
            meaning: "exponent of the loss",
            ..SHAPE
        },
    ],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let (lost, exponent) = (values[0], values[1]);
        if exponent == 1.0 {
            assembly.supply.push(Box::new(move |p, _| p * (1.0 - lost)));
        } else {
            let law = move |p: f64| p - lost * REFERENCE_PA * (p / REFERENCE_PA).powf(exponent);
            assembly.supply.push(Box::new(move |p, _| law(p.max(0.0)).max(0.0)));
        }
    },
    ..BALANCE
};
