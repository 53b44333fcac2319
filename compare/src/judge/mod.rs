//! How well a prediction meets measurements: numbers, maps and sentences.

pub(crate) mod accuracy;
pub(crate) mod beside_mean;
pub mod evaluate;
pub mod metrics;
pub mod residuals;
pub(crate) mod scaling;
pub mod stats;
pub mod where_it_fails;
pub mod wording;
