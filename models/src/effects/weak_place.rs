//! A place of the actuator gets less pressure: a pouch that does not fill, a pinched hose, a leak.
//!
//! ```text
//! P(s) = P − a w(s) (P − P₀)₊      w = e^{−((s − c L)/λ)⁴}      λ = q R
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a | share of the pressure that is missing there; below zero more arrives | - |
//! | c | station of its middle, as a share of the body's length | - |
//! | q | half of its length, in body radii | - |
//! | P₀ | pressure above which it is missing | Pa |
//!
//! Divides the body into segments, as transverse loads do. **Validity**: one place; a wall that is softer or stiffer at one place
//! looks alike. Derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "weak_place",
    group: Group::Supply,
    stage: Stage::Supply,
    formula: "P(s) = P − a w(s) (P − P₀)₊, w = e^{−((s − c L)/λ)⁴}, λ = q R",
    sentence: "One place of the actuator pulls less: a pouch that does not fill, a pinched hose, tape on a pouch.",
    differs: "One stretch of the robot stays straighter than the rest, in proportion to the bending.",
    remedy: "Look at that place in the images at full pressure, and press on its pouches: is one of them soft?",
    validity: "one place; a softer or stiffer wall there looks alike",
    reference: "derived here",
    parameters: &[
        Parameter {
            key: "share",
            symbol: "a",
            typical: 0.5,
            lower: -0.5,
            upper: 1.0,
            possible: [-1.0, 1.0],
            meaning: "share of the pressure that is missing there",
            ..PLAIN
        },
        Parameter {
            key: "station",
            symbol: "c",
            neutral: 0.5,
            typical: 0.5,
            lower: 0.2,
            upper: 0.8,
            possible: [0.0, 1.0],
            starts: &[0.25, 0.5, 0.75],
            meaning: "station of its middle, as a share of the body's length",
            ..PLAIN
        },
        Parameter {
            key: "reach_radii",
            symbol: "q",
            neutral: 1.0,
            typical: 1.0,
            lower: 0.3,
            upper: 3.0,
            possible: ABOVE_ZERO,
            meaning: "half of its length, in body radii",
            ..SHAPE
        },
        Parameter {
            key: "from_kpa",
            symbol: "P₀",
            unit: "kPa",
            si: 1e3,
            upper: 20.0,
            starts: &[10.0],
            meaning: "pressure above which it is missing",
            ..SHAPE
        },
    ],
    needs: Needs::Actuator,
    add,
    ..BALANCE
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let [share, station, reach, from_pa] = [values[0], values[1], values[2], values[3]];
    let Some(radius_m) = assembly.sites.first().map(|site| site.radius_m).filter(|_| share != 0.0) else { return };
    let (middle_m, half_m) = (station * assembly.length_m(), reach * radius_m);
    assembly.varies = true;
    assembly.supply.push(Box::new(move |p, at| {
        let weight = (-((at.s_m - middle_m) / half_m).powi(4)).exp();
        p - share * weight * (p - from_pa).max(0.0)
    }));
}
