//! Residuals, metrics and reports: the only crate that knows both model and measurement.
//!
//! The statistics of a comparison, from the data up: `layout` (shape of one run) → [`noise`] (run as the unit) →
//! `beside_mean` (prediction beside the mean) → [`metrics`], [`residuals`], [`where_it_fails`], `scaling` →
//! [`evaluate`](mod@evaluate), which bundles them. Predictions arrive as plain slices in run layout.
//!
//! What a user does: [`ScenarioFile`] and [`Evidence`] → [`compare`] → [`diagnose`] → [`extend`] → [`validate`] on other data;
//! [`ladder`](fn@ladder) repeats the middle.

mod accuracy;
pub mod bench;
mod beside_mean;
pub mod characterize;
mod data_slope;
pub mod demo;
pub mod diagnosis;
mod directions;
pub mod error;
pub mod evaluate;
pub mod evidence;
pub mod extension;
mod fit;
mod gauge;
pub mod ladder;
mod layout;
pub mod metrics;
pub mod moment;
pub mod noise;
mod noise_summary;
pub mod policy;
mod prepare;
pub mod progress;
pub mod residuals;
mod run_scatter;
mod scaling;
pub mod scenario_file;
pub mod slips;
pub mod stats;
pub mod study;
pub mod typed_effect;
pub mod validation;
pub mod where_it_fails;
pub mod witness;
pub mod wording;

#[cfg(test)]
mod tests;

pub use diagnosis::{Diagnosis, diagnose};
pub use error::CompareError;
pub use evaluate::{EvaluateOptions, Evaluation, evaluate};
pub use evidence::Evidence;
pub use extension::{Extension, extend};
pub use ladder::ladder;
pub use progress::Progress;
pub use scenario_file::ScenarioFile;
pub use study::comparison::{Comparison, compare};
pub use study::in_space::{InSpace, compare_in_space};
pub use validation::{Validation, validate};
