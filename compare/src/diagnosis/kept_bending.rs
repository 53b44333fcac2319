//! The answer with the bending stiffness as the scenario has it, where with a fitted one there is none.
//!
//! A fitted B takes up part of every effect, and where the base misses by far it takes up the wrong part: with it goes the
//! pressure's slope, and with that what counts as scatter between runs (7.6 % of the pressure in place of 1.8 on the ePAM of the
//! finite elements). Such a base overrules a `[bending]` of `about.toml` as well, so B has to be kept. Whether the robot has it is
//! for a bending test to say, not for these data.

use super::options::Options;
use super::result::{Diagnosis, KeptBending, Verdict};
use super::{Measured, diagnose_together};
use crate::error::CompareError;
use crate::policy;
use models::Scenario;

/// That answer, if `found` has none, nobody measured B, and it comes closer by a fifth.
///
/// # Errors
/// As [`diagnose_together`].
pub fn kept_bending(
    found: &Diagnosis,
    scenario: &Scenario,
    first: Measured,
    further: &[Measured],
    options: &Options,
) -> Result<Option<KeptBending>, CompareError> {
    let mut all = std::iter::once(&first).chain(further);
    let is_known = options.keep_bending || all.any(|m| m.about.is_some_and(|about| about.bending_nm2.is_some()));
    if is_known || found.verdict != Some(Verdict::OutOfCatalog) {
        return Ok(None);
    }
    let options = Options { keep_bending: true, next_experiment: false, ..options.clone() };
    let kept = diagnose_together(scenario, first, further, &options)?;
    let after = kept.base.systematic_with_added_mm;
    let is_closer = after < policy::CLOSER * found.base.systematic_with_added_mm;
    Ok((kept.verdict == Some(Verdict::Effect) && is_closer).then_some(KeptBending {
        value_nm2: kept.base.bending_nominal_nm2,
        indistinguishable: kept.indistinguishable,
        systematic_after_mm: after,
    }))
}
