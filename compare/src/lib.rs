//! Residuals, metrics and reports: the only crate that knows both model and measurement.
//!
//! The statistics of a comparison, from the data up: [`layout`] (shape of one run) → [`noise`] (run as the unit) →
//! [`comparison`] (prediction beside the mean) → [`metrics`], [`residuals`], [`where_it_fails`], [`scaling`] →
//! [`evaluate`](mod@evaluate), which bundles them. Predictions arrive as plain slices in run layout.

pub mod accuracy;
pub mod bench;
pub mod characterize;
pub mod comparison;
mod data_slope;
pub mod diagnosis;
pub mod directions;
pub mod error;
pub mod evaluate;
pub mod gauge;
mod interval;
pub mod known;
pub mod layout;
pub mod metrics;
pub mod noise;
pub mod noise_summary;
pub mod policy;
pub mod residuals;
mod run_scatter;
pub mod scaling;
pub mod slips;
pub mod stats;
pub mod study;
pub mod where_it_fails;
pub mod whiten;
pub mod wording;

#[cfg(test)]
mod monte_carlo;
#[cfg(test)]
mod scenarios;
#[cfg(test)]
mod synthetic;

pub use error::CompareError;
pub use evaluate::{EvaluateOptions, Evaluation, evaluate};
