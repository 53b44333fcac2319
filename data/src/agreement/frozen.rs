//! Frames that repeat the one before: the camera, or the program that tracks, stood still while the time went on.

use super::seen::{Doubt, Seen};

/// Places nearer than this are the same: rounding of means \[m\].
const SAME_M: f64 = 1e-9;
/// Repeated frames may be this share of all others: a coarse tracker repeats places of a robot at rest.
const USUAL: f64 = 0.2;
/// Fewest equal frames that count as frozen.
const FEWEST: f64 = 4.0;
/// Shortest time that equal frames must last \[s\].
const LEAST_S: f64 = 0.5;

/// Some frames of a run are alike, and the others are not.
pub(super) fn frozen(seen: &Seen) -> Option<Doubt> {
    seen.runs.iter().find_map(|run| {
        let Doubt { message, help } = stands_still(&run.times_s, &run.places_m)?;
        Some(Doubt { message: format!("run {}: {message}", run.label), help })
    })
}

/// The same of one video: time of every frame \[s\] and `[marker][frame]`. By chance the longest of n repeats has ln n / ln(1/share)
/// frames.
pub(crate) fn stands_still(times_s: &[f64], places: &[Vec<[f64; 3]>]) -> Option<Doubt> {
    let count = times_s.len();
    if count < 2 {
        return None;
    }
    let alike: Vec<bool> = (1..count).map(|k| repeats(places, k)).collect();
    let (mut longest, mut first) = (0..0, 0);
    for k in 0..=alike.len() {
        if k == alike.len() || !alike[k] {
            if k - first > longest.len() {
                longest = first..k;
            }
            first = k + 1;
        }
    }
    let others = alike.len() - longest.len();
    let repeated = alike.iter().filter(|same| **same).count() - longest.len();
    let share = repeated as f64 / others.max(1) as f64;
    let by_chance = (count as f64).ln() / (1.0 / share.max(1e-3)).ln();
    let [begin, end] = [longest.start, longest.end].map(|k| times_s[k]);
    let few = (longest.len() as f64) < FEWEST - 1.0 + 2.0 * by_chance.floor();
    if share >= USUAL || others == 0 || few || end - begin < LEAST_S {
        return None;
    }
    let message = format!(
        "all markers are frozen to the last digit from {begin:.1} to {end:.1} s, in {} frames",
        longest.len() + 1
    );
    let help = "delete these frames, or record the run again: the picture did not change while the time went on";
    Some(Doubt::new(message, help))
}

/// Whether all markers are where they were in the frame before.
fn repeats(places: &[Vec<[f64; 3]>], frame: usize) -> bool {
    let mut some = false;
    for column in places {
        let [before, now] = [column[frame - 1], column[frame]];
        if before[0].is_nan() != now[0].is_nan() || (0..3).any(|axis| (before[axis] - now[axis]).abs() > SAME_M) {
            return false;
        }
        some |= now[0].is_finite();
    }
    some
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::frozen;

    #[test]
    fn a_picture_that_stands_still_for_a_hold_is_refused() {
        refused(frozen, |made: &mut Made| made.freeze(0, 250..450), &["run 1", "are frozen", "from 10.0 to 18.0 s"]);
        right(frozen);
        // Without noise all frames of a hold are equal.
        assert!(frozen(&Made { noise_mm: 0.0, ..Made::new(1) }.seen()).is_none());
    }
}
