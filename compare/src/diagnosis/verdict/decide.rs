//! The verdict from all fits: noise, one effect, two effects, a fault or nothing in the catalogue.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::closest::{as_close, closest};
use crate::diagnosis::lack_of_fit::{lack_of_fit, with_supply};
use crate::diagnosis::left_patterns::{ClearPattern, Simpler, alone, left_patterns};
use crate::diagnosis::options::Options;
use crate::diagnosis::order::{self, Ordered};
use crate::diagnosis::pairs::{another_wanted, fit_pairs, indistinguishable as alike_pairs, p_over};
use crate::diagnosis::patterns::PatternCause;
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::{LackOfFit, Verdict};
use crate::diagnosis::singles::indistinguishable;
use crate::diagnosis::source::DiagnosisSource;
use crate::error::CompareError;
use crate::fit::numbers::least;
use crate::policy;
use crate::progress::Progress;
use crate::stats::reported_p;

pub(crate) struct Decision {
    pub singles: Ordered,
    /// Empty if one effect is enough.
    pub pairs: Ordered,
    /// The final model; `None`: the base.
    pub last: Option<Fit>,
    /// Where nothing explains the data: the final model and what comes as close.
    pub as_close: Vec<Fit>,
    /// `None` if no p-values can be formed.
    pub verdict: Option<Verdict>,
    /// One corrected p of "nothing is missing".
    pub p_value: Option<f64>,
    /// One fault that is a simpler answer than the final model.
    pub fault: Option<Simpler>,
    /// Lack of fit of the base.
    pub before: Option<LackOfFit>,
    /// Lack of fit of the final model.
    pub after: Option<LackOfFit>,
}

impl Decision {
    /// Everything of the catalogue that was fitted: single effects and pairs.
    pub(crate) fn rivals(&self) -> Vec<Fit> {
        [&self.singles.fits[..], &self.pairs.fits].concat()
    }

    /// The final model where the verdict names effects.
    pub(crate) fn answer(&self) -> Option<&Fit> {
        self.last.as_ref().filter(|_| self.verdict == Some(Verdict::Effect))
    }

    /// The same without an answer: the data are not what they say.
    pub(crate) fn withheld(self) -> Decision {
        let singles = Ordered { set: Vec::new(), ..self.singles };
        let (pairs, p_value, before) = (Ordered::default(), self.p_value, self.before);
        let (last, as_close, verdict, fault) = (None, Vec::new(), None, None);
        Decision { singles, pairs, last, as_close, verdict, p_value, fault, before, after: before }
    }
}

pub(crate) fn decide(
    case: &DiagnosisCase,
    (singles, allowance): (Vec<Fit>, f64),
    options: &Options,
    progress: &mut Progress,
) -> Result<Decision, CompareError> {
    let set = indistinguishable(case, &singles, allowance);
    let before = test(case, &case.base)?;
    let p_effect = set.iter().filter_map(|i| p_of(case, &singles[*i])).reduce(f64::min);
    let p_value = before.map(|lof| combined(p_effect.unwrap_or(1.0), lof.p_value));
    let mut decision = Decision {
        singles: Ordered { tried: singles.len(), fits: singles, allowance, set },
        pairs: Ordered::default(),
        last: None,
        as_close: Vec::new(),
        fault: None,
        verdict: p_value.map(|_| Verdict::None),
        p_value: p_value.map(reported_p),
        before,
        after: before,
    };
    if p_value.is_none_or(|p| p >= case.alpha) {
        return Ok(decision);
    }
    decision.verdict = Some(Verdict::OutOfCatalog);
    let significant = p_effect.is_some_and(|p| p < policy::SHARE_OF_EFFECTS * case.alpha);
    explain(case, options, &mut decision, significant, progress)?;
    Ok(decision)
}

/// Adds the best effect, a second one if it is needed, and asks whether that explains the misfit.
fn explain(
    case: &DiagnosisCase,
    options: &Options,
    decision: &mut Decision,
    significant: bool,
    progress: &mut Progress,
) -> Result<(), CompareError> {
    let single = decision.singles.stated().next().filter(|_| significant).cloned();
    let mut last = single.clone();
    let mut of_one = None;
    let one_is_enough = match &single {
        Some(fit) if !(leaves(case, fit, policy::is_worth_a_second) && is_significant(case, fit)?) => {
            !*of_one.insert(is_unexplained(case, fit, test(case, fit)?, 1))
        }
        _ => false,
    };
    if options.pairs && !one_is_enough {
        add_second(case, decision, &mut last, progress);
    }
    let Some(last) = last else { return Ok(()) };
    decision.after = test(case, &last)?;
    let unexplained = match of_one {
        // No pair has taken its place: the same question.
        Some(answer) if decision.pairs.fits.is_empty() => answer,
        _ => is_unexplained(case, &last, decision.after, if decision.pairs.fits.is_empty() { 1 } else { 2 }),
    };
    if unexplained {
        let fits = [&decision.singles.fits[..], &decision.pairs.fits];
        let closest = closest(case, fits, last);
        // A fit that hardly moves the model is not an attempt.
        if !policy::is_closer(case.error_in_all_mm(&closest), case.error_in_all_mm(&case.base)) {
            decision.after = decision.before;
            return Ok(());
        }
        decision.after = test(case, &closest)?;
        decision.as_close = as_close(case, fits, &closest);
        decision.last = Some(closest);
        return Ok(());
    }
    decision.fault = simpler(case, &last);
    if decision.fault.is_none() {
        decision.verdict = Some(Verdict::Effect);
    }
    decision.last = Some(last);
    Ok(())
}

/// Whether a fit of so many effects leaves a share of the error that the tests see as more than noise, at the level that is theirs.
fn is_unexplained(case: &DiagnosisCase, fit: &Fit, lof: Option<LackOfFit>, effects: usize) -> bool {
    let level = (1.0 - policy::SHARE_OF_EFFECTS) * case.alpha;
    let lacks = lof.is_some_and(|lof| lof.p_value < level);
    let left_over = |after: f64, before: f64| policy::is_left_over(effects, after, before);
    leaves(case, fit, left_over) && (lacks || leaves(case, fit, policy::is_most) && another_wanted(case, fit) < level)
        || leaves_a_place(case, fit, level)
}

fn leaves_a_place(case: &DiagnosisCase, fit: &Fit, level: f64) -> bool {
    let look = left_patterns(case, fit);
    look.first(false).is_some_and(|seen| is_a_place_left(case, fit, seen) && look.is_below(seen, level))
}

/// Whether a place that a fit leaves has a share of the error; amplitudes, as far as they were seen.
fn is_a_place_left(case: &DiagnosisCase, fit: &Fit, seen: &ClearPattern) -> bool {
    policy::is_a_place_left(seen.gain, case.gain(fit))
}

/// One fault whose single amplitude explains as much as the effects with more numbers. Compared with two effects, an equally good fault
/// is the simpler answer. One effect is as simple: a place must be clearly better, for a law that is not quite its formula leaves one
/// now and then, and a hold does not count against it, because three pressures and B leave every law one hold to miss.
fn simpler(case: &DiagnosisCase, last: &Fit) -> Option<Simpler> {
    let (kinds, margin): (&[PatternCause], f64) = match case.added(last).len() {
        ..=1 => (&[PatternCause::Place], policy::SAME_EVIDENCE),
        _ => (&[PatternCause::Place, PatternCause::Hold], 0.0),
    };
    let allowance = |fault: &ClearPattern| order::allowance(case.gain(last).max(fault.gain));
    let is_simpler = |fault: &ClearPattern| {
        let allowance = allowance(fault);
        let by_fault = order::criterion_of(case, case.base.cost() - fault.gain, 1, allowance);
        by_fault + margin < order::criterion(case, last, allowance)
    };
    let (fault, p_value) = alone(case, kinds, case.alpha, &is_simpler)?;
    // By the sums of squares alone, without what numbers cost.
    let either = (fault.gain - case.gain(last)) / allowance(&fault) < policy::SAME_EVIDENCE;
    Some(Simpler { fault, p_value, either })
}

/// Takes the best pair in place of the single effect, or of the base, if it is significantly better, and in mm too: by the whitened
/// sum of squares alone a second name may mend quiet holds and leave the error as it was.
fn add_second(case: &DiagnosisCase, decision: &mut Decision, last: &mut Option<Fit>, progress: &mut Progress) {
    let (mut fits, tried) = fit_pairs(case, &decision.singles.fits, progress);
    let before = last.as_ref().unwrap_or(&case.base);
    let allowance = order::sort(case, &mut fits, before);
    let error_mm = |fit: &Fit| case.error_in_all_mm(fit);
    let enough_mm =
        last.as_ref().map_or(f64::INFINITY, |one| (policy::CLOSER * error_mm(one)).max(1e3 * case.tolerance_m));
    if let Some(best) = fits.first()
        && p_over(case, best, before, tried).is_some_and(|p| p < case.alpha)
        && error_mm(best) < enough_mm
    {
        *last = Some(best.clone());
        decision.pairs = Ordered { set: alike_pairs(case, &fits, allowance), fits, allowance, tried };
    }
}

/// Whether a fit leaves so much of the base's error by both measures: without the part that scatter between runs explains, and with
/// it. By the first alone a misfit that looks like a run's pressure counts for little, and its remainder for much.
fn leaves(case: &DiagnosisCase, fit: &Fit, left: impl Fn(f64, f64) -> bool) -> bool {
    let error_mm = |fit: &Fit| case.error_in_all_mm(fit);
    left(case.beyond_noise_mm(fit), case.beyond_noise_mm(&case.base)) && left(error_mm(fit), error_mm(&case.base))
}

/// Whether what a fit leaves is more than noise, seen by a test for lack of fit or along another effect.
fn is_significant(case: &DiagnosisCase, fit: &Fit) -> Result<bool, CompareError> {
    let lack = test(case, fit)?.is_some_and(|lof| lof.p_value < case.alpha);
    Ok(lack || another_wanted(case, fit) < case.alpha)
}

/// Lack of fit; of several data the clearest, corrected for their number.
fn test(case: &DiagnosisCase, fit: &Fit) -> Result<Option<LackOfFit>, CompareError> {
    let mut tests = Vec::new();
    for (block, noise) in case.problem.blocks.iter().zip(&case.noises) {
        let DiagnosisSource { dataset, gauge, .. } = &*block.source;
        let positions = lack_of_fit(dataset, noise, &case.prediction_of(block, fit), fit.theta().len())?;
        let supply = |gauge| (gauge, case.problem.supply(block, &fit.effects, fit.theta()));
        let supply = gauge.as_ref().map(supply);
        tests.push(positions.map(|lof| supply.map_or(lof, |(gauge, white)| with_supply(lof, gauge, &white))));
    }
    let count = tests.len() as f64;
    let clearest = tests.into_iter().collect::<Option<Vec<_>>>().and_then(|all| least(all, |lof| lof.p_value));
    Ok(clearest.map(|lof| LackOfFit { p_value: (count * lof.p_value).min(1.0), ..lof }))
}

fn p_of(case: &DiagnosisCase, fit: &Fit) -> Option<f64> {
    case.p_of_gain(case.seen_gain(fit), case.extra(fit), case.tests)
}

pub(crate) fn combined(p_effect: f64, p_lack_of_fit: f64) -> f64 {
    (p_effect / policy::SHARE_OF_EFFECTS).min(p_lack_of_fit / (1.0 - policy::SHARE_OF_EFFECTS)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::combined;

    #[test]
    fn effects_get_four_fifths_of_the_level_and_lack_of_fit_one() {
        assert!((combined(8e-4, 1.0) - 1e-3).abs() < 1e-12 && (combined(1.0, 2e-4) - 1e-3).abs() < 1e-12);
        assert_eq!(combined(0.9, 0.9), 1.0);
    }
}
