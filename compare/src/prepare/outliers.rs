//! Samples and runs that stand out.

use serde::Serialize;

/// Samples and runs that stand out from the others.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Outliers {
    /// Samples far from the median over runs; they were replaced by the mean of the other runs.
    pub samples: Vec<data::check::Outlier>,
    /// Share of all samples.
    pub share: f64,
    /// Runs whose shape differs from the others, beyond pressure, alignment and rotation.
    pub runs: Vec<OutlyingRun>,
    /// Pairs of runs that are copies; the second was left out.
    pub copies: Vec<[String; 2]>,
}

/// A run that differs from the others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutlyingRun {
    /// Label.
    pub run: String,
    /// Its scatter over that of the other runs.
    pub scatter_ratio: f64,
    /// p of the ratio, corrected for the number of runs.
    pub p_corrected: f64,
}

impl OutlyingRun {
    /// What to do with it.
    pub fn words(&self) -> String {
        let OutlyingRun { run, scatter_ratio, .. } = self;
        format!(
            "run {run} scatters {scatter_ratio:.1} times as much as the others: look at it before believing anything"
        )
    }
}
