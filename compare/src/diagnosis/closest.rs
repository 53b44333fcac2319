//! What comes closest to the measurements in millimetres, where nothing explains them.
//!
//! The best by the whitened sum of squares may mend small differences of quiet holds and leave the robot far off where runs
//! scatter. An answer that is not enough is judged by the distance that it leaves, and is no more a bare name than one that is:
//! what leaves the same distance to a fifth is told beside it.

use super::case::Case;
use super::decide::Decision;
use super::problem::Fit;

/// Another attempt, or a second effect, must bring the error in mm below this share; a second effect, or within the tolerance.
pub const CLOSER: f64 = 0.8;

/// The final model, or a single effect, or a pair, each only if it comes closer by a fifth.
pub fn closest(case: &Case, decision: &Decision, last: Fit) -> Fit {
    let mut best = (case.error_in_all_mm(&last), last);
    for fits in [&decision.singles, &decision.pairs] {
        if let Some((error, fit)) = by_distance(case, fits).into_iter().next()
            && error < CLOSER * best.0
        {
            best = (error, fit.clone());
        }
    }
    best.1
}

/// Others with as many effects that leave the same distance to a fifth, nearest first.
pub fn as_close(case: &Case, decision: &Decision, closest: &Fit) -> Vec<Fit> {
    let effects = |fit: &Fit| {
        let mut effects = fit.effects.clone();
        effects.sort_unstable();
        effects
    };
    let (own, error) = (effects(closest), case.error_in_all_mm(closest));
    let fits = if own.len() - case.always.len() < 2 { &decision.singles } else { &decision.pairs };
    let near = by_distance(case, fits).into_iter().filter(|(e, fit)| CLOSER * e < error && effects(fit) != own);
    near.map(|(_, fit)| fit.clone()).collect()
}

/// Fits that no bound rejects and their errors in mm, nearest first.
fn by_distance<'f>(case: &Case, fits: &'f [Fit]) -> Vec<(f64, &'f Fit)> {
    let accepted = fits.iter().filter(|fit| !case.is_rejected(fit));
    let mut errors: Vec<(f64, &Fit)> = accepted.map(|fit| (case.error_in_all_mm(fit), fit)).collect();
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    errors
}
