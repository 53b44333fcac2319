//! What a fit leaves of many patterns at once, without a long vector for each.
//!
//! With the whitening W = (I − B diag(ℓ) Bᵀ)^½/s, ℓ the lost share of the variance along B, and Q the basis of what is fitted,
//! a whitened pattern with all that projected out is g = (I − QQᵀ) W d, and
//!
//! ```text
//! gᵢᵀgⱼ = dᵢᵀdⱼ/s² − vᵢᵀvⱼ      v = [√ℓ Bᵀd/s, (WQ)ᵀd]      t = gᵀr/|g| = dᵀ W (I − QQᵀ) r / |g|
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | d, r | displacement of a pattern; whitened residuals of the fit |
//! | s, B | unit of the noise and directions along which runs scatter |
//! | v | a number for each of these directions and each column of Q, some twenty |
//!
//! so that all of it comes from products of the shapes with some twenty vectors and, for correlations, with each other. Where
//! nearly all of a pattern is taken off, the difference loses its digits: such a one is whitened and projected at length.

use super::patterns::{Pattern, Patterns};
use crate::fit::basis::Basis;
use crate::fit::least_squares::{dot, square};
use crate::fit::whiten::Whitener;
use nalgebra::DMatrix;

/// A pattern of which fits leave less than this share cannot be told from them.
pub(super) const LEFT: f64 = 0.02;
/// Share of |d|²/s² below which the difference is no longer trusted: ten digits are left.
const CANCELLED: f64 = 1e-6;

pub struct Beside<'a> {
    pub whitener: &'a Whitener,
    /// What the fit takes of any pattern.
    pub fitted: &'a Basis,
    /// The same and more, of those that are a place; begins with the columns of `fitted`.
    pub of_places: &'a Basis,
    pub residual: &'a [f64],
}

/// A pattern that can be told from what is fitted.
pub struct Trace {
    /// Index of the pattern.
    pub pattern: usize,
    pub t: f64,
    /// v of the formula, first what is taken of every pattern.
    taken: Vec<f64>,
    length: f64,
}

/// All that can be told from what is fitted, in the order of the patterns.
pub struct Traces {
    patterns: Patterns,
    /// Those that are left.
    pub left: Vec<Trace>,
    /// Numbers taken of every pattern.
    of_any: usize,
    unit_m: f64,
}

impl Traces {
    /// The traces of patterns.
    pub fn of(patterns: Patterns, beside: &Beside) -> Traces {
        let Beside { whitener, fitted, of_places, residual } = beside;
        let spread: Vec<Vec<f64>> = whitener.lost().collect();
        let white = of_places.columns().iter().map(|q| whitener.whiten(q));
        let [any, place] = [fitted, of_places].map(|basis| whitener.whiten(&basis.rest(residual)));
        let (of_spread, of_any) = (spread.len(), spread.len() + fitted.columns().len());
        let vectors: Vec<Vec<f64>> = spread.into_iter().chain(white).chain([any, place]).collect();
        let unit_m = whitener.unit_m();
        let by_shape: Vec<(Vec<f64>, Vec<Vec<f64>>)> = patterns
            .shapes
            .iter()
            .map(|shape| {
                let mut squares = vec![0.0; patterns.all.first().map_or(0, |p| p.time.len())];
                shape.with(shape, &mut squares);
                (squares, vectors.iter().map(|vector| shape.along(vector)).collect())
            })
            .collect();
        let trace = |(i, pattern): (usize, &Pattern)| {
            let (squares, products) = &by_shape[pattern.shape];
            let mut taken: Vec<f64> = products.iter().map(|by_hold| dot(by_hold, &pattern.time)).collect();
            let along = taken.split_off(taken.len() - 2);
            let whole = at_times(squares, &pattern.time, &pattern.time) / (unit_m * unit_m);
            let white = whole - square(&taken[..of_spread]);
            let (basis, to, along) =
                if pattern.is_uniform { (fitted, of_any, along[0]) } else { (of_places, taken.len(), along[1]) };
            let rest = white - square(&taken[of_spread..to]);
            let (white, rest, along) = if rest > CANCELLED * whole {
                (white, rest, along)
            } else {
                let white = whitener.whiten(&patterns.shapes[pattern.shape].direction(&pattern.time));
                let rest = basis.rest(&white);
                (square(&white), square(&rest), dot(&rest, residual))
            };
            let length = rest.max(0.0).sqrt();
            (rest > LEFT * LEFT * white && rest > 0.0).then(|| Trace { pattern: i, t: along / length, taken, length })
        };
        let left = patterns.all.iter().enumerate().filter_map(trace).collect();
        Traces { patterns, left, of_any, unit_m }
    }

    /// The pattern of a trace.
    pub fn pattern(&self, trace: &Trace) -> &Pattern {
        &self.patterns.all[trace.pattern]
    }

    /// Correlations of all t under noise.
    pub fn correlations(&self) -> DMatrix<f64> {
        let Traces { patterns, left, of_any, unit_m } = self;
        let mut all = DMatrix::zeros(left.len(), left.len());
        let mut of_shape = vec![Vec::new(); patterns.shapes.len()];
        left.iter().enumerate().for_each(|(i, trace)| of_shape[self.pattern(trace).shape].push(i));
        let mut by_hold = vec![0.0; patterns.all.first().map_or(0, |p| p.time.len())];
        for (a, shape) in patterns.shapes.iter().enumerate().filter(|(a, _)| !of_shape[*a].is_empty()) {
            for b in (a..patterns.shapes.len()).filter(|b| !of_shape[*b].is_empty()) {
                let in_common = shape.with(&patterns.shapes[b], &mut by_hold);
                for (i, j) in of_shape[a].iter().flat_map(|i| of_shape[b].iter().map(move |j| (*i, *j))) {
                    let (one, other) = (self.pattern(&left[i]), self.pattern(&left[j]));
                    let both = if in_common { at_times(&by_hold, &one.time, &other.time) } else { 0.0 };
                    let to = if one.is_uniform && other.is_uniform { *of_any } else { left[i].taken.len() };
                    let taken = dot(&left[i].taken[..to], &left[j].taken[..to]);
                    let value = (both / (unit_m * unit_m) - taken) / (left[i].length * left[j].length);
                    (all[(i, j)], all[(j, i)]) = (value, value);
                }
            }
        }
        all
    }
}

/// Σ over the holds of products by hold times both factors.
fn at_times(by_hold: &[f64], one: &[f64], other: &[f64]) -> f64 {
    by_hold.iter().zip(one).zip(other).map(|((product, a), b)| product * a * b).sum()
}
