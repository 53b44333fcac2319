//! sPAM / pouch motor: separate pouches taped onto the body.
//!
//! Law of [`super::pouch`]. Its line of action is **outside** the body: the chord of the lens is lifted by the inner
//! bulge, h/2, so the arm grows with pressure. That is the effect `arm_growth` with β = 1, stated in the scenario, so
//! that a user sees what it costs.

use super::actuator::Actuator;
use super::pattern::{ChamberBottom, Film, flat};
use super::pouch::POUCH;

pub(super) const ENTRY: Actuator = Actuator {
    name: "spam",
    title: "series pneumatic artificial muscle / pouch motor",
    sentence: "Flat pouches in series, welded at their ends and taped onto the body; each becomes a lens and shortens.",
    formula: "ε = 1 − sinθ/θ;  N = P W L₀ cosθ/θ;  arm = 2R + β h/2, h = L₀(1 − cosθ)/θ",
    reference: "Niiyama et al. 2015 (pouch motor); arm of an external pouch derived here",
    validity: "Sealed side edges and stiff tape are not in the bare law, which bends too far: see sealed_sides.",
    // Published: two layers welded at their sides and taped onto the body; the whole face is assumed to be taped.
    pattern: |shape| flat(shape, ChamberBottom::Bonded { film: Film::Tape, warp_rad: 0.0 }),
    ..POUCH
};
