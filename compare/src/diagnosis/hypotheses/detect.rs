//! How large an effect would have to be to be seen in these data.

use crate::diagnosis::candidates::{Candidate, Free};
use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::result::{Added, Undetectable};
use crate::fit::basis::Basis;
use crate::fit::least_squares::square;
use crate::fit::numbers::differences;
use crate::policy;
use statrs::distribution::{ContinuousCDF, Normal};

const ROUNDS: usize = 12;
const CLOSE: f64 = 0.02;

/// Smallest detectable size of an effect: where its trace, base fitted out, reaches (z_{α/2m} + z_0.9)² in units of noise.
pub(crate) fn smallest_detectable(case: &DiagnosisCase, effect: usize) -> Undetectable {
    let candidate = case.candidate(effect);
    let share = case.noise().is_known().then(|| smallest_share(case, effect)).flatten();
    let free = &candidate.parameters[candidate.lead()];
    let value = share.map(|s| (free.neutral + s * (free.typical - free.neutral)) / free.si);
    Undetectable {
        effect: candidate.name.clone(),
        group: candidate.group,
        smallest_detectable: value,
        unit: free.unit.clone(),
        times_typical: share,
    }
}

/// The trace an effect must leave to be seen with 90 % probability.
pub(crate) fn needed(case: &DiagnosisCase) -> f64 {
    let z = Normal::new(0.0, 1.0).map_or(4.0, |n| n.inverse_cdf(1.0 - case.alpha / (2.0 * case.tests)));
    (z + policy::Z_POWER).powi(2)
}

/// The size as a multiple of the typical one; `None` if no size within the bounds is enough.
fn smallest_share(case: &DiagnosisCase, effect: usize) -> Option<f64> {
    let needed = needed(case);
    let base = Basis::of(&case.base.minimum.jacobian);
    let trace = |share: f64| trace(case, &base, effect, share);
    let largest = largest_share(case, effect);
    let mut share = 1.0_f64.min(largest);
    let (mut below, mut above) = (0.0, f64::INFINITY);
    for _ in 0..ROUNDS {
        let found = trace(share);
        if (found / needed - 1.0).abs() < CLOSE {
            return Some(share);
        }
        if found > needed {
            above = share
        } else {
            below = share
        }
        if below >= largest {
            return None;
        }
        // A trace grows with the square of a small effect; a threshold is closed in on by halves.
        let guess = share * (needed / found).sqrt();
        let middle = if above.is_finite() { 0.5 * (below + above) } else { (4.0 * share).min(largest) };
        share = if guess > below && guess < above.min(largest) { guess } else { middle };
    }
    above.is_finite().then_some(above)
}

/// Squared whitened trace of an effect, the base's own parameters fitted out.
fn trace(case: &DiagnosisCase, base: &Basis, effect: usize, share: f64) -> f64 {
    let theta = case.base.theta_with(&case.candidate(effect).at(share));
    let Some(moved) = case.problem.residuals(&case.with(effect), &theta) else { return 0.0 };
    square(&base.rest(&differences(&moved, &case.base.minimum.residual)))
}

/// The multiple of the typical size at which the first parameter meets its bound.
fn largest_share(case: &DiagnosisCase, effect: usize) -> f64 {
    let share = |p: &Free| match p.typical - p.neutral {
        d if d > 0.0 => (p.upper - p.neutral) / d,
        d if d < 0.0 => (p.lower - p.neutral) / d,
        _ => f64::INFINITY,
    };
    case.candidate(effect).parameters.iter().map(share).fold(f64::INFINITY, f64::min)
}

/// Of every effect that the scenario lacks and that neither the set nor a pair in it names; a ranking without verdict finds nothing.
pub(crate) fn undetectable(case: &DiagnosisCase, stated: &[String], added: &[Added]) -> Vec<Undetectable> {
    let found = |name: &str| {
        let in_set = !added.is_empty() && stated.iter().flat_map(|entry| entry.split(" + ")).any(|part| part == name);
        in_set || added.iter().any(|a| a.effect == name)
    };
    let is_missed = |candidate: &Candidate| candidate.removes.is_none() && !found(&candidate.name);
    let missed = case.tried.iter().filter(|e| is_missed(case.candidate(**e)));
    missed.map(|e| smallest_detectable(case, *e)).collect()
}
