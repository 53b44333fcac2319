//! The answer with the bending stiffness as the scenario has it, where with a fitted one there is none.
//!
//! A fitted B takes up part of every effect, and where the base misses by far it takes up the wrong part: with it goes the
//! pressure's slope, and with that what counts as scatter between runs (7.6 % of the pressure in place of 1.8 on the ePAM of the
//! finite elements). Such a base overrules a `[bending]` of `about.toml` as well, so B has to be kept. Whether the robot has it is
//! for a bending test to say, not for these data.

use super::diagnose;
use super::options::Options;
use super::result::{Diagnosis, KeptBending, Verdict};
use crate::error::CompareError;
use crate::evidence::Evidence;
use crate::policy;
use models::Scenario;

/// That answer, if `found` has none, nobody measured B, and it comes closer by a fifth.
///
/// # Errors
/// As [`diagnose`].
pub fn kept_bending(
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
    let options = Options { keep_bending: true, next_experiment: false, missing_moment: false, ..options.clone() };
    let kept = diagnose(scenario, evidence, &options, &mut |_, _| ())?;
    let after = kept.base.systematic_with_added_mm;
    let is_closer = policy::is_closer(after, found.base.systematic_with_added_mm);
    Ok((kept.verdict == Some(Verdict::Effect) && is_closer).then_some(KeptBending {
        value_nm2: kept.base.bending_nominal_nm2,
        indistinguishable: kept.indistinguishable,
        systematic_after_mm: after,
    }))
}
