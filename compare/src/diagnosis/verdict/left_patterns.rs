//! The pattern that a fit leaves most clearly, and how often noise alone leaves one as clear.
//!
//! With g the whitened pattern, everything fitted projected out of it, t = gᵀr/|g| is standard normal under noise, t of the
//! dof of σ² as σ is estimated. Patterns resemble each other; the largest |t| of all is as if from m independent ones, m so that
//! the 99 % quantile of the largest of simulated correlated normals is met (fixed seed), and p = 1 − (1 − p₁)^m.

use crate::diagnosis::case::DiagnosisCase;
use crate::diagnosis::patterns::{PatternCause, ResidualPattern, patterns, uniform_bending};
use crate::diagnosis::problem::Fit;
use crate::diagnosis::result::LeftPattern;
use crate::fit::basis::Basis;
use crate::fit::least_squares::{dot, square};
use crate::fit::numbers::{largest, sort_by};
use crate::policy;
use crate::stats::{SMALLEST_P, quantile, reported_p, two_sided_p};
use crate::study::generate::NormalNumbers;
use nalgebra::DMatrix;
use std::cell::OnceCell;

/// Simulated sets of noise: 40 of them lie above the quantile, give or take six, so the number of independent patterns is known to
/// about a sixth.
const SIMULATED: usize = 4000;
/// Of these, side by side; no matter for the result.
const TOGETHER: usize = 8;
const QUANTILE: f64 = 0.99;
const SEED: u64 = 20_261_121;
/// Fits that leave less than this share of a pattern can imitate it.
const LEFT: f64 = 0.02;
/// Share of a pattern's variance below which the patterns before it contain it.
const NEW: f64 = 1e-6;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClearPattern {
    pub pattern: ResidualPattern,
    /// Fall of the whitened sum of squares along it.
    pub gain: f64,
    /// p of it as if it were the only one.
    pub p_alone: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Simpler {
    pub fault: ClearPattern,
    pub p_value: f64,
    /// It explains no more than they do, and is preferred for its single number.
    pub either: bool,
}

pub(crate) struct Look {
    /// Patterns found in the residuals, the clearest first.
    pub seen: Vec<ClearPattern>,
    units: Vec<Vec<f64>>,
    tests: OnceCell<f64>,
}

impl Look {
    /// The clearest place or the clearest time.
    pub(crate) fn first(&self, uniform: bool) -> Option<&ClearPattern> {
        self.seen.iter().find(|seen| seen.pattern.is_uniform == uniform)
    }

    pub(crate) fn p_value(&self, seen: &ClearPattern) -> f64 {
        if self.at_most(seen) <= SMALLEST_P { SMALLEST_P } else { reported_p(of_several(seen.p_alone, self.tests())) }
    }

    /// Whether that p is below a level. The number of tests, which takes long with many markers, is between one and the number of
    /// patterns; these bounds answer most questions.
    pub(crate) fn is_below(&self, seen: &ClearPattern, level: f64) -> bool {
        let p_value = || of_several(seen.p_alone, self.tests());
        of_several(seen.p_alone, 1.0) < level && (self.at_most(seen) < level || p_value() < level)
    }

    fn at_most(&self, seen: &ClearPattern) -> f64 {
        of_several(seen.p_alone, self.seen.len() as f64)
    }

    fn tests(&self) -> f64 {
        let count = self.units.len();
        let correlations = || DMatrix::from_fn(count, count, |i, j| dot(&self.units[i], &self.units[j]));
        *self.tests.get_or_init(|| independent(&correlations()).unwrap_or(count as f64))
    }
}

/// Significant patterns in the residuals of a fit; none if p-values cannot be formed. Places are looked for on top of any uniform
/// bending of the holds, which every law of a uniform robot may leave.
pub(crate) fn left_patterns(case: &DiagnosisCase, fit: &Fit) -> Look {
    look(case, fit, true)
}

/// The clearest fault of some kinds that the calibrated base leaves, as if it were the only cause, with its p as
/// reported: if that is below a level and the caller accepts the fault.
pub(crate) fn alone(
    case: &DiagnosisCase,
    kinds: &[PatternCause],
    level: f64,
    is_wanted: &dyn Fn(&ClearPattern) -> bool,
) -> Option<(ClearPattern, f64)> {
    let look = look(case, &case.base, false);
    let is_wanted_kind = |seen: &&ClearPattern| seen.pattern.fault.is_some_and(|fault| kinds.contains(&fault));
    let clearest = look.seen.iter().find(is_wanted_kind)?;
    let told = is_wanted(clearest) && look.is_below(clearest, level);
    told.then(|| (clearest.clone(), look.p_value(clearest)))
}

/// In words: the fault that is a simpler answer than `last`; else what the calibrated base leaves if one pattern alone explains
/// more of it than `last` does, else what `last` leaves.
pub(crate) fn left_pattern(case: &DiagnosisCase, last: Option<&Fit>, fault: Option<&Simpler>) -> Option<LeftPattern> {
    let told = |fit: &Fit, seen: &ClearPattern, p_value, instead| LeftPattern {
        share: seen.gain / excess(case, case.of_first(&fit.minimum.residual)).max(seen.gain),
        words: seen.pattern.words.clone(),
        check: seen.pattern.check.clone(),
        p_value,
        instead,
        simpler: fault.is_some(),
        either: fault.is_some_and(|fault| fault.either),
    };
    if let Some(Simpler { fault, p_value, .. }) = fault {
        return Some(told(&case.base, fault, *p_value, true));
    }
    let clearest = |look: &Look| largest(&look.seen, |seen| seen.gain).cloned();
    let of_base = look(case, &case.base, false);
    let alone = clearest(&of_base)?;
    let (fit, look, instead) = match last {
        Some(fit) if case.gain(fit) > alone.gain => (fit, look(case, fit, false), false),
        _ => (&case.base, of_base, true),
    };
    let seen = clearest(&look)?;
    let left = look.is_below(&seen, case.alpha).then(|| told(fit, &seen, look.p_value(&seen), instead));
    left.filter(|left| policy::is_worth_a_look(left.share))
}

/// `beside_bending`: what uniform bending explains of a place is fitted out.
fn look(case: &DiagnosisCase, fit: &Fit, beside_bending: bool) -> Look {
    let (prediction, whitener) = (case.prediction(fit), &case.problem.blocks[0].whitener);
    let patterns = if case.gives_p_values() { patterns(case, &prediction) } else { Vec::new() };
    let columns: Vec<Vec<f64>> = fit.minimum.jacobian.iter().map(|column| case.of_first(column).to_vec()).collect();
    let fitted = Basis::of(&columns);
    let mut of_places = fitted.clone();
    for column in if beside_bending { uniform_bending(case, &prediction) } else { Vec::new() } {
        of_places.add(&whitener.whiten(&column));
    }
    let residual = case.of_first(&fit.minimum.residual);
    let (mut seen, mut units) = (Vec::new(), Vec::new());
    for pattern in patterns {
        let white = whitener.whiten(&pattern.direction);
        let mut unit = if pattern.is_uniform { &fitted } else { &of_places }.rest(&white);
        let left = square(&unit);
        if left > LEFT * LEFT * square(&white) && left > 0.0 {
            unit.iter_mut().for_each(|v| *v /= left.sqrt());
            let t = dot(&unit, residual);
            let (gain, p_alone) = (t * t, two_sided_p(t, case.noise().pure_error_dof));
            seen.push(ClearPattern { pattern, gain, p_alone });
            units.push(unit);
        }
    }
    sort_by(&mut seen, |seen: &ClearPattern| -seen.gain);
    Look { seen, units, tests: OnceCell::new() }
}

fn of_several(p: f64, tests: f64) -> f64 {
    -(tests * (-p).ln_1p()).exp_m1()
}

fn excess(case: &DiagnosisCase, white: &[f64]) -> f64 {
    square(white) - case.noise().seen(0..white.len()) as f64
}

/// Number of independent normals whose largest has the same 99 % quantile as the largest of normals so correlated.
fn independent(correlations: &DMatrix<f64>) -> Option<f64> {
    let m = correlations.nrows();
    let factor = factor(correlations);
    let mut scatter = NormalNumbers::new(SEED);
    let mut most: Vec<f64> = Vec::with_capacity(SIMULATED);
    for _ in 0..SIMULATED / TOGETHER {
        let mut noise = vec![[0.0; TOGETHER]; m];
        (0..TOGETHER).for_each(|set| noise.iter_mut().for_each(|noise| noise[set] = scatter.normal()));
        most.extend(largest_of(&factor, &noise));
    }
    most.sort_by(f64::total_cmp);
    let quantile = quantile(&most, QUANTILE)?;
    Some((QUANTILE.ln() / (-two_sided_p(quantile, 0)).ln_1p()).clamp(1.0, m as f64))
}

/// L of C = L Lᵀ, row by row to the diagonal, without what rounding leaves of patterns that the ones before them contain. Eigenvectors
/// have signs that depend on the last bit; L moves as little as C does.
fn factor(correlations: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(correlations.nrows());
    for i in 0..correlations.nrows() {
        let mut row: Vec<f64> = Vec::with_capacity(i + 1);
        for (j, before) in rows.iter().enumerate() {
            let pivot = before[j];
            let rest = correlations[(i, j)] - dot(&row, &before[..j]);
            row.push(if pivot > 0.0 { rest / pivot } else { 0.0 });
        }
        let new = correlations[(i, i)] - square(&row);
        row.push(if new > NEW { new.sqrt() } else { 0.0 });
        rows.push(row);
    }
    rows
}

fn largest_of(factor: &[Vec<f64>], noise: &[[f64; TOGETHER]]) -> [f64; TOGETHER] {
    let mut largest = [0.0_f64; TOGETHER];
    for row in factor {
        let mut sums = [0.0; TOGETHER];
        for (f, noise) in row.iter().zip(noise) {
            (0..TOGETHER).for_each(|set| sums[set] += f * noise[set]);
        }
        (0..TOGETHER).for_each(|set| largest[set] = largest[set].max(sums[set].abs()));
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::tests::pattern::of_base;
    use crate::study::{Generator, generate, published::textbook_scenario};

    #[test]
    fn what_bounds_answer_is_what_the_number_of_tests_answers() {
        for (kind, bending, effect, value) in [("spam", 6.0, "end_constraint", 0.1), ("fpam", 0.3, "friction", 0.3)] {
            let plain = textbook_scenario(kind).unwrap().with_bending(bending);
            let candidate = models::effects::EFFECTS.iter().find(|e| e.name == effect).unwrap();
            let values = [&[value], &candidate.typical()[1..]].concat();
            let data = generate(&plain.with_effect(effect, &values), "made", &Generator::default()).unwrap();
            of_base(&plain, &data, |case| {
                let look = look(case, &case.base, true);
                assert!(look.seen.len() > 30);
                for seen in &look.seen {
                    let p = of_several(seen.p_alone, look.tests());
                    assert_eq!(look.p_value(seen), reported_p(p));
                    assert!([0.002, 0.01, 0.2].iter().all(|level| look.is_below(seen, *level) == (p < *level)));
                }
            });
        }
    }

    #[test]
    fn equal_patterns_count_once_and_perpendicular_ones_each() {
        let same = DMatrix::from_element(6, 6, 1.0);
        assert!((independent(&same).unwrap() - 1.0).abs() < 0.5);
        let m = independent(&DMatrix::identity(8, 8)).unwrap();
        assert!((5.0..=8.0).contains(&m), "{m}: eight independent patterns, within what the simulations know");
    }
}
