//! The same data diagnosed with another design of the robot.

use super::candidates::WITHOUT;
use super::case::{DiagnosisCase, catalogue};
use super::decide::decide;
use super::options::Options;
use super::problem::Fit;
use super::result::{Diagnosis, OtherDesign, Verdict};
use super::singles::fit_all;
use super::source::DiagnosisSource;
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::policy;
use crate::study::published::shipped_scenario;
use models::Scenario;
use models::scenario::EffectChoice;

/// The answer with every mechanism of the shipped robot of this kind, or with none of them, nothing of them fitted: if what `found`
/// leaves is more than noise and beyond the tolerance, or its stiffness is on a bound, and it leaves less by a fifth. One mechanism alone is a candidate like any other.
pub(super) fn other_design(
    found: &Diagnosis,
    scenario: &Scenario,
    evidence: &[Evidence],
    options: &Options,
) -> Result<Option<OtherDesign>, CompareError> {
    let is_more = found.lack_of_fit_after.is_some_and(|left| left.p_value < found.alpha);
    let is_large = !policy::is_good_enough(found.base.systematic_with_added_mm, found.tolerance_mm);
    let is_doubtful = is_more && (is_large || found.base.bending.iter().any(|b| b.at_bound));
    let is_open = matches!(found.verdict, Some(Verdict::Effect | Verdict::OutOfCatalog)) && is_doubtful;
    if !options.other_design || !is_open {
        return Ok(None);
    }
    let mut best: Option<OtherDesign> = None;
    let options = &Options { pairs: false, ..options.clone() };
    for (other, switched) in designs(scenario, options)? {
        // A robot without equilibrium at these pressures explains nothing.
        let Ok(Some(answer)) = of_design(&other, switched, evidence, options, found.base.systematic_mm) else {
            continue;
        };
        let most = best.as_ref().map_or_else(|| own_mm(found), |best| best.systematic_after_mm);
        if policy::is_closer(answer.systematic_after_mm, most) {
            best = Some(answer);
        }
    }
    Ok(best)
}

/// What the scenario's own answer leaves; where it explains nothing, what its best single effect leaves, because other designs are asked
/// for no pairs \[mm\].
fn own_mm(found: &Diagnosis) -> f64 {
    let base = &found.base;
    if found.verdict == Some(Verdict::Effect) {
        return base.systematic_with_added_mm;
    }
    let singles = found.ranked.iter().filter(|row| !row.at_bound).map(|row| row.systematic_after_mm);
    singles.fold(base.systematic_mm, f64::min)
}

/// The scenario with every mechanism of the shipped robot of this kind, and with none of them, as far as that switches several; each with
/// what it switches, as candidates are called.
pub(super) fn designs(scenario: &Scenario, options: &Options) -> Result<Vec<(Scenario, Vec<String>)>, CompareError> {
    let has = |e: &&EffectChoice| scenario.effects.iter().any(|own| own.name == e.name);
    let all = shipped_scenario(scenario.actuator.kind.name)?.effects;
    let (own, mut lacking): (Vec<_>, Vec<_>) = all.iter().partition(has);
    let catalogue = scenario.catalogue();
    lacking.retain(|e| catalogue.by_name(&e.name).is_some_and(|e| scenario.takes(&e)) && !options.excludes(&e.name));
    let gone: Vec<String> =
        own.into_iter().map(|e| format!("{WITHOUT}{}", e.name)).filter(|n| !options.excludes(n)).collect();
    let with = lacking.iter().fold(scenario.clone(), |with, e| with.with_effect(&e.name, &e.values));
    let mut without = scenario.clone();
    without.effects.retain(|e| !gone.contains(&format!("{WITHOUT}{}", e.name)));
    let new: Vec<String> = lacking.into_iter().map(|e| e.name.clone()).collect();
    Ok([(with, new), (without, gone)].into_iter().filter(|(_, switched)| switched.len() > 1).collect())
}

/// What single effects make of another design; `None` where its base is further off than the robot's own of `own_mm`.
fn of_design(
    scenario: &Scenario,
    switched: Vec<String>,
    evidence: &[Evidence],
    options: &Options,
    own_mm: f64,
) -> Result<Option<OtherDesign>, CompareError> {
    let (sources, _) = DiagnosisSource::all(scenario, evidence)?;
    let (candidates, own) = catalogue(&sources, options);
    let mut wider = Vec::new();
    let mut case = DiagnosisCase::new(&sources, (&candidates, own), options)?;
    let error_mm = |case: &DiagnosisCase, fit: &Fit| case.error_mm(&case.prediction(fit));
    let systematic_mm = error_mm(&case, &case.base);
    if !policy::may_be_made_so(systematic_mm, own_mm) {
        return Ok(None);
    }
    let singles = fit_all(&mut case, &mut wider, &mut |_, _| ());
    let decision = decide(&case, singles, options, &mut |_, _| ())?;
    let is_effect = decision.verdict == Some(Verdict::Effect);
    let stated = decision.singles.stated().filter(|_| is_effect);
    Ok(Some(OtherDesign {
        switched,
        systematic_mm,
        verdict: decision.verdict,
        indistinguishable: stated.map(|fit| case.names(fit).join(" + ")).collect(),
        systematic_after_mm: error_mm(&case, decision.last.as_ref().unwrap_or(&case.base)),
    }))
}
