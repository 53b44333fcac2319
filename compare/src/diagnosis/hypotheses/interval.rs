//! Intervals of the parameters of a fit ([`crate::fit::interval`]).

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::problem::Fit;
use crate::diagnosis::source::DiagnosisSource;
use crate::fit::interval::{FittedData, half_width, of_parameter, weights};
use crate::fit::least_squares::Residuals;
use crate::fit::numbers::differences;

/// Intervals of all parameters of a fit, SI; `None` if the noise is unknown or the data do not hold the parameter.
pub(crate) fn intervals<'c>(case: &'c DiagnosisCase<'c>, fit: &Fit, profiled: bool) -> Vec<Option<[f64; 2]>> {
    let part = |(i, source): (usize, &'c DiagnosisSource)| -> FittedData<'c> {
        let block = &case.problem.blocks[i];
        let residual_m = differences(&case.prediction_of(block, fit), &block.target_m);
        let readings = source.gauge.as_ref().map_or(0, |gauge| gauge.readings.len());
        FittedData { dataset: &source.dataset, noise: &case.noises[i], residual_m, misfit: fit.misfit[i], readings }
    };
    let data: Vec<FittedData> = case.sources.iter().enumerate().map(part).collect();
    let Some(jacobian) = case.problem.jacobian_allowing(fit) else { return vec![None; fit.theta().len()] };
    (0..fit.theta().len()).map(|k| one(case, fit, (&data, &jacobian), k, profiled)).collect()
}

fn one(
    case: &DiagnosisCase,
    fit: &Fit,
    (data, jacobian): (&[FittedData], &[Vec<f64>]),
    k: usize,
    profiled: bool,
) -> Option<[f64; 2]> {
    let ranges = case.problem.ranges(&fit.effects);
    let (weights, squares) = weights(jacobian, k)?;
    let half = half_width(data, &weights, ranges.iter().filter(|range| range.is_free()).count())?;
    let mut residuals = |at: &[f64]| case.problem.residuals_allowing(&fit.misfit, &fit.effects, at);
    let residuals: Option<&mut Residuals> = if profiled { Some(&mut residuals) } else { None };
    of_parameter(k, fit.theta(), &ranges, (half, squares), residuals)
}
