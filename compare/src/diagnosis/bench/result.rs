//! Result of a diagnosis of a table.

use crate::diagnosis::result::{Group, ParameterValue, Verdict};
use serde::Serialize;

/// Level, assumed scatter and refit of the scenario's own numbers in [`super::diagnose_bench`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BenchOptions {
    /// Level of the one corrected p-value.
    pub alpha: f64,
    /// Standard deviation of a row that states none, as a share of the measured value.
    pub sigma: Option<f64>,
    /// Fit what the scenario has along with every law.
    pub refit: bool,
}

impl Default for BenchOptions {
    fn default() -> Self {
        BenchOptions { alpha: crate::diagnosis::options::Options::default().alpha, sigma: None, refit: false }
    }
}

/// Errors of a model at what its fit had not seen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOut {
    /// Kind of part that was left out: `pressure`, `specimen` or `load`.
    pub what: &'static str,
    /// Typical factor by which it is off, less one, all parts together.
    pub off: f64,
    /// Parts in which no other law of the table was better in the fit.
    pub first_in: usize,
    /// How many parts were left out, one at a time.
    pub parts: usize,
}

/// One law, fitted together with the base.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchRanked {
    /// Name of the effect, or of the number of the scenario.
    pub effect: String,
    /// What the law belongs to: actuator, body, load, supply or measurement.
    pub group: Group,
    /// What the law does, in one plain sentence.
    pub sentence: String,
    /// What measurements show where it is missing.
    pub differs: String,
    /// What to measure to see whether the law acts.
    pub remedy: String,
    /// Fitted values of the law's parameters.
    pub parameters: Vec<ParameterValue>,
    /// A value sits on its physical bound and the data push beyond: rejected.
    pub at_bound: bool,
    /// Typical factor by which the model is off with it, less one.
    pub off: f64,
    /// Fall of the whitened sum of squares against the base.
    pub gain: f64,
    /// p of the gain, corrected for all laws tried; `None` without standard deviations.
    pub p_corrected: Option<f64>,
    /// At what was left out of the fit.
    pub left_out: Vec<LeftOut>,
    /// Fits these data as well as the best.
    pub in_set: bool,
}

/// Everything a diagnosis of a table found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchDiagnosis {
    /// File of the bench table that was diagnosed.
    pub table: String,
    /// Kind of the bench table, such as `load_deflection`.
    pub kind: &'static str,
    /// Model that it was compared with.
    pub scenario: String,
    /// Number of rows of the table.
    pub rows: usize,
    /// Whether all rows have a standard deviation.
    pub noise_known: bool,
    /// Verdict of the diagnosis; `None` without standard deviations.
    pub verdict: Option<Verdict>,
    /// One p of "nothing is missing", corrected for everything that was tried.
    pub p_value: Option<f64>,
    /// Level at which it is judged.
    pub alpha: f64,
    /// Typical factor by which the base is off, less one: the rms of logarithms.
    pub off: f64,
    /// Rms standard deviation of the means, as a share.
    pub noise: Option<f64>,
    /// Mean square of the base's residuals in standard errors.
    pub reduced_chi2: Option<f64>,
    /// What was fitted to make the base.
    pub base: Vec<ParameterValue>,
    /// The base at what was left out.
    pub left_out: Vec<LeftOut>,
    /// Laws that were tried, the best first.
    pub ranked: Vec<BenchRanked>,
    /// Whether the best of them leaves noise, or less than a fifth of the error.
    pub explains: bool,
    /// Effects that would act, by a size that neither table nor scenario gives.
    pub unsized_laws: Vec<String>,
    /// The answer and its reasons, one sentence each.
    pub summary: Vec<String>,
    /// Where the model as it is fails.
    pub where_it_fails: Vec<String>,
    /// Where it fails with the best law.
    pub leftover: Vec<String>,
}

impl BenchDiagnosis {
    /// Laws that fit as well as the best, best first.
    pub fn set(&self) -> impl Iterator<Item = &BenchRanked> {
        self.ranked.iter().filter(|r| r.in_set)
    }
}
