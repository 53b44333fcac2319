//! Four tests of whether what a model leaves is noise.
//!
//! | test | looks at | finds |
//! |---|---|---|
//! | all | every value | anything large |
//! | hold means | means over the samples of a hold | small static misfit, which the many values of the first dilute |
//! | drift | late minus early samples of each hold, along the robot's shape | creep, leaks |
//! | marker means | means over all holds | a marker or camera at fault |
//!
//! Each is a χ² of whitened functionals over its degrees of freedom, held against F because σ is estimated. The
//! smallest p times four is the p of the whole.

use super::result::LackOfFit;
use crate::comparison::Comparison;
use crate::error::CompareError;
use crate::layout::{Layout, Weights, apply};
use crate::noise::NoiseModel;
use crate::residuals::residual_map;
use crate::stats::{f_tail, reported_p};
use crate::whiten::Whitener;
use data::Dataset;

/// Tests a prediction; `fitted` parameters were fitted to the data. `None` if no p-values can be formed.
///
/// # Errors
/// If a prediction is not finite or the covariance cannot be decomposed.
pub fn lack_of_fit(
    dataset: &Dataset,
    noise: &NoiseModel,
    prediction_m: &[f64],
    fitted: usize,
) -> Result<Option<LackOfFit>, CompareError> {
    if !noise.gives_p_values() {
        return Ok(None);
    }
    let c = Comparison::new(dataset, noise, prediction_m)?;
    let all = p_of(&noise.whiten(&c.residual_m), fitted, noise);
    let hold_means = p_of(&whitened(&c, &hold_means(&c.layout))?, fitted, noise);
    let marker_means = p_of(&whitened(&c, &marker_means(&c.layout))?, 0, noise);
    let drift = drift(&c, noise);
    let least = [all, hold_means, drift, marker_means].into_iter().fold(1.0, f64::min);
    let p_value = reported_p(4.0 * least);
    let [all, hold_means, drift, marker_means] = [all, hold_means, drift, marker_means].map(reported_p);
    Ok(Some(LackOfFit { all, hold_means, drift, marker_means, p_value }))
}

fn p_of(white: &[f64], fitted: usize, noise: &NoiseModel) -> f64 {
    let dof = white.len().saturating_sub(fitted);
    let chi2: f64 = white.iter().map(|w| w * w).sum();
    if dof == 0 { 1.0 } else { f_tail(chi2 / dof as f64, dof, noise.pure_error_dof) }
}

fn hold_means(layout: &Layout) -> Vec<Weights> {
    let cells = (0..layout.holds).flat_map(|h| (0..layout.markers).map(move |m| (h, m)));
    cells.flat_map(|(h, m)| [0, 1].map(|axis| layout.mean_weights(h, m, axis))).collect()
}

fn marker_means(layout: &Layout) -> Vec<Weights> {
    let share = 1.0 / layout.holds as f64;
    let mean = |m: usize, axis: usize| -> Weights {
        let holds = (0..layout.holds).flat_map(|h| layout.mean_weights(h, m, axis));
        holds.map(|(i, w)| (i, share * w)).collect()
    };
    (0..layout.markers).flat_map(|m| [0, 1].map(|axis| mean(m, axis))).collect()
}

/// Whitened values of means of equally many values each, no value in two of them.
fn whitened(c: &Comparison, means: &[Weights]) -> Result<Vec<f64>, CompareError> {
    let values: Vec<f64> = means.iter().map(|w| apply(w, &c.residual_m)).collect();
    let direction = |w: &Weights| -> [f64; 4] {
        std::array::from_fn(|j| w.iter().map(|(i, share)| share * c.noise.directions[*i][j]).sum())
    };
    let rows: Vec<[f64; 4]> = means.iter().map(direction).collect();
    let unit_m = c.noise.unit_m() / (means.first().map_or(1, Vec::len) as f64).sqrt();
    Ok(Whitener::new(&rows, unit_m, &c.noise.test_variance)?.whiten(&values))
}

fn drift(c: &Comparison, noise: &NoiseModel) -> f64 {
    let z: Vec<f64> = residual_map(c).drifts.iter().filter_map(|d| d.deviation.in_noise).collect();
    p_of(&z, 0, noise)
}
