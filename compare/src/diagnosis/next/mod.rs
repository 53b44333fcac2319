//! The experiment that would separate the remaining explanations.
//!
//! The best explanation a predicts the data at hand and the data of a planned experiment, and a rival b is fitted to
//! them, its bending stiffnesses too. What b cannot meet, in units of the noise expected there, is the
//! separation λ = min |f_a − f_b|²: the expected difference of the sums of squares.
//! It is taken both ways round and the larger counts: a fit of the wrong explanation hides part of the difference.
//!
//! ```text
//! λ ± 2√λ ≥ 6 A in nine of ten:    λ ≥ (z + √(z² + 6 A))²,    z = 1.28,    A = 1 + cG
//! ```
//!
//! with the allowance A for the form of laws and the gain G expected of a there ([`crate::diagnosis::order`]); 16 where A = 1.

pub(super) mod experiments;
pub(super) mod worth;

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::decide::Decision;
use crate::diagnosis::experiments::{BENDING_TEST, Plan, bending_test, plans, protocol_text};
use crate::diagnosis::known::{BENCH_TEST, BENCH_TESTS, BenchTest, KnownParameter, parameters_of};
use crate::diagnosis::order::allowance;
use crate::diagnosis::problem::{Block, Fit, FitProblem, with};
use crate::diagnosis::result::{Experiment, NextExperiment, Separation, Verdict};
use crate::diagnosis::source::{DiagnosisSource, is_rolled, nearest};
use crate::directions::nuisance_directions;
use crate::error::CompareError;
use crate::fit::numbers::sort_by;
use crate::fit::whiten::Whitener;
use crate::gauge::Gauge;
use crate::policy;
use crate::study::predict::without_settled;
use crate::study::predict_dataset;
use crate::wording::list;
use data::Direct;
use models::Supply;
use models::effects::Stage;
use std::borrow::Cow;
use std::cmp::Reverse;

const MOST_REPEATS: usize = 20;
const RIVALS: usize = 5;
/// Relative error at which the fits for λ may stop.
const LAMBDA_ERROR: f64 = 0.05;

/// Looks for the experiment; `None` if there is nothing to separate or the noise is unknown. Where the answer is outside the
/// catalogue the names at hand are wrong anyhow: nothing is computed to separate them, and `outside` names the place to look at.
pub(super) fn next_experiment(
    case: &DiagnosisCase,
    decision: &Decision,
    outside: Option<String>,
) -> Result<Option<NextExperiment>, CompareError> {
    let hypotheses = hypotheses(decision);
    if hypotheses.len() < 2 || !case.noise().is_known() {
        return Ok(outside.map(|sentence| NextExperiment { needed_now: enough(0.0), sentence, ..Default::default() }));
    }
    let best = hypotheses[0];
    let rivals = &hypotheses[1..hypotheses.len().min(RIVALS + 1)];
    let (now, gain_now) = separations(case, None, best, rivals)?;
    let next = NextExperiment { best: label(case, best), now, needed_now: enough(gain_now), ..Default::default() };
    if let Some(sentence) = outside {
        return Ok(Some(NextExperiment { sentence, ..next }));
    }
    let mut tried = Vec::new();
    let first = case.first();
    let mut plans = plans(&first.scenario, &first.as_set(), first.direct, instruments(case, &hypotheses));
    plans.extend((case.problem.bendings > 0 && case.problem.known_bending.is_none()).then(bending_test));
    for plan in plans {
        // A planned pressure without equilibrium cannot be proposed.
        if let Ok((separations, gain)) = separations(case, Some(&plan), best, rivals) {
            tried.push(experiment(case, &plan, separations, gain));
        }
    }
    // Beyond enough more is still better, because real laws are not the catalogue's.
    sort_by(&mut tried, |e| -e.separations.iter().map(|s| s.lambda.ln_1p()).sum::<f64>());
    tried.sort_by_key(|e| Reverse(e.separated));
    let is_worth_it = |e: &&Experiment| e.separations.iter().any(|s| policy::is_worth_its_time(s.lambda));
    let recommended = tried.first().filter(is_worth_it).cloned();
    let sentence = sentence(&next.best, recommended.as_ref());
    Ok(Some(NextExperiment { recommended, tried, sentence, ..next }))
}

fn hypotheses(decision: &Decision) -> Vec<&Fit> {
    match decision.verdict {
        Some(Verdict::None) => Vec::new(),
        _ if !decision.pairs.fits.is_empty() => decision.pairs.stated().collect(),
        _ => decision.singles.stated().collect(),
    }
}

/// What would have to be measured directly so that no remaining explanation belongs to supply or camera, or to a quantity that a
/// separate test measures.
fn instruments(case: &DiagnosisCase, hypotheses: &[&Fit]) -> (Direct, Vec<&'static BenchTest>) {
    let tried: Vec<usize> = hypotheses.iter().flat_map(|fit| case.added(fit)).copied().collect();
    let has = |stage: Stage| tried.iter().any(|e| case.candidate(*e).stage == stage);
    let is_open = |test: &&BenchTest| {
        let is_known = |at| case.problem.known.iter().any(|known| (known.effect, known.parameter) == at);
        parameters_of(test, case.problem.candidates).iter().any(|at| tried.contains(&at.0) && !is_known(*at))
    };
    let direct = Direct { pressure: has(Stage::Supply), frame: has(Stage::Camera) };
    (direct, BENCH_TESTS.iter().filter(is_open).collect())
}

fn label(case: &DiagnosisCase, fit: &Fit) -> String {
    case.names(fit).join(" + ")
}

/// λ that separates two explanations in about nine of ten cases where the better one gains that much.
fn enough(gain: f64) -> f64 {
    let z = policy::Z_POWER;
    (z + (z * z + policy::SAME_EVIDENCE * allowance(gain)).sqrt()).powi(2)
}

fn experiment(case: &DiagnosisCase, plan: &Plan, separations: Vec<Separation>, gain: f64) -> Experiment {
    let needed = enough(gain);
    let lambdas = || separations.iter().map(|s| s.lambda);
    let within_reach = lambdas().filter(|l| policy::is_worth_its_time(*l)).reduce(f64::min);
    let largest = lambdas().fold(0.0, f64::max);
    // More runs make more of λ and of what a law's form shows, which may never be enough.
    let at_hand = case.noise().runs.max(1);
    let suffices = |runs: usize, lambda: f64| {
        let times = runs as f64 / at_hand as f64;
        times * lambda >= enough(times * gain)
    };
    let runs = |lambda: f64| (3..=MOST_REPEATS * at_hand).find(|runs| suffices(*runs, lambda));
    let repeated = within_reach.filter(|_| !plan.parts.is_empty());
    Experiment {
        name: plan.name.clone(),
        sentence: plan.sentence.clone(),
        protocol: protocol_text(plan),
        direct: plan.parts.first().map_or(case.first().direct, |part| part.direct),
        tests: plan.tests.iter().map(|test| test.name.to_string()).collect(),
        needed,
        separated: lambdas().filter(|l| *l >= needed).count(),
        lambda: within_reach.unwrap_or(largest),
        runs_needed: repeated.and_then(runs),
        separations,
    }
}

/// λ from every rival, and the gain expected of the best.
fn separations(
    case: &DiagnosisCase,
    plan: Option<&Plan>,
    best: &Fit,
    rivals: &[&Fit],
) -> Result<(Vec<Separation>, f64), CompareError> {
    let ours = Expected::of(case, plan, best)?;
    let mut found = Vec::new();
    for &rival in rivals {
        let theirs = Expected::of(case, plan, rival)?;
        let lambda = ours.misfit(rival).max(theirs.misfit(best));
        found.push(Separation { rival: label(case, rival), lambda });
    }
    Ok((found, ours.misfit(&case.base)))
}

/// The data that a hypothesis leads one to expect, at hand and planned.
struct Expected<'a> {
    problem: FitProblem<'a>,
    /// Bending stiffnesses that the data at hand do not have.
    added: usize,
}

impl<'a> Expected<'a> {
    fn of(case: &DiagnosisCase<'a>, plan: Option<&Plan>, truth: &Fit) -> Result<Expected<'a>, CompareError> {
        let expected = |block: &Block<'a>| Block { target_m: case.prediction_of(block, truth), ..block.clone() };
        let parts: &[DiagnosisSource] = plan.map_or(&[], |plan| &plan.parts);
        let body = parts.first().map(|part| part.dataset.holds[0].p_body_pa);
        let mut levels = case.body_pa.clone();
        let is_new = |p: &f64| levels.iter().all(|l| !policy::is_same_pressure(*l, *p));
        let added = usize::from(case.problem.bendings > 0 && body.as_ref().is_some_and(is_new));
        levels.extend(body.filter(|_| added > 0));
        let theta = extended(truth, case.problem.bendings, added);
        // The hypothesis's own value: a hypothesis meets its own prediction.
        let tested = plan.is_some_and(|plan| plan.parts.is_empty() && plan.tests.is_empty());
        let sd_nm2 = |b: f64| case.problem.known_bending.map(|[_, sd]| sd).or(tested.then_some(BENDING_TEST * b));
        let known_bending = theta.first().and_then(|b| sd_nm2(*b).filter(|sd| *sd > 0.0).map(|sd| [*b, sd]));
        let mut problem = FitProblem {
            candidates: case.problem.candidates,
            blocks: case.problem.blocks.iter().map(expected).collect(),
            bendings: case.problem.bendings + added,
            known_bending,
            known: expected_tests(case, plan, truth),
            enough: LAMBDA_ERROR,
        };
        let levels = if problem.bendings == 0 { &[][..] } else { &levels };
        for part in parts {
            let planned = planned(case, &problem, part, levels, (truth, &theta))?;
            problem.blocks.push(planned);
        }
        Ok(Expected { problem, added })
    }

    fn misfit(&self, other: &Fit) -> f64 {
        let start = extended(other, self.problem.bendings - self.added, self.added);
        // Without an equilibrium there the rival could not even be measured: nothing is promised.
        self.problem.fit(&other.effects, &[start]).map_or(0.0, |fit| fit.cost())
    }
}

/// Results of separate tests, done and planned, as a hypothesis predicts them.
fn expected_tests(case: &DiagnosisCase, plan: Option<&Plan>, truth: &Fit) -> Vec<KnownParameter> {
    let values = &truth.theta()[case.problem.bendings..];
    let candidates = case.problem.candidates;
    let at_hand = case.problem.known.iter().copied();
    let planned = plan.into_iter().flat_map(|plan| &plan.tests).flat_map(|test| parameters_of(test, candidates));
    let planned = planned.map(|(effect, parameter)| KnownParameter::planned(effect, parameter));
    let expected = |known: KnownParameter| {
        if known.usual {
            return known;
        }
        let p = &candidates[known.effect].parameters[known.parameter];
        let value = known.of(candidates, &truth.effects, values).unwrap_or(p.neutral);
        let sd = if known.sd > 0.0 { known.sd } else { BENCH_TEST * value.abs().max(p.typical.abs()) };
        known.at(candidates, value, sd)
    };
    at_hand.chain(planned).map(expected).collect()
}

/// Parameters with the stiffness of a new body pressure, the same as at the first.
fn extended(fit: &Fit, bendings: usize, added: usize) -> Vec<f64> {
    let (bending, effects) = fit.theta().split_at(bendings);
    let new = &bending[..added.min(bending.len())];
    [bending, new, effects].concat()
}

/// A planned part as the hypothesis `truth` predicts it, with the noise of as many runs as at hand.
fn planned<'a>(
    case: &DiagnosisCase,
    problem: &FitProblem<'a>,
    part: &DiagnosisSource,
    levels: &[f64],
    (truth, theta): (&Fit, &[f64]),
) -> Result<Block<'a>, CompareError> {
    let (noise, own) = (case.noise(), case.first());
    let gauge = part.direct.pressure.then(|| {
        let is_supply = |stage| stage == Stage::Supply;
        let values = &theta[problem.bendings..];
        let laws = with(&part.scenario, problem.candidates, &truth.effects, values, &is_supply);
        let run_sd = noise.run_sd[0].unwrap_or(policy::SENSOR_SD[0]);
        Gauge::planned(&part.dataset, &part.scenario, &Supply::of(&laws), noise.runs, run_sd)
    });
    let dataset = gauge.as_ref().map_or_else(|| part.dataset.clone(), |gauge| gauge.positions(&part.dataset));
    let rolled = is_rolled(part.scenario.gravity_direction, own.scenario.gravity_direction);
    let scenario = without_settled(&part.scenario, part.direct);
    let source = DiagnosisSource { scenario, dataset, gauge, rolled, ..part.clone() };
    let mut block = Block {
        holds: (0..source.dataset.holds.len()).collect(),
        bending_of: source.dataset.holds.iter().map(|h| nearest(levels, h.p_body_pa)).collect(),
        of_gauge: source.gauge.as_ref().map(|gauge| gauge.whitener()).transpose()?,
        source: Cow::Owned(source),
        ..problem.blocks[0].clone()
    };
    let scenarios = problem.scenarios(&block, &truth.effects, theta);
    let predicted = predict_dataset(&scenarios[block.bending_of[0]], &block.source.dataset)?;
    let directions = nuisance_directions(&predicted.coordinates_m, &predicted.d_ln_pressure_m, part.dataset.axes);
    let errors = block.source.gauge.as_ref().map(|g| g.errors_m(&block.source.dataset, &predicted.d_ln_pressure_m));
    let mut variance = noise.test_variance;
    if errors.is_some() {
        variance[0] = 0.0;
    }
    block.whitener = Whitener::with_columns(&directions, noise.unit_m(), &variance, &errors.unwrap_or_default())?;
    block.target_m = predicted.coordinates_m;
    Ok(block)
}

const RESULTS: &str =
    " What tests of their own find goes into [measured] of about.toml; ibr characterize writes it for a fabric.";

fn sentence(best: &str, recommended: Option<&Experiment>) -> String {
    let Some(e) = recommended else {
        return format!(
            "No listed experiment separates {best} from its rivals: measure the quantities directly (weigh the robot, put a \
             gauge on the actuator, photograph a checkerboard)."
        );
    };
    let protocol = if e.protocol.is_empty() { String::new() } else { format!(" ({})", e.protocol) };
    let results = if e.tests.is_empty() { "" } else { RESULTS };
    let names = |least: f64| list(e.separations.iter().filter(|s| s.lambda >= least).map(|s| &s.rival));
    let (some, separated) = (names(policy::WORTHLESS), names(e.needed));
    let parts = match (e.runs_needed, separated.is_empty()) {
        (Some(runs), _) => format!("About {runs} runs of it would separate {best} from {some}."),
        (None, false) => format!("It would separate {best} from {separated}."),
        (None, true) => format!(
            "It separates {best} from {some} more than others do and will not decide: a twentieth of an effect is granted to the form \
             of its law, and more runs do not change that."
        ),
    };
    format!("Next: {}{protocol}. {parts}{results}", e.sentence)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_is_enough_where_laws_are_their_formulas_and_more_where_a_share_is_granted() {
        assert!((enough(0.0) - 16.0).abs() < 1.0, "{}", enough(0.0));
        // Of a large gain the granted share decides, six units of noise times A.
        let gain = 1e6;
        assert!((enough(gain) / (6.0 * allowance(gain)) - 1.0).abs() < 0.02);
    }
}
