//! What was decided, as a reader gets it.

use crate::beside_mean::BesideMean;
use crate::diagnosis::bending_alarm::bending_alarm;
use crate::diagnosis::candidates::taken_away;
use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::closest::by_design;
use crate::diagnosis::decide::Decision;
use crate::diagnosis::detect::undetectable;
use crate::diagnosis::heldout::HeldOut;
use crate::diagnosis::interval::intervals;
use crate::diagnosis::left_patterns::left_pattern;
use crate::diagnosis::limits::{limits, not_in_space};
use crate::diagnosis::order;
use crate::diagnosis::pairs::describe;
use crate::diagnosis::problem::{Block, Fit};
use crate::diagnosis::result::*;
use crate::diagnosis::singles::{parameter_values, rank};
use crate::diagnosis::source::DiagnosisSource;
use crate::diagnosis::worth::worth;
use crate::error::CompareError;
use crate::evidence::{Evidence, Used};
use crate::fit::numbers::mean;
use crate::gauge::GaugeReading;
use crate::noise_summary::NoiseSummary;
use crate::policy;
use crate::prepare::Outliers;
use crate::residuals::{ResidualMap, residual_map};
use crate::slips::pressure::PressureSlipFound;
use crate::study::predict_dataset;
use crate::where_it_fails::{Statement, where_it_fails};

pub(crate) struct Beside<'e> {
    pub evidence: &'e [Evidence],
    pub excluded: Vec<String>,
    pub outliers: Outliers,
    pub slips: Vec<String>,
    pub pressure_slip: Option<PressureSlipFound>,
    pub warnings: Vec<String>,
}

/// The whole diagnosis except the parts that need a finished verdict: the story, the next experiment, the missing moment.
pub(crate) fn assemble(
    case: &DiagnosisCase,
    decision: &Decision,
    mut beside: Beside,
) -> Result<Diagnosis, CompareError> {
    let evidence = beside.evidence;
    let held_out = HeldOut::new(case)?;
    let mut ranked = rank(case, &decision.singles, &held_out);
    let is_untold = evidence[0].about.as_ref().is_some_and(|a| a.gravity_direction.is_none());
    for gravity in ranked.iter_mut().filter(|r| is_untold && r.effect == "gravity") {
        let words =
            "about.toml names no [gravity] direction: out of the question if the robot bends in a horizontal plane";
        gravity.notes.push(words.into());
    }
    let single = decision.singles.stated().next().unwrap_or(&case.base);
    let pairs = describe(case, &decision.pairs, single);
    let last = decision.last.as_ref().unwrap_or(&case.base);
    let (added, attempt) = match decision.verdict {
        Some(Verdict::Effect) => (added(case, decision), Vec::new()),
        _ => (Vec::new(), added(case, decision)),
    };
    let indistinguishable = names(case, decision, &pairs);
    let undetectable = undetectable(case, &indistinguishable, &added);
    let first = case.first();
    let noise = NoiseSummary::of(case.noise(), &first.dataset.holds);
    beside.warnings.extend(noise.warning.clone());
    let (residuals_before, _) = fails(case, &case.base, decision.before)?;
    let (residuals_after, leftover) = fails(case, last, decision.after)?;
    let outside = decision.verdict == Some(Verdict::OutOfCatalog);
    let pattern = outside.then(|| left_pattern(case, decision.last.as_ref(), decision.fault.as_ref())).flatten();
    let as_close = |fit: &Fit| AsClose { effects: case.names(fit), systematic_after_mm: case.error_in_all_mm(fit) };
    let datasets: Vec<_> = case.sources.iter().map(|source| &source.dataset).collect();
    Ok(Diagnosis {
        scenario: first.scenario.name.clone(),
        dataset: first.dataset.name.clone(),
        actuator: first.dataset.actuator.clone(),
        runs: first.dataset.runs.len(),
        evidence: evidence.iter().map(Used::of).collect::<Result<_, _>>()?,
        foreign_bases: evidence.iter().filter_map(|one| one.base.clone()).collect(),
        beside: fitted_beside(case, last),
        gauges: case.problem.blocks.iter().filter_map(|block| gauge_fit(case, block, last)).collect(),
        verdict: decision.verdict,
        p_value: decision.p_value,
        alpha: case.alpha,
        tolerance_mm: 1e3 * case.tolerance_m,
        confidence: confidence(case, decision),
        summary: Vec::new(),
        base: base(case, last, &held_out, &noise)?,
        noise,
        rule_out_first: rule_out_first(case, &ranked, decision),
        limits: [limits(&datasets, &undetectable), not_in_space(&first.scenario)].concat(),
        by_design: by_design(case, decision.verdict, &decision.singles.fits).map(as_close).collect(),
        ranked,
        covered: is_covered(case, &added).then_some(policy::COVERED),
        indistinguishable,
        pairs,
        added,
        worth: decision.answer().map(|fit| worth(case, fit)),
        attempt,
        attempt_alike: decision.as_close.iter().map(as_close).collect(),
        lack_of_fit_before: decision.before,
        lack_of_fit_after: decision.after,
        pattern,
        leftover,
        residuals_before,
        residuals_after,
        outliers: beside.outliers,
        undetectable,
        kept_bending: None,
        other_design: None,
        bending_alarm: bending_alarm(case, last).filter(|_| beside.pressure_slip.is_none()),
        excluded: beside.excluded,
        next_experiment: None,
        missing_moment: None,
        learned: None,
        pressure_slip: beside.pressure_slip,
        slips: beside.slips,
        warnings: beside.warnings,
    })
}

/// Whether the share of true answers is known: the made-up robots were planar.
fn is_covered(case: &DiagnosisCase, added: &[Added]) -> bool {
    !added.is_empty() && !case.first().scenario.is_spatial()
}

fn fitted_beside(case: &DiagnosisCase, last: &Fit) -> Vec<FittedBeside> {
    let [before, after] = [&case.base, last].map(|fit| case.errors_mm(fit));
    let of = |(i, source): (usize, &DiagnosisSource)| FittedBeside {
        dataset: source.dataset.name.clone(),
        runs: source.dataset.runs.len(),
        direct: source.direct,
        systematic_mm: before[i],
        systematic_with_added_mm: after[i],
    };
    case.sources.iter().enumerate().skip(1).map(of).collect()
}

fn gauge_fit(case: &DiagnosisCase, block: &Block, last: &Fit) -> Option<GaugeFit> {
    let rms = |d: &[f64]| 1e-3 * mean(d.iter().map(|d| d * d)).sqrt();
    let readings = &block.source.gauge.as_ref()?.readings;
    let [before, after] = [&case.base, last].map(|fit| case.problem.supply_pa(block, &fit.effects, fit.theta()));
    let kpa = |of: fn(&GaugeReading) -> f64| readings.iter().map(|r| 1e-3 * of(r)).collect();
    Some(GaugeFit {
        dataset: block.source.dataset.name.clone(),
        set_kpa: kpa(|r| r.set_pa),
        held_s: readings.iter().map(|r| r.at.held_s).collect(),
        read_kpa: kpa(|r| r.read_pa),
        with_added_kpa: readings.iter().zip(&after).map(|(r, after)| 1e-3 * (r.read_pa + after)).collect(),
        before_kpa: rms(&before),
        after_kpa: rms(&after),
    })
}

fn fails(
    case: &DiagnosisCase,
    fit: &Fit,
    lof: Option<LackOfFit>,
) -> Result<(ResidualMap, Vec<Statement>), CompareError> {
    let prediction = case.prediction(fit);
    let c = BesideMean::new(&case.first().dataset, case.noise(), &prediction)?;
    let map = residual_map(&c);
    let statements = where_it_fails(&c, &map, lof.map(|lof| lof.p_value), case.alpha, case.tolerance_m);
    Ok((map, statements))
}

fn base(case: &DiagnosisCase, last: &Fit, held_out: &HeldOut, noise: &NoiseSummary) -> Result<BaseFit, CompareError> {
    let intervals = intervals(case, &case.base, true);
    let bending = |(k, value_nm2): (usize, f64)| Bending {
        p_body_kpa: 1e-3 * case.body_pa[k],
        value_nm2,
        lo: intervals[k].map(|i| i[0]),
        hi: intervals[k].map(|i| i[1]),
        at_bound: case.base.binding[k],
    };
    let nominal = predict_dataset(&case.first().scenario, &case.first().dataset)?.coordinates_m;
    Ok(BaseFit {
        bending_nominal_nm2: case.first().scenario.bending_stiffness,
        bending: case.bendings(&case.base).into_iter().enumerate().map(bending).collect(),
        bending_with_added_nm2: case.bendings(last),
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

fn confidence(case: &DiagnosisCase, decision: &Decision) -> Option<Confidence> {
    let last = decision.answer()?;
    let stated = if decision.pairs.fits.is_empty() { &decision.singles } else { &decision.pairs };
    let sure = confidence_of(case.gain(last), stated.set.len());
    let most = if order::is_unusual(case, last) { Confidence::LikelyOneOf } else { sure };
    Some(sure.min(most))
}

/// By the gain of an answer and the number of answers that fit as well, itself included.
pub(crate) fn confidence_of(gain: f64, rivals: usize) -> Confidence {
    match gain {
        gain if policy::is_a_hint(gain) => Confidence::Hint,
        gain if policy::is_beyond_doubt(gain) && rivals == 1 => Confidence::IdentifiedInCatalog,
        _ => Confidence::LikelyOneOf,
    }
}

fn added(case: &DiagnosisCase, decision: &Decision) -> Vec<Added> {
    let Some(last) = &decision.last else { return Vec::new() };
    let own: usize = case.always.iter().map(|e| case.candidate(*e).parameters.len()).sum();
    let mut values = parameter_values(case, last, true).into_iter().skip(own);
    let entry = |effect: &usize| {
        let candidate = case.candidate(*effect);
        let parameters = values.by_ref().take(candidate.parameters.len()).collect();
        Added { effect: candidate.name.clone(), group: candidate.group, parameters }
    };
    case.added(last).iter().map(entry).collect()
}

/// Names in the set of the verdict, best first; without verdict, names of the ranking.
fn names(case: &DiagnosisCase, decision: &Decision, pairs: &[Combination]) -> Vec<String> {
    if decision.verdict.is_some_and(|v| v != Verdict::Effect) {
        return Vec::new();
    }
    if !pairs.is_empty() {
        return pairs.iter().filter(|p| p.in_set).map(|p| p.effects.join(" + ")).collect();
    }
    let name = |fit: &Fit| fit.effects.last().map(|e| case.candidate(*e).name.clone());
    decision.singles.stated().filter_map(name).collect()
}

fn rule_out_first(case: &DiagnosisCase, ranked: &[Ranked], decision: &Decision) -> Vec<String> {
    if decision.verdict.is_some_and(|v| v != Verdict::Effect) {
        return Vec::new();
    }
    // A gauge has been asked already.
    let doubtful = |r: &&Ranked| {
        r.in_set
            && taken_away(&r.effect).is_none()
            && r.group.is_nuisance()
            && !(case.is_gauged() && r.group == Group::Supply)
    };
    ranked.iter().filter(doubtful).map(|r| r.effect.clone()).collect()
}
