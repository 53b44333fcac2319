//! Residuals, metrics and reports: the only crate that knows both model and measurement.
//!
//! The statistics of a comparison, from the data up: `layout` (shape of one run) → [`noise`] (run as the unit) →
//! `beside_mean` (prediction compared with the mean) → [`metrics`], [`residuals`], [`where_it_fails`], `scaling` →
//! [`evaluate`](mod@evaluate), which bundles them. Predictions arrive as plain slices in run layout.
//!
//! What a user does: [`ScenarioFile`] and [`Evidence`] → [`compare`] → [`diagnose`] → [`extend`] → [`validate`] on other data;
//! [`ladder`](fn@ladder) repeats the middle.

pub mod characterize;
pub mod demo;
pub mod diagnosis;
pub mod error;
pub mod extension;
mod fit;
pub mod foreign;
mod judge;
pub mod moment;
pub mod policy;
pub mod progress;
mod readings;
pub mod slips;
pub mod study;
pub mod witness;

#[cfg(test)]
mod tests;

pub use diagnosis::{Diagnosis, diagnose};
pub use error::CompareError;
pub use evaluate::{EvaluateOptions, Evaluation, evaluate};
pub use evidence::Evidence;
pub use extension::{Extension, extend};
pub use extension::{ladder, scenario_file, typed_effect, validation};
pub use judge::scaling::ScalingCheck;
pub use judge::{evaluate, metrics, residuals, stats, where_it_fails, wording};
pub use ladder::ladder;
pub use progress::Progress;
pub use readings::noise_summary::NoiseSummary;
pub use readings::{bench, evidence, noise};
pub use scenario_file::ScenarioFile;
pub use study::comparison::{Comparison, compare};
pub use validation::{Validation, validate};

use judge::{accuracy, beside_mean, scaling};
use readings::{data_slope, directions, gauge, hold_scatter, layout, noise_summary, prepare, run_scatter};
