//! How well the movement follows the pressure at a clock: the share of a rising function of the pressure, as a correlation.

/// Share of the movement that noise may make before nothing can be said.
const MOSTLY_NOISE: f64 = 0.5;
/// Readings nearer than this are one pressure \[Pa\].
const ONE_PA: f64 = 20.0;

/// Movement, pressure and branch of one frame.
pub(super) struct CameraFrame {
    pub moved: f64,
    pub act_pa: f64,
    /// Frames of one branch (rising or falling, one body pressure) share a function of the pressure.
    pub branch: (bool, i64),
}

/// r = √(1 − Σ(m − f(P))² / Σ(m − m̄)²) with the best monotone function f of every branch; white noise of standard deviation `noise`
/// is taken from both sums. `None` where the movement is hardly more than noise.
pub(super) fn follows(frames: &[CameraFrame], noise: f64) -> Option<f64> {
    let count = frames.len() as f64;
    let noise = noise.powi(2) * count;
    let mean = frames.iter().map(|frame| frame.moved).sum::<f64>() / count;
    let all = frames.iter().map(|frame| (frame.moved - mean).powi(2)).sum::<f64>();
    if all <= 0.0 || noise > MOSTLY_NOISE * all {
        return None;
    }
    // Readings of one pressure have one place, whatever their order.
    let pressure = |frame: &CameraFrame| (frame.branch, (frame.act_pa / ONE_PA).round() as i64);
    let mut sorted: Vec<&CameraFrame> = frames.iter().collect();
    sorted.sort_by_key(|frame| pressure(frame));
    let left = |sign: f64| -> f64 {
        let pool = |frames: &[&CameraFrame]| {
            let moved = || frames.iter().map(|frame| sign * frame.moved);
            [frames.len() as f64, moved().sum(), moved().map(|m| m * m).sum()]
        };
        let of_branch =
            |frames: &[&CameraFrame]| squares_left(frames.chunk_by(|a, b| pressure(a) == pressure(b)).map(pool));
        sorted.chunk_by(|a, b| a.branch == b.branch).map(of_branch).sum()
    };
    let left = (left(1.0).min(left(-1.0)) - noise).max(0.0);
    Some((1.0 - left / (all - noise)).max(0.0).sqrt())
}

/// Squares that the best rising sequence leaves of groups of values (count, sum, sum of squares), by pooling adjacent violators.
fn squares_left(groups: impl Iterator<Item = [f64; 3]>) -> f64 {
    let mut pools: Vec<[f64; 3]> = Vec::new();
    for mut pool in groups {
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
        let left = |values: &[f64]| squares_left(values.iter().map(|v| [1.0, *v, v * v]));
        assert_eq!((left(&[1.0, 2.0, 5.0]), left(&[1.0, 3.0, 1.0, 4.0])), (0.0, 2.0));
    }

    #[test]
    fn a_concave_movement_follows_and_an_unlike_one_does_not() {
        let frames = |of: &dyn Fn(f64) -> f64| -> Vec<CameraFrame> {
            let frame =
                |k: usize| CameraFrame { moved: of((k / 20) as f64), act_pa: 1e3 * (k / 20) as f64, branch: (true, 2) };
            (0..200).map(frame).collect()
        };
        assert!(follows(&frames(&f64::sqrt), 0.0).unwrap() > 0.999);
        assert!(follows(&frames(&|p| -p), 0.0).unwrap() > 0.999);
        assert!(follows(&frames(&|p| (2.0 * p).sin()), 0.0).unwrap() < 0.8);
        assert!(follows(&frames(&|_| 1.0), 0.0).is_none());
        // Movement within holds of exact pressures, none between them.
        let within =
            |k: usize| CameraFrame { moved: k.div_ceil(2) as f64, act_pa: 1e3 * (k / 2) as f64, branch: (true, 2) };
        assert!(follows(&(0..6).map(within).collect::<Vec<_>>(), 0.0).unwrap() < 0.95);
    }
}
