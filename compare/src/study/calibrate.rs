//! Calibration of one number on a dataset: the effective bending stiffness B, or the body's pressure.

use crate::error::CompareError;
use crate::evaluate::EvaluateOptions;
use crate::fit::interval::{FittedData, half_width, interval};
use crate::fit::whiten::MISFIT_ROUNDS;
use crate::noise::NoiseModel;
use crate::policy;
use crate::study::predict::{first_slope, predict_dataset};
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;
use data::Dataset;
use models::Scenario;

/// Which number of a scenario a calibration fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Knob {
    /// Effective bending stiffness B of the body \[N·m²\].
    Bending,
    /// Body pressure \[kPa\]; in data of several, the scenario's; the others shift by the same amount.
    BodyPressure,
}

impl std::str::FromStr for Knob {
    type Err = String;

    fn from_str(text: &str) -> Result<Knob, String> {
        match text {
            "bending" => Ok(Knob::Bending),
            "body-pressure" => Ok(Knob::BodyPressure),
            _ => Err("known: bending, body-pressure".into()),
        }
    }
}

impl Knob {
    fn word(self) -> &'static str {
        match self {
            Knob::Bending => "B",
            Knob::BodyPressure => "the body pressure",
        }
    }

    fn set(self, scenario: &Scenario, value: f64) -> Scenario {
        match self {
            Knob::Bending => scenario.with_bending(value),
            Knob::BodyPressure => scenario.with_effect("body_pressure_offset", &[scenario.p_body_pa - 1e3 * value]),
        }
    }

    fn reach(self, scenario: &Scenario) -> [f64; 2] {
        match self {
            Knob::Bending => [policy::MOST_BENDING, 1e-4],
            Knob::BodyPressure => [2e-3 * scenario.p_body_pa, 1e-4],
        }
    }
}

/// A number fitted to the mean over runs, with its interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// What was found, in the unit of its [`Knob`].
    pub value: f64,
    /// Its 95 % interval; `None` when the noise is unknown.
    pub interval: Option<[f64; 2]>,
    /// The model misses the data by more than noise, and the interval holds that.
    pub misses: bool,
    /// The fit ended on a bound: this number does not explain the data.
    pub at_bound: bool,
    /// The scenario with the fitted value.
    pub scenario: Scenario,
}

/// A value that no robot shows: as good as none.
const SMALLEST: f64 = 1e-9;

/// Whitened sum of squares over `s = √value`, which makes small values as easy to find as large.
#[derive(Clone)]
struct Misfit<'a> {
    knob: Knob,
    scenario: &'a Scenario,
    dataset: &'a Dataset,
    noise: &'a NoiseModel,
    mean_m: Vec<f64>,
}

impl Misfit<'_> {
    fn at(&self, value: f64) -> Result<f64, CompareError> {
        Ok(self.noise.whiten(&self.residual_m(value)?).iter().map(|r| r * r).sum())
    }

    fn residual_m(&self, value: f64) -> Result<Vec<f64>, CompareError> {
        let predicted = predict_dataset(&self.knob.set(self.scenario, value), self.dataset)?;
        Ok(predicted.coordinates_m.iter().zip(&self.mean_m).map(|(f, y)| f - y).collect())
    }
}

impl CostFunction for Misfit<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, root: &f64) -> Result<f64, argmin::core::Error> {
        Ok(self.at(root * root)?)
    }
}

/// Fits one number ≥ 0 to a dataset, everything else fixed; a **calibrated** number, not a prediction.
pub fn calibrate(
    scenario: &Scenario,
    dataset: &Dataset,
    options: &EvaluateOptions,
    knob: Knob,
) -> Result<Calibration, CompareError> {
    let estimate = |slope: &[f64]| NoiseModel::estimate(dataset, slope, &options.sessions, options.sigma_m);
    // Twice: the noise needs a model that fits, and the scenario's own value shall not matter.
    let least = Misfit {
        knob,
        scenario,
        dataset,
        noise: &estimate(&first_slope(scenario, dataset)?)?,
        mean_m: dataset.mean_over_runs(),
    };
    let (root, ..) = fit(&least)?;
    let noise = estimate(&predict_dataset(&knob.set(scenario, root * root), dataset)?.d_ln_pressure_m)?;
    let (best, wider, factor) = fit(&Misfit { noise: &noise, ..least.clone() })?;
    let misfit = Misfit { noise: &wider, ..least.clone() };
    let value = best * best;
    let is_zero = value < SMALLEST || misfit.at(0.0)? <= misfit.at(value)?;
    let at_bound = is_zero || best > 0.999 * knob.reach(scenario)[0].sqrt();
    let value = if is_zero { 0.0 } else { value };
    let found = interval_of(&misfit, value, (&noise, factor))?;
    let (interval, misses) = found.map_or((None, false), |(ends, misses)| (Some(ends), misses));
    Ok(Calibration { value, interval, misses, at_bound, scenario: knob.set(scenario, value) })
}

/// √value, the noise that it was fitted in, wider if the model misses the data, and by which factor.
fn fit(least: &Misfit) -> Result<(f64, NoiseModel, f64), CompareError> {
    let count = least.noise.seen(0..least.mean_m.len()) as f64;
    let mut best = minimum(least)?;
    let (mut wider, mut factor) = (least.noise.clone(), 1.0);
    if policy::is_a_misfit(least.at(best * best)? / count) {
        for _ in 0..MISFIT_ROUNDS {
            factor = (least.at(best * best)? / count).max(1.0);
            wider = least.noise.wider(factor);
            best = minimum(&Misfit { noise: &wider, ..least.clone() })?;
        }
    }
    Ok((best, wider, factor))
}

/// √value of the least misfit: the best of a coarse scan, then Brent's method around it.
fn minimum(misfit: &Misfit) -> Result<f64, CompareError> {
    let top = misfit.knob.reach(misfit.scenario)[0].sqrt();
    let grid: Vec<f64> = (0..=24).map(|i| top * (f64::from(i) / 24.0).powi(2)).collect();
    let costs = grid.iter().map(|s| misfit.at(s * s)).collect::<Result<Vec<_>, _>>()?;
    let best = (0..grid.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b])).unwrap_or(0);
    let (low, high) = (grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)]);
    let solver = BrentOpt::new(low, high).set_tolerance(1e-6, 1e-9);
    let run = Executor::new(misfit.clone(), solver)
        .configure(|state| state.max_iters(100))
        .run()
        .map_err(|e| CompareError::Fit { what: misfit.knob.word(), problem: e.to_string() })?;
    Ok(run.state.get_best_param().copied().unwrap_or(grid[best]))
}

/// Its interval, and whether a misfit is in it, from the noise and the factor by which it was widened; `None` if the noise is unknown.
fn interval_of(
    misfit: &Misfit,
    value: f64,
    (noise, factor): (&NoiseModel, f64),
) -> Result<Option<([f64; 2], bool)>, CompareError> {
    let [most, step] = misfit.knob.reach(misfit.scenario);
    let residual_m = misfit.residual_m(value)?;
    let moved = misfit.residual_m(value + step)?;
    let slope: Vec<f64> = moved.iter().zip(&residual_m).map(|(a, b)| (a - b) / step).collect();
    let own = misfit.noise.whiten(&slope);
    let squares: f64 = own.iter().map(|v| v * v).sum();
    if squares == 0.0 {
        return Ok(None);
    }
    let data = [FittedData { dataset: misfit.dataset, noise, residual_m, misfit: factor, readings: 0 }];
    let Some(half) = half_width(&data, &own.iter().map(|v| v / squares).collect::<Vec<_>>(), 1) else {
        return Ok(None);
    };
    let least = misfit.at(value)?;
    let mut rise = |value: f64| misfit.at(value).map_or(f64::INFINITY, |cost| cost - least);
    Ok(Some((interval((value, half, squares), [0.0, most], Some(&mut rise)), half.misses)))
}
