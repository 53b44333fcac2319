//! ePAM: pouches welded into the wall of the body.
//!
//! Law of [`super::pouch`] with the line of action in the wall: the arm from the taut generator is 2R.

use super::actuator::Actuator;
use super::pattern::{ChamberBottom, Pattern, flat};
use super::pouch::POUCH;

pub(super) const ENTRY: Actuator = Actuator {
    name: "epam",
    title: "embedded pneumatic artificial muscle",
    sentence: "Two concentric bodies welded in a pattern: the pouches are part of the wall.",
    formula: "ε = 1 − sinθ/θ;  N = P W L₀ cosθ/θ;  arm = 2R",
    reference: "Niiyama et al. 2015 (pouch); Abrar et al. 2021 (ePAM; its model text was not available here)",
    validity: "Sealed side edges are not in the bare law, which bends too far: see sealed_sides.",
    // Published: two cylinders welded in a pattern; that they are loose at the sides of the pouches is assumed.
    pattern: |shape| Pattern { body_sheets: 2, ..flat(shape, ChamberBottom::Wall) },
    ..POUCH
};
