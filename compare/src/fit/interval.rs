//! 95 % intervals of fitted parameters.
//!
//! The fit is linear near its end: a parameter is wᵀȳ with weights w from the whitened Jacobian. Its variance is noise and, where
//! the law misses the data by more than noise, what it misses by:
//!
//! ```text
//! var = σ²/R |w|² + Σ_j v_j (wᵀu_j)² + max(s² (f − 1) Σ_c (Σ_{i∈c} w_i)², G/(G − q) Σ_g (Σ_{i∈g} w_i r_i)²)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | σ²/R, v_j, u_j | camera part and run-to-run parts of the mean, best estimate ([`crate::noise`]) |
//! | s², f | variance of a value of the mean; mean square of the whitened residuals |
//! | r | residuals |
//! | c, g | values of one coordinate of one marker at one pressure; values at one pressure |
//! | G, q | pressures that inform about the parameter; parameters fitted |
//!
//! A law that misses does so at a pressure as a whole: all samples and markers there err together, and its error at one pressure
//! does not predict its error at the next. So pressures are the unit of a misfit as runs are of noise (cluster-robust variance, Liang &
//! Zeger 1986, with the correction for few clusters), and the interval holds what the value would be at other pressures.
//! Taking every value of the misfit as independent understates this: for `synthetic-epam` without sealed edges, B is 0.60, 0.87
//! and 1.15 N·m² at 10, 20 and 30 kPa alone, and 0.94 ± 0.04 by such a count. Where parameters are as many as pressures, these are met
//! one by one and markers are the unit; samples of a hold never are.
//!
//! t has the degrees of freedom of the sum (Welch–Satterthwaite), so that three runs, or three pressures, give wide intervals. Where a bound
//! is near or the interval exceeds 30 % of the value, the profile of the sum of squares replaces the linear one; not where the law
//! misses, because that sum's rise is then no measure of it.

use super::basis::own_part;
use super::least_squares::{FitRange, Residuals, minimise, square};
use crate::noise::NoiseModel;
use crate::policy;
use data::Dataset;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Part of a column that must be its own for the data to hold the parameter.
const LEAST_OWN: f64 = 1e-9;
/// A round of a profile's fit that lowers the sum of squares by less is the last one.
const ENOUGH: f64 = 1e-2;
const HALVINGS: usize = 10;
/// Degrees of freedom beyond which t is normal to three digits. The quantile of `statrs` is 1.83 in place of 1.96 at 1e7, and at
/// 1e8 it does not return.
const MOST_DOF: f64 = 1e4;

pub(crate) struct FittedData<'a> {
    pub dataset: &'a Dataset,
    /// Noise of the mean over runs of this dataset.
    pub noise: &'a NoiseModel,
    /// Prediction minus mean in run layout \[m\].
    pub residual_m: Vec<f64>,
    /// Mean square of the whitened residuals by which the fit allowed for its misfit; 1 if it did not.
    pub misfit: f64,
    /// Readings of a gauge, which come after the positions.
    pub readings: usize,
}

/// Half-width of a confidence interval, and whether misfit widened it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HalfWidth {
    pub width: f64,
    /// What the law misses by is in it.
    pub misses: bool,
}

/// Half of the interval of a parameter; `None` if the noise is unknown. `white` are its weights on values whitened with noise and
/// misfit: the values of all data one after the other, then the separately measured ones.
pub(crate) fn half_width(data: &[FittedData], white: &[f64], parameters: usize) -> Option<HalfWidth> {
    let (mut total, mut squares_over_dof, mut from) = (0.0, 0.0, 0);
    let (mut each, mut cells, mut pressures) = (0.0, 0, Vec::new());
    for part in data {
        let noise = part.noise;
        let to = from + noise.directions.len();
        let sigma = noise.sigma_m?;
        // The whitening matrix is symmetric: weights on raw values are the whitened weights on white ones.
        let weights = match part.misfit > 1.0 {
            true => noise.wider(part.misfit).whiten(&white[from..to]),
            false => noise.whiten(&white[from..to]),
        };
        let runs = noise.runs as f64;
        let camera = sigma * sigma / runs * square(&weights);
        let run_to_run: f64 = (0..noise.mean_variance.len())
            .map(|j| {
                let along: f64 = weights.iter().zip(&noise.directions).map(|(w, u)| w * u[j]).sum();
                along * along * noise.mean_variance[j].max(policy::SENSOR_SD[j].powi(2) / runs)
            })
            .sum();
        let pairs: Vec<(usize, f64)> = weights.iter().copied().enumerate().collect();
        let held = noise.per_hold.variance_of_mean(&pairs, &noise.per_hold.test_variance, noise.runs);
        let dot = |column: &Vec<f64>| weights.iter().zip(column).map(|(w, c)| w * c).sum::<f64>();
        let gauge: f64 = noise.gauge_errors.iter().map(|c| dot(c).powi(2)).sum();
        // Errors of the gauge are specified, or widened already: whitened readings have unit variance.
        total += gauge + square(&white[to..to + part.readings]);
        let run_dof = noise.runs.saturating_sub(noise.sessions).max(1) as f64;
        total += camera + run_to_run + held;
        squares_over_dof += camera * camera / noise.pure_error_dof.max(1) as f64 + run_to_run * run_to_run / run_dof;
        let missed = square(&noise.whiten(&part.residual_m)) / noise.seen(0..weights.len()) as f64;
        if policy::misses(missed) {
            let sums = part.by_cell(&weights);
            each += noise.unit_m().powi(2) * (missed - 1.0) * square(&sums);
            cells += sums.iter().filter(|sum| **sum != 0.0).count();
            pressures.extend(part.by_pressure(&weights));
        }
        from = to + part.readings;
    }
    // A separately measured bending stiffness, of unit variance too.
    total += square(&white[from..]);
    let (misfit, dof) = misfit(&pressures, (each, cells), parameters);
    total += misfit;
    squares_over_dof += misfit * misfit / dof;
    let dof = total * total / squares_over_dof;
    let t = StudentsT::new(0.0, 1.0, dof.clamp(1.0, MOST_DOF)).ok()?.inverse_cdf(0.975);
    Some(HalfWidth { width: t * total.sqrt(), misses: !pressures.is_empty() })
}

impl FittedData<'_> {
    /// Of every hold the first one at its pressures.
    fn first(&self) -> Vec<usize> {
        let holds = &self.dataset.holds;
        let alike = |a: usize, b: usize| policy::same_pressures(&holds[a], &holds[b]);
        (0..holds.len()).map(|h| (0..h).find(|other| alike(*other, h)).unwrap_or(h)).collect()
    }

    /// Of every pressure Σ w² and Σ w r.
    fn by_pressure(&self, weights: &[f64]) -> Vec<[f64; 2]> {
        let first = self.first();
        let mut sums = vec![[0.0; 2]; first.len()];
        let width = weights.len() / first.len();
        for (i, (w, r)) in weights.iter().zip(&self.residual_m).enumerate() {
            let sum = &mut sums[first[i / width]];
            (sum[0], sum[1]) = (sum[0] + w * w, sum[1] + w * r);
        }
        sums
    }

    /// Of every coordinate of every marker at every pressure Σ w.
    fn by_cell(&self, weights: &[f64]) -> Vec<f64> {
        let first = self.first();
        let cells = self.dataset.axes * self.dataset.markers.len();
        let width = weights.len() / first.len();
        let mut sums = vec![0.0; cells * first.len()];
        weights.iter().enumerate().for_each(|(i, w)| sums[cells * first[i / width] + i % cells] += w);
        sums
    }
}

pub(crate) fn misfit(pressures: &[[f64; 2]], (each, cells): (f64, usize), parameters: usize) -> (f64, f64) {
    let all: f64 = pressures.iter().map(|[squares, _]| squares).sum();
    let count = pressures.iter().filter(|[squares, _]| *squares > policy::PRESSURE_TELLS * all).count();
    let spare = count.saturating_sub(parameters) as f64;
    let together = count as f64 / spare * pressures.iter().map(|[_, sum]| sum * sum).sum::<f64>();
    if spare > 0.0 && together > each { (together, spare) } else { (each, cells.max(1) as f64) }
}

/// The interval of a parameter: `squares` is the least sum of squares' second derivative by half, `rise` how far this sum rises above
/// its value at the fit when the parameter is held at a place; without `rise` the interval is linear.
pub(crate) fn interval(
    (value, half, squares): (f64, HalfWidth, f64),
    [lower, upper]: [f64; 2],
    rise: Option<&mut dyn FnMut(f64) -> f64>,
) -> [f64; 2] {
    let (half, misses) = (half.width, half.misses);
    let is_free = value - half >= lower && value + half <= upper;
    match rise.filter(|_| !(misses || is_free && half <= policy::WIDE * value.abs())) {
        None => [(value - half).max(lower), (value + half).min(upper)],
        Some(rise) => {
            let most = half * half * squares;
            [(-half, lower), (half, upper)]
                .map(|(step, bound)| profile_end(value, step, bound, &mut |x| rise(x) < most))
        }
    }
}

/// Weights of a parameter on whitened values, and half of the second derivative of the least sum of squares; `None` if the data do not
/// hold it.
pub(crate) fn weights(jacobian: &[Vec<f64>], k: usize) -> Option<(Vec<f64>, f64)> {
    let own = own_part(jacobian, k);
    let squares = square(&own);
    let is_held = squares > LEAST_OWN * square(&jacobian[k]) && squares > 0.0;
    is_held.then(|| (own.iter().map(|v| v / squares).collect(), squares))
}

/// The interval of a parameter of a fit; `residuals` make its profile.
pub(crate) fn of_parameter(
    k: usize,
    at: &[f64],
    ranges: &[FitRange],
    (half, squares): (HalfWidth, f64),
    residuals: Option<&mut Residuals>,
) -> Option<[f64; 2]> {
    let (linear, bounds) = ((at[k], half, squares), [ranges[k].lower, ranges[k].upper]);
    let Some(residuals) = residuals else { return Some(interval(linear, bounds, None)) };
    let least = square(&residuals(at)?);
    let (mut theta, mut held) = (at.to_vec(), ranges.to_vec());
    let mut rise = |x: f64| {
        (held[k], theta[k]) = (FitRange::fixed(x, held[k].scale), x);
        minimise(&theta, &held, ENOUGH, residuals).map_or(f64::INFINITY, |found| found.cost - least)
    };
    Some(interval(linear, bounds, Some(&mut rise)))
}

fn profile_end(value: f64, step: f64, bound: f64, is_inside: &mut dyn FnMut(f64) -> bool) -> f64 {
    let beyond = |x: f64| if step > 0.0 { x >= bound } else { x <= bound };
    let (mut inside, mut outside) = (value, value + 0.5 * step);
    while !beyond(outside) && is_inside(outside) {
        inside = outside;
        outside = value + 2.0 * (outside - value);
    }
    if beyond(outside) {
        if is_inside(bound) {
            return bound;
        }
        outside = bound;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if is_inside(middle) { inside = middle } else { outside = middle }
    }
    0.5 * (inside + outside)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values 1, 2, 3, 10 times each at one pressure: their mean scatters as three values do, not as thirty.
    #[test]
    fn a_misfit_counts_once_per_pressure() {
        let of = |value: f64| [10.0 / 900.0, 10.0 / 30.0 * (value - 2.0)];
        let (variance, dof) = misfit(&[of(1.0), of(2.0), of(3.0), [0.0; 2]], (2.0 / 3.0 / 30.0, 30), 1);
        // Variance of the mean of three: 1/3.
        assert!((variance - 1.0 / 3.0).abs() < 1e-12 && dof == 2.0, "{variance} {dof}");
        assert_eq!(
            misfit(&[of(1.0), of(2.0), of(3.0)], (0.02, 30), 3),
            (0.02, 30.0),
            "as many parameters as pressures"
        );
        assert_eq!(misfit(&[], (0.0, 0), 1), (0.0, 1.0));
    }

    /// At a pressure that holds less than a thousandth of the weights nothing is seen of the parameter.
    #[test]
    fn a_pressure_counts_from_a_thousandth_of_the_weights() {
        let spare = |share: f64| misfit(&[[1.0, 5.0], [1.0, -5.0], [2.0 * share, 0.0]], (0.0, 0), 1).1;
        assert_eq!([0.9e-3, 1.1e-3].map(spare), [1.0, 2.0]);
    }

    #[test]
    fn the_profile_is_followed_from_three_tenths_of_the_value() {
        let mut asked = 0;
        for width in [2.9, 3.1] {
            let half = HalfWidth { width, misses: false };
            interval(
                (10.0, half, 4.0),
                [0.0, 90.0],
                Some(&mut |x| {
                    asked += usize::from(width < 3.0) + 1;
                    4.0 * (x - 10.0).powi(2)
                }),
            );
            assert_eq!(asked > 0, width > 3.0, "{width}");
        }
    }

    #[test]
    fn near_a_bound_or_where_it_is_wide_the_profile_is_followed() {
        let half = |width: f64| HalfWidth { width, misses: false };
        let linear = interval((5.0, half(1.0), 4.0), [0.0, 9.0], Some(&mut |_| unreachable!()));
        assert_eq!(linear, [4.0, 6.0]);
        let mut cube = |x: f64| 4.0 * (x - 1.0).powi(2) * x;
        let [low, high] = interval((1.0, half(1.0), 4.0), [0.0, 9.0], Some(&mut cube));
        assert!(low == 0.0 && (cube(high) / 4.0 - 1.0).abs() < 0.01, "{low} {high}");
        assert_eq!(interval((1.0, half(2.0), 4.0), [0.0, 9.0], None), [0.0, 3.0]);
        let misses = HalfWidth { width: 2.0, misses: true };
        assert_eq!(interval((1.0, misses, 4.0), [0.0, 9.0], Some(&mut cube)), [0.0, 3.0]);
    }
}
