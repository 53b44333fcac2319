//! A scenario and its datasets made ready for hypotheses: noise, calibrated base, catalogue.

use super::candidates::{Candidate, candidates, hold, present, surplus, taken_away, tried_between};
use super::known::{KnownParameter, add_shapes, known, make_room};
use super::options::Options;
use super::problem::{Block, Fit, FitProblem};
use super::screen::{bound, trace};
use super::source::{DiagnosisSource, body_pressures};
use crate::beside_mean::BesideMean;
use crate::error::CompareError;
use crate::fit::basis::{Basis, cosine};
use crate::fit::least_squares::square;
use crate::fit::numbers::squared_distance;
use crate::layout::{Layout, values_of};
use crate::noise::NoiseModel;
use crate::policy;
use crate::stats::f_tail;
use crate::study::{first_slope, predict_dataset};
use data::MeasuredValue;
use nalgebra::{DMatrix, SymmetricEigen};

/// Fits end when a round lowers the whitened sum of squares by less.
const ENOUGH: f64 = 1e-4;
const EIGEN_ROUNDS: usize = 1000;

pub(crate) struct DiagnosisCase<'a> {
    /// All data; errors in millimetres, places and held-out parts refer to the first.
    pub sources: &'a [DiagnosisSource],
    /// Noise of the mean of each source.
    pub noises: Vec<NoiseModel>,
    pub problem: FitProblem<'a>,
    /// Effects in every hypothesis: the scenario's own, if they are refitted.
    pub always: Vec<usize>,
    /// Candidates that are fitted as missing, as indices into the catalogue.
    pub tried: Vec<usize>,
    /// Body pressures with a bending stiffness of their own \[Pa\].
    pub body_pa: Vec<f64>,
    pub base: Fit,
    /// Independent tests among the effects tried.
    pub tests: f64,
    /// Error below which a model is good enough \[m\].
    pub tolerance_m: f64,
    /// Level of the one corrected p-value.
    pub alpha: f64,
}

/// Catalogue of a diagnosis: the scenario's own effects first if they are refitted, then those that may be missing, then those that may
/// be one too many; without effects of which nothing is left to be seen in any of the data.
pub(super) fn catalogue(sources: &[DiagnosisSource], options: &Options) -> (Vec<Candidate>, usize) {
    let scenario = sources[0].as_given();
    let open = |c: &Candidate| sources.iter().any(|source| source.shows(c.stage));
    let mut list = if options.refit_present { present(scenario) } else { Vec::new() };
    list.retain(open);
    let own = list.len();
    let measured: Vec<&MeasuredValue> = sources.iter().flat_map(|source| &source.measured).collect();
    let is_measured = |c: &Candidate| measured.iter().any(|m| taken_away(&c.name) == Some(&m.effect));
    let mut tried = [candidates(scenario), surplus(scenario, &list)].concat();
    tried.retain(|c| open(c) && !options.excludes(&c.name) && !is_measured(c));
    list.append(&mut tried);
    let bodies = body_pressures(sources.iter().map(|source| &source.dataset)).len();
    hold(&mut list, options.keep_bending, bodies > 1, &measured);
    tried_between(&mut list, &sources[0].dataset.holds);
    make_room(&mut list, &measured, scenario);
    list[..own].iter_mut().for_each(|candidate| candidate.as_given(&candidate.own_values(scenario)));
    let missing = list.split_off(own);
    list.extend(missing.into_iter().filter(Candidate::is_tried));
    (list, own)
}

impl<'a> DiagnosisCase<'a> {
    /// Estimates the noise and fits the base, twice: each needs the other.
    pub(crate) fn new(
        sources: &'a [DiagnosisSource],
        (candidates, own): (&'a [Candidate], usize),
        options: &Options,
    ) -> Result<DiagnosisCase<'a>, CompareError> {
        if let Some(source) = sources.iter().skip(1).find(|s| s.dataset.runs.len() < policy::FEWEST_RUNS) {
            let (name, runs) = (&source.dataset.name, source.dataset.runs.len());
            return Err(CompareError::told(format!(
                "{name} has {runs} run(s); data that are diagnosed together with others need {} of their own to know their noise: \
                 measure more, or diagnose them alone",
                policy::FEWEST_RUNS
            )));
        }
        let first = &sources[0];
        let known_bending = sources.iter().find_map(|source| source.bending_nm2);
        let mut known = known(sources.iter().flat_map(|source| &source.measured), candidates, first.as_given())?;
        add_shapes(&mut known, candidates);
        for source in sources {
            Layout::of(&source.dataset)?;
        }
        let body_pa = body_pressures(sources.iter().map(|source| &source.dataset));
        let levels = if options.keep_bending { &[][..] } else { &body_pa };
        let always: Vec<usize> = (0..own).collect();
        let values: Vec<f64> = candidates[..own].iter().flat_map(|c| c.own_values(first.as_given())).collect();
        let slopes = sources.iter().map(|s| first_slope(&s.scenario, &s.dataset)).collect::<Result<Vec<_>, _>>()?;
        let fit = |slopes: &[Vec<f64>],
                   known: &[KnownParameter]|
         -> Result<(Vec<NoiseModel>, FitProblem<'a>, Fit), CompareError> {
            let (mut noises, mut blocks) = (Vec::new(), Vec::new());
            for (source, slope) in sources.iter().zip(slopes) {
                let estimated = NoiseModel::estimate(&source.dataset, slope, &source.sessions, options.sigma_m)?;
                let noise = source.at_readings(estimated, slope)?;
                blocks.push(Block::of(source, &noise, levels)?);
                noises.push(noise);
            }
            let (bendings, known) = (levels.len(), known.to_vec());
            let problem = FitProblem { candidates, blocks, bendings, known_bending, known, enough: ENOUGH };
            let base = problem.fit_base(&always, &values).ok_or_else(no_base)?;
            Ok((noises, problem, base))
        };
        let (_, problem, base) = fit(&slopes, &known)?;
        bound(&problem, &base, &mut known);
        let slopes: Result<Vec<_>, _> = problem.blocks.iter().map(|block| derivative(&problem, block, &base)).collect();
        let (noises, problem, base) = fit(&slopes?, &known)?;
        let d_max_m = BesideMean::new(&first.dataset, &noises[0], &first.dataset.mean_over_runs())?.d_max_m;
        let tried = own..candidates.len();
        Ok(DiagnosisCase {
            sources,
            noises,
            always,
            tests: independent_tests(&problem, &base, tried.clone()),
            problem,
            tried: tried.collect(),
            body_pa,
            base,
            tolerance_m: options.tolerance_m.unwrap_or_else(|| policy::tolerance_m(d_max_m)),
            alpha: options.alpha,
        })
    }

    /// The data to which errors in millimetres, places and held-out parts refer.
    pub(crate) fn first(&self) -> &'a DiagnosisSource {
        &self.sources[0]
    }

    pub(crate) fn noise(&self) -> &NoiseModel {
        &self.noises[0]
    }

    pub(crate) fn candidate(&self, effect: usize) -> &Candidate {
        &self.problem.candidates[effect]
    }

    pub(crate) fn added<'f>(&self, fit: &'f Fit) -> &'f [usize] {
        &fit.effects[self.always.len()..]
    }

    pub(crate) fn names(&self, fit: &Fit) -> Vec<String> {
        self.added(fit).iter().map(|e| self.candidate(*e).name.clone()).collect()
    }

    pub(crate) fn with(&self, effect: usize) -> Vec<usize> {
        self.always.iter().copied().chain([effect]).collect()
    }

    pub(crate) fn bendings(&self, fit: &Fit) -> Vec<f64> {
        fit.theta()[..self.problem.bendings].to_vec()
    }

    /// Prediction of a fit in run layout of the first data \[m\].
    pub(crate) fn prediction(&self, fit: &Fit) -> Vec<f64> {
        self.prediction_of(&self.problem.blocks[0], fit)
    }

    pub(crate) fn prediction_of(&self, block: &Block, fit: &Fit) -> Vec<f64> {
        let predicted = self.problem.predict(block, &block.holds, &fit.effects, fit.theta());
        // A fit ends at a place that was predicted before, so there is a prediction.
        predicted.unwrap_or_else(|| block.target_m.clone())
    }

    pub(crate) fn of_first<'v>(&self, white: &'v [f64]) -> &'v [f64] {
        &white[..self.noise().directions.len()]
    }

    pub(crate) fn gives_p_values(&self) -> bool {
        self.noises.iter().all(NoiseModel::gives_p_values)
    }

    pub(crate) fn is_gauged(&self) -> bool {
        self.sources.iter().any(|source| source.gauge.is_some())
    }

    /// Error beyond noise of a prediction of the first data \[mm\]; the root-mean-square error if the noise is unknown.
    pub(crate) fn error_mm(&self, prediction_m: &[f64]) -> f64 {
        error_mm(prediction_m, &self.problem.blocks[0].target_m, self.noise())
    }

    pub(crate) fn errors_mm(&self, fit: &Fit) -> Vec<f64> {
        let blocks = self.problem.blocks.iter().zip(&self.noises);
        blocks.map(|(block, noise)| error_mm(&self.prediction_of(block, fit), &block.target_m, noise)).collect()
    }

    /// Root mean square of a fit's errors over all values of all data \[mm\].
    pub(crate) fn error_in_all_mm(&self, fit: &Fit) -> f64 {
        let (mut squares, mut count) = (0.0, 0.0);
        for (mm, noise) in self.errors_mm(fit).into_iter().zip(&self.noises) {
            let seen = noise.all_seen() as f64;
            squares += seen * mm * mm;
            count += seen;
        }
        (squares / count).sqrt()
    }

    /// Error beyond noise that no scatter between runs explains \[mm\]: from the whitened sum of squares, whose expectation
    /// under noise is its degrees of freedom. Pressure, alignment and rotation of a run do not count.
    pub(crate) fn beyond_noise_mm(&self, fit: &Fit) -> f64 {
        let unseen: usize = self.noises.iter().map(|noise| noise.directions.len() - noise.all_seen()).sum();
        let seen = fit.minimum.residual.len() - self.problem.known.len() - unseen;
        let dof = seen.saturating_sub(fit.theta().len()).max(1) as f64;
        1e3 * self.noise().unit_m() * (self.seen_cost(fit) / dof - 1.0).max(0.0).sqrt()
    }

    /// Whitened sum of squares without what tests of their own found of effects, which no marker shows.
    fn seen_cost(&self, fit: &Fit) -> f64 {
        let residual = &fit.minimum.residual;
        fit.cost() - square(&residual[residual.len() - self.problem.known.len()..])
    }

    /// Fall of the sum of squares that the markers show against the calibrated base.
    pub(crate) fn seen_gain(&self, fit: &Fit) -> f64 {
        (self.seen_cost(&self.base) - self.seen_cost(fit)).max(0.0)
    }

    pub(crate) fn gain(&self, fit: &Fit) -> f64 {
        (self.base.cost() - fit.cost()).max(0.0)
    }

    /// Parameters beyond the base that do not shape a law; a shape pays by its prior.
    pub(crate) fn extra(&self, fit: &Fit) -> usize {
        self.problem.sizes(&fit.effects) - self.problem.sizes(&self.always)
    }

    /// p of a gain by `parameters`, the best of `tests`; `None` if no p-values can be formed. Of several data σ² has the fewest
    /// degrees of freedom.
    pub(crate) fn p_of_gain(&self, gain: f64, parameters: usize, tests: f64) -> Option<f64> {
        let dof = self.noises.iter().map(|noise| noise.pure_error_dof).min().unwrap_or(0);
        let q = parameters.max(1);
        let p = tests * f_tail(gain / q as f64, q, dof);
        self.gives_p_values().then_some(p.min(1.0))
    }

    /// Whether a parameter of its effects sits on a bound against which the data push.
    pub(crate) fn is_rejected(&self, fit: &Fit) -> bool {
        fit.binding[self.problem.bendings..].contains(&true)
    }
}

/// Effective number of independent tests, `(Σ√λ)²/Σλ` over the eigenvalues λ of the correlations between the effects' first
/// traces (Galwey 2009): twins are one test, not two. An effect without a first trace, a threshold, counts as one more.
fn independent_tests(problem: &FitProblem, base: &Fit, tried: std::ops::Range<usize>) -> f64 {
    let free = Basis::of(&base.minimum.jacobian);
    let count = tried.len();
    let traces: Vec<Vec<f64>> = tried.filter_map(|e| trace(problem, base, &free, e)).collect();
    let n = traces.len();
    if n == 0 {
        return count.max(1) as f64;
    }
    let correlations = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { cosine(&traces[i], &traces[j]) });
    let eigen = SymmetricEigen::try_new(correlations, f64::EPSILON, EIGEN_ROUNDS);
    let roots = eigen.map(|eigen| eigen.eigenvalues.iter().map(|l| l.max(0.0).sqrt()).sum::<f64>());
    let apart = roots.map_or(n as f64, |roots| roots.powi(2) / n as f64);
    (apart + (count - n) as f64).max(1.0)
}

/// Root-mean-square error of a prediction beyond the noise of the mean \[mm\].
fn error_mm(prediction_m: &[f64], mean_m: &[f64], noise: &NoiseModel) -> f64 {
    let squares = squared_distance(prediction_m, mean_m) / noise.seen(0..mean_m.len()) as f64;
    let expected = noise.mean_square(0..mean_m.len()).unwrap_or(0.0);
    1e3 * (squares - expected).max(0.0).sqrt()
}

/// ∂f/∂ln p of a fit in a block \[m\].
fn derivative(problem: &FitProblem, block: &Block, fit: &Fit) -> Result<Vec<f64>, CompareError> {
    let mut slope = vec![0.0; block.target_m.len()];
    let scenarios = problem.scenarios(block, &fit.effects, fit.theta());
    for (group, scenario) in scenarios.iter().enumerate() {
        let predicted = predict_dataset(scenario, &block.source.dataset)?.d_ln_pressure_m;
        let own: Vec<usize> = (0..block.bending_of.len()).filter(|hold| block.bending_of[*hold] == group).collect();
        values_of(&block.source.dataset, &own).for_each(|i| slope[i] = predicted[i]);
    }
    Ok(slope)
}

fn no_base() -> CompareError {
    let problem =
        "the base has no equilibrium at the pressures of the data for any stiffness: check pressures and units";
    CompareError::Fit { what: "the base", problem: problem.into() }
}
