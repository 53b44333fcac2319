//! Four tests of whether what a model leaves is noise.
//!
//! | test | looks at | finds |
//! |---|---|---|
//! | all | every value | anything large |
//! | hold means | means over the samples of a hold | small static misfit, which the many values of the first dilute |
//! | drift | late minus early samples of each hold, along the robot's shape | creep, leaks |
//! | marker means | means over all holds | a marker or camera at fault |
//!
//! Where a gauge was read at the actuator, its readings against the supply's laws are a fifth ([`with_supply`]).
//!
//! Each is a χ² of whitened functionals over its degrees of freedom, compared with F because σ is estimated. The
//! smallest p times four is the p of the whole.

use crate::beside_mean::BesideMean;
use crate::diagnosis::result::LackOfFit;
use crate::error::CompareError;
use crate::gauge::Gauge;
use crate::layout::{Layout, Weights, apply};
use crate::noise::NoiseModel;
use crate::residuals::residual_map;
use crate::stats::{f_tail, reported_p};
use data::Dataset;

/// Tests a prediction; `fitted` parameters were fitted to the data. `None` if no p-values can be formed.
///
/// # Errors
/// If a prediction is not finite or the covariance cannot be decomposed.
pub(crate) fn lack_of_fit(
    dataset: &Dataset,
    noise: &NoiseModel,
    prediction_m: &[f64],
    fitted: usize,
) -> Result<Option<LackOfFit>, CompareError> {
    if !noise.gives_p_values() {
        return Ok(None);
    }
    let c = BesideMean::new(dataset, noise, prediction_m)?;
    let values = noise.seen(0..c.residual_m.len());
    let all = p_of(&noise.whiten(&c.residual_m), values.saturating_sub(fitted), noise);
    let means = values / c.layout.samples;
    let hold_means = p_of(&whitened(&c, &hold_means(&c.layout))?, means.saturating_sub(fitted), noise);
    let marker_means = p_of(&whitened(&c, &marker_means(&c))?, c.layout.axes * c.layout.markers, noise);
    let drift = drift(&c, noise);
    let least = [all, hold_means, drift, marker_means].into_iter().fold(1.0, f64::min);
    let p_value = reported_p(4.0 * least);
    let [all, hold_means, drift, marker_means] = [all, hold_means, drift, marker_means].map(reported_p);
    Ok(Some(LackOfFit { all, hold_means, drift, marker_means, supply: None, p_value }))
}

/// The same with the gauge's test of the supply; `white` are its readings minus the laws, whitened.
pub(crate) fn with_supply(lof: LackOfFit, gauge: &Gauge, white: &[f64]) -> LackOfFit {
    let chi2: f64 = white.iter().map(|w| w * w).sum();
    let p = f_tail(chi2 / white.len() as f64, white.len(), gauge.dof);
    LackOfFit { supply: Some(reported_p(p)), p_value: (1.25 * lof.p_value).min(reported_p(5.0 * p)), ..lof }
}

fn p_of(white: &[f64], dof: usize, noise: &NoiseModel) -> f64 {
    let chi2: f64 = white.iter().map(|w| w * w).sum();
    if dof == 0 { 1.0 } else { f_tail(chi2 / dof as f64, dof, noise.pure_error_dof) }
}

fn hold_means(layout: &Layout) -> Vec<Weights> {
    let cells = (0..layout.holds).flat_map(|h| (0..layout.markers).map(move |m| (h, m)));
    cells.flat_map(|(h, m)| (0..layout.axes).map(move |axis| layout.mean_weights(h, m, axis))).collect()
}

/// Of the holds in which a marker was seen; their squares have the same total for every marker.
fn marker_means(c: &BesideMean) -> Vec<Weights> {
    let layout = &c.layout;
    let mean = |m: usize, axis: usize| -> Weights {
        let seen: Vec<usize> = (0..layout.holds).filter(|h| c.dataset.is_seen(*h, m)).collect();
        let share = 1.0 / (layout.holds as f64 * seen.len() as f64).sqrt();
        let holds = seen.into_iter().flat_map(|h| layout.mean_weights(h, m, axis));
        holds.map(|(i, w)| (i, share * w)).collect()
    };
    (0..layout.markers).flat_map(|m| (0..layout.axes).map(move |axis| mean(m, axis))).collect()
}

/// Whitened values of means of equally many values each, no value in two of them.
fn whitened(c: &BesideMean, means: &[Weights]) -> Result<Vec<f64>, CompareError> {
    let values: Vec<f64> = means.iter().map(|w| apply(w, &c.residual_m)).collect();
    Ok(c.noise.whitener_of(means)?.whiten(&values))
}

fn drift(c: &BesideMean, noise: &NoiseModel) -> f64 {
    let z: Vec<f64> = residual_map(c).drifts.iter().filter_map(|d| d.deviation.in_noise).collect();
    p_of(&z, z.len(), noise)
}
