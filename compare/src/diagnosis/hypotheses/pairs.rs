//! Two effects at once, when one is not enough: greedy search alone fails where two compensate each other.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::order::{Ordered, criterion};
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::Combination;
use crate::diagnosis::screen::{score, starts};
use crate::diagnosis::singles::parameter_values;
use crate::fit::basis::{Basis, cosine};
use crate::fit::numbers::{differences, sort_by};
use crate::policy;
use crate::progress::{Progress, each};
use crate::stats::reported_p;

/// Pairs refitted, the most promising by screening every effect on top of every other.
const REFITTED: usize = 32;
const REPORTED: usize = 12;
/// What has more numbers than this mends anything next to another effect: it is an answer alone.
const MOST_SIZES: usize = 2;

/// p of the best further effect on top of a fit, screened and corrected for all effects; 1 if there is none.
pub(crate) fn another_wanted(case: &DiagnosisCase, fit: &Fit) -> f64 {
    let free = Basis::of(&fit.minimum.jacobian);
    let others = case.tried.iter().filter(|e| !fit.effects.contains(e));
    let best = others.filter_map(|e| score(&case.problem, fit, &free, *e)).map(|s| s.gain).fold(0.0, f64::max);
    case.p_of_gain(best, 1, case.tests).unwrap_or(1.0)
}

/// Promising pairs fitted, without those that a bound rejects; and how many there are in all.
pub(crate) fn fit_pairs(case: &DiagnosisCase, singles: &[Fit], progress: &mut Progress) -> (Vec<Fit>, usize) {
    let fit = |(a, b): &(usize, usize)| {
        let (first, second) = (&singles[*a], &singles[*b]);
        let effects = [&first.effects[..], &[own(second)]].concat();
        let mut all = starts(&case.problem, first, own(second), false);
        all.truncate(2);
        all.extend(swapped(case, first, second));
        case.problem.fit(&effects, &all).filter(|fit| !case.is_rejected(fit))
    };
    let fits =
        each(&promising(case, singles), "fitting pairs of effects", progress, fit).into_iter().flatten().collect();
    (fits, singles.len() * singles.len().saturating_sub(1) / 2)
}

/// Pairs (index of the better single, of the other) in order of the sum of squares that screening expects of them.
fn promising(case: &DiagnosisCase, singles: &[Fit]) -> Vec<(usize, usize)> {
    let n = singles.len();
    let mut expected = vec![f64::INFINITY; n * n];
    let may_join = |fit: &Fit| case.candidate(own(fit)).sizes() <= MOST_SIZES;
    for (a, first) in singles.iter().enumerate().filter(|(_, fit)| may_join(fit)) {
        let free = Basis::of(&first.minimum.jacobian);
        for (b, second) in singles.iter().enumerate().filter(|(b, fit)| *b != a && may_join(fit)) {
            let gain = score(&case.problem, first, &free, own(second)).map_or(0.0, |s| s.gain);
            let (low, high) = (a.min(b), a.max(b));
            let place = &mut expected[low * n + high];
            *place = place.min(first.cost() - gain);
        }
    }
    let mut order: Vec<usize> = (0..n * n).filter(|i| expected[*i].is_finite()).collect();
    sort_by(&mut order, |i| expected[*i]);
    order.iter().take(REFITTED).map(|i| (i / n, i % n)).collect()
}

fn own(fit: &Fit) -> usize {
    fit.effects[fit.effects.len() - 1]
}

/// The start from the second effect's fit with the first one's expected amount on top, in the order of the pair.
fn swapped(case: &DiagnosisCase, first: &Fit, second: &Fit) -> Option<Vec<f64>> {
    let effect = own(first);
    let free = Basis::of(&second.minimum.jacobian);
    let amount = score(&case.problem, second, &free, effect).filter(|s| s.amount != 0.0)?.amount;
    let kept = second.theta().len() - case.candidate(own(second)).parameters.len();
    let (base, own) = second.theta().split_at(kept);
    let values = case.candidate(effect).at(amount);
    Some([base, &values, own].concat())
}

pub(crate) fn indistinguishable(case: &DiagnosisCase, pairs: &[Fit], allowance: f64) -> Vec<usize> {
    let Some(best) = pairs.first() else { return Vec::new() };
    let c = |fit: &Fit| criterion(case, fit, allowance);
    let is_alike = |i: &usize| policy::is_alike(c(&pairs[*i]), c(best));
    (0..pairs.len()).filter(is_alike).collect()
}

pub(crate) fn describe(case: &DiagnosisCase, pairs: &Ordered, single: &Fit) -> Vec<Combination> {
    let (fits, set) = (&pairs.fits, &pairs.set);
    let c = |fit: &Fit| criterion(case, fit, pairs.allowance);
    let entry = |(i, fit): (usize, &Fit)| Combination {
        effects: case.names(fit),
        parameters: parameter_values(case, fit, false),
        gain: case.gain(fit),
        bic_difference: c(fit) - c(&fits[0]),
        p_corrected: p_over(case, fit, single, pairs.tried).map(reported_p),
        systematic_after_mm: case.error_mm(&case.prediction(fit)),
        bending_nm2: case.bendings(fit),
        in_set: set.contains(&i),
        cancels: cancels(case, fit),
    };
    fits.iter().take(REPORTED.max(set.len())).enumerate().map(entry).collect()
}

/// p of the gain of a pair over the best single effect, or over the base.
pub(crate) fn p_over(case: &DiagnosisCase, pair: &Fit, single: &Fit, tried: usize) -> Option<f64> {
    let more = case.extra(pair).saturating_sub(case.extra(single)).max(1);
    case.p_of_gain((single.cost() - pair.cost()).max(0.0), more, tried as f64)
}

fn cancels(case: &DiagnosisCase, fit: &Fit) -> bool {
    let lead = fit.effects.len().saturating_sub(2);
    let without = |dropped: usize| -> Option<Vec<f64>> {
        let mut theta = fit.theta().to_vec();
        let mut at = case.problem.bendings;
        for (i, effect) in fit.effects.iter().enumerate() {
            let neutral = case.candidate(*effect).at(0.0);
            if i == dropped {
                theta[at..at + neutral.len()].copy_from_slice(&neutral);
            }
            at += neutral.len();
        }
        Some(differences(&fit.minimum.residual, &case.problem.residuals(&fit.effects, &theta)?))
    };
    match (without(lead), without(lead + 1)) {
        (Some(a), Some(b)) => policy::cancel(cosine(&a, &b)),
        _ => false,
    }
}
