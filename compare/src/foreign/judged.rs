//! Whether a correction of another simulator's predictions helps on data that it was not fitted to.

use super::{BaseTable, in_run_layout};
use crate::data_slope::data_slope;
use crate::error::CompareError;
use crate::evaluate::{EvaluateOptions, evaluate};
use crate::evidence::Evidence;
use crate::prepare::prepare;
use crate::validation::Validation;
use data::{CorrectionTable, Dataset, parse_predictions};

/// The predictions with and without the correction, compared with data. Nothing is fitted.
///
/// # Errors
/// Predictions that are not for these data; holds outside the pressures of the correction.
pub fn judge(
    correction: &CorrectionTable,
    base: &BaseTable,
    evidence: &Evidence,
    sigma_m: Option<f64>,
) -> Result<Validation, CompareError> {
    let prepared = prepare(&evidence.dataset, evidence.about.as_ref());
    let dataset = in_plane(prepared.dataset);
    let before = in_run_layout(&dataset, &parse_predictions(&base.file, &base.text, &dataset)?);
    let mut after = before.clone();
    after.iter_mut().zip(correction.moved_m(&dataset)?).for_each(|(value, moved)| *value += moved);
    dataset.unseen_values().for_each(|i| after[i] = before[i]);
    let slope = data_slope(&dataset).unwrap_or_else(|| vec![0.0; before.len()]);
    let sessions = prepared.sessions;
    let options = EvaluateOptions { sigma_m, bootstrap_samples: 0, sessions, ..EvaluateOptions::default() };
    let compared = |prediction_m: &[f64]| evaluate(&dataset, prediction_m, &slope, &options);
    let fitted_to_these = correction.data_sha256.contains(&evidence.sha256()?);
    Ok(Validation::of(evidence, [&compared(&before)?, &compared(&after)?], fitted_to_these, prepared.warnings))
}

fn in_plane(dataset: Dataset) -> Dataset {
    if dataset.has_z() { dataset.in_plane() } else { dataset }
}
