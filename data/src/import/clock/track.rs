//! The movement of all markers as columns without gaps, its principal direction and its noise.

use super::super::holds::{SD_PER_STEP, median};
use super::super::recording::Recording;

/// Frames that are used; longer recordings are averaged over blocks of frames.
const MOST_FRAMES: usize = 20_000;
const MOST_MARKERS: usize = 16;
/// A marker that is seen in a smaller share of the frames is not used.
const SEEN: f64 = 0.5;
/// Iterations for the principal direction; an error of a few per cent is of no importance.
const ITERATIONS: usize = 30;

/// Coordinates of the markers over the camera's time.
pub(super) struct Track {
    pub times: Vec<f64>,
    pub columns: Vec<Vec<f64>>,
    /// Standard deviation of the noise of every column.
    pub noise: Vec<f64>,
    /// Unit vector along which the markers move most.
    pub direction: Vec<f64>,
}

impl Track {
    /// `None` if no marker moves, or if there are too few frames.
    pub(super) fn of(recording: &Recording) -> Option<Track> {
        let block = recording.times.len().div_ceil(MOST_FRAMES).max(1);
        let times: Vec<f64> = recording.times.chunks(block).map(mean).collect();
        let seen = |column: &&Vec<[f64; 3]>| {
            column.iter().filter(|place| place[0].is_finite()).count() as f64 >= SEEN * column.len() as f64
        };
        let markers: Vec<&Vec<[f64; 3]>> = recording.places.iter().filter(seen).collect();
        let step = markers.len().div_ceil(MOST_MARKERS).max(1);
        let columns: Vec<Vec<f64>> = markers
            .iter()
            .step_by(step)
            .flat_map(|places| (0..3).map(|axis| places.iter().map(|place| place[axis]).collect::<Vec<f64>>()))
            .filter_map(|values| {
                let blocks: Vec<f64> = values.chunks(block).map(mean).collect();
                Some(calm(&bridged(&times, &blocks)?)).filter(|values| values.iter().any(|v| *v != values[0]))
            })
            .collect();
        if columns.is_empty() || times.len() < 3 {
            return None;
        }
        let noise = columns.iter().map(|values| noise_of(values)).collect();
        let direction = principal(&columns);
        Some(Track { times, columns, noise, direction })
    }

    pub(super) fn along(&self) -> Vec<f64> {
        let at = |k: usize| self.direction.iter().zip(&self.columns).map(|(d, values)| d * values[k]).sum();
        (0..self.times.len()).map(at).collect()
    }
}

/// Standard deviation of noise, from the steps of all frames: most of them are within holds.
pub(super) fn noise_of(values: &[f64]) -> f64 {
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    SD_PER_STEP * median(steps).unwrap_or(0.0)
}

fn mean(values: &[f64]) -> f64 {
    let (sum, count) =
        values.iter().filter(|v| v.is_finite()).fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    sum / count
}

/// Values with lines across the gaps; `None` if all are missing.
fn bridged(times: &[f64], values: &[f64]) -> Option<Vec<f64>> {
    let known: Vec<usize> = (0..values.len()).filter(|k| values[*k].is_finite()).collect();
    let (first, last) = (*known.first()?, *known.last()?);
    let mut filled = values.to_vec();
    filled[..first].fill(values[first]);
    filled[last..].fill(values[last]);
    for pair in known.windows(2).filter(|pair| pair[1] > pair[0] + 1) {
        let [a, b] = [pair[0], pair[1]];
        for k in a + 1..b {
            let share = (times[k] - times[a]) / (times[b] - times[a]);
            filled[k] = values[a] + share * (values[b] - values[a]);
        }
    }
    Some(filled)
}

/// Medians of three neighbours: single wild places are gone, steps are kept.
fn calm(values: &[f64]) -> Vec<f64> {
    let of = |k: usize| match (k.checked_sub(1).map(|k| values[k]), values[k], values.get(k + 1)) {
        (Some(a), b, Some(&c)) => a.max(b).min(a.min(b).max(c)),
        _ => values[k],
    };
    (0..values.len()).map(of).collect()
}

/// The direction of the largest variance, by power iteration.
fn principal(columns: &[Vec<f64>]) -> Vec<f64> {
    let centred: Vec<Vec<f64>> = columns
        .iter()
        .map(|values| {
            let middle = mean(values);
            values.iter().map(|v| v - middle).collect()
        })
        .collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let covariance: Vec<Vec<f64>> =
        centred.iter().map(|a| centred.iter().map(|b| dot(a, b)).collect::<Vec<f64>>()).collect();
    let widest = (0..columns.len()).max_by(|a, b| covariance[*a][*a].total_cmp(&covariance[*b][*b])).unwrap_or(0);
    let mut direction = covariance[widest].clone();
    for _ in 0..ITERATIONS {
        let size = dot(&direction, &direction).sqrt().max(f64::MIN_POSITIVE);
        direction.iter_mut().for_each(|d| *d /= size);
        direction = covariance.iter().map(|row| dot(row, &direction)).collect();
    }
    let size = dot(&direction, &direction).sqrt().max(f64::MIN_POSITIVE);
    direction.iter().map(|d| d / size).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_bridged_and_single_wild_values_are_gone() {
        let times = [0.0, 1.0, 2.0, 3.0, 4.0];
        let gap = [f64::NAN, 1.0, f64::NAN, 3.0, f64::NAN];
        assert_eq!(bridged(&times, &gap).unwrap(), [1.0, 1.0, 2.0, 3.0, 3.0]);
        assert!(bridged(&times, &[f64::NAN; 5]).is_none());
        assert_eq!(calm(&[0.0, 0.0, 9.0, 0.0, 1.0, 1.0]), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn the_principal_direction_is_that_of_the_movement() {
        let way: Vec<f64> = (0..50).map(|k| f64::from(k % 10)).collect();
        let columns = [3.0, -4.0].map(|by| way.iter().map(|w| by * w + 7.0).collect::<Vec<f64>>());
        let found = principal(&columns);
        assert!((found[0].abs() - 0.6).abs() < 1e-9 && (found[0] * found[1] + 0.48).abs() < 1e-9, "{found:?}");
    }
}
