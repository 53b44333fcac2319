//! A scenario and a dataset made ready for hypotheses: noise, calibrated base, catalogue.

use super::basis::{Basis, cosine};
use super::candidates::{Candidate, candidates, present};
use super::options::Options;
use super::problem::{Block, Fit, Problem, with_effects};
use super::screen::trace;
use crate::comparison::Comparison;
use crate::error::CompareError;
use crate::evaluate::default_tolerance_m;
use crate::layout::Layout;
use crate::noise::NoiseModel;
use crate::stats::f_tail;
use crate::study::predict_dataset;
use crate::whiten::Whitener;
use data::Dataset;
use models::Scenario;
use nalgebra::{DMatrix, SymmetricEigen};

/// Body pressures within this fraction share a bending stiffness.
const SAME_BODY_PRESSURE: f64 = 0.05;
/// Fits end when a round lowers the whitened sum of squares by less.
const ENOUGH: f64 = 1e-4;
/// Rounds of the eigenvalue iteration; a handful suffice.
const EIGEN_ROUNDS: usize = 1000;

/// What every hypothesis is held against.
pub struct Case<'a> {
    /// The base as given, with the dataset's markers and loads.
    pub scenario: &'a Scenario,
    /// The data.
    pub dataset: &'a Dataset,
    /// Noise of their mean.
    pub noise: NoiseModel,
    /// The fit.
    pub problem: Problem<'a>,
    /// Effects in every hypothesis: the scenario's own, if they are refitted.
    pub always: Vec<usize>,
    /// Effects that may be missing.
    pub tried: Vec<usize>,
    /// Body pressures with a bending stiffness of their own \[Pa\].
    pub body_pa: Vec<f64>,
    /// The calibrated base.
    pub base: Fit,
    /// Independent tests among the effects tried.
    pub tests: f64,
    /// Error below which a model is good enough \[m\].
    pub tolerance_m: f64,
    /// Level of the one corrected p-value.
    pub alpha: f64,
}

/// Catalogue of a diagnosis: the scenario's own effects first if they are refitted, then those that may be missing.
pub fn catalogue(scenario: &Scenario, options: &Options) -> (Vec<Candidate>, usize) {
    let mut list = if options.refit_present { present(scenario) } else { Vec::new() };
    let own = list.len();
    list.extend(candidates(scenario));
    (list, own)
}

impl<'a> Case<'a> {
    /// Estimates the noise and fits the base, twice: each needs the other.
    ///
    /// # Errors
    /// What the model or the noise estimate returns.
    pub fn new(
        scenario: &'a Scenario,
        dataset: &'a Dataset,
        sessions: &[usize],
        (candidates, own): (&'a [Candidate], usize),
        options: &Options,
    ) -> Result<Case<'a>, CompareError> {
        let estimate = |slope: &[f64]| NoiseModel::estimate(dataset, slope, sessions, options.sigma_m);
        Case::with_noise(scenario, dataset, &estimate, (candidates, own), options)
    }

    /// The same with noise from elsewhere, as a function of ∂f/∂ln p.
    ///
    /// # Errors
    /// What the model or the noise returns.
    pub fn with_noise(
        scenario: &'a Scenario,
        dataset: &'a Dataset,
        noise: &dyn Fn(&[f64]) -> Result<NoiseModel, CompareError>,
        (candidates, own): (&'a [Candidate], usize),
        options: &Options,
    ) -> Result<Case<'a>, CompareError> {
        Layout::of(dataset)?;
        let body_pa = body_pressures(dataset);
        let bendings = if options.keep_bending { 0 } else { body_pa.len() };
        let always: Vec<usize> = (0..own).collect();
        let values: Vec<f64> = candidates[..own].iter().flat_map(|c| own_values(scenario, c)).collect();
        let mut slope = predict_dataset(scenario, dataset)?.d_ln_pressure_m;
        let fit = |slope: &[f64]| -> Result<(NoiseModel, Problem<'a>, Fit), CompareError> {
            let noise = noise(slope)?;
            let all: Vec<usize> = (0..dataset.holds.len()).collect();
            let block = block(scenario, dataset, &all, dataset.mean_over_runs(), &noise, &body_pa)?;
            let problem = Problem { candidates, blocks: vec![block], bendings, enough: ENOUGH };
            let base = problem.fit_base(&always, &values).ok_or_else(no_base)?;
            Ok((noise, problem, base))
        };
        let (_, problem, base) = fit(&slope)?;
        slope = derivative(&problem, &base)?;
        let (noise, problem, base) = fit(&slope)?;
        let d_max_m = Comparison::new(dataset, &noise, &dataset.mean_over_runs())?.d_max_m;
        Ok(Case {
            scenario,
            dataset,
            noise,
            always,
            tests: independent_tests(&problem, &base, own..candidates.len()),
            problem,
            tried: (own..candidates.len()).collect(),
            body_pa,
            base,
            tolerance_m: options.tolerance_m.unwrap_or_else(|| default_tolerance_m(d_max_m)),
            alpha: options.alpha,
        })
    }

    /// Catalogue entry.
    pub fn candidate(&self, effect: usize) -> &Candidate {
        &self.problem.candidates[effect]
    }

    /// Prediction of a fit in run layout \[m\].
    pub fn prediction(&self, fit: &Fit) -> Vec<f64> {
        let block = &self.problem.blocks[0];
        let predicted =
            block.predict_at(&block.holds, self.problem.candidates, &fit.effects, fit.theta(), self.problem.bendings);
        // A fit ends at a place that was predicted before, so there is a prediction.
        predicted.unwrap_or_else(|| self.dataset.mean_over_runs())
    }

    /// Error beyond noise of a prediction \[mm\]; the root-mean-square error if the noise is unknown.
    pub fn error_mm(&self, prediction_m: &[f64]) -> f64 {
        let mean = &self.problem.blocks[0].target_m;
        let squares = prediction_m.iter().zip(mean).map(|(f, y)| (f - y).powi(2)).sum::<f64>() / mean.len() as f64;
        let noise = self.noise.mean_square(0..mean.len()).unwrap_or(0.0);
        1e3 * (squares - noise).max(0.0).sqrt()
    }

    /// Error beyond noise that no scatter between runs explains \[mm\]: from the whitened sum of squares, whose expectation
    /// under noise is its degrees of freedom. Pressure, alignment and rotation of a run do not count.
    pub fn beyond_noise_mm(&self, fit: &Fit) -> f64 {
        let dof = fit.minimum.residual.len().saturating_sub(fit.theta().len()).max(1) as f64;
        1e3 * self.noise.unit_m() * (fit.cost() / dof - 1.0).max(0.0).sqrt()
    }

    /// Fall of the whitened sum of squares against the calibrated base.
    pub fn gain(&self, fit: &Fit) -> f64 {
        (self.base.cost() - fit.cost()).max(0.0)
    }

    /// Parameters beyond the base.
    pub fn extra(&self, fit: &Fit) -> usize {
        self.problem.count(&fit.effects) - self.problem.count(&self.always)
    }

    /// p of a gain by `parameters`, the best of `tests`; `None` if no p-values can be formed.
    pub fn p_of_gain(&self, gain: f64, parameters: usize, tests: f64) -> Option<f64> {
        let q = parameters.max(1);
        let p = tests * f_tail(gain / q as f64, q, self.noise.pure_error_dof);
        self.noise.gives_p_values().then_some(p.min(1.0))
    }

    /// Whether a parameter of its effects sits on a bound against which the data push.
    pub fn is_rejected(&self, fit: &Fit) -> bool {
        fit.binding[self.problem.bendings..].iter().any(|b| *b)
    }
}

/// Effective number of independent tests, `(Σ√λ)²/Σλ` over the eigenvalues λ of the correlations between the effects' first
/// traces (Galwey 2009): twins are one test, not two. An effect without a first trace, a threshold, is one of its own.
fn independent_tests(problem: &Problem, base: &Fit, tried: std::ops::Range<usize>) -> f64 {
    let free = Basis::of(&base.minimum.jacobian);
    let count = tried.len();
    let traces: Vec<Vec<f64>> = tried.filter_map(|e| trace(problem, base, &free, e)).collect();
    let n = traces.len();
    let correlations = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { cosine(&traces[i], &traces[j]) });
    let apart = match SymmetricEigen::try_new(correlations, f64::EPSILON, EIGEN_ROUNDS) {
        Some(eigen) if n > 0 => eigen.eigenvalues.iter().map(|l| l.max(0.0).sqrt()).sum::<f64>().powi(2) / n as f64,
        _ => n as f64,
    };
    (apart + (count - n) as f64).max(1.0)
}

/// The block of a dataset's mean, or of another target at its holds.
///
/// # Errors
/// If the covariance cannot be decomposed.
pub fn block<'a>(
    scenario: &Scenario,
    dataset: &'a Dataset,
    holds: &[usize],
    target_m: Vec<f64>,
    noise: &NoiseModel,
    body_pa: &[f64],
) -> Result<Block<'a>, CompareError> {
    let width = dataset.values_per_run() / dataset.holds.len();
    let rows: Vec<[f64; 4]> =
        holds.iter().flat_map(|h| noise.directions[h * width..(h + 1) * width].to_vec()).collect();
    Ok(Block {
        scenario: scenario.clone(),
        dataset,
        holds: holds.to_vec(),
        bending_of: dataset.holds.iter().map(|h| nearest(body_pa, h.p_body_pa)).collect(),
        target_m,
        whitener: Whitener::new(&rows, noise.unit_m(), &noise.test_variance)?,
    })
}

/// Distinct body pressures in order of appearance \[Pa\].
pub fn body_pressures(dataset: &Dataset) -> Vec<f64> {
    let mut levels: Vec<f64> = Vec::new();
    for hold in &dataset.holds {
        let p = hold.p_body_pa;
        if !levels.iter().any(|l| (l - p).abs() <= SAME_BODY_PRESSURE * l.abs().max(100.0)) {
            levels.push(p);
        }
    }
    levels
}

/// Index of the nearest level.
pub fn nearest(levels: &[f64], p: f64) -> usize {
    (0..levels.len()).min_by(|a, b| (levels[*a] - p).abs().total_cmp(&(levels[*b] - p).abs())).unwrap_or(0)
}

/// Scenarios of a fit, one per bending stiffness; the scenario's own if B is kept.
pub fn fitted_scenarios(problem: &Problem, block: &Block, effects: &[usize], theta: &[f64]) -> Vec<Scenario> {
    let model = with_effects(&block.scenario, problem.candidates, effects, &theta[problem.bendings..]);
    match problem.bendings {
        0 => vec![model],
        n => theta[..n].iter().map(|b| model.with_bending(*b)).collect(),
    }
}

/// ∂f/∂ln p of a fit in the first block \[m\].
fn derivative(problem: &Problem, fit: &Fit) -> Result<Vec<f64>, CompareError> {
    let block = &problem.blocks[0];
    let mut slope = vec![0.0; block.target_m.len()];
    let width = slope.len() / block.dataset.holds.len();
    for (group, scenario) in fitted_scenarios(problem, block, &fit.effects, fit.theta()).iter().enumerate() {
        let predicted = predict_dataset(scenario, block.dataset)?;
        for (hold, own) in block.bending_of.iter().enumerate() {
            if *own == group || problem.bendings == 0 {
                let rows = hold * width..(hold + 1) * width;
                slope[rows.clone()].copy_from_slice(&predicted.d_ln_pressure_m[rows]);
            }
        }
    }
    Ok(slope)
}

fn own_values(scenario: &Scenario, candidate: &Candidate) -> Vec<f64> {
    scenario.effects.iter().find(|e| e.name == candidate.name).map_or_else(|| candidate.at(0.0), |e| e.values.clone())
}

fn no_base() -> CompareError {
    let problem =
        "the base has no equilibrium at the pressures of the data for any stiffness: check pressures and units";
    CompareError::Fit { what: "the base", problem: problem.into() }
}
