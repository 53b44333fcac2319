//! The pattern that a fit leaves most clearly, and how often noise alone leaves one as clear.
//!
//! With g the whitened pattern, everything fitted projected out of it, t = gᵀr/|g| is standard normal under noise, t of the
//! dof of σ² as σ is estimated. Patterns resemble each other; the largest |t| of all is as if from m independent ones, m so that
//! the 99 % quantile of the largest of simulated correlated normals is met (fixed seed), and p = 1 − (1 − p₁)^m.

use super::case::Case;
use super::patterns::{Fault, Pattern, Patterns, patterns, uniform_bending};
use super::problem::Fit;
use super::result::LeftPattern;
use super::traces::{Beside, Traces};
use crate::fit::basis::Basis;
use crate::fit::least_squares::{dot, square};
use crate::stats::{SMALLEST_P, reported_p, two_sided_p};
use crate::study::generate::Scatter;
use nalgebra::DMatrix;
use std::cell::OnceCell;

/// Simulated sets of noise: 40 of them lie above the quantile, give or take six, so the number of independent patterns is known to
/// about a sixth.
const SIMULATED: usize = 4000;
/// Of these, side by side; no matter for the result.
const TOGETHER: usize = 8;
/// Quantile that sets the number of independent patterns.
const QUANTILE: f64 = 0.99;
/// Seed of the simulation.
const SEED: u64 = 20_261_121;
/// Share of a pattern's variance below which the patterns before it contain it.
const NEW: f64 = 1e-6;

/// The clearest pattern of a kind.
#[derive(Debug, Clone, PartialEq)]
pub struct StandsOut {
    pub words: String,
    pub check: String,
    /// The whole robot bends otherwise at some time.
    pub is_uniform: bool,
    /// The fault that looks like it.
    pub fault: Option<Fault>,
    /// Fall of the whitened sum of squares along it.
    pub gain: f64,
    /// p of it as if it were the only one.
    pub p_alone: f64,
}

/// A fault that is a simpler answer than effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Simpler {
    /// The fault.
    pub fault: StandsOut,
    pub p_value: f64,
    /// It explains no more than they do, and is preferred for its single number.
    pub either: bool,
}

/// Everything that may be seen in the residuals of a fit.
pub struct Look {
    /// The clearest first.
    pub seen: Vec<StandsOut>,
    traces: Traces,
    tests: OnceCell<f64>,
}

impl Look {
    /// The clearest place or the clearest time.
    pub fn first(&self, uniform: bool) -> Option<&StandsOut> {
        self.seen.iter().find(|seen| seen.is_uniform == uniform)
    }

    /// p of the largest of all patterns, as reported.
    pub fn p_value(&self, seen: &StandsOut) -> f64 {
        if self.at_most(seen) <= SMALLEST_P { SMALLEST_P } else { reported_p(of_several(seen.p_alone, self.tests())) }
    }

    /// Whether that p is below a level. The number of tests, which takes long with many markers, lies between one and that of the
    /// patterns; most questions are answered by that.
    pub fn is_below(&self, seen: &StandsOut, level: f64) -> bool {
        let p_value = || of_several(seen.p_alone, self.tests());
        of_several(seen.p_alone, 1.0) < level && (self.at_most(seen) < level || p_value() < level)
    }

    fn at_most(&self, seen: &StandsOut) -> f64 {
        of_several(seen.p_alone, self.seen.len() as f64)
    }

    fn tests(&self) -> f64 {
        *self.tests.get_or_init(|| independent(&self.traces.correlations()).unwrap_or(self.seen.len() as f64))
    }
}

/// What stands out in the residuals of a fit; nothing if p-values cannot be formed. Places are looked for beside any uniform
/// bending of the holds, which every law of a uniform robot may leave.
pub fn stands_out(case: &Case, fit: &Fit) -> Look {
    look(case, fit, true)
}

/// The clearest fault of some kinds that the calibrated base leaves, as if it were the only cause, with the p of it as
/// reported: if that is below a level and it is wanted.
pub fn alone(
    case: &Case,
    kinds: &[Fault],
    level: f64,
    is_wanted: &dyn Fn(&StandsOut) -> bool,
) -> Option<(StandsOut, f64)> {
    let look = look(case, &case.base, false);
    let clearest = look.seen.iter().find(|seen| seen.fault.is_some_and(|fault| kinds.contains(&fault)))?;
    let told = is_wanted(clearest) && look.is_below(clearest, level);
    told.then(|| (clearest.clone(), look.p_value(clearest)))
}

/// In words: the fault that is a simpler answer than `last`; else what the calibrated base leaves if one pattern alone explains
/// more of it than `last` does, else what `last` leaves.
pub fn left_pattern(case: &Case, last: Option<&Fit>, fault: Option<&Simpler>) -> Option<LeftPattern> {
    let told = |fit: &Fit, seen: &StandsOut, p_value: f64, instead: bool| LeftPattern {
        share: seen.gain / excess(case, case.of_first(&fit.minimum.residual)).max(seen.gain),
        words: seen.words.clone(),
        check: seen.check.clone(),
        p_value,
        instead,
        simpler: fault.is_some(),
        either: fault.is_some_and(|fault| fault.either),
    };
    if let Some(Simpler { fault, p_value, .. }) = fault {
        return Some(told(&case.base, fault, *p_value, true));
    }
    let clearest = |look: &Look| look.seen.iter().max_by(|a, b| a.gain.total_cmp(&b.gain)).cloned();
    let of_base = look(case, &case.base, false);
    let alone = clearest(&of_base)?;
    let (fit, look, instead) = match last {
        Some(fit) if case.gain(fit) > alone.gain => (fit, look(case, fit, false), false),
        _ => (&case.base, of_base, true),
    };
    let seen = clearest(&look)?;
    look.is_below(&seen, case.alpha).then(|| told(fit, &seen, look.p_value(&seen), instead))
}

fn look(case: &Case, fit: &Fit, beside_bending: bool) -> Look {
    let prediction = case.prediction(fit);
    let patterns = if case.gives_p_values() { patterns(case, &prediction) } else { Patterns::default() };
    let [fitted, of_places] = fitted_out(case, fit, &prediction, beside_bending);
    let traces = Traces::of(patterns, &beside(case, fit, &fitted, &of_places));
    let mut seen: Vec<StandsOut> = Vec::new();
    for trace in &traces.left {
        let Pattern { words, check, is_uniform, fault, .. } = traces.pattern(trace);
        let (gain, p_alone) = (trace.t * trace.t, two_sided_p(trace.t, case.noise().pure_error_dof));
        seen.push(StandsOut {
            words: words.clone(),
            check: check.clone(),
            is_uniform: *is_uniform,
            fault: *fault,
            gain,
            p_alone,
        });
    }
    seen.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    Look { seen, traces, tests: OnceCell::new() }
}

/// What is fitted out of every pattern, and out of places.
fn fitted_out(case: &Case, fit: &Fit, prediction_m: &[f64], beside_bending: bool) -> [Basis; 2] {
    let fitted =
        Basis::of(&fit.minimum.jacobian.iter().map(|column| case.of_first(column).to_vec()).collect::<Vec<_>>());
    let mut of_places = fitted.clone();
    if beside_bending {
        for column in uniform_bending(case, prediction_m) {
            of_places.add(&case.problem.blocks[0].whitener.whiten(&column));
        }
    }
    [fitted, of_places]
}

fn beside<'a>(case: &'a Case, fit: &'a Fit, fitted: &'a Basis, of_places: &'a Basis) -> Beside<'a> {
    let residual = case.of_first(&fit.minimum.residual);
    Beside { whitener: &case.problem.blocks[0].whitener, fitted, of_places, residual }
}

/// p of the clearest of several independent ones.
fn of_several(p: f64, tests: f64) -> f64 {
    -(tests * (-p).ln_1p()).exp_m1()
}

/// What whitened residuals have beyond noise.
fn excess(case: &Case, white: &[f64]) -> f64 {
    square(white) - case.noise().seen(0..white.len()) as f64
}

/// Number of independent normals whose largest has the same 99 % quantile as that of normals so correlated.
fn independent(correlations: &DMatrix<f64>) -> Option<f64> {
    let m = correlations.nrows();
    let factor = factor(correlations);
    let mut scatter = Scatter::new(SEED);
    let mut largest: Vec<f64> = Vec::with_capacity(SIMULATED);
    for _ in 0..SIMULATED / TOGETHER {
        let mut noise = vec![[0.0; TOGETHER]; m];
        (0..TOGETHER).for_each(|set| noise.iter_mut().for_each(|noise| noise[set] = scatter.normal()));
        largest.extend(largest_of(&factor, &noise));
    }
    largest.sort_by(f64::total_cmp);
    let quantile = crate::stats::quantile(&largest, QUANTILE)?;
    Some((QUANTILE.ln() / (-two_sided_p(quantile, 0)).ln_1p()).clamp(1.0, m as f64))
}

/// L of C = L Lᵀ, row by row to the diagonal, without what rounding leaves of patterns that the ones before them contain. Unlike
/// that of eigenvectors, whose signs hang on the last bit, it moves as little as C does.
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

/// The largest |normal| of some sets of noise.
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
    use super::super::pattern_tests::of_base;
    use super::super::traces::LEFT;
    use super::*;
    use crate::study::{Generator, generate, published::textbook_scenario};

    /// Index of every pattern that is left, and its unit vector.
    fn units(patterns: &Patterns, beside: &Beside) -> Vec<(usize, Vec<f64>)> {
        let unit = |(i, pattern): (usize, &Pattern)| {
            let white = beside.whitener.whiten(&patterns.shapes[pattern.shape].direction(&pattern.time));
            let rest = if pattern.is_uniform { beside.fitted } else { beside.of_places }.rest(&white);
            let left = square(&rest);
            let is_left = left > LEFT * LEFT * square(&white) && left > 0.0;
            is_left.then(|| (i, rest.iter().map(|v| v / left.sqrt()).collect()))
        };
        patterns.all.iter().enumerate().filter_map(unit).collect()
    }

    /// Correlations of unit vectors.
    fn correlations(units: &[(usize, Vec<f64>)]) -> DMatrix<f64> {
        DMatrix::from_fn(units.len(), units.len(), |i, j| dot(&units[i].1, &units[j].1))
    }

    /// Whitened, projected and multiplied at length, one by one.
    #[test]
    fn many_patterns_at_once_are_the_same_as_one_by_one() {
        let usual = Generator::default();
        // Pressures scatter a thousand times as much as the camera: nearly all of some patterns is taken off.
        let scattered = Generator { camera_sd_m: 2e-5, pressure_sd: 0.1, ..usual.clone() };
        for (kind, bending, effect, value, generator) in [
            ("spam", 6.0, "end_constraint", 0.1, &usual),
            ("fpam", 0.3, "friction", 0.3, &usual),
            ("epam", 1.35, "base_clamp", 1.0, &scattered),
        ] {
            let plain = textbook_scenario(kind).unwrap().with_bending(bending);
            let length_m = plain.markers_m.last().copied().unwrap();
            let told = plain.with_markers(&(1..=14).map(|i| length_m * f64::from(i) / 14.0).collect::<Vec<_>>());
            let candidate = models::effects::EFFECTS.iter().find(|e| e.name == effect).unwrap();
            let values = [&[value], &candidate.typical()[1..]].concat();
            let data = generate(&told.with_effect(effect, &values), "made", generator).unwrap();
            of_base(&told, &data, |case| [true, false].into_iter().for_each(|bent| agree(case, bent)));
        }
    }

    fn agree(case: &Case, beside_bending: bool) {
        let prediction = case.prediction(&case.base);
        let [fitted, of_places] = fitted_out(case, &case.base, &prediction, beside_bending);
        let beside = beside(case, &case.base, &fitted, &of_places);
        let units = units(&patterns(case, &prediction), &beside);
        let traces = Traces::of(patterns(case, &prediction), &beside);
        assert!(units.len() > 60 && units.iter().map(|u| u.0).eq(traces.left.iter().map(|t| t.pattern)));
        let largest = traces.left.iter().map(|t| t.t.abs()).fold(1.0, f64::max);
        for (trace, (_, unit)) in traces.left.iter().zip(&units) {
            let t = dot(unit, beside.residual);
            assert!((trace.t - t).abs() < 1e-9 * largest, "{}: {} {t}", traces.pattern(trace).words, trace.t);
        }
        let (fast, slow) = (traces.correlations(), correlations(&units));
        assert!((&fast - &slow).amax() < 1e-9, "{}", (&fast - &slow).amax());
        let [fast, slow] = [fast, slow].map(|correlations| independent(&correlations).unwrap());
        assert!((fast / slow - 1.0).abs() < 1e-5, "{fast} {slow}");
        // What bounds answer is what the number of tests answers.
        let look = look(case, &case.base, beside_bending);
        for seen in &look.seen {
            let p = of_several(seen.p_alone, look.tests());
            assert_eq!(look.p_value(seen), reported_p(p));
            assert!([0.002, 0.01, 0.2].iter().all(|level| look.is_below(seen, *level) == (p < *level)));
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
