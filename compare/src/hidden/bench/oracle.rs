//! How often the truth could be named at best: by whoever has every law as it is in these robots.
//!
//! ```text
//! y = m(law, size, B) + noise      named: the law with the least |W (y − m)|² over its sizes of 0.8–1.5 and over B
//! ```
//!
//! m is the true mean without noise, W the whitening by the known covariance. Between a few sizes m is a straight line, and B
//! acts linearly. No diagnosis has those laws: where even this misses a row of the table, the data do not hold the answer.

use crate::error::CompareError;
use crate::hidden::march;
use crate::hidden::measure::ideal;
use crate::hidden::truth::{HiddenChoice, standard_protocol};
use crate::hidden::{HIDDEN, Truth, truth};
use crate::noise::NoiseModel;
use crate::study::generate::{Scatter, holds};
use data::Dataset;

/// Sizes at which the laws are asked \[typical sizes\]: the range that is drawn from.
const SIZES: [f64; 4] = [0.8, 1.0, 1.2, 1.5];
/// Draws of noise for each set.
const DRAWS: usize = 200;
/// Steps of the differences in ln p and in B.
const STEP: f64 = 0.01;

/// Shares of all noise in which the law of a single hidden effect has the least misfit, and one of the three least; `data`
/// gives holds and markers.
///
/// # Errors
/// A hold at which nothing balances.
pub(super) fn at_best(truth: &Truth, data: &Dataset) -> Result<[f64; 2], CompareError> {
    let g = truth.measurement(&standard_protocol()).generator;
    let robot = truth.robot()?;
    let mean = ideal(&robot, &g)?;
    let apart = |positions: &[f64]| -> Vec<f64> { positions.iter().zip(&mean).map(|(a, b)| a - b).collect() };
    let slope = apart(&march::run(&robot, &holds(&g), 1.0 + STEP)?).iter().map(|d| d / STEP).collect::<Vec<_>>();
    let run_sd = [g.pressure_sd, g.alignment_sd_m, g.alignment_sd_m, g.rotation_sd];
    let known = Dataset { runs: vec!["1".into()], xy_m: mean.clone(), ..data.clone() };
    let noise = NoiseModel::known(&known, &slope, g.runs, g.camera_sd_m, run_sd)?;
    let stiffer = Truth { bending_nm2: (1.0 + STEP) * truth.bending_nm2, ..truth.clone() };
    let bending = noise.whiten(&apart(&ideal(&stiffer.robot()?, &g)?));
    let seen = |positions: &[f64]| without(&bending, noise.whiten(&apart(positions)));
    let mut laws = Vec::new();
    for effect in truth::applicable(&truth.actuator, HIDDEN)? {
        let is_true = truth.effects.iter().find(|choice| choice.name == effect.name);
        let mut sizes: Vec<f64> = SIZES.into_iter().chain(is_true.map(|choice| choice.times_typical)).collect();
        sizes.sort_by(f64::total_cmp);
        let of_size = |size: &f64| -> Option<Vec<f64>> {
            let choice = HiddenChoice { name: effect.name.to_string(), times_typical: *size };
            let other = Truth { effects: vec![choice], ..truth.clone() };
            Some(seen(&ideal(&other.robot().ok()?, &g).ok()?))
        };
        laws.push((is_true.is_some(), Curve::new(sizes.iter().filter_map(of_size).collect())));
    }
    let mut scatter = Scatter::new(truth.seed);
    let mut hits = [0; 2];
    for _ in 0..DRAWS {
        let drawn = without(&bending, mean.iter().map(|_| scatter.normal()).collect());
        let own = laws.iter().filter(|law| law.0).map(|law| law.1.misfit(&drawn)).fold(f64::INFINITY, f64::min);
        let before = laws.iter().filter(|law| !law.0 && law.1.misfit(&drawn) < own).count();
        hits[0] += usize::from(before == 0);
        hits[1] += usize::from(before < 3);
    }
    Ok(hits.map(|hit| hit as f64 / DRAWS as f64))
}

/// What is left of a vector without its part along a direction.
fn without(direction: &[f64], mut vector: Vec<f64>) -> Vec<f64> {
    let square = dot(direction, direction);
    if square > 0.0 {
        let along = dot(direction, &vector) / square;
        vector.iter_mut().zip(direction).for_each(|(v, d)| *v -= along * d);
    }
    vector
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Straight lines through points.
struct Curve {
    points: Vec<Vec<f64>>,
    /// Scalar product of every point with itself and with the next.
    square: Vec<f64>,
    next: Vec<f64>,
}

impl Curve {
    fn new(points: Vec<Vec<f64>>) -> Curve {
        let square = points.iter().map(|p| dot(p, p)).collect();
        let next = points.windows(2).map(|pair| dot(&pair[0], &pair[1])).collect();
        Curve { points, square, next }
    }

    /// min |p − e|² − |e|² over the lines; infinite without points.
    fn misfit(&self, e: &[f64]) -> f64 {
        let along: Vec<f64> = self.points.iter().map(|p| dot(p, e)).collect();
        let mut least = self.square.iter().zip(&along).map(|(s, a)| s - 2.0 * a).fold(f64::INFINITY, f64::min);
        for i in 0..self.next.len() {
            // p + t u with u to the next point: |p + t u − e|² − |e|².
            let start = self.square[i] - 2.0 * along[i];
            let slope = self.next[i] - self.square[i] - (along[i + 1] - along[i]);
            let length = self.square[i] + self.square[i + 1] - 2.0 * self.next[i];
            if length > 0.0 && -slope > 0.0 && -slope < length {
                least = least.min(start - slope * slope / length);
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_misfit_of_a_curve_is_that_of_its_nearest_point() {
        let curve = Curve::new(vec![vec![0.0, 0.0], vec![2.0, 0.0], vec![2.0, 2.0]]);
        for (e, square) in [([1.0, 1.0], 1.0), ([-1.0, 0.0], 1.0), ([3.0, 1.5], 1.0), ([2.5, 3.0], 1.25)] {
            assert!((curve.misfit(&e) + dot(&e, &e) - square).abs() < 1e-12, "{e:?}");
        }
    }

    #[test]
    fn what_is_left_is_perpendicular() {
        let left = without(&[1.0, 1.0, 0.0], vec![2.0, 0.0, 5.0]);
        assert!(dot(&left, &[1.0, 1.0, 0.0]).abs() < 1e-12 && left[2] == 5.0);
    }

    /// Without noise to speak of the truth is always named; drowned in noise it is not.
    #[test]
    fn noise_decides_how_often_the_truth_is_named() {
        let mut truth = Truth::draw("epam", &mut crate::hidden::Draw::new(3, 0)).unwrap();
        truth.add("tip_load", 1.1);
        let of = |camera_sd_m: f64| {
            let truth = Truth { camera_sd_m, ..truth.clone() };
            at_best(&truth, &truth.dataset("set", &standard_protocol()).unwrap()).unwrap()
        };
        let (quiet, loud) = (of(1e-6), of(0.2));
        assert_eq!(quiet, [1.0, 1.0]);
        assert!(loud[0] < 0.5 && loud[1] < 0.8 && loud[0] <= loud[1], "{loud:?}");
    }
}
