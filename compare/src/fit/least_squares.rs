//! Least squares in a box: Levenberg–Marquardt on the coordinates that are not held by a bound.
//!
//! In each round a coordinate on a bound is held if the downhill direction leads out of the box. The others take the
//! step `(JᵀJ + λ diag JᵀJ) δ = −Jᵀr`, cut to the box; it is taken if the sum of squares falls. A held coordinate is let
//! go in the next round if the direction has turned, so the end is a point where downhill leads nowhere but out
//! (Karush–Kuhn–Tucker), whatever way led there.

use nalgebra::{DMatrix, DVector};

/// Range and natural step of one coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FitRange {
    pub lower: f64,
    pub upper: f64,
    /// A change of this size matters.
    pub scale: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Minimum {
    pub at: Vec<f64>,
    pub residual: Vec<f64>,
    /// Sum of squares of the residuals.
    pub cost: f64,
    /// Derivative of the residuals, one column per coordinate.
    pub jacobian: Vec<Vec<f64>>,
}

impl Minimum {
    /// A place with its residuals, without derivatives; `None` where the residuals do not exist.
    pub(crate) fn there(at: Vec<f64>, residuals: &mut Residuals) -> Option<Minimum> {
        let residual = residuals(&at)?;
        Some(Minimum { cost: square(&residual), at, residual, jacobian: Vec::new() })
    }
}

impl FitRange {
    /// A range without bounds, for a parameter of this typical size.
    pub(crate) fn endless(scale: f64) -> FitRange {
        FitRange { lower: f64::NEG_INFINITY, upper: f64::INFINITY, scale }
    }

    pub(crate) fn fixed(at: f64, scale: f64) -> FitRange {
        FitRange { lower: at, upper: at, scale }
    }

    pub(crate) fn is_free(&self) -> bool {
        self.lower < self.upper
    }
}

/// Step of the one-sided differences in units of the scale: a compromise between their curvature and the accuracy of
/// the model's own equations.
const DIFFERENCE: f64 = 1e-4;
/// Rounds; quadratic minima need two, thresholds some tens.
const ROUNDS: usize = 40;
/// Damping at the start, and beyond which no step is tried.
const DAMPING: [f64; 2] = [1e-3, 1e8];

/// Residuals at a place; `None` where they do not exist, which counts as infinitely bad.
pub(crate) type Residuals<'a> = dyn FnMut(&[f64]) -> Option<Vec<f64>> + 'a;

/// Derivatives of residuals at a place, one column per coordinate.
pub(crate) type ResidualSlopes<'a> = dyn FnMut(&Minimum, &mut Residuals) -> Vec<Vec<f64>> + 'a;

/// Minimises the sum of squares from `start` until a round lowers it by less than `enough`; `None` if the residuals do
/// not exist there.
pub(crate) fn minimise(start: &[f64], ranges: &[FitRange], enough: f64, residuals: &mut Residuals) -> Option<Minimum> {
    minimise_by(start, ranges, enough, residuals, &mut |at, residuals| jacobian(at, ranges, residuals))
}

pub(crate) fn minimise_by(
    start: &[f64],
    ranges: &[FitRange],
    enough: f64,
    residuals: &mut Residuals,
    slopes: &mut ResidualSlopes,
) -> Option<Minimum> {
    let at: Vec<f64> = start.iter().zip(ranges).map(|(x, r)| x.clamp(r.lower, r.upper)).collect();
    let mut best = Minimum::there(at, residuals)?;
    best.jacobian = slopes(&best, residuals);
    let mut damping = DAMPING[0];
    for _ in 0..ROUNDS {
        let before = best.cost;
        match improve(&best, ranges, &mut damping, residuals) {
            Some(next) => best = next,
            None => break,
        }
        best.jacobian = slopes(&best, residuals);
        if before - best.cost < enough + 1e-9 * best.cost {
            break;
        }
    }
    Some(best)
}

/// One accepted step, without its Jacobian; `None` if there is none.
fn improve(from: &Minimum, ranges: &[FitRange], damping: &mut f64, residuals: &mut Residuals) -> Option<Minimum> {
    let gradient: Vec<f64> = from.jacobian.iter().map(|column| dot(column, &from.residual)).collect();
    let free: Vec<usize> = (0..ranges.len()).filter(|&k| !is_held(from.at[k], &ranges[k], gradient[k])).collect();
    if free.is_empty() {
        return None;
    }
    let squares = products(&from.jacobian, &free);
    while *damping < DAMPING[1] {
        let step = damped_step(&squares, &free, &gradient, ranges, *damping);
        let mut at = from.at.clone();
        for (k, d) in free.iter().zip(step.iter()) {
            at[*k] = (at[*k] + d).clamp(ranges[*k].lower, ranges[*k].upper);
        }
        if at == from.at {
            return None;
        }
        match Minimum::there(at, residuals) {
            Some(next) if next.cost < from.cost => {
                *damping = (*damping * 0.1).max(1e-9);
                return Some(next);
            }
            _ if tiny(&step, &free, ranges) => return None,
            _ => *damping *= 8.0,
        }
    }
    None
}

/// Solves the damped normal equations; a coordinate without effect is left where it is.
fn damped_step(
    squares: &DMatrix<f64>,
    free: &[usize],
    gradient: &[f64],
    ranges: &[FitRange],
    damping: f64,
) -> DVector<f64> {
    let n = free.len();
    let mut matrix = squares.clone();
    for i in 0..n {
        // The tiny absolute part keeps coordinates apart that have no effect here, or the same one.
        let least = 1e-12 / ranges[free[i]].scale.powi(2);
        matrix[(i, i)] += damping * squares[(i, i)] + least;
    }
    let right = DVector::from_fn(n, |i, _| -gradient[free[i]]);
    matrix.cholesky().map_or_else(|| DVector::zeros(n), |c| c.solve(&right))
}

fn tiny(step: &DVector<f64>, free: &[usize], ranges: &[FitRange]) -> bool {
    step.iter().zip(free).all(|(d, k)| d.abs() < 1e-9 * ranges[*k].scale)
}

/// On a bound, and downhill leads out.
fn is_held(x: f64, range: &FitRange, gradient: f64) -> bool {
    (x <= range.lower && gradient >= 0.0) || (x >= range.upper && gradient <= 0.0)
}

/// One-sided differences, inwards at the upper bound; a column is zero where the residuals do not exist, and for a
/// coordinate whose range is one value.
pub(crate) fn jacobian(at: &Minimum, ranges: &[FitRange], residuals: &mut Residuals) -> Vec<Vec<f64>> {
    let mut moved = at.at.clone();
    let mut columns = Vec::with_capacity(ranges.len());
    for (k, range) in ranges.iter().enumerate() {
        if range.lower == range.upper {
            columns.push(vec![0.0; at.residual.len()]);
            continue;
        }
        let h = DIFFERENCE * range.scale;
        let inward = if at.at[k] + h <= range.upper { h } else { -h };
        let column = [inward, -inward].into_iter().find_map(|h| {
            moved[k] = at.at[k] + h;
            let shifted = residuals(&moved)?;
            Some(shifted.iter().zip(&at.residual).map(|(a, b)| (a - b) / h).collect())
        });
        moved[k] = at.at[k];
        columns.push(column.unwrap_or_else(|| vec![0.0; at.residual.len()]));
    }
    columns
}

/// JᵀJ of the chosen columns of J.
pub(crate) fn products(jacobian: &[Vec<f64>], chosen: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(chosen.len(), chosen.len(), |i, j| dot(&jacobian[chosen[i]], &jacobian[chosen[j]]))
}

/// Σ aᵢ bᵢ, summed in eight parts that do not wait for each other.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (whole, rest) = a[..a.len().min(b.len())].as_chunks::<8>();
    let mut parts = [0.0; 8];
    for (a, b) in whole.iter().zip(b.as_chunks::<8>().0) {
        parts.iter_mut().zip(a.iter().zip(b)).for_each(|(part, (a, b))| *part += a * b);
    }
    let last: f64 = rest.iter().zip(&b[8 * whole.len()..]).map(|(a, b)| a * b).sum();
    parts.iter().sum::<f64>() + last
}

pub(crate) fn square(a: &[f64]) -> f64 {
    dot(a, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(lower: f64, upper: f64) -> FitRange {
        FitRange { lower, upper, scale: 1.0 }
    }

    #[test]
    fn rosenbrocks_valley_is_followed_to_its_end() {
        let mut valley = |x: &[f64]| Some(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]);
        let found = minimise(&[-1.2, 1.0], &[range(-5.0, 5.0); 2], 1e-9, &mut valley).unwrap();
        assert!((found.at[0] - 1.0).abs() < 1e-3 && (found.at[1] - 1.0).abs() < 2e-3, "{:?}", found.at);
    }

    #[test]
    fn a_correlated_quadratic_in_a_box_ends_at_its_constrained_minimum() {
        // r = A(x − c): the unconstrained minimum c is outside; compare with a dense scan of the box.
        let a = [[2.0, 1.5, 0.3], [0.2, 1.0, -0.8], [0.5, -0.4, 1.1]];
        for c in [[2.0, -1.0, 0.4], [-3.0, 0.5, 2.0], [0.5, 0.5, 0.5], [1.5, 1.5, -2.0], [-0.2, 3.0, 0.1]] {
            let mut residuals = |x: &[f64]| {
                Some(a.iter().map(|row| (0..3).map(|k| row[k] * (x[k] - c[k])).sum::<f64>()).collect::<Vec<f64>>())
            };
            let mut least = f64::INFINITY;
            let steps = 60;
            for i in 0..=steps {
                for j in 0..=steps {
                    for k in 0..=steps {
                        let x = [i, j, k].map(|i| f64::from(i) / f64::from(steps));
                        least = least.min(square(&residuals(&x).unwrap()));
                    }
                }
            }
            for start in [[0.5; 3], [0.0; 3], [1.0; 3], [0.0, 1.0, 0.0]] {
                let found = minimise(&start, &[range(0.0, 1.0); 3], 1e-12, &mut residuals).unwrap();
                assert!(found.cost <= least + 1e-9, "{c:?} from {start:?}: {} {least}", found.cost);
                assert!(found.at.iter().all(|x| (0.0..=1.0).contains(x)));
            }
        }
    }

    #[test]
    fn places_without_residuals_are_avoided_and_useless_coordinates_stay() {
        let mut root = |x: &[f64]| (x[0] >= 0.0).then(|| vec![x[0].sqrt() - 0.1]);
        let found = minimise(&[4.0, 0.7], &[range(-10.0, 10.0); 2], 1e-9, &mut root).unwrap();
        assert!((found.at[0] - 0.01).abs() < 1e-4 && found.at[1] == 0.7, "{:?}", found.at);
        assert!(minimise(&[-1.0, 0.0], &[range(-10.0, 10.0); 2], 1e-9, &mut root).is_none());
    }
}
