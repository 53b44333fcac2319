//! Rising staircases and staircases with a way back of four robots: the clock is right, or it is refused.

use super::{Readings, agree};
use crate::import::options::{ImportOptions, Offset};
use crate::import::recording::{Lengths, Pivot, Recording};

/// Uniform numbers in 0..1 (Knuth's MMIX constants).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.roll()).sum::<f64>() - 6.0
    }
}

/// Bend over the pressure \[rad\]: proportional, concave, with a threshold, and saturating.
const ROBOTS: [fn(f64) -> f64; 4] = [
    |kpa| 1.4 * kpa / 40.0,
    |kpa| 1.6 * (kpa / 40.0).sqrt(),
    |kpa| 1.8 * (kpa - 4.0).max(0.0) / (kpa + 20.0),
    |kpa| 1.5 * (kpa / 15.0).tanh(),
];

#[derive(Clone, Copy)]
struct Take {
    robot: fn(f64) -> f64,
    step_kpa: f64,
    hold_s: f64,
    way_back: bool,
    /// The log's time is `ahead_s + rate · t`.
    ahead_s: f64,
    rate: f64,
    /// Part by which the frame rate falls over the take.
    slows: f64,
    /// Parts of a hold that the video shows before the first change and after the last one.
    margins: [f64; 2],
    /// Steps that the video misses at its beginning.
    misses: usize,
    seed: u64,
}

impl Take {
    fn levels(&self) -> Vec<f64> {
        let most = (36.0 / self.step_kpa) as usize;
        let up = 0..=most;
        let down = (0..most).rev().take(if self.way_back { most } else { 0 });
        up.chain(down).map(|k| k as f64 * self.step_kpa).collect()
    }

    /// Pressure at a true time; ramps of 0.6 s begin every hold but the first.
    fn pressure_kpa(&self, levels: &[f64], t_s: f64) -> f64 {
        let k = ((t_s / self.hold_s).max(0.0) as usize).min(levels.len() - 1);
        let before = levels[k.saturating_sub(1)];
        before + (levels[k] - before) * ((t_s - k as f64 * self.hold_s) / 0.6).clamp(0.0, 1.0)
    }

    /// The camera sees the true time; 25 frames a second nominally.
    fn record(&self) -> (Recording, Vec<f64>, Vec<f64>) {
        let (levels, mut dice) = (self.levels(), Dice(self.seed));
        let end_s = levels.len() as f64 * self.hold_s;
        let [begin, stop] =
            [self.hold_s * (self.misses as f64 + 1.0 - self.margins[0]), end_s - self.hold_s * (1.0 - self.margins[1])];
        let mut pivot = Pivot::new(Lengths::Pixels, true);
        let markers = [100.0, 200.0, 300.0].map(|s| (pivot.marker(&format!("{s}")), s));
        let (mut bend, mut t_s, mut shown_s) = (0.0, begin - 20.0, 0.0);
        while t_s < stop {
            let filming = t_s >= begin;
            let step_s = 0.04 * (1.0 + if filming { self.slows * (t_s - begin) / (stop - begin) } else { 0.0 });
            bend += ((self.robot)(self.pressure_kpa(&levels, t_s)) - bend) * (step_s / 0.3).min(1.0);
            if filming {
                let frame = pivot.frame(shown_s);
                for (marker, s) in markers {
                    let k = (bend / 300.0_f64).max(1e-9);
                    let place = [(k * s).sin() / k, (1.0 - (k * s).cos()) / k].map(|v| v + 0.5 * dice.normal());
                    pivot.put(frame, marker, [place[0], place[1], 0.0], true);
                }
                shown_s += 0.04;
            }
            t_s += step_s;
        }
        let [first, last] = [-0.9 * self.hold_s, end_s + 0.9 * self.hold_s];
        let count = ((last - first) / 0.05) as usize;
        let times: Vec<f64> = (0..count).map(|k| first + 0.05 * k as f64).collect();
        let act = times.iter().map(|t| 1e3 * self.pressure_kpa(&levels, *t) + 40.0 * dice.normal()).collect();
        let log_s = times.iter().map(|t| self.ahead_s + self.rate * (t - begin)).collect();
        (pivot.finish(), log_s, act)
    }

    fn agreed(&self, offset: Offset) -> super::Agreed {
        let (recording, times_s, act) = self.record();
        let body = vec![2e3; act.len()];
        let readings = Readings { times_s: &times_s, values_pa: [&body, &act] };
        agree(&readings, &recording, &ImportOptions { offset, ..ImportOptions::default() })
    }

    /// How far the found clock is at most from the true one at the changes that the video shows \[s\]; `None` if it is refused.
    fn off_s(&self) -> Option<f64> {
        let (clock, _) = self.agreed(Offset::Find).ok()?;
        let begin = self.begin_s();
        let end_s = self.levels().len() as f64 * self.hold_s;
        let length_s = end_s - self.hold_s * (1.0 - self.margins[1]) - begin;
        let off = |k: usize| {
            let true_s = k as f64 * self.hold_s + 0.3;
            let since = true_s - begin;
            // Frame n comes after dt (1 + slows · since / length): the shown time is the logarithm of it.
            let part = self.slows / length_s;
            let shown = if part > 0.0 { (1.0 + part * since).ln() / part } else { since };
            (clock.at(shown) - self.ahead_s - self.rate * since).abs()
        };
        Some((1 + self.misses..self.levels().len()).map(off).fold(0.0, f64::max))
    }

    fn begin_s(&self) -> f64 {
        self.hold_s * (self.misses as f64 + 1.0 - self.margins[0])
    }
}

fn takes() -> Vec<Take> {
    let mut found = Vec::new();
    for (r, robot) in ROBOTS.into_iter().enumerate() {
        for step_kpa in [4.0, 5.0, 10.0] {
            for hold_s in [5.0, 10.0] {
                for way_back in [false, true] {
                    for (k, (rate, slows)) in
                        [(1.0, 0.0), (0.97, 0.0), (1.03, 0.0), (1.0, 0.04), (1.0, 0.2)].into_iter().enumerate()
                    {
                        let seed = (found.len() + 1) as u64;
                        let ahead_s = [3.4, -7.7, 12.1, 0.0, 25.0][(k + r) % 5];
                        let margins = [[0.8, 0.8], [0.5, 0.9], [0.95, 0.4]][found.len() % 3];
                        found.push(Take {
                            robot,
                            step_kpa,
                            hold_s,
                            way_back,
                            ahead_s,
                            rate,
                            slows,
                            margins,
                            misses: 0,
                            seed,
                        });
                    }
                }
            }
        }
    }
    found
}

/// Found and right, refused, found and wrong.
fn judged(misses: usize) -> [usize; 3] {
    let mut counts = [0; 3];
    for take in takes() {
        match (Take { misses, ..take }).off_s() {
            None => counts[1] += 1,
            Some(off) if off < 1.0 => counts[0] += 1,
            Some(_) => counts[2] += 1,
        }
    }
    counts
}

#[test]
fn no_clock_of_a_staircase_is_wrong_and_most_are_found() {
    let [right, refused, wrong] = judged(0);
    println!("whole takes: {right} right, {refused} refused, {wrong} wrong");
    assert!(wrong == 0 && right > 200, "{right} right, {refused} refused, {wrong} wrong");
}

#[test]
fn no_clock_of_a_video_that_begins_late_is_wrong() {
    let [right, refused, wrong] = judged(1);
    println!("first step missed: {right} right, {refused} refused, {wrong} wrong");
    assert!(wrong == 0 && right > 100, "{right} right, {refused} refused, {wrong} wrong");
}

#[test]
fn right_clocks_are_kept() {
    let right = takes().into_iter().filter(|take| take.rate == 1.0 && take.slows == 0.0);
    let takes: Vec<Take> =
        right.flat_map(|take| (0..5).map(move |k| Take { seed: take.seed + 1000 * k, ..take })).collect();
    let refused: Vec<_> = takes.iter().filter_map(|take| take.agreed(Offset::Given(take.ahead_s)).err()).collect();
    println!("{} of {} right clocks refused", refused.len(), takes.len());
    assert!(refused.is_empty(), "{refused:?}");
}

/// By a second, or by part of a hold; by whole holds only where the pressures do not rise by steps that look alike.
#[test]
fn wrong_clocks_are_refused_unless_several_clocks_explain_the_video() {
    for take in takes().into_iter().filter(|take| take.rate == 1.0 && take.slows == 0.0) {
        let unique = take.off_s().is_some();
        for wrong_s in [1.0, -1.5, 0.5 * take.hold_s, take.hold_s, -take.hold_s, 2.0 * take.hold_s] {
            let kept = take.agreed(Offset::Given(take.ahead_s + wrong_s)).is_ok();
            let whole = wrong_s.abs() >= take.hold_s;
            assert!(!kept || (whole && !unique), "{} kPa, {} s: {wrong_s} s", take.step_kpa, take.hold_s);
        }
    }
}
