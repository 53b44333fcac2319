//! 95 % intervals of fitted parameters.
//!
//! The fit is linear near its end: parameter k = w_kᵀȳ with weights from the whitened Jacobian. Its variance is taken from
//! the best estimate of the noise, not from the widened one of the tests, as camera part plus run-to-run parts; t has the
//! degrees of freedom of that sum over all data (Welch–Satterthwaite), so that three runs give wide intervals. Where a bound is near or
//! the interval exceeds 30 % of the value, the profile of the sum of squares replaces the linear one.

use super::basis::Basis;
use super::case::Case;
use super::least_squares::{dot, minimise, square};
use super::problem::Fit;
use crate::noise::SENSOR_SD;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Half-width over value above which the profile is followed.
const WIDE: f64 = 0.3;
/// Halvings of the bracket of a profile's end.
const HALVINGS: usize = 10;
/// Degrees of freedom beyond which t is normal to three digits. The quantile of `statrs` is 1.83 in place of 1.96 at 1e7, and at
/// 1e8 it does not return.
const MOST_DOF: f64 = 1e4;

/// Intervals of all parameters of a fit, SI; `None` if the noise is unknown or the data do not hold the parameter.
pub fn intervals(case: &Case, fit: &Fit, profiled: bool) -> Vec<Option<[f64; 2]>> {
    (0..fit.theta().len()).map(|k| interval(case, fit, k, profiled)).collect()
}

fn interval(case: &Case, fit: &Fit, k: usize, profiled: bool) -> Option<[f64; 2]> {
    let range = case.problem.ranges(&fit.effects)[k];
    let jacobian = &fit.minimum.jacobian;
    let others: Vec<Vec<f64>> = (0..jacobian.len()).filter(|j| *j != k).map(|j| jacobian[j].clone()).collect();
    let own = Basis::of(&others).rest(&jacobian[k]);
    let squares = square(&own);
    if squares <= 1e-9 * square(&jacobian[k]) || squares == 0.0 {
        return None;
    }
    let half = half_width(case, &own.iter().map(|v| v / squares).collect::<Vec<_>>())?;
    let value = fit.theta()[k];
    let free = value - half >= range.lower && value + half <= range.upper;
    if free && half <= WIDE * value.abs() || !profiled {
        return Some([(value - half).max(range.lower), (value + half).min(range.upper)]);
    }
    let rise = half * half * squares;
    Some([-1.0, 1.0].map(|side| profile_end(case, fit, k, side * half, rise)))
}

/// Half-width of the interval of wᵀȳ, `white` being the weights on whitened values.
fn half_width(case: &Case, white: &[f64]) -> Option<f64> {
    let (mut total, mut squares_over_dof, mut from) = (0.0, 0.0, 0);
    for (source, noise) in case.sources() {
        let to = from + noise.directions.len();
        let read = source.gauge.map_or(0, |gauge| gauge.readings.len());
        let sigma = noise.sigma_m?;
        // The whitening matrix is symmetric: weights on raw values are the whitened weights on white ones.
        let weights = noise.whiten(&white[from..to]);
        let runs = noise.runs as f64;
        let camera = sigma * sigma / runs * square(&weights);
        let run_to_run: f64 = (0..4)
            .map(|j| {
                let along: f64 = weights.iter().zip(&noise.directions).map(|(w, u)| w * u[j]).sum();
                along * along * noise.mean_variance[j].max(SENSOR_SD[j].powi(2) / runs)
            })
            .sum();
        let gauge: f64 = noise.gauge_errors.iter().map(|c| dot(&weights, c).powi(2)).sum();
        // Errors of the gauge are specified, or widened already: unit variance of what is whitened.
        total += gauge + square(&white[to..to + read]);
        let run_dof = noise.runs.saturating_sub(noise.sessions).max(1) as f64;
        total += camera + run_to_run;
        squares_over_dof += camera * camera / noise.pure_error_dof.max(1) as f64 + run_to_run * run_to_run / run_dof;
        from = to + read;
    }
    // A bending stiffness measured by itself, of unit variance too.
    total += square(&white[from..]);
    let dof = total * total / squares_over_dof;
    let t = StudentsT::new(0.0, 1.0, dof.clamp(1.0, MOST_DOF)).ok()?.inverse_cdf(0.975);
    Some(t * total.sqrt())
}

/// Where the least sum of squares at a fixed parameter has risen by `rise`, or the bound.
fn profile_end(case: &Case, fit: &Fit, k: usize, step: f64, rise: f64) -> f64 {
    let mut ranges = case.problem.ranges(&fit.effects);
    let (lower, upper) = (ranges[k].lower, ranges[k].upper);
    let mut theta = fit.theta().to_vec();
    let value = theta[k];
    let mut is_inside = |x: f64| {
        ranges[k].lower = x;
        ranges[k].upper = x;
        theta[k] = x;
        let mut residuals = |at: &[f64]| case.problem.residuals(&fit.effects, at);
        let found = minimise(&theta, &ranges, 1e-2, &mut residuals);
        found.is_some_and(|m| m.cost < fit.cost() + rise)
    };
    let bound = if step > 0.0 { upper } else { lower };
    let beyond = |x: f64| if step > 0.0 { x >= bound } else { x <= bound };
    let (mut inside, mut outside) = (value, value + 0.5 * step);
    while !beyond(outside) && is_inside(outside) {
        inside = outside;
        outside = value + 2.0 * (outside - value);
    }
    if beyond(outside) {
        if is_inside(bound) {
            return bound;
        }
        outside = bound;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if is_inside(middle) { inside = middle } else { outside = middle }
    }
    0.5 * (inside + outside)
}
