//! y turned over in some runs. In all of them it is refused where the table is read.

use super::{SlipSeen, become_mm};
use crate::policy;

pub(super) fn upside(seen: &mut SlipSeen) -> Vec<String> {
    let count = seen.points.len();
    let down: Vec<usize> = (0..count).filter(|run| !seen.bends_up(&seen.points[*run])).collect();
    if count < policy::FEWEST_RUNS || down.is_empty() || 2 * down.len() >= count {
        return Vec::new();
    }
    let mut found = Vec::new();
    for run in down.clone() {
        let (before, after) = (from_others(seen, run, &down, 1.0), from_others(seen, run, &down, -1.0));
        if !policy::is_far_less(before, seen.half_apart()) && policy::is_far_less(after, before) {
            found.push((run, [before, after]));
        }
    }
    for (run, _) in &found {
        seen.points[*run].iter_mut().flatten().for_each(|point| point[1] = -point[1]);
    }
    let told = |(run, rms_m): &(usize, [f64; 2])| {
        format!(
            "y looks turned over {}: {} (rms from the mean of the other runs) with -y in place of y. Look at it first: y is \
             positive towards the actuator",
            seen.in_runs(&[*run]),
            become_mm(*rms_m)
        )
    };
    found.iter().map(told).collect()
}

/// Distance of a run from the mean of those that bend up, with a sign on its y \[m\].
fn from_others(seen: &SlipSeen, run: usize, down: &[usize], sign: f64) -> f64 {
    let others: Vec<usize> = (0..seen.points.len()).filter(|other| !down.contains(other)).collect();
    let mut squares = 0.0;
    for (hold, points) in seen.points[run].iter().enumerate() {
        for (marker, point) in points.iter().enumerate() {
            let mean = [0, 1].map(|axis| {
                others.iter().map(|other| seen.points[*other][hold][marker][axis]).sum::<f64>() / others.len() as f64
            });
            squares += (point[0] - mean[0]).powi(2) + (sign * point[1] - mean[1]).powi(2);
        }
    }
    seen.rms(squares, seen.points[run].len())
}
