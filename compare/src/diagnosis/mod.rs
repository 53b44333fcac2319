//! Which physical effect is missing, what it would bring, and when the data cannot tell.
//!
//! ```text
//! prepare ─► noise, base ─► every effect refitted ─► one p ─► set ─► pairs if wanted ─► lack of fit, places ─► verdict
//!            (case)          (screen, singles)                       (pairs)            (lack_of_fit, stands_out, decide)
//!                                 └─► intervals, held-out error, smallest detectable sizes, next experiment
//! ```
//!
//! Several data of one robot are blocks of one fit; what was measured directly leaves nothing to explain there (`data::Direct`).
//!
//! All fits minimise the whitened sum of squares of the mean over runs ([`crate::noise`]: the run is the unit). Gains are
//! falls of that sum against the calibrated base; under "nothing is missing" a gain by q parameters follows about q·F(q,
//! dof of σ²), and p is multiplied by the number of independent tests among the effects. Effects with a bound at their
//! neutral value and thresholds make that conservative (Chernoff; Davies). The set is what the data cannot tell apart: BIC within 6 of the
//! best, or 95 % of its gain. A name is the best explanation *in the catalogue*, never a proof.

mod answers;
mod basis;
mod bench;
mod bending_alarm;
mod blocks;
mod candidates;
mod case;
mod closest;
mod decide;
mod detect;
mod distance;
mod evaluator;
mod experiments;
mod fitted;
#[cfg(test)]
mod gauge_tests;
mod heldout;
mod interval;
mod kept_bending;
mod known;
mod lack_of_fit;
mod learned;
mod least_squares;
mod limits;
mod look;
#[cfg(test)]
mod lost_tests;
mod missing;
mod next;
mod options;
mod order;
mod outliers;
mod pairs;
mod part;
#[cfg(test)]
mod pattern_tests;
mod patterns;
mod pressures;
#[cfg(test)]
mod pressures_tests;
mod problem;
mod proposed;
mod result;
mod screen;
mod shapes;
mod singles;
mod source;
mod stands_out;
mod story;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod together_tests;
mod traces;
pub mod words;

pub use crate::prepare::{Outliers, OutlyingRun};
pub use crate::slips::pressure::{BestEffect, PressureSlipFound};
pub use answers::{Answer, Standing};
pub use bench::{BenchDiagnosis, BenchOptions, BenchRanked, LeftOut, diagnose_bench};
pub use bending_alarm::BendingAlarm;
pub use candidates::{Candidate, Free, candidates};
pub use distance::{Distances, KnownNoise, distances, power};
pub use experiments::{BENDING_TEST, BENDING_TEST_NAME};
pub use fitted::{FittedBeside, GaugeFit, with_fitted};
pub use known::{BENCH_TEST, BENCH_TESTS, BenchTest};
pub use learned::{LearnedLaw, LearnedLine, LearnedTried};
pub use options::{Options, PRESSURES_ARE_RIGHT};
pub use outliers::Undetectable;
pub use pressures::pressure_slip;
pub use proposed::*;
pub use result::*;

use crate::beside_mean::BesideMean;
use crate::error::CompareError;
use crate::evidence::{Evidence, Used};
use crate::noise_summary::NoiseSummary;
use crate::policy;
use crate::prepare::outlying_runs;
use crate::progress::shares::{DIAGNOSIS, PAIRS};
use crate::progress::{Progress, part};
use crate::residuals::{ResidualMap, residual_map};
use crate::where_it_fails::{FailureOptions, Statement, where_it_fails};
use case::Case;
use decide::{Decision, decide};
use heldout::HeldOut;
use models::Scenario;
use part::{Part, contradicted};
use pressures::Pressures;
use problem::Fit;
use source::Source;

/// Diagnoses measurements: is an effect missing in the scenario, which, and what would tell. Several data of one robot lie each
/// under its own protocol and loads: one bending stiffness for every body pressure and one value of every parameter must meet
/// them all. Errors in millimetres, places and held-out parts are those of the first.
///
/// # Errors
/// Scenario and data that do not fit together, impossible options, a base without equilibrium; further data with fewer than three
/// runs, or none at all.
pub fn diagnose(
    scenario: &Scenario,
    evidence: &[Evidence],
    options: &Options,
    progress: &mut Progress,
) -> Result<Diagnosis, CompareError> {
    options.check(scenario)?;
    let first = evidence.first().ok_or_else(|| CompareError::refused("no data to diagnose", "give measurements"))?;
    let (parts, mut warnings) = parts(scenario, evidence)?;
    warnings.extend(parts.iter().flat_map(|part| known::unusual(&part.measured, scenario)));
    let sources: Vec<Source> = parts.iter().map(|part| part.source(&parts[0].scenario)).collect();
    let sessions: Vec<Vec<usize>> = parts.iter().map(|part| part.prepared.sessions.clone()).collect();
    let (candidates, own) = case::catalogue(&sources, options);
    let mut wider = Vec::new();
    let pressures = Pressures { parts: &parts, sessions: &sessions, options };
    let mut case =
        Case::new(&sources, &sessions, (&candidates, own), options).map_err(|error| pressures.refusal(error))?;
    let [of_singles, of_pairs] = [[0.0, PAIRS], [PAIRS, 1.0]].map(|ends| ends.map(|end| end * DIAGNOSIS[0]));
    let singles = singles::fit_all(&mut case, &mut wider, &mut part(progress, of_singles));
    let case = case;
    let runs = outlying_runs(case.dataset, &case.noise);
    warnings.extend(runs.iter().map(OutlyingRun::words));
    warnings.extend(limits::warnings(&case));
    let mut decision = decide(&case, singles, options, &mut part(progress, of_pairs))?;
    let pressure_slip = pressures.found(&case, || Ok(decision.rivals()))?;
    if pressure_slip.is_some() {
        decision.withhold();
    }
    warnings.extend(singles::left_out(&case, &decision.singles));
    progress("left-out data", Some(DIAGNOSIS[0]));
    let outliers = parts[0].prepared.outliers.clone();
    let mut diagnosis = assemble(&case, &decision, Outliers { runs, ..outliers }, warnings)?;
    diagnosis.excluded.clone_from(&options.not);
    diagnosis.evidence = evidence.iter().map(Used::of).collect::<Result<_, _>>()?;
    if first.about.as_ref().is_some_and(|a| a.gravity_direction.is_none()) {
        let words =
            "about.toml names no [gravity] direction: out of the question if the robot bends in a horizontal plane";
        diagnosis.ranked.iter_mut().filter(|r| r.effect == "gravity").for_each(|r| r.notes.push(words.into()));
    }
    diagnosis.slips = parts.iter().flat_map(|part| part.slips.clone()).collect();
    if let Some(found) = pressure_slip {
        return Ok(found.withholds(diagnosis, evidence));
    }
    diagnosis.kept_bending = kept_bending::kept_bending(&diagnosis, scenario, evidence, options)?;
    if options.next_experiment {
        progress("the next experiment", Some(DIAGNOSIS[1]));
        diagnosis.next_experiment = next::next_experiment(&case, &decision, look::next(&diagnosis))?;
    }
    if options.missing_moment || options.learn {
        // It shows a verdict and decides none: where it cannot be had, the verdict stands without it.
        if let Err(error) = learned::moments(&case, &decision, (&sources, &sessions), options, &mut diagnosis) {
            diagnosis.warnings.push(format!("no missing moment is shown: {error}"));
        }
    }
    diagnosis.summary = story::story(&diagnosis);
    Ok(diagnosis)
}

/// Every dataset made ready, without copies, and cautions.
fn parts(scenario: &Scenario, evidence: &[Evidence]) -> Result<(Vec<Part>, Vec<String>), CompareError> {
    let (mut parts, mut warnings) = (Vec::new(), Vec::new());
    for (i, measured) in evidence.iter().enumerate() {
        let name = &measured.dataset.name;
        if evidence[..i].iter().any(|seen| seen.dataset.xy_m == measured.dataset.xy_m) {
            warnings.push(format!(
                "{name} is a copy of data that are there already and was left out: copies are not repeats"
            ));
            continue;
        }
        let direction = measured.about.as_ref().and_then(|a| a.gravity_direction).unwrap_or(scenario.gravity_direction);
        let lies = Scenario { gravity_direction: direction, ..scenario.clone() };
        let rolled = parts.first().is_some_and(|first: &Part| source::is_rolled(&lies, &first.scenario));
        let (part, told) = Part::of(&if rolled { source::seen_rolled(scenario) } else { scenario.clone() }, measured)?;
        let tested = parts.iter().find(|known: &&Part| known.bending_nm2.is_some() && part.bending_nm2.is_some());
        if tested.is_some_and(|known| known.bending_nm2 != part.bending_nm2) {
            warnings.push(format!(
                "{name} says something else of [bending] in about.toml than data before it, which stands"
            ));
        }
        if let Some(other) = parts.iter().find_map(|known: &Part| contradicted(&known.measured, &part.measured)) {
            warnings.push(format!(
                "{name} says something else of [measured.{other}] in about.toml than data before it, which stands"
            ));
        }
        let of = if i > 0 { format!("{name}: ") } else { String::new() };
        warnings.extend(part.slips.iter().cloned());
        warnings.extend(told.into_iter().map(|warning| format!("{of}{warning}")));
        parts.push(part);
    }
    Ok((parts, warnings))
}

fn assemble(
    case: &Case,
    decision: &Decision,
    outliers: Outliers,
    mut warnings: Vec<String>,
) -> Result<Diagnosis, CompareError> {
    let held_out = HeldOut::new(case)?;
    let ranked = singles::rank(case, decision, &held_out);
    let pairs = pairs_of(case, decision);
    let last = decision.last.as_ref().unwrap_or(&case.base);
    let (added, attempt) = match decision.verdict {
        Some(Verdict::Effect) => (added(case, decision), Vec::new()),
        _ => (Vec::new(), added(case, decision)),
    };
    let indistinguishable = names(case, decision, &pairs);
    let undetectable = detect::undetectable(case, &indistinguishable, &added);
    let noise = NoiseSummary::of(&case.noise, &case.dataset.holds);
    warnings.extend(noise.warning.clone());
    let (residuals_before, _) = fails(case, &case.base, decision.before)?;
    let (residuals_after, leftover) = fails(case, last, decision.after)?;
    let outside = decision.verdict == Some(Verdict::OutOfCatalog);
    Ok(Diagnosis {
        scenario: case.scenario.name.clone(),
        dataset: case.dataset.name.clone(),
        actuator: case.dataset.actuator.clone(),
        runs: case.dataset.runs.len(),
        evidence: Vec::new(),
        beside: beside(case, last),
        gauges: GaugeFit::all(case, last),
        verdict: decision.verdict,
        p_value: decision.p_value,
        alpha: case.alpha,
        tolerance_mm: 1e3 * case.tolerance_m,
        confidence: confidence(case, decision),
        summary: Vec::new(),
        base: base(case, last, &held_out, &noise)?,
        noise,
        rule_out_first: rule_out_first(case, &ranked, decision),
        limits: limits::limits(&case.sources().map(|(source, _)| source.dataset).collect::<Vec<_>>(), &undetectable),
        by_design: closest::by_design(case, decision).map(|fit| as_close(case, fit)).collect(),
        ranked,
        covered: (added.len() == 1).then_some(policy::COVERED),
        indistinguishable,
        pairs,
        added,
        attempt,
        attempt_alike: decision.as_close.iter().map(|fit| as_close(case, fit)).collect(),
        lack_of_fit_before: decision.before,
        lack_of_fit_after: decision.after,
        pattern: outside
            .then(|| stands_out::left_pattern(case, decision.last.as_ref(), decision.fault.as_ref()))
            .flatten(),
        leftover,
        residuals_before,
        residuals_after,
        outliers,
        undetectable,
        kept_bending: None,
        bending_alarm: bending_alarm::bending_alarm(case, last),
        excluded: Vec::new(),
        next_experiment: None,
        missing_moment: None,
        learned: None,
        pressure_slip: None,
        slips: Vec::new(),
        warnings,
    })
}

fn beside(case: &Case, last: &Fit) -> Vec<FittedBeside> {
    let errors = case.errors_beside_mm(&case.base).into_iter().zip(case.errors_beside_mm(last));
    let entry = |(b, (before, after)): (&case::Beside, (f64, f64))| FittedBeside {
        dataset: b.source.dataset.name.clone(),
        runs: b.source.dataset.runs.len(),
        direct: b.source.direct,
        systematic_mm: before,
        systematic_with_added_mm: after,
    };
    case.beside.iter().zip(errors).map(entry).collect()
}

fn pairs_of(case: &Case, decision: &Decision) -> Vec<Combination> {
    let single = decision.set.first().map_or(&case.base, |i| &decision.singles[*i]);
    pairs::describe(case, decision, single)
}

/// Residual map of a fit, and where it fails in plain language.
fn fails(case: &Case, fit: &Fit, lof: Option<LackOfFit>) -> Result<(ResidualMap, Vec<Statement>), CompareError> {
    let prediction = case.prediction(fit);
    let c = BesideMean::new(case.dataset, &case.noise, &prediction)?;
    let map = residual_map(&c);
    let options = FailureOptions { alpha: case.alpha, tolerance_m: case.tolerance_m };
    let statements = where_it_fails(&c, &map, lof.map(|lof| lof.p_value), &options);
    Ok((map, statements))
}

fn base(case: &Case, last: &Fit, held_out: &HeldOut, noise: &NoiseSummary) -> Result<BaseFit, CompareError> {
    let intervals = interval::intervals(case, &case.base, true);
    let bendings = case.problem.bendings;
    let bending = |k: usize| Bending {
        p_body_kpa: 1e-3 * case.body_pa[k],
        value_nm2: case.base.theta()[k],
        lo: intervals[k].map(|i| i[0]),
        hi: intervals[k].map(|i| i[1]),
        at_bound: case.base.binding[k],
    };
    let nominal = crate::study::predict_dataset(case.scenario, case.dataset)?.xy_m;
    Ok(BaseFit {
        bending_nominal_nm2: case.scenario.bending_stiffness,
        bending: (0..bendings).map(bending).collect(),
        bending_with_added_nm2: last.theta()[..bendings].to_vec(),
        systematic_nominal_mm: case.error_mm(&nominal),
        systematic_mm: case.error_mm(&case.prediction(&case.base)),
        systematic_with_added_mm: case.error_mm(&case.prediction(last)),
        left_share: match case.beyond_noise_mm(&case.base) {
            before if before > 0.0 => case.beyond_noise_mm(last) / before,
            _ => 0.0,
        },
        noise_floor_mm: noise.noise_of_mean_mm,
        heldout_mm: held_out.pressure_mm(&case.base),
        heldout_run_mm: held_out.run_mm(&case.base),
        heldout_with_added_mm: held_out.pressure_mm(last),
        heldout_run_with_added_mm: held_out.run_mm(last),
    })
}

fn confidence(case: &Case, decision: &Decision) -> Option<Confidence> {
    let last = decision.last.as_ref().filter(|_| decision.verdict == Some(Verdict::Effect))?;
    let rivals = if decision.pairs.is_empty() { decision.set.len() } else { decision.pair_set.len() };
    Some(confidence_of(case.gain(last), rivals))
}

/// By the gain of an answer and the number of those that cannot be told from it, itself among them.
fn confidence_of(gain: f64, rivals: usize) -> Confidence {
    match gain {
        gain if policy::is_a_hint(gain) => Confidence::Hint,
        gain if policy::is_beyond_doubt(gain) && rivals == 1 => Confidence::IdentifiedInCatalog,
        _ => Confidence::LikelyOneOf,
    }
}

fn added(case: &Case, decision: &Decision) -> Vec<Added> {
    let Some(last) = &decision.last else { return Vec::new() };
    let values = singles::parameter_values(case, last, true);
    let mut from: usize = case.always.iter().map(|e| case.candidate(*e).parameters.len()).sum();
    let entry = |effect: &usize| {
        let candidate = case.candidate(*effect);
        let to = from + candidate.parameters.len();
        let parameters = values[from..to].to_vec();
        from = to;
        Added { effect: candidate.name.clone(), group: candidate.group, parameters }
    };
    last.effects[case.always.len()..].iter().map(entry).collect()
}

fn as_close(case: &Case, fit: &Fit) -> AsClose {
    let effects = fit.effects[case.always.len()..].iter().map(|e| case.candidate(*e).name.clone());
    AsClose { effects: effects.collect(), systematic_after_mm: case.error_in_all_mm(fit) }
}

/// Names in the set of the verdict, best first; without verdict those of the ranking.
fn names(case: &Case, decision: &Decision, pairs: &[Combination]) -> Vec<String> {
    if decision.verdict.is_some_and(|v| v != Verdict::Effect) {
        return Vec::new();
    }
    if !decision.pairs.is_empty() {
        return pairs.iter().filter(|p| p.in_set).map(|p| p.effects.join(" + ")).collect();
    }
    let name = |i: &usize| decision.singles[*i].effects.last().map(|e| case.candidate(*e).name.clone());
    decision.set.iter().filter_map(name).collect()
}

fn rule_out_first(case: &Case, ranked: &[Ranked], decision: &Decision) -> Vec<String> {
    if decision.verdict.is_some_and(|v| v != Verdict::Effect) {
        return Vec::new();
    }
    // A gauge has been asked already.
    let read = case.sources().any(|(source, _)| source.gauge.is_some());
    let doubtful = |r: &&Ranked| r.in_set && r.group.is_nuisance() && !(read && r.group == Group::Supply);
    ranked.iter().filter(doubtful).map(|r| r.effect.clone()).collect()
}
