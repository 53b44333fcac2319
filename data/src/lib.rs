//! Measurements and fabric tests as plain structs.
pub mod dataset;
pub use dataset::{Dataset, Hold, Marker, Phase};
