//! How well the movement follows the pressure at a clock: the share of a rising function of the pressure, as a correlation.

use super::super::holds::{SD_PER_STEP, median};

/// Share of the movement that noise may make before nothing can be said.
const MOSTLY_NOISE: f64 = 0.5;

/// Movement, pressure and branch of one frame.
pub(super) struct CameraFrame {
    pub moved: f64,
    pub act_pa: f64,
    /// Frames of one branch (rising or falling, one body pressure) share a function of the pressure.
    pub branch: (bool, i64),
}

/// r = √(1 − Σ(m − f(P))² / Σ(m − m̄)²) with the best monotone function f of every branch; white noise, estimated from neighbours,
/// is taken from both sums. `None` where the movement is hardly more than noise.
pub(super) fn follows(frames: &[CameraFrame]) -> Option<f64> {
    let count = frames.len() as f64;
    let steps = frames.windows(2).map(|pair| (pair[1].moved - pair[0].moved).abs()).collect();
    let noise = (SD_PER_STEP * median(steps)?).powi(2) * count;
    let mean = frames.iter().map(|frame| frame.moved).sum::<f64>() / count;
    let all = frames.iter().map(|frame| (frame.moved - mean).powi(2)).sum::<f64>();
    if all <= 0.0 || noise > MOSTLY_NOISE * all {
        return None;
    }
    let mut sorted: Vec<&CameraFrame> = frames.iter().collect();
    sorted.sort_by(|a, b| (a.branch, a.act_pa).partial_cmp(&(b.branch, b.act_pa)).unwrap_or(std::cmp::Ordering::Equal));
    let left = |sign: f64| -> f64 {
        let of_branch = |frames: &[&CameraFrame]| squares_left(frames.iter().map(|frame| sign * frame.moved));
        sorted.chunk_by(|a, b| a.branch == b.branch).map(of_branch).sum()
    };
    let left = (left(1.0).min(left(-1.0)) - noise).max(0.0);
    Some((1.0 - left / (all - noise)).max(0.0).sqrt())
}

/// Squares that the best rising sequence leaves of values, by pooling adjacent violators.
fn squares_left(values: impl Iterator<Item = f64>) -> f64 {
    let mut pools: Vec<[f64; 3]> = Vec::new(); // count, sum, sum of squares
    for value in values {
        let mut pool = [1.0, value, value * value];
        while let Some(last) = pools.pop_if(|last| last[1] * pool[0] >= pool[1] * last[0]) {
            (0..3).for_each(|k| pool[k] += last[k]);
        }
        pools.push(pool);
    }
    pools.iter().map(|[n, sum, squares]| (squares - sum * sum / n).max(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_rising_sequence_leaves_what_falls() {
        assert_eq!(squares_left([1.0, 2.0, 5.0].into_iter()), 0.0);
        assert_eq!(squares_left([1.0, 3.0, 1.0, 4.0].into_iter()), 2.0);
    }

    #[test]
    fn a_concave_movement_follows_and_an_unlike_one_does_not() {
        let frames = |of: &dyn Fn(f64) -> f64| -> Vec<CameraFrame> {
            let frame =
                |k: usize| CameraFrame { moved: of((k / 20) as f64), act_pa: (k / 20) as f64, branch: (true, 2) };
            (0..200).map(frame).collect()
        };
        assert!(follows(&frames(&f64::sqrt)).unwrap() > 0.999);
        assert!(follows(&frames(&|p| -p)).unwrap() > 0.999);
        assert!(follows(&frames(&|p| (2.0 * p).sin())).unwrap() < 0.8);
        assert!(follows(&frames(&|_| 1.0)).is_none());
    }
}
