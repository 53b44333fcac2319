//! Screening: how much a first bit of an effect would help, from one prediction each (score test).
//!
//! With g the whitened change per unit of the effect and P the projection that fits everything already free out of it,
//! `gain = (gᵀPr)²/(gᵀPg)` at the amount `−gᵀPr/(gᵀPg)`. Cheap and explainable, but local: an effect with a threshold
//! shows nothing. It gives starts for the fits and asks whether another effect is needed; it decides nothing alone.

use crate::diagnosis::known::KnownParameter;
use crate::diagnosis::problem::{Fit, FitProblem};
use crate::fit::basis::Basis;
use crate::fit::least_squares::{dot, square};
use crate::fit::numbers::differences;

const FIRST_BIT: f64 = 0.02;

#[derive(Debug, Clone)]
pub(crate) struct Score {
    /// Expected fall of the whitened sum of squares along the typical direction, within the bounds.
    pub gain: f64,
    /// Amount at which it is expected, in units of the typical size; 0 if bounds forbid the right sign.
    pub amount: f64,
}

/// Whitened trace of the first bit of an effect per typical size, everything free fitted out; `None` if it leaves none.
pub(crate) fn trace(problem: &FitProblem, fit: &Fit, free: &Basis, effect: usize) -> Option<Vec<f64>> {
    let candidate = &problem.candidates[effect];
    let effects: Vec<usize> = fit.effects.iter().copied().chain([effect]).collect();
    let moved = problem.residuals(&effects, &fit.theta_with(&candidate.at(FIRST_BIT)))?;
    let change: Vec<f64> = moved.iter().zip(&fit.minimum.residual).map(|(a, b)| (a - b) / FIRST_BIT).collect();
    let rest = free.rest(&change);
    let squares = square(&rest);
    (squares > 1e-12 * square(&change) && squares > 0.0).then_some(rest)
}

/// Screens an effect on top of a fit; `None` if it changes nothing there or has no equilibrium.
pub(crate) fn score(problem: &FitProblem, fit: &Fit, free: &Basis, effect: usize) -> Option<Score> {
    let rest = trace(problem, fit, free, effect)?;
    let squares = square(&rest);
    let candidate = &problem.candidates[effect];
    let amount = -dot(&rest, &fit.minimum.residual) / squares;
    let allowed = candidate.parameters.iter().zip(candidate.at(amount)).all(|(p, v)| {
        let outward = if v > p.neutral { p.upper - p.neutral } else { p.neutral - p.lower };
        outward > 0.0 || v == p.neutral
    });
    let amount = if allowed { amount } else { 0.0 };
    Some(Score { gain: amount * amount * squares, amount })
}

/// Starts for the fit of an effect on top of another: the expected amount, then the catalogue's own.
pub(crate) fn starts(problem: &FitProblem, fit: &Fit, effect: usize, own: bool) -> Vec<Vec<f64>> {
    let candidate = &problem.candidates[effect];
    if candidate.count() == 0 {
        return candidate.starts().iter().map(|values| fit.theta_with(values)).collect();
    }
    let expected = score(problem, fit, &Basis::of(&fit.minimum.jacobian), effect)
        .filter(|s| s.amount != 0.0)
        .map(|s| candidate.at(s.amount));
    let catalogue = if own || expected.is_none() { candidate.starts() } else { Vec::new() };
    expected.into_iter().chain(catalogue).map(|values| fit.theta_with(&values)).collect()
}

/// Bounds what lacking an effect costs by what it changes at the markers where the robot is fitted with it: with the base alone, whose
/// stiffness has taken its place, it might not act at all.
pub(crate) fn bound(problem: &FitProblem, base: &Fit, known: &mut [KnownParameter]) {
    for i in 0..known.len() {
        let effect = known[i].effect;
        if known[i].usual || base.effects.contains(&effect) {
            continue;
        }
        let mut values = problem.candidates[effect].at(1.0);
        known.iter().filter(|k| k.effect == effect).for_each(|k| values[k.parameter] = k.value);
        let effects: Vec<usize> = base.effects.iter().copied().chain([effect]).collect();
        let starts = [vec![base.theta_with(&values)], starts(problem, base, effect, true)].concat();
        let Some(with) = problem.fit(&effects, &starts) else { continue };
        let own = with.theta().len() - problem.candidates[effect].parameters.len();
        let Some(without) = problem.residuals(&base.effects, &with.theta()[..own]) else { continue };
        let seen = without.len() - problem.known.len();
        let most = square(&differences(&with.minimum.residual[..seen], &without)).sqrt();
        known[i].lacking = known[i].lacking.clamp(-most, most);
    }
}
