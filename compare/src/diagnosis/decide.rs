//! From fits to a verdict.

use super::case::Case;
use super::lack_of_fit::lack_of_fit;
use super::options::Options;
use super::pairs::{another_wanted, fit_pairs, indistinguishable as alike_pairs, p_over_single};
use super::problem::Fit;
use super::result::{LackOfFit, Verdict};
use super::singles::{fit_all, indistinguishable};
use crate::error::CompareError;
use crate::stats::reported_p;

/// Of the level α, the share that the effects get; the tests for lack of fit get the rest.
const SHARE_OF_EFFECTS: f64 = 0.8;
/// More than this share of the error left after adding means that the catalogue does not explain it.
const LEFT_OVER: f64 = 0.25;
/// Least error left that is called unexplained \[mm\].
const LEAST_LEFT_MM: f64 = 0.15;

/// Everything that was fitted, and what follows.
pub struct Decision {
    /// Single effects, best first.
    pub singles: Vec<Fit>,
    /// Those that cannot be told apart.
    pub set: Vec<usize>,
    /// Pairs, best first; empty if one effect is enough.
    pub pairs: Vec<Fit>,
    /// Those that cannot be told apart.
    pub pair_set: Vec<usize>,
    /// Pairs tried.
    pub pairs_tried: usize,
    /// The final model; `None`: the base.
    pub last: Option<Fit>,
    /// Verdict; `None` without p-values.
    pub verdict: Option<Verdict>,
    /// One corrected p of "nothing is missing".
    pub p_value: Option<f64>,
    /// Lack of fit of the base.
    pub before: Option<LackOfFit>,
    /// Lack of fit of the final model.
    pub after: Option<LackOfFit>,
}

/// Fits, tests and decides.
///
/// # Errors
/// What the tests return.
pub fn decide(case: &Case, options: &Options) -> Result<Decision, CompareError> {
    let singles = fit_all(case);
    let set = indistinguishable(case, &singles);
    let before = test(case, &case.base)?;
    let p_effect = set.iter().filter_map(|i| p_of(case, &singles[*i])).reduce(f64::min);
    let p_value = before.map(|lof| combined(p_effect.unwrap_or(1.0), lof.p_value));
    let mut decision = Decision {
        singles,
        set,
        pairs: Vec::new(),
        pair_set: Vec::new(),
        pairs_tried: 0,
        last: None,
        verdict: p_value.map(|_| Verdict::None),
        p_value: p_value.map(reported_p),
        before,
        after: before,
    };
    if p_value.is_none_or(|p| p >= case.alpha) {
        return Ok(decision);
    }
    decision.verdict = Some(Verdict::OutOfCatalog);
    if p_effect.is_some_and(|p| p < SHARE_OF_EFFECTS * case.alpha) {
        explain(case, options, &mut decision)?;
    }
    Ok(decision)
}

/// Adds the best effect, a second one if it is wanted, and asks whether that explains the misfit.
fn explain(case: &Case, options: &Options, decision: &mut Decision) -> Result<(), CompareError> {
    let Some(&best) = decision.set.first() else { return Ok(()) };
    let mut last = decision.singles[best].clone();
    if options.pairs && wants_more(case, &last)? {
        add_second(case, decision, &mut last);
    }
    decision.after = test(case, &last)?;
    let before_mm = case.error_mm(&case.prediction(&case.base));
    let after_mm = case.error_mm(&case.prediction(&last));
    let unexplained = decision.after.is_some_and(|lof| lof.p_value < case.alpha)
        && after_mm > LEAST_LEFT_MM.max(LEFT_OVER * before_mm);
    let third = case.extra(&last) > 1 && !decision.pairs.is_empty() && wants_more(case, &last)?;
    decision.verdict = Some(if unexplained || third { Verdict::OutOfCatalog } else { Verdict::Effect });
    decision.last = Some(last);
    Ok(())
}

/// Replaces the single effect by the best pair if that is significantly better.
fn add_second(case: &Case, decision: &mut Decision, last: &mut Fit) {
    let (pairs, tried) = fit_pairs(case, &decision.singles);
    decision.pairs_tried = tried;
    if let Some(best) = pairs.first()
        && p_over_single(case, best, last, tried).is_some_and(|p| p < case.alpha)
    {
        decision.pair_set = alike_pairs(case, &pairs, last);
        *last = best.clone();
        decision.pairs = pairs;
    }
}

/// Whether more than noise and more than the tolerance is left.
fn wants_more(case: &Case, fit: &Fit) -> Result<bool, CompareError> {
    if case.error_mm(&case.prediction(fit)) <= 1e3 * case.tolerance_m {
        return Ok(false);
    }
    let lof = test(case, fit)?.is_some_and(|lof| lof.p_value < case.alpha);
    Ok(lof || another_wanted(case, fit) < case.alpha)
}

fn test(case: &Case, fit: &Fit) -> Result<Option<LackOfFit>, CompareError> {
    lack_of_fit(case.dataset, &case.noise, &case.prediction(fit), fit.theta().len())
}

fn p_of(case: &Case, fit: &Fit) -> Option<f64> {
    case.p_of_gain(case.gain(fit), case.extra(fit), case.tried.len())
}

/// Weighted Bonferroni over the two kinds of tests.
fn combined(p_effect: f64, p_lack_of_fit: f64) -> f64 {
    (p_effect / SHARE_OF_EFFECTS).min(p_lack_of_fit / (1.0 - SHARE_OF_EFFECTS)).min(1.0)
}
