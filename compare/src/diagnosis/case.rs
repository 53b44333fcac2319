//! A scenario and its datasets made ready for hypotheses: noise, calibrated base, catalogue.

use super::basis::{Basis, cosine};
use super::blocks::{body_pressures, fitted_scenarios, whole_block};
use super::candidates::{Candidate, Held, candidates, hold, present};
use super::known::{Known, add_shapes, bound, known, make_room};
use super::least_squares::square;
use super::options::Options;
use super::problem::{Block, Fit, Problem};
use super::screen::trace;
use super::source::Source;
use crate::beside_mean::BesideMean;
use crate::error::CompareError;
use crate::gauge::Gauge;
use crate::layout::Layout;
use crate::noise::NoiseModel;
use crate::policy;
use crate::stats::f_tail;
use crate::study::{first_slope, predict_dataset};
use data::{Dataset, Direct};
use models::Scenario;
use nalgebra::{DMatrix, SymmetricEigen};

/// Fits end when a round lowers the whitened sum of squares by less.
const ENOUGH: f64 = 1e-4;
/// Rounds of the eigenvalue iteration; a handful suffice.
const EIGEN_ROUNDS: usize = 1000;

/// Noise of the source with that number, given its ∂f/∂ln p.
type NoiseOf<'n> = dyn Fn(usize, &[f64]) -> Result<NoiseModel, CompareError> + 'n;

/// A dataset of the same robot that is fitted along with the first.
pub struct Beside<'a> {
    /// Base and data.
    pub source: Source<'a>,
    /// Noise of their mean.
    pub noise: NoiseModel,
}

/// What every hypothesis is held against.
pub struct Case<'a> {
    /// The base as given, with the first dataset's markers and loads.
    pub scenario: &'a Scenario,
    /// The first data: errors in millimetres, places and held-out parts are theirs.
    pub dataset: &'a Dataset,
    /// What was measured directly in them.
    pub direct: Direct,
    /// Readings of the actuator's pressure in them.
    pub gauge: Option<&'a Gauge>,
    /// Noise of their mean.
    pub noise: NoiseModel,
    /// Further data.
    pub beside: Vec<Beside<'a>>,
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

/// Catalogue of a diagnosis: the scenario's own effects first if they are refitted, then those that may be missing; without
/// those that nothing is left to be seen of in any of the data.
pub fn catalogue(sources: &[Source], options: &Options) -> (Vec<Candidate>, usize) {
    let scenario = sources[0].as_given();
    let open = |c: &Candidate| sources.iter().any(|source| source.shows(c.stage));
    let mut list = if options.refit_present { present(scenario) } else { Vec::new() };
    list.retain(open);
    let own = list.len();
    list.extend(candidates(scenario).into_iter().filter(open).filter(|c| !options.excludes(&c.name)));
    let held = Held {
        kept_bending: options.keep_bending,
        body_pressures: body_pressures(sources.iter().map(|source| source.dataset)).len() > 1,
        measured: &sources.iter().flat_map(|source| source.measured).collect::<Vec<_>>(),
    };
    hold(&mut list, &held);
    make_room(&mut list, held.measured, scenario);
    list[..own].iter_mut().for_each(|candidate| candidate.as_given(&own_values(scenario, candidate)));
    let missing = list.split_off(own);
    list.extend(missing.into_iter().filter(|candidate| candidate.count() > 0 || candidate.is_by_design()));
    (list, own)
}

impl<'a> Case<'a> {
    /// Estimates the noise and fits the base, twice: each needs the other. `sessions` are those of each source, in order.
    ///
    /// # Errors
    /// What the model or the noise estimate returns; data beside the first with fewer than three runs.
    pub fn new(
        sources: &[Source<'a>],
        sessions: &[Vec<usize>],
        (candidates, own): (&'a [Candidate], usize),
        options: &Options,
    ) -> Result<Case<'a>, CompareError> {
        if let Some(source) = sources.iter().skip(1).find(|s| s.dataset.runs.len() < policy::FEWEST_RUNS) {
            let (name, runs) = (source.dataset.name.clone(), source.dataset.runs.len());
            return Err(CompareError::TooFewRunsBeside { name, runs, needed: policy::FEWEST_RUNS });
        }
        let estimate = |i: usize, slope: &[f64]| {
            let noise = NoiseModel::estimate(sources[i].dataset, slope, &sessions[i], options.sigma_m)?;
            sources[i].at_readings(noise, slope)
        };
        Case::with_noise(sources, &estimate, (candidates, own), options)
    }

    /// The same with noise from elsewhere, as a function of the source's number and its ∂f/∂ln p.
    ///
    /// # Errors
    /// What the model or the noise returns.
    pub fn with_noise(
        sources: &[Source<'a>],
        noise: &NoiseOf,
        (candidates, own): (&'a [Candidate], usize),
        options: &Options,
    ) -> Result<Case<'a>, CompareError> {
        let Source { scenario, dataset, direct, gauge, .. } = sources[0];
        let known_bending = sources.iter().find_map(|source| source.bending_nm2);
        let mut known = known(sources.iter().flat_map(|source| source.measured), candidates, sources[0].as_given())?;
        add_shapes(&mut known, candidates);
        for source in sources {
            Layout::of(source.dataset)?;
        }
        let body_pa = body_pressures(sources.iter().map(|source| source.dataset));
        let bendings = if options.keep_bending { 0 } else { body_pa.len() };
        let always: Vec<usize> = (0..own).collect();
        let values: Vec<f64> = candidates[..own].iter().flat_map(|c| own_values(sources[0].as_given(), c)).collect();
        let slopes = sources.iter().map(|s| first_slope(s.scenario, s.dataset));
        let slopes: Vec<Vec<f64>> = slopes.collect::<Result<_, _>>()?;
        let fit = |slopes: &[Vec<f64>], known: &[Known]| -> Result<(Vec<NoiseModel>, Problem<'a>, Fit), CompareError> {
            let (mut noises, mut blocks) = (Vec::new(), Vec::new());
            for (i, source) in sources.iter().enumerate() {
                let noise = noise(i, &slopes[i])?;
                blocks.push(whole_block(source, source.dataset.mean_over_runs(), &noise, &body_pa)?);
                noises.push(noise);
            }
            let problem =
                Problem { candidates, blocks, bendings, known_bending, known: known.to_vec(), enough: ENOUGH };
            let base = problem.fit_base(&always, &values).ok_or_else(no_base)?;
            Ok((noises, problem, base))
        };
        let (_, problem, base) = fit(&slopes, &known)?;
        bound(&problem, &base, &mut known);
        let slopes: Result<Vec<_>, _> = problem.blocks.iter().map(|block| derivative(&problem, block, &base)).collect();
        let (mut noises, problem, base) = fit(&slopes?, &known)?;
        let noise = noises.remove(0);
        let beside = sources[1..].iter().zip(noises).map(|(source, noise)| Beside { source: *source, noise }).collect();
        let d_max_m = BesideMean::new(dataset, &noise, &dataset.mean_over_runs())?.d_max_m;
        Ok(Case {
            scenario,
            dataset,
            direct,
            gauge,
            noise,
            beside,
            always,
            tests: independent_tests(&problem, &base, own..candidates.len()),
            problem,
            tried: (own..candidates.len()).collect(),
            body_pa,
            base,
            tolerance_m: options.tolerance_m.unwrap_or_else(|| policy::tolerance_m(d_max_m)),
            alpha: options.alpha,
        })
    }

    /// Catalogue entry.
    pub fn candidate(&self, effect: usize) -> &Candidate {
        &self.problem.candidates[effect]
    }

    /// Prediction of a fit in run layout of the first data \[m\].
    pub fn prediction(&self, fit: &Fit) -> Vec<f64> {
        self.prediction_of(0, fit)
    }

    /// The same of the source with that number.
    pub fn prediction_of(&self, source: usize, fit: &Fit) -> Vec<f64> {
        let block = &self.problem.blocks[source];
        let predicted =
            block.predict_at(&block.holds, self.problem.candidates, &fit.effects, fit.theta(), self.problem.bendings);
        // A fit ends at a place that was predicted before, so there is a prediction.
        predicted.unwrap_or_else(|| block.target_m.clone())
    }

    /// Whitened differences of a fit's supply to the readings in the source with that number.
    pub fn supply_of(&self, source: usize, fit: &Fit) -> Option<Vec<f64>> {
        let values = &fit.theta()[self.problem.bendings..];
        self.problem.blocks[source].supply(self.problem.candidates, &fit.effects, values)
    }

    /// All sources with their noise, the first one first.
    pub fn sources(&self) -> impl Iterator<Item = (Source<'a>, &NoiseModel)> {
        std::iter::once((self.source(), &self.noise)).chain(self.beside.iter().map(|b| (b.source, &b.noise)))
    }

    /// The first data.
    pub fn source(&self) -> Source<'a> {
        let Case { scenario, dataset, direct, gauge, .. } = *self;
        Source {
            scenario,
            dataset,
            direct,
            gauge,
            rolled: false,
            bending_nm2: self.problem.known_bending,
            measured: &[],
        }
    }

    /// Blocks of the data beside the first.
    ///
    /// # Errors
    /// If a covariance cannot be decomposed.
    pub fn blocks_beside(&self) -> Result<Vec<Block<'a>>, CompareError> {
        let block = |b: &Beside<'a>| whole_block(&b.source, b.source.dataset.mean_over_runs(), &b.noise, &self.body_pa);
        self.beside.iter().map(block).collect()
    }

    /// The part of whitened values that belongs to the first data.
    pub fn first<'v>(&self, white: &'v [f64]) -> &'v [f64] {
        &white[..self.noise.directions.len()]
    }

    /// Whether p-values can be formed.
    pub fn gives_p_values(&self) -> bool {
        self.sources().all(|(_, noise)| noise.gives_p_values())
    }

    /// Degrees of freedom of σ²; of several data the fewest.
    fn noise_dof(&self) -> usize {
        self.sources().map(|(_, noise)| noise.pure_error_dof).min().unwrap_or(0)
    }

    /// Error beyond noise of a prediction \[mm\]; the root-mean-square error if the noise is unknown.
    pub fn error_mm(&self, prediction_m: &[f64]) -> f64 {
        error_mm(prediction_m, &self.problem.blocks[0].target_m, &self.noise)
    }

    /// The same of a fit in each of the data beside the first \[mm\].
    pub fn errors_beside_mm(&self, fit: &Fit) -> Vec<f64> {
        let error = |(i, b): (usize, &Beside)| {
            error_mm(&self.prediction_of(i + 1, fit), &self.problem.blocks[i + 1].target_m, &b.noise)
        };
        self.beside.iter().enumerate().map(error).collect()
    }

    /// Root mean square of a fit's errors over all values of all data \[mm\].
    pub fn error_in_all_mm(&self, fit: &Fit) -> f64 {
        let errors = std::iter::once(self.error_mm(&self.prediction(fit))).chain(self.errors_beside_mm(fit));
        let counts = self.sources().map(|(_, noise)| noise.seen(0..noise.directions.len()) as f64);
        let (squares, count) = errors.zip(counts).fold((0.0, 0.0), |(s, n), (mm, k)| (s + k * mm * mm, n + k));
        (squares / count).sqrt()
    }

    /// Error beyond noise that no scatter between runs explains \[mm\]: from the whitened sum of squares, whose expectation
    /// under noise is its degrees of freedom. Pressure, alignment and rotation of a run do not count.
    pub fn beyond_noise_mm(&self, fit: &Fit) -> f64 {
        let unseen = |noise: &NoiseModel| noise.directions.len() - noise.seen(0..noise.directions.len());
        let unseen: usize = self.sources().map(|(_, noise)| unseen(noise)).sum();
        let seen = fit.minimum.residual.len() - self.problem.known.len() - unseen;
        let (cost, dof) = (self.seen_cost(fit), seen.saturating_sub(fit.theta().len()).max(1) as f64);
        1e3 * self.noise.unit_m() * (cost / dof - 1.0).max(0.0).sqrt()
    }

    /// Whitened sum of squares without what tests of their own found of effects, which no marker shows.
    fn seen_cost(&self, fit: &Fit) -> f64 {
        let residual = &fit.minimum.residual;
        fit.cost() - square(&residual[residual.len() - self.problem.known.len()..])
    }

    /// Fall of the sum of squares that the markers show against the calibrated base.
    pub fn seen_gain(&self, fit: &Fit) -> f64 {
        (self.seen_cost(&self.base) - self.seen_cost(fit)).max(0.0)
    }

    /// Fall of the whitened sum of squares against the calibrated base.
    pub fn gain(&self, fit: &Fit) -> f64 {
        (self.base.cost() - fit.cost()).max(0.0)
    }

    /// Parameters beyond the base that do not shape a law; a shape pays by its prior.
    pub fn extra(&self, fit: &Fit) -> usize {
        self.problem.sizes(&fit.effects) - self.problem.sizes(&self.always)
    }

    /// p of a gain by `parameters`, the best of `tests`; `None` if no p-values can be formed.
    pub fn p_of_gain(&self, gain: f64, parameters: usize, tests: f64) -> Option<f64> {
        let q = parameters.max(1);
        let p = tests * f_tail(gain / q as f64, q, self.noise_dof());
        self.gives_p_values().then_some(p.min(1.0))
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
    if n == 0 {
        return count.max(1) as f64;
    }
    let correlations = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { cosine(&traces[i], &traces[j]) });
    let apart = match SymmetricEigen::try_new(correlations, f64::EPSILON, EIGEN_ROUNDS) {
        Some(eigen) => eigen.eigenvalues.iter().map(|l| l.max(0.0).sqrt()).sum::<f64>().powi(2) / n as f64,
        _ => n as f64,
    };
    (apart + (count - n) as f64).max(1.0)
}

/// Root-mean-square error of a prediction beyond the noise of the mean \[mm\].
fn error_mm(prediction_m: &[f64], mean_m: &[f64], noise: &NoiseModel) -> f64 {
    let squares = prediction_m.iter().zip(mean_m).map(|(f, y)| (f - y).powi(2)).sum::<f64>();
    let squares = squares / noise.seen(0..mean_m.len()) as f64;
    let expected = noise.mean_square(0..mean_m.len()).unwrap_or(0.0);
    1e3 * (squares - expected).max(0.0).sqrt()
}

/// ∂f/∂ln p of a fit in a block \[m\].
fn derivative(problem: &Problem, block: &Block, fit: &Fit) -> Result<Vec<f64>, CompareError> {
    let mut slope = vec![0.0; block.target_m.len()];
    let width = slope.len() / block.dataset.holds.len();
    for (group, scenario) in fitted_scenarios(problem, block, &fit.effects, fit.theta()).iter().enumerate() {
        let predicted = predict_dataset(scenario, &block.dataset)?;
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
