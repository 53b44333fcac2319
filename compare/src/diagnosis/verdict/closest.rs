//! What comes closest to the measurements in millimetres, where nothing explains them.
//!
//! The best by the whitened sum of squares may mend small differences of quiet holds and leave the robot far off where runs
//! scatter. So an answer that is not enough is judged by the distance that it leaves, and is not named alone:
//! answers that leave the same distance to a fifth are reported with it.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::Verdict;
use crate::fit::numbers::sort_by;
use crate::policy;

/// Two effects if a pair comes closer by a fifth than any single one, else one: the final model if it has as many and none of them
/// comes closer by a fifth, else the nearest.
pub(crate) fn closest(case: &DiagnosisCase, [singles, pairs]: [&[Fit]; 2], last: Fit) -> Fit {
    let (singles, pairs) = (by_distance(case, singles), by_distance(case, pairs));
    let least = |fits: &[(f64, &Fit)]| fits.first().map_or(f64::INFINITY, |(error, _)| *error);
    let wants_two = policy::is_closer(least(&pairs), least(&singles));
    let is_two = case.added(&last).len() > 1;
    match if wants_two { pairs } else { singles }.first() {
        Some((error, nearest)) if wants_two != is_two || policy::is_closer(*error, case.error_in_all_mm(&last)) => {
            (*nearest).clone()
        }
        _ => last,
    }
}

/// The closest, then answers that leave the same distance to a fifth and less than the base: single effects, and for a pair the pairs of
/// which no member does so alone, nearest first.
pub(crate) fn as_close(case: &DiagnosisCase, [singles, pairs]: [&[Fit]; 2], closest: &Fit) -> Vec<Fit> {
    let added = |fit: &Fit| case.added(fit).to_vec();
    let (own, before) = (added(closest), case.error_in_all_mm(&case.base));
    let most = (case.error_in_all_mm(closest) / policy::CLOSER).min(before);
    let near = |fits: &[Fit]| -> Vec<Fit> {
        let all = by_distance(case, fits).into_iter();
        all.filter(|(error, fit)| *error < most && added(fit) != own).map(|(_, fit)| fit.clone()).collect()
    };
    let singles = near(singles);
    let pairs = if own.len() > 1 { near(pairs) } else { Vec::new() };
    let alone: Vec<usize> = singles.iter().flat_map(&added).collect();
    let pairs = pairs.into_iter().filter(|pair| !added(pair).iter().any(|effect| alone.contains(effect)));
    std::iter::once(closest.clone()).chain(singles).chain(pairs).collect()
}

/// What follows from the design and takes a fifth of the error, the nearest first; none where the verdict is that nothing is missing.
pub(crate) fn by_design<'d>(
    case: &DiagnosisCase,
    verdict: Option<Verdict>,
    singles: &'d [Fit],
) -> impl Iterator<Item = &'d Fit> {
    let is_open = verdict != Some(Verdict::None);
    let before = case.error_in_all_mm(&case.base);
    let mut pay = by_distance(case, if is_open { singles } else { &[] });
    let is_by_design = |fit: &Fit| fit.effects.last().is_some_and(|e| case.candidate(*e).is_by_design());
    pay.retain(|(after, fit)| is_by_design(fit) && policy::is_closer(*after, before));
    pay.into_iter().map(|(_, fit)| fit)
}

fn by_distance<'f>(case: &DiagnosisCase, fits: &'f [Fit]) -> Vec<(f64, &'f Fit)> {
    let accepted = fits.iter().filter(|fit| !case.is_rejected(fit));
    let mut errors: Vec<(f64, &Fit)> = accepted.map(|fit| (case.error_in_all_mm(fit), fit)).collect();
    sort_by(&mut errors, |(mm, _)| *mm);
    errors
}
