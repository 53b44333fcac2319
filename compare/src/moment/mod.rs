//! The missing moment: first what no law of bending can mend, then what moment the model's terms lack at every bend.
//!
//! ```text
//! markers ─► shape: a free bend per hold and place ─► points: missing moment over bend and pressures ─► candidates as curves
//! ```
//!
//! Pure functions over plain structs; nothing here decides a verdict.

mod curve;
pub(crate) mod learned;
mod points;
mod result;
mod shape;
#[cfg(test)]
mod tests;
mod told;
mod view;

pub(crate) use curve::{CurvePoint, PressurePath, at_turn, band, curve};
pub(crate) use points::{Moments, RobotScenarios, missing, moments};
pub use result::{MeasuredShape, MissingMoment, MomentCurve, MomentPoint, SharedNumber};
pub(crate) use shape::{Shape, shape};
pub(crate) use told::{degrees, sentences, shape_sentences};
pub(crate) use view::View;
