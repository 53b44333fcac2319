//! Error at what a fit has not seen of the first data: pressures left out, runs left out. Further data stay in the fit.
//!
//! ```text
//! E |f(θ̂) − y|² = |f − μ|² + noise of y + tr(D C Dᵀ)/n,    C = (JᵀJ)⁻¹
//! ```
//!
//! The first term is the error. The second is the scatter of the values left out, the third the scatter that the fit took over from the
//! rest; both are subtracted. J is the whitened derivative at the data of the fit, D the plain one \[m\] at the n values left out.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::problem::{Fit, FitProblem};
use crate::error::CompareError;
use crate::fit::least_squares::{dot, products, square};
use crate::fit::numbers::groups;
use crate::layout::{values_of, width};
use crate::policy;
use data::Hold;

const MOST_FOLDS: usize = 5;
/// Step of the differences in units of a parameter's scale.
const DIFFERENCE: f64 = 1e-4;
/// A coarse end is enough for an error in hundredths of a millimetre.
const ENOUGH: f64 = 1e-2;

/// Pressures or runs that are left out of a fit and then predicted by it.
struct Fold<'a> {
    problem: FitProblem<'a>,
    holds: Vec<usize>,
    /// What was measured there \[m\], in run layout.
    truth_m: Vec<f64>,
    /// Mean square noise of one value of it \[m²\].
    noise_m2: f64,
    /// The same of the data of the fit: no fit takes over more of it.
    fitted_m2: f64,
    /// Values that too few runs saw.
    unseen: Vec<usize>,
}

pub(crate) struct HeldOut<'a> {
    pressures: Vec<Fold<'a>>,
    runs: Vec<Fold<'a>>,
}

impl<'a> HeldOut<'a> {
    /// Divides the data of a case.
    ///
    /// # Errors
    /// If a covariance cannot be decomposed.
    pub(crate) fn new(case: &DiagnosisCase<'a>) -> Result<HeldOut<'a>, CompareError> {
        Ok(HeldOut { pressures: pressure_folds(case)?, runs: run_folds(case)? })
    }

    /// Error beyond noise at actuator pressures left out \[mm\]; `None` with one pressure.
    pub(crate) fn pressure_mm(&self, fit: &Fit) -> Option<f64> {
        error_mm(&self.pressures, fit)
    }

    /// Error beyond noise of runs left out \[mm\]; `None` with one run.
    pub(crate) fn run_mm(&self, fit: &Fit) -> Option<f64> {
        error_mm(&self.runs, fit)
    }
}

fn error_mm(folds: &[Fold], fit: &Fit) -> Option<f64> {
    let (mut squares, mut values) = (0.0, 0.0);
    for fold in folds {
        let refit = fold.problem.fit(&fit.effects, &[fit.theta().to_vec()])?;
        let block = &fold.problem.blocks[0];
        let predicted = fold.problem.predict(block, &fold.holds, &fit.effects, refit.theta())?;
        let rows = values_of(&block.source.dataset, &fold.holds);
        let rows: Vec<usize> = rows.filter(|i| !fold.unseen.contains(i)).collect();
        let noise_m2 = fold.noise_m2 + taken_over_m2(fold, &refit, &predicted, &rows).min(fold.fitted_m2);
        squares += rows.iter().map(|i| (predicted[*i] - fold.truth_m[*i]).powi(2) - noise_m2).sum::<f64>();
        values += rows.len() as f64;
    }
    (values > 0.0).then(|| 1e3 * (squares.max(0.0) / values).sqrt())
}

/// tr(D C Dᵀ)/n of the parameters that change anything \[m²\]; infinite if the data cannot separate them.
fn taken_over_m2(fold: &Fold, fit: &Fit, predicted_m: &[f64], rows: &[usize]) -> f64 {
    let ranges = fold.problem.ranges(&fit.effects);
    let free: Vec<usize> = (0..ranges.len()).filter(|k| square(&fit.minimum.jacobian[*k]) > 0.0).collect();
    let Some(covariance) = products(&fit.minimum.jacobian, &free).try_inverse() else { return f64::INFINITY };
    let column = |k: &usize| -> Option<Vec<f64>> {
        let step = DIFFERENCE * ranges[*k].scale;
        let mut theta = fit.theta().to_vec();
        theta[*k] += if theta[*k] + step > ranges[*k].upper { -step } else { step };
        let moved = fold.problem.predict(&fold.problem.blocks[0], &fold.holds, &fit.effects, &theta)?;
        let by = theta[*k] - fit.theta()[*k];
        Some(rows.iter().map(|i| (moved[*i] - predicted_m[*i]) / by).collect())
    };
    let Some(columns) = free.iter().map(column).collect::<Option<Vec<_>>>() else { return f64::INFINITY };
    let mut sum = 0.0;
    for (i, a) in columns.iter().enumerate() {
        columns.iter().enumerate().for_each(|(j, b)| sum += covariance[(i, j)] * dot(a, b));
    }
    sum.max(0.0) / rows.len().max(1) as f64
}

fn pressure_folds<'a>(case: &DiagnosisCase<'a>) -> Result<Vec<Fold<'a>>, CompareError> {
    let dataset = &case.first().dataset;
    let pressed = dataset.holds.iter().filter(|hold| hold.sum_act_pa() > policy::ZERO_PRESSURE_PA);
    let pressed: Vec<&Hold> = pressed.collect();
    let levels = groups(&pressed, |a, b| policy::same_channels(a, b));
    if levels.len() < 2 {
        return Ok(Vec::new());
    }
    let (mean, noise) = (dataset.mean_over_runs(), case.noise());
    let width = width(dataset);
    let fold = |own: &Vec<usize>| {
        let is_out = |h: &usize| policy::same_channels(pressed[own[0]], &dataset.holds[*h]);
        let (out, kept): (Vec<usize>, Vec<usize>) = (0..dataset.holds.len()).partition(is_out);
        let count = |h: &usize| noise.seen(h * width..(h + 1) * width) as f64;
        let of_hold = |h: &usize| noise.mean_square(h * width..(h + 1) * width).unwrap_or(0.0) * count(h);
        let noise_m2 = out.iter().map(of_hold).sum::<f64>() / out.iter().map(count).sum::<f64>().max(1.0);
        let fitted_m2 = noise.mean_square(0..mean.len()).unwrap_or(0.0);
        fold(case, (kept, mean.clone()), (out, mean.clone()), [noise_m2, fitted_m2])
    };
    levels.iter().map(fold).collect()
}

fn run_folds<'a>(case: &DiagnosisCase<'a>) -> Result<Vec<Fold<'a>>, CompareError> {
    let dataset = &case.first().dataset;
    let runs = dataset.runs.len();
    if runs < 2 {
        return Ok(Vec::new());
    }
    let folds = runs.min(MOST_FOLDS);
    let all: Vec<usize> = (0..dataset.holds.len()).collect();
    let mean_of = |chosen: &dyn Fn(usize) -> bool| -> Vec<f64> {
        let picked: Vec<usize> = (0..runs).filter(|r| chosen(*r)).collect();
        let mut mean = vec![0.0; dataset.values_per_run()];
        for run in &picked {
            mean.iter_mut().zip(dataset.run(*run)).for_each(|(m, y)| *m += y / picked.len() as f64);
        }
        mean
    };
    let noise = case.noise().mean_square(0..dataset.values_per_run()).unwrap_or(0.0);
    let fold = |k: usize| {
        let out = (k..runs).step_by(folds).count() as f64;
        let (kept, truth) = (mean_of(&|r| r % folds != k), mean_of(&|r| r % folds == k));
        let noises = [out, runs as f64 - out].map(|count| noise * runs as f64 / count);
        fold(case, (all.clone(), kept), (all.clone(), truth), noises)
    };
    (0..folds).map(fold).collect()
}

/// A fit to some holds of the first data, and the holds that it predicts.
fn fold<'a>(
    case: &DiagnosisCase<'a>,
    (kept, target_m): (Vec<usize>, Vec<f64>),
    (holds, truth_m): (Vec<usize>, Vec<f64>),
    [noise_m2, fitted_m2]: [f64; 2],
) -> Result<Fold<'a>, CompareError> {
    let mut problem = FitProblem { enough: ENOUGH, ..case.problem.clone() };
    problem.blocks[0] = problem.blocks[0].to_meet(kept, target_m, case.noise())?;
    let unseen = case.first().dataset.unseen_values().collect();
    Ok(Fold { problem, holds, truth_m, noise_m2, fitted_m2, unseen })
}
