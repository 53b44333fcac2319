//! Intervals of the parameters of a fit ([`crate::fit::interval`]).

use super::case::Case;
use super::problem::Fit;
use super::source::Source;
use crate::fit::basis::own_part;
use crate::fit::interval::{FittedData, half_width, interval};
use crate::fit::least_squares::{Range, minimise, square};

/// Intervals of all parameters of a fit, SI; `None` if the noise is unknown or the data do not hold the parameter.
pub fn intervals<'c>(case: &'c Case<'c>, fit: &Fit, profiled: bool) -> Vec<Option<[f64; 2]>> {
    let part = |(i, source): (usize, &'c Source)| -> FittedData<'c> {
        let block = &case.problem.blocks[i];
        let residual_m = case.prediction_of(block, fit).iter().zip(&block.target_m).map(|(f, y)| f - y).collect();
        let readings = source.gauge.as_ref().map_or(0, |gauge| gauge.readings.len());
        FittedData { dataset: &source.dataset, noise: &case.noises[i], residual_m, misfit: fit.misfit[i], readings }
    };
    let data: Vec<FittedData> = case.sources.iter().enumerate().map(part).collect();
    let Some(jacobian) = case.problem.jacobian_allowing(fit) else { return vec![None; fit.theta().len()] };
    (0..fit.theta().len()).map(|k| one(case, fit, (&data, &jacobian), k, profiled)).collect()
}

fn one(
    case: &Case,
    fit: &Fit,
    (data, jacobian): (&[FittedData], &[Vec<f64>]),
    k: usize,
    profiled: bool,
) -> Option<[f64; 2]> {
    let ranges = case.problem.ranges(&fit.effects);
    let own = own_part(jacobian, k);
    let squares = square(&own);
    if squares <= 1e-9 * square(&jacobian[k]) || squares == 0.0 {
        return None;
    }
    let fitted = ranges.iter().filter(|range| range.is_free()).count();
    let half = half_width(data, &own.iter().map(|v| v / squares).collect::<Vec<_>>(), fitted)?;
    let least = square(&case.problem.residuals_allowing(&fit.misfit, &fit.effects, fit.theta())?);
    let (mut theta, mut held) = (fit.theta().to_vec(), case.problem.ranges(&fit.effects));
    let mut rise = |x: f64| {
        (held[k], theta[k]) = (Range::fixed(x, held[k].scale), x);
        let mut residuals = |at: &[f64]| case.problem.residuals_allowing(&fit.misfit, &fit.effects, at);
        minimise(&theta, &held, 1e-2, &mut residuals).map_or(f64::INFINITY, |found| found.cost - least)
    };
    let rise: Option<&mut dyn FnMut(f64) -> f64> = if profiled { Some(&mut rise) } else { None };
    Some(interval((fit.theta()[k], half, squares), [ranges[k].lower, ranges[k].upper], rise))
}
