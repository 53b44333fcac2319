//! Steady pressure drop between regulator and actuator: air leaves through a leak and loses pressure in the hose.
//!
//! n = a b of a hose ΔP ~ qᵃ and a leak q ~ Pᵇ in series, incompressible and at small gauge pressures (Hagen–Poiseuille, orifice flow).

use super::entry::*;

/// Pressure at which the lost share is f \[Pa\].
const REFERENCE_PA: f64 = 20e3;

pub(super) const ENTRY: Effect = Effect {
    name: "pressure_loss",
    formula: "P = P_set − f P_r (P_set/P_r)ⁿ, P_r = 20 kPa",
    sentence: "A leak takes part of the set pressure.",
    differs: "The curve over pressure is stretched sideways, by the same factor everywhere if n = 1.",
    remedy: "Put a gauge on the actuator while air flows.",
    validity: "steady flow; looks like a stiffer body if n = 1",
    reference: "laminar or turbulent hose (n = 1, 2 times) and a leak through pores or a hole (1, ½), in series",
    parameters: &[
        parameter("fraction", "f", "-", 1.0)
            .usual(0.15, [0.0, 0.8])
            .possible([0.0, 1.0])
            .means("share of the set pressure that is lost at 20 kPa"),
        shape("exponent", "n", "-", 1.0)
            .around(1.0, [0.5, 2.0])
            .possible([0.5, 2.0])
            .starts(&[0.5, 1.5])
            .means("exponent of the loss"),
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
    ..SUPPLY
};
