//! The missing moment: first what no law of bending can mend, then what moment the model's terms lack at every bend.
//!
//! ```text
//! markers ─► shape: a free bend per hold and place ─► points: missing moment over bend and pressures ─► candidates as curves
//! ```
//!
//! Pure functions over plain structs; nothing here decides a verdict.

mod curve;
pub mod learned;
mod points;
mod shape;
#[cfg(test)]
mod tests;
mod told;
mod view;

pub use curve::{CurvePoint, Path, at_turn, band, curve};
pub use points::{Moments, Point, Robot, missing, moments};
pub use shape::{Shape, Shared, shape};
pub use told::{
    MeasuredShape, MissingMoment, MomentCurve, MomentPoint, SharedNumber, degrees, is_told, sentences, shape_sentences,
    told,
};
pub use view::{Division, Place, View};
