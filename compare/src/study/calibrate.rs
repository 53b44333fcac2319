//! Calibration of the effective bending stiffness B on a dataset.

use crate::error::CompareError;
use crate::evaluate::EvaluateOptions;
use crate::interval::{Fitted, half_width, interval};
use crate::noise::NoiseModel;
use crate::study::predict::{first_slope, predict_dataset};
use crate::whiten::{MISFIT, MISFIT_ROUNDS};
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;
use data::Dataset;
use models::Scenario;

/// A fitted bending stiffness.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Calibration {
    /// Effective bending stiffness B \[N·m²\].
    pub bending_nm2: f64,
    /// Its 95 % interval \[N·m²\]; `None` when the noise is unknown.
    pub interval_nm2: Option<[f64; 2]>,
    /// The model misses the data by more than noise, and the interval holds that.
    pub misses: bool,
    /// The fit ended on a bound: B does not explain the data.
    pub at_bound: bool,
}

/// Largest B searched \[N·m²\]: 100 times what a 0.2 mm coated fabric would need at these sizes.
const MAX_BENDING: f64 = 200.0;
/// B that no robot shows \[N·m²\]: as good as none.
const SMALLEST_BENDING: f64 = 1e-9;
/// Step of B in its derivative \[N·m²\].
const STEP: f64 = 1e-4;

/// Whitened sum of squares over `s = √B`, which makes small B as easy to find as large.
struct Misfit<'a> {
    scenario: &'a Scenario,
    dataset: &'a Dataset,
    noise: &'a NoiseModel,
    mean_m: Vec<f64>,
}

impl Misfit<'_> {
    fn at(&self, bending: f64) -> Result<f64, CompareError> {
        Ok(self.noise.whiten(&self.residual_m(bending)?).iter().map(|r| r * r).sum())
    }

    /// Prediction minus mean \[m\].
    fn residual_m(&self, bending: f64) -> Result<Vec<f64>, CompareError> {
        let predicted = predict_dataset(&self.scenario.with_bending(bending), self.dataset)?;
        Ok(predicted.xy_m.iter().zip(&self.mean_m).map(|(f, y)| f - y).collect())
    }
}

impl CostFunction for Misfit<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, root: &f64) -> Result<f64, argmin::core::Error> {
        Ok(self.at(root * root)?)
    }
}

/// Fits B ≥ 0 to a dataset, everything else fixed; a **calibrated** number, not a prediction.
///
/// # Errors
/// What the model or the noise estimate returns.
pub fn calibrate_bending(
    scenario: &Scenario,
    dataset: &Dataset,
    options: &EvaluateOptions,
) -> Result<Calibration, CompareError> {
    let estimate = |slope: &[f64]| NoiseModel::estimate(dataset, slope, &options.sessions, options.sigma_m);
    // Twice: the noise needs a model that fits, and the scenario's own B shall not matter.
    let (root, ..) = fit(scenario, dataset, estimate(&first_slope(scenario, dataset)?)?)?;
    let fitted = predict_dataset(&scenario.with_bending(root * root), dataset)?;
    let noise = estimate(&fitted.d_ln_pressure_m)?;
    let (best, wider, factor) = fit(scenario, dataset, noise.clone())?;
    let misfit = Misfit { scenario, dataset, noise: &wider, mean_m: dataset.mean_over_runs() };
    let bending_nm2 = best * best;
    let is_zero = bending_nm2 < SMALLEST_BENDING || misfit.at(0.0)? <= misfit.at(bending_nm2)?;
    let at_bound = is_zero || best > 0.999 * MAX_BENDING.sqrt();
    let bending_nm2 = if is_zero { 0.0 } else { bending_nm2 };
    let found = interval_of(&misfit, bending_nm2, (&noise, factor))?;
    let interval_nm2 = found.map(|(ends, _)| ends);
    Ok(Calibration { bending_nm2, interval_nm2, misses: found.is_some_and(|(_, misses)| misses), at_bound })
}

/// √B, the noise that it was fitted in, wider if the model misses the data, and by which factor.
fn fit(scenario: &Scenario, dataset: &Dataset, noise: NoiseModel) -> Result<(f64, NoiseModel, f64), CompareError> {
    let mean_m = dataset.mean_over_runs();
    let count = noise.seen(0..mean_m.len()) as f64;
    let least = Misfit { scenario, dataset, noise: &noise, mean_m };
    let mut best = minimum(&least)?;
    let (mut wider, mut factor) = (noise.clone(), 1.0);
    if least.at(best * best)? > MISFIT * count {
        for _ in 0..MISFIT_ROUNDS {
            factor = (least.at(best * best)? / count).max(1.0);
            wider = noise.wider(factor);
            best = minimum(&Misfit { noise: &wider, mean_m: least.mean_m.clone(), ..least })?;
        }
    }
    Ok((best, wider, factor))
}

/// √B of the least misfit: the best of a coarse scan, then Brent's method around it.
fn minimum(misfit: &Misfit) -> Result<f64, CompareError> {
    let top = MAX_BENDING.sqrt();
    let grid: Vec<f64> = (0..=24).map(|i| top * (f64::from(i) / 24.0).powi(2)).collect();
    let costs = grid.iter().map(|s| misfit.at(s * s)).collect::<Result<Vec<_>, _>>()?;
    let best = (0..grid.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b])).unwrap_or(0);
    let (low, high) = (grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)]);
    let solver = BrentOpt::new(low, high).set_tolerance(1e-6, 1e-9);
    let run = Executor::new(Misfit { mean_m: misfit.mean_m.clone(), ..*misfit }, solver)
        .configure(|state| state.max_iters(100))
        .run()
        .map_err(|e| CompareError::Fit { what: "B", problem: e.to_string() })?;
    Ok(run.state.get_best_param().copied().unwrap_or(grid[best]))
}

/// Its interval, and whether a misfit is in it, from the noise and the factor by which it was widened; `None` if the noise is unknown.
fn interval_of(
    misfit: &Misfit,
    bending: f64,
    (noise, factor): (&NoiseModel, f64),
) -> Result<Option<([f64; 2], bool)>, CompareError> {
    let residual_m = misfit.residual_m(bending)?;
    let moved = misfit.residual_m(bending + STEP)?;
    let slope: Vec<f64> = moved.iter().zip(&residual_m).map(|(a, b)| (a - b) / STEP).collect();
    let own = misfit.noise.whiten(&slope);
    let squares: f64 = own.iter().map(|v| v * v).sum();
    if squares == 0.0 {
        return Ok(None);
    }
    let data = [Fitted { dataset: misfit.dataset, noise, residual_m, misfit: factor, readings: 0 }];
    let Some(half) = half_width(&data, &own.iter().map(|v| v / squares).collect::<Vec<_>>(), 1) else {
        return Ok(None);
    };
    let least = misfit.at(bending)?;
    let mut rise = |b: f64| misfit.at(b).map_or(f64::INFINITY, |cost| cost - least);
    Ok(Some((interval((bending, half, squares), [0.0, MAX_BENDING], Some(&mut rise)), half.misses)))
}
