//! Times of change: of the pressure from hold to hold, of the movement from place to place.

use super::super::holds::{PressedRun, median, plateaus};
use super::super::options::ImportOptions;
use super::track::Track;
use crate::policy::{is_a_room, tolerance_act_pa, tolerance_body_pa};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SignalEdge {
    /// When half of it has happened \[s\].
    pub t_s: f64,
    /// +1 or −1; 0 where the direction is not clear.
    pub sign: i8,
    /// Time between the samples around it \[s\].
    pub gap_s: f64,
}

/// Edges above this number are noise.
const MOST_EDGES: usize = 300;
/// Part of the usual time between changes over which places before and after a change are averaged.
const WINDOW: f64 = 0.4;
/// A change of movement exceeds this many standard deviations of its noise.
const CLEAR: f64 = 6.0;
/// And this share of the largest change.
const LEAST_SHARE: f64 = 0.02;
/// Share of a change along the principal direction from which on its sign is clear.
const ALONG: f64 = 0.3;

/// Changes of the pressure between holds of a log.
pub(super) fn of_log(times_s: &[f64], values_pa: [&[f64]; 2], options: &ImportOptions) -> Vec<SignalEdge> {
    let gauge = |values: &[f64]| {
        let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
        let room = options.room_pa.unwrap_or(if is_a_room(lowest) { lowest } else { 0.0 });
        values.iter().map(|p| p - room).collect::<Vec<f64>>()
    };
    let run = PressedRun {
        label: String::new(),
        times_s: times_s.to_vec(),
        pressures_pa: values_pa.map(gauge),
        xy_m: Vec::new(),
    };
    let kept = plateaus(&run, &ImportOptions { settle_s: 0.0, least_frames: 2, ..options.clone() });
    let levels = |frames: &[usize]| {
        [0, 1].map(|which| frames.iter().map(|k| run.pressures_pa[which][*k]).sum::<f64>() / frames.len() as f64)
    };
    let edge = |pair: &[super::super::holds::Kept]| {
        let [before, after] = [&pair[0], &pair[1]].map(|hold| levels(&hold.frames));
        let act = (after[1] - before[1]).abs() > tolerance_act_pa(before[1].min(after[1]));
        let body = (after[0] - before[0]).abs() > tolerance_body_pa(before[0].min(after[0]));
        let which = usize::from(act);
        let (last, first) = (*pair[0].frames.last()?, *pair[1].frames.first()?);
        let half = 0.5 * (before[which] + after[which]);
        let rises = after[which] > before[which];
        let passed = (last + 1..=first).find(|k| (run.pressures_pa[which][*k] > half) == rises)?;
        let [t0, t1] = [times_s[passed - 1], times_s[passed]];
        let sign = if act { [-1, 1][usize::from(rises)] } else { 0 };
        (act || body).then_some(SignalEdge { t_s: 0.5 * (t0 + t1), sign, gap_s: t1 - t0 })
    };
    kept.windows(2).filter_map(edge).take(MOST_EDGES + 1).collect()
}

/// The usual time between changes \[s\]: a quarter of them follow each other faster. Of a single change, its distance from the ends.
pub(super) fn usual_gap_s(edges: &[SignalEdge], ends_s: [f64; 2]) -> f64 {
    let mut gaps: Vec<f64> = edges.windows(2).map(|pair| pair[1].t_s - pair[0].t_s).collect();
    gaps.sort_by(f64::total_cmp);
    let alone = |edge: &SignalEdge| (edge.t_s - ends_s[0]).min(ends_s[1] - edge.t_s);
    gaps.get(gaps.len() / 4).copied().or(edges.first().map(alone)).unwrap_or(0.0)
}

/// Changes of the markers' places: the means after and before a time differ most there.
pub(super) fn of_movement(track: &Track, gap_s: f64) -> Vec<SignalEdge> {
    let times = &track.times;
    let steps = median(times.windows(2).map(|pair| pair[1] - pair[0]).collect()).unwrap_or(0.0);
    let window_s = (WINDOW * gap_s).max(1.5 * steps);
    let changes = changes(track, window_s);
    let largest = changes.iter().map(|change| change.size).fold(0.0, f64::max);
    let sizes: Vec<f64> = changes.iter().map(|change| change.size).collect();
    let mut found = Vec::new();
    for k in 0..changes.len() {
        let near = near(&changes, k, window_s);
        let peak = near.clone().all(|j| sizes[j] < sizes[k] || (sizes[j] == sizes[k] && j >= k));
        if !peak || sizes[k] < changes[k].noise * CLEAR || sizes[k] < LEAST_SHARE * largest || sizes[k] == 0.0 {
            continue;
        }
        let high = |j: &usize| sizes[*j] >= 0.5 * sizes[k];
        let from = (near.start..k).rev().take_while(high).last().unwrap_or(k);
        let to = (k..near.end).take_while(high).last().unwrap_or(k);
        let weight = |j: usize| sizes[j] * changes[j].gap_s;
        let total: f64 = (from..=to).map(weight).sum();
        let centre = (from..=to).map(|j| weight(j) * changes[j].t_s).sum::<f64>() / total;
        let along = changes[k].along / sizes[k];
        let sign = if along.abs() < ALONG { 0 } else { along.signum() as i8 };
        found.push(SignalEdge { t_s: centre, sign, gap_s: changes[k].gap_s });
        if found.len() > MOST_EDGES {
            break;
        }
    }
    found
}

/// Whether there are so many that they are noise.
pub(super) fn too_many(edges: &[SignalEdge]) -> bool {
    edges.len() > MOST_EDGES
}

/// Difference of the mean places within a window after and before the middle of two frames.
struct MeanShift {
    t_s: f64,
    gap_s: f64,
    size: f64,
    along: f64,
    noise: f64,
}

fn changes(track: &Track, window_s: f64) -> Vec<MeanShift> {
    let times = &track.times;
    let sums: Vec<Vec<f64>> = track
        .columns
        .iter()
        .map(|values| {
            let mut sum = 0.0;
            let next = |v: &f64| {
                sum += v - values[0];
                sum
            };
            std::iter::once(0.0).chain(values.iter().map(next)).collect()
        })
        .collect();
    let noise = track.noise.iter().map(|sd| sd * sd).sum::<f64>().sqrt();
    let (mut low, mut high) = (0, 0);
    let change = |k: usize| {
        while times[low] < times[k] - window_s {
            low += 1;
        }
        while high < times.len() && times[high] <= times[k + 1] + window_s {
            high += 1;
        }
        let [before, after] = [k + 1 - low, high - (k + 1)].map(|count| count as f64);
        let step = |sum: &Vec<f64>| (sum[high] - sum[k + 1]) / after - (sum[k + 1] - sum[low]) / before;
        let steps: Vec<f64> = sums.iter().map(step).collect();
        MeanShift {
            t_s: 0.5 * (times[k] + times[k + 1]),
            gap_s: times[k + 1] - times[k],
            size: steps.iter().map(|s| s * s).sum::<f64>().sqrt(),
            along: steps.iter().zip(&track.direction).map(|(s, d)| s * d).sum(),
            noise: noise * (1.0 / before + 1.0 / after).sqrt(),
        }
    };
    (0..times.len() - 1).map(change).collect()
}

/// Indices of the changes within a window around one.
fn near(changes: &[MeanShift], k: usize, window_s: f64) -> std::ops::Range<usize> {
    let from = changes.partition_point(|change| change.t_s < changes[k].t_s - window_s);
    let to = changes.partition_point(|change| change.t_s <= changes[k].t_s + window_s);
    from..to
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_of_a_log_are_halfway_between_its_holds() {
        let times: Vec<f64> = (0..300).map(|k| 0.1 * f64::from(k)).collect();
        let level = |t: f64| 1e3 * (10.0 * (t - 10.0).clamp(0.0, 1.0) - 5.0 * (t - 20.0).clamp(0.0, 1.0));
        let act: Vec<f64> = times.iter().map(|t| level(*t)).collect();
        let found = of_log(&times, [&vec![2e3; 300], &act], &ImportOptions::default());
        assert_eq!(found.iter().map(|edge| edge.sign).collect::<Vec<_>>(), [1, -1]);
        assert!((found[0].t_s - 10.5).abs() < 0.1 && (found[1].t_s - 20.5).abs() < 0.1, "{found:?}");
        assert!((usual_gap_s(&found, [0.0, 29.9]) - 10.0).abs() < 0.2);
    }

    #[test]
    fn changes_of_movement_are_found_in_ramps_and_noise() {
        let times: Vec<f64> = (0..900).map(|k| f64::from(k) / 30.0).collect();
        let place = |t: f64| 40.0 * (t - 10.0).clamp(0.0, 1.0) - 5.0 * (t - 20.0).clamp(0.0, 2.0);
        let noise = |k: usize| 0.4 * (7.1 * (k * k % 97) as f64).sin();
        let column: Vec<f64> = times.iter().enumerate().map(|(k, t)| place(*t) + noise(k)).collect();
        let track = Track { times, columns: vec![column], noise: vec![0.3], direction: vec![1.0] };
        let found = of_movement(&track, 10.0);
        assert_eq!(found.iter().map(|edge| edge.sign).collect::<Vec<_>>(), [1, -1], "{found:?}");
        assert!((found[0].t_s - 10.5).abs() < 0.1 && (found[1].t_s - 21.0).abs() < 0.2, "{found:?}");
    }
}
