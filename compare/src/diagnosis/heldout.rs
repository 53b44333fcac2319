//! Error at what a fit has not seen of the first data: pressures left out, runs left out. Data beside them stay in the fit.

use super::blocks::block;
use super::case::Case;
use super::problem::{Fit, Problem};
use crate::comparison::ZERO_PRESSURE_PA;
use crate::error::CompareError;

/// Pressures within this fraction are one level.
const SAME_PRESSURE: f64 = 0.05;
/// Parts into which many runs are divided.
const MOST_FOLDS: usize = 5;
/// A coarse end is enough for an error in hundredths of a millimetre.
const ENOUGH: f64 = 1e-2;

/// One part left out.
struct Fold<'a> {
    problem: Problem<'a>,
    /// Holds that are predicted.
    holds: Vec<usize>,
    /// What was measured there \[m\], in run layout.
    truth_m: Vec<f64>,
    /// Mean square noise of one value of it \[m²\].
    noise_m2: f64,
}

/// The parts of a dataset, made once for all effects.
pub struct HeldOut<'a> {
    pressures: Vec<Fold<'a>>,
    runs: Vec<Fold<'a>>,
}

impl<'a> HeldOut<'a> {
    /// Divides the data of a case.
    ///
    /// # Errors
    /// If a covariance cannot be decomposed.
    pub fn new(case: &Case<'a>) -> Result<HeldOut<'a>, CompareError> {
        Ok(HeldOut { pressures: pressure_folds(case)?, runs: run_folds(case)? })
    }

    /// Error beyond noise at actuator pressures left out \[mm\]; `None` with one pressure.
    pub fn pressure_mm(&self, fit: &Fit) -> Option<f64> {
        error_mm(&self.pressures, fit)
    }

    /// Error beyond noise of runs left out \[mm\]; `None` with one run.
    pub fn run_mm(&self, fit: &Fit) -> Option<f64> {
        error_mm(&self.runs, fit)
    }
}

fn error_mm(folds: &[Fold], fit: &Fit) -> Option<f64> {
    let (mut squares, mut values) = (0.0, 0.0);
    for fold in folds {
        let refit = fold.problem.fit(&fit.effects, &[fit.theta().to_vec()])?;
        let block = &fold.problem.blocks[0];
        let (candidates, bendings) = (fold.problem.candidates, fold.problem.bendings);
        let predicted = block.predict_at(&fold.holds, candidates, &fit.effects, refit.theta(), bendings)?;
        let width = predicted.len() / block.dataset.holds.len();
        for i in fold.holds.iter().flat_map(|h| h * width..(h + 1) * width) {
            squares += (predicted[i] - fold.truth_m[i]).powi(2) - fold.noise_m2;
            values += 1.0;
        }
    }
    (values > 0.0).then(|| 1e3 * (squares.max(0.0) / values).sqrt())
}

fn pressure_folds<'a>(case: &Case<'a>) -> Result<Vec<Fold<'a>>, CompareError> {
    let mut levels: Vec<f64> = Vec::new();
    for hold in case.dataset.holds.iter().filter(|h| h.p_act_pa > ZERO_PRESSURE_PA) {
        if !levels.iter().any(|l| same(*l, hold.p_act_pa)) {
            levels.push(hold.p_act_pa);
        }
    }
    if levels.len() < 2 {
        return Ok(Vec::new());
    }
    let mean = case.dataset.mean_over_runs();
    let width = mean.len() / case.dataset.holds.len();
    let fold = |level: &f64| {
        let is_out = |h: &usize| same(*level, case.dataset.holds[*h].p_act_pa);
        let (out, kept): (Vec<usize>, Vec<usize>) = (0..case.dataset.holds.len()).partition(is_out);
        let noise: f64 =
            out.iter().map(|h| case.noise.mean_square(h * width..(h + 1) * width).unwrap_or(0.0)).sum::<f64>();
        let problem = problem(case, &kept, mean.clone())?;
        Ok(Fold { problem, truth_m: mean.clone(), noise_m2: noise / out.len() as f64, holds: out })
    };
    levels.iter().map(fold).collect()
}

fn run_folds<'a>(case: &Case<'a>) -> Result<Vec<Fold<'a>>, CompareError> {
    let runs = case.dataset.runs.len();
    if runs < 2 {
        return Ok(Vec::new());
    }
    let folds = runs.min(MOST_FOLDS);
    let all: Vec<usize> = (0..case.dataset.holds.len()).collect();
    let mean_of = |chosen: &dyn Fn(usize) -> bool| -> Vec<f64> {
        let picked: Vec<usize> = (0..runs).filter(|r| chosen(*r)).collect();
        let mut mean = vec![0.0; case.dataset.values_per_run()];
        for run in &picked {
            mean.iter_mut().zip(case.dataset.run(*run)).for_each(|(m, y)| *m += y / picked.len() as f64);
        }
        mean
    };
    let noise = case.noise.mean_square(0..case.dataset.values_per_run()).unwrap_or(0.0);
    let fold = |k: usize| {
        let out = (k..runs).step_by(folds).count() as f64;
        let problem = problem(case, &all, mean_of(&|r| r % folds != k))?;
        let truth_m = mean_of(&|r| r % folds == k);
        Ok(Fold { problem, holds: all.clone(), truth_m, noise_m2: noise * runs as f64 / out })
    };
    (0..folds).map(fold).collect()
}

fn problem<'a>(case: &Case<'a>, holds: &[usize], target_m: Vec<f64>) -> Result<Problem<'a>, CompareError> {
    let mut blocks = vec![block(&case.source(), holds, target_m, &case.noise, &case.body_pa)?];
    blocks.extend(case.blocks_beside()?);
    let Problem { candidates, bendings, known_bending, ref known, .. } = case.problem;
    Ok(Problem { candidates, blocks, bendings, known_bending, known: known.clone(), enough: ENOUGH })
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= (SAME_PRESSURE * a.abs().max(b.abs())).max(ZERO_PRESSURE_PA)
}
