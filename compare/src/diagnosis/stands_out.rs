//! The pattern that a fit leaves most clearly, and how often noise alone leaves one as clear.
//!
//! With g the whitened pattern, everything fitted projected out of it, t = gᵀr/|g| is standard normal under noise, t of the
//! dof of σ² as σ is estimated. Patterns resemble each other; the largest |t| of all is as if from m independent ones, m so that
//! the 99 % quantile of the largest of simulated correlated normals is met (fixed seed), and p = 1 − (1 − p₁)^m.

use super::basis::Basis;
use super::case::Case;
use super::least_squares::{dot, square};
use super::patterns::{Fault, Pattern, patterns, uniform_bending};
use super::problem::Fit;
use super::result::LeftPattern;
use crate::stats::{reported_p, two_sided_p};
use crate::study::generate::Scatter;
use nalgebra::{DMatrix, SymmetricEigen};

/// A pattern of which fits leave less than this share cannot be told from them.
const LEFT: f64 = 0.02;
/// Simulated sets of noise: the 99 % quantile of the largest is known to a tenth.
const SIMULATED: usize = 1000;
/// Quantile that sets the number of independent patterns.
const QUANTILE: f64 = 0.99;
/// Seed of the simulation.
const SEED: u64 = 20_261_121;
/// Rounds of the eigenvalue iteration.
const EIGEN_ROUNDS: usize = 1000;

/// The clearest pattern of a kind.
#[derive(Debug, Clone, PartialEq)]
pub struct StandsOut {
    /// What it looks like.
    pub words: String,
    /// What would show it.
    pub check: String,
    /// The whole robot bends otherwise at some time.
    pub is_uniform: bool,
    /// The fault that looks like it.
    pub fault: Option<Fault>,
    /// Fall of the whitened sum of squares along it.
    pub gain: f64,
    /// p of the largest of all patterns.
    pub p_value: f64,
}

/// A fault that is a simpler answer than effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Simpler {
    /// The fault.
    pub fault: StandsOut,
    /// It explains no more than they do, and is preferred for its single number.
    pub either: bool,
}

/// The clearest place and the clearest time in the residuals of a fit; none if p-values cannot be formed. Places are looked for
/// beside any uniform bending of the holds, which every law of a uniform robot may leave.
pub fn stands_out(case: &Case, fit: &Fit) -> Vec<StandsOut> {
    let found = look(case, fit, true);
    let first = |uniform: bool| found.iter().find(|f| f.is_uniform == uniform).cloned();
    [first(false), first(true)].into_iter().flatten().collect()
}

/// The clearest fault of some kinds that the calibrated base leaves, as if it were the only cause.
pub fn alone(case: &Case, kinds: &[Fault]) -> Option<StandsOut> {
    look(case, &case.base, false).into_iter().find(|seen| seen.fault.is_some_and(|fault| kinds.contains(&fault)))
}

/// In words: the fault that is a simpler answer than `last`; else what the calibrated base leaves if one pattern alone explains
/// more of it than `last` does, else what `last` leaves.
pub fn left_pattern(case: &Case, last: Option<&Fit>, fault: Option<&Simpler>) -> Option<LeftPattern> {
    let clearest = |fit: &Fit| look(case, fit, false).into_iter().max_by(|a, b| a.gain.total_cmp(&b.gain));
    let told = |fit: &Fit, seen: StandsOut, instead: bool| LeftPattern {
        share: seen.gain / excess(case.first(&fit.minimum.residual)).max(seen.gain),
        words: seen.words,
        check: seen.check,
        p_value: reported_p(seen.p_value),
        instead,
        simpler: fault.is_some(),
        either: fault.is_some_and(|fault| fault.either),
    };
    if let Some(Simpler { fault, .. }) = fault {
        return Some(told(&case.base, fault.clone(), true));
    }
    let alone = clearest(&case.base)?;
    match last {
        Some(fit) if case.gain(fit) > alone.gain => Some(told(fit, clearest(fit)?, false)),
        _ => Some(told(&case.base, alone, true)),
    }
    .filter(|pattern| pattern.p_value < case.alpha)
}

fn look(case: &Case, fit: &Fit, beside_bending: bool) -> Vec<StandsOut> {
    if !case.gives_p_values() {
        return Vec::new();
    }
    let prediction = case.prediction(fit);
    let whiten = |direction: &[f64]| case.problem.blocks[0].whitener.whiten(direction);
    let fitted = Basis::of(&fit.minimum.jacobian.iter().map(|column| case.first(column).to_vec()).collect::<Vec<_>>());
    let mut bent = fitted.clone();
    if beside_bending {
        for column in uniform_bending(case, &prediction) {
            bent.add(&whiten(&column));
        }
    }
    let mut found = Vec::new();
    let mut units: Vec<Vec<f64>> = Vec::new();
    for Pattern { words, check, is_uniform, fault, direction } in patterns(case, &prediction) {
        let white = whiten(&direction);
        let Some(unit) = unit(if is_uniform { &fitted } else { &bent }, &white) else { continue };
        let t = dot(&unit, case.first(&fit.minimum.residual));
        let p_value = two_sided_p(t, case.noise.pure_error_dof);
        found.push(StandsOut { words, check, is_uniform, fault, gain: t * t, p_value });
        units.push(unit);
    }
    let tests = independent(&units).unwrap_or(units.len() as f64);
    found.iter_mut().for_each(|f| f.p_value = -(tests * (-f.p_value).ln_1p()).exp_m1());
    found.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    found
}

/// What whitened residuals have beyond noise.
fn excess(white: &[f64]) -> f64 {
    square(white) - white.len() as f64
}

/// Unit vector along what a fit leaves of a pattern; `None` if that is next to nothing.
fn unit(fitted: &Basis, white: &[f64]) -> Option<Vec<f64>> {
    let rest = fitted.rest(white);
    let left = square(&rest);
    (left > LEFT * LEFT * square(white) && left > 0.0).then(|| rest.iter().map(|v| v / left.sqrt()).collect())
}

/// Number of independent normals whose largest has the same 99 % quantile.
fn independent(units: &[Vec<f64>]) -> Option<f64> {
    let m = units.len();
    let correlations = DMatrix::from_fn(m, m, |i, j| dot(&units[i], &units[j]));
    let eigen = SymmetricEigen::try_new(correlations, f64::EPSILON, EIGEN_ROUNDS)?;
    let kept: Vec<usize> = (0..m).filter(|k| eigen.eigenvalues[*k] > 1e-9 * m as f64).collect();
    let factor: Vec<Vec<f64>> = (0..m)
        .map(|i| kept.iter().map(|k| eigen.eigenvectors[(i, *k)] * eigen.eigenvalues[*k].sqrt()).collect())
        .collect();
    let mut scatter = Scatter::new(SEED);
    let mut largest: Vec<f64> = (0..SIMULATED)
        .map(|_| {
            let noise: Vec<f64> = kept.iter().map(|_| scatter.normal()).collect();
            factor.iter().map(|row| dot(row, &noise).abs()).fold(0.0, f64::max)
        })
        .collect();
    largest.sort_by(f64::total_cmp);
    let quantile = crate::stats::quantile(&largest, QUANTILE)?;
    Some((QUANTILE.ln() / (-two_sided_p(quantile, 0)).ln_1p()).clamp(1.0, m as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_patterns_count_once_and_perpendicular_ones_each() {
        let axis = |k: usize| (0..8).map(|i| f64::from(u8::from(i == k))).collect::<Vec<f64>>();
        let same: Vec<Vec<f64>> = (0..6).map(|_| axis(0)).collect();
        assert!((independent(&same).unwrap() - 1.0).abs() < 0.5);
        let apart: Vec<Vec<f64>> = (0..8).map(axis).collect();
        let m = independent(&apart).unwrap();
        assert!((5.0..=8.0).contains(&m), "{m}: eight independent patterns, within what 1000 simulations know");
    }
}
