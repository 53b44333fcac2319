//! Which physical effect is missing, what it would bring, and when the data cannot decide.
//!
//! ```text
//! prepare ─► noise, base ─► every effect refitted ─► one p ─► set ─► pairs if needed ─► lack of fit, places ─► verdict
//! (source)      (case)          (screen, singles)                       (pairs)            (lack_of_fit, left_patterns, decide)
//!                                 └─► intervals, held-out error, smallest detectable sizes (assemble), next experiment
//! ```
//!
//! Several data of one robot are blocks of one fit; what was measured directly leaves nothing to explain there (`data::Direct`).
//!
//! All fits minimise the whitened sum of squares of the mean over runs ([`crate::noise`]: the run is the unit). Gains are
//! falls of that sum against the calibrated base; under "nothing is missing" a gain by q parameters follows about q·F(q,
//! dof of σ²), and p is multiplied by the number of independent tests among the effects. Effects with a bound at their
//! neutral value and thresholds make that conservative (Chernoff; Davies). The data cannot separate the members of the set: BIC within 6 of the
//! best, or 95 % of its gain. A name is the best explanation *in the catalogue*, never a proof.

mod bench;
mod case;
mod hypotheses;
mod moments;
mod next;
mod options;
mod other_design;
mod result;
mod source;
#[cfg(test)]
mod tests;
pub(crate) mod verdict;

pub use crate::prepare::{Outliers, OutlyingRun};
pub use crate::slips::pressure::{BestEffect, PressureSlipFound};
pub(crate) use answers::in_step;
pub use answers::{EffectAnswer, Standing, with_fitted};
pub use bench::{BenchDiagnosis, BenchOptions, BenchRanked, LeftOut, diagnose_bench};
pub use candidates::taken_away;
pub use experiments::{BENDING_TEST, BENDING_TEST_NAME};
pub use known::{BENCH_TEST, BENCH_TESTS, BenchTest};
pub use options::{Options, PRESSURES_ARE_RIGHT};
pub use pressures::pressure_slip;
use pressures::slip_of_another_design;
pub use result::*;

use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::policy;
use crate::prepare::outlying_runs;
use crate::progress::shares::{DIAGNOSIS, PAIRS};
use crate::progress::{Progress, part};
use crate::slips::pressure::pressure_words;
use assemble::{Beside, assemble};
use case::{DiagnosisCase, catalogue};
use decide::decide;
use hypotheses::{candidates, detect, evaluator, heldout, interval, known, order, pairs, problem, screen, singles};
use models::Scenario;
use moments::{learned, missing};
use next::{experiments, worth};
use other_design::other_design;
use pressures::PressureCheck;
use source::DiagnosisSource;
use story::story;
use verdict::{assemble, bending_alarm, closest, decide, lack_of_fit, left_patterns, limits, patterns, pressures};

/// Diagnoses measurements: is an effect missing in the scenario, which one, and which experiment would decide. Several data of one robot
/// each have their own protocol and loads: one bending stiffness for every body pressure and one value of every parameter must meet
/// them all. Errors in millimetres, places and held-out parts refer to the first data.
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
    if evidence.is_empty() {
        return Err(CompareError::refused("no data to diagnose", "give measurements"));
    }
    // Another simulator's design is not the scenario's.
    let is_ours = evidence.iter().all(|one| one.base.is_none());
    let options = &Options { other_design: options.other_design && is_ours, ..options.clone() };
    let (sources, mut warnings) = DiagnosisSource::all(scenario, evidence)?;
    warnings.extend(sources.iter().flat_map(|source| known::unusual(&source.measured, scenario)));
    let (candidates, own) = catalogue(&sources, options);
    let mut wider = Vec::new();
    let pressures = PressureCheck { sources: &sources, options };
    let mut case =
        DiagnosisCase::new(&sources, (&candidates, own), options).map_err(|error| pressures.refusal(error))?;
    let [of_singles, of_pairs] = [[0.0, PAIRS], [PAIRS, 1.0]].map(|ends| ends.map(|end| end * DIAGNOSIS[0]));
    let singles = singles::fit_all(&mut case, &mut wider, &mut part(progress, of_singles));
    let case = case;
    let runs = outlying_runs(&case.first().dataset, case.noise());
    warnings.extend(runs.iter().map(OutlyingRun::words));
    warnings.extend(limits::warnings(&case));
    let decision = decide(&case, singles, options, &mut part(progress, of_pairs))?;
    let mut pressure_slip = pressures.found(&case, || Ok(decision.rivals()))?;
    let is_alarm = matches!(decision.verdict, Some(Verdict::Effect | Verdict::OutOfCatalog));
    if pressure_slip.is_none() && options.other_design && is_alarm && pressures.may_slip_in_another_design(&case) {
        pressure_slip = slip_of_another_design(scenario, evidence, options)?;
    }
    let decision = if pressure_slip.is_some() { decision.withheld() } else { decision };
    warnings.extend(singles::left_out(&case, &decision.singles.fits));
    let mut slips: Vec<String> = sources.iter().flat_map(|source| source.slips.clone()).collect();
    if let Some(found) = &pressure_slip {
        // A slip that the numbers alone show is reported once.
        let in_numbers: Vec<String> = evidence.iter().flat_map(|e| pressure_words(&e.dataset)).collect();
        for told in [&mut slips, &mut warnings] {
            told.retain(|words| !in_numbers.contains(words));
            told.insert(0, found.words.clone());
        }
    }
    progress("left-out data", Some(DIAGNOSIS[0]));
    let outliers = Outliers { runs, ..sources[0].outliers.clone() };
    let excluded = options.not.clone();
    let found = assemble(&case, &decision, Beside { evidence, excluded, outliers, slips, pressure_slip, warnings })?;
    if found.pressure_slip.is_some() {
        return Ok(Diagnosis { summary: story(&found), ..found });
    }
    let found = Diagnosis { kept_bending: kept_bending(&found, scenario, evidence, options)?, ..found };
    let found = match other_design(&found, scenario, evidence, options)? {
        // A name is not the only one of its kind where the robot may be made otherwise.
        Some(other) => {
            let confidence = found.confidence.map(|sure| sure.min(Confidence::LikelyOneOf));
            Diagnosis { other_design: Some(other), confidence, ..found }
        }
        None => found,
    };
    let mut next_experiment = None;
    if options.next_experiment {
        progress("the next experiment", Some(DIAGNOSIS[1]));
        next_experiment = next::next_experiment(&case, &decision, look::next(&found))?;
    }
    let (mut shown, mut warnings) = (Default::default(), found.warnings.clone());
    let one_way = !scenario.is_spatial() && sources.iter().all(|source| !source.dataset.channels_differ());
    if (options.missing_moment || options.learn) && one_way {
        // It illustrates a verdict and decides none: if it fails, the verdict stays.
        match learned::moments(&case, &decision, options, &found) {
            Ok(moments) => shown = moments,
            Err(error) => warnings.push(format!("no missing moment is shown: {error}")),
        }
    }
    let (missing_moment, learned) = shown;
    let found = Diagnosis { next_experiment, missing_moment, learned, warnings, ..found };
    Ok(Diagnosis { summary: story(&found), ..found })
}

/// The answer with the bending stiffness as the scenario has it, if `found` has none, B was not measured, and it comes closer by a fifth.
///
/// A fitted B takes up part of every effect, and where the base misses by far it takes up the wrong part: with it goes the
/// pressure's slope, and with that what counts as scatter between runs (7.6 % of the pressure in place of 1.8 on the ePAM of the
/// finite elements). Such a base overrules a `[bending]` of `about.toml` as well, so B has to be kept. Whether the robot has it is
/// for a bending test to say, not for these data.
fn kept_bending(
    found: &Diagnosis,
    scenario: &Scenario,
    evidence: &[Evidence],
    options: &Options,
) -> Result<Option<KeptBending>, CompareError> {
    let is_measured = |e: &Evidence| e.about.as_ref().is_some_and(|about| about.bending_nm2.is_some());
    let is_known = options.keep_bending || evidence.iter().any(is_measured);
    if is_known || found.verdict != Some(Verdict::OutOfCatalog) {
        return Ok(None);
    }
    let (next_experiment, missing_moment, other_design) = (false, false, false);
    let options = Options { keep_bending: true, next_experiment, missing_moment, other_design, ..options.clone() };
    let kept = diagnose(scenario, evidence, &options, &mut |_, _| ())?;
    let after = kept.base.systematic_with_added_mm;
    let is_closer = policy::is_closer(after, found.base.systematic_with_added_mm);
    Ok((kept.verdict == Some(Verdict::Effect) && is_closer).then_some(KeptBending {
        value_nm2: kept.base.bending_nominal_nm2,
        indistinguishable: kept.indistinguishable,
        systematic_after_mm: after,
    }))
}
