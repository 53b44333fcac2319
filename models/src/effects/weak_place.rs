//! A place of the actuator gets less pressure: a pouch that does not fill, a pinched hose, a leak.
//!
//! Below a = 0 more arrives there. Divides the body into segments, as transverse loads do.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "weak_place",
    formula: "P(s) = P − a w(s) (P − P₀)₊, w = e^{−((s − c L)/λ)⁴}, λ = q R",
    sentence: "One place of the actuator pulls less: a pouch that does not fill, a pinched hose, tape on a pouch.",
    differs: "One stretch of the robot stays straighter than the rest, in proportion to the bending.",
    remedy: "Look at that place in the images at full pressure, and press on its pouches: is one of them soft?",
    validity: "one place; a softer or stiffer wall there looks alike",
    reference: "derived here",
    parameters: &[
        parameter("share", "a", "-", 1.0)
            .usual(0.5, [-0.5, 1.0])
            .possible([-1.0, 1.0])
            .means("share of the pressure that is missing there"),
        parameter("station", "c", "-", 1.0)
            .around(0.5, [0.2, 0.8])
            .possible([0.0, 1.0])
            .starts(&[0.25, 0.5, 0.75])
            .means("station of its middle, as a share of the body's length"),
        shape("reach_radii", "q", "-", 1.0)
            .around(1.0, [0.3, 3.0])
            .possible(ABOVE_ZERO)
            .means("half of its length, in body radii"),
        shape("from_kpa", "P₀", "kPa", 1e3)
            .usual(0.0, [0.0, 20.0])
            .starts(&[10.0])
            .means("pressure above which it is missing"),
    ],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let [share, station, reach, from_pa] = [values[0], values[1], values[2], values[3]];
        let Some(radius_m) = assembly.sites.first().map(|site| site.radius_m).filter(|_| share != 0.0) else { return };
        let (middle_m, half_m) = (station * assembly.length_m(), reach * radius_m);
        assembly.varies = true;
        assembly.supply.push(Box::new(move |p, at| {
            let weight = (-((at.s_m - middle_m) / half_m).powi(4)).exp();
            p - share * weight * (p - from_pa).max(0.0)
        }));
    },
    ..SUPPLY
};
