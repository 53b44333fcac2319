//! Places of the markers at rest, run against run: a camera or a base that was elsewhere in one of them.

use super::seen::{Doubt, Seen, mean, middle, minus, size};
use crate::units::mm;

/// Largest distance from the other runs \[m\], and as a part of the robot's length.
const MOST: (f64, f64) = (0.008, 0.02);

/// The centre of the markers at rest is elsewhere in one run.
pub(super) fn rest(seen: &Seen) -> Option<Doubt> {
    let centres: Option<Vec<[f64; 3]>> = seen.runs.iter().map(|run| Some(mean(&run.at_rest()?))).collect();
    let centres = centres.filter(|_| seen.runs.len() > 1)?;
    let usual = match &centres[..] {
        [first, _] => *first,
        all => middle(all.iter().copied())?,
    };
    let away = |run: usize| size(minus(centres[run], usual));
    let farthest = (0..centres.len()).max_by(|a, b| away(*a).total_cmp(&away(*b)))?;
    if away(farthest) <= MOST.0.max(MOST.1 * seen.length_m()) {
        return None;
    }
    let message = format!(
        "run {}: at rest the markers are {:.1} mm away from where they are in the other runs: the camera or the base was elsewhere",
        seen.runs[farthest].label,
        mm(away(farthest))
    );
    let help = "give --base MARKER with a marker at the clamp, so that each run has its own base, or import runs with another camera apart";
    Some(Doubt::new(message, help))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::rest;

    #[test]
    fn a_camera_that_was_elsewhere_in_one_run_is_refused() {
        let elsewhere = |made: &mut Made| {
            made.each(|run, _, _, place| {
                if run == 1 {
                    place[1] += 0.015;
                }
            })
        };
        refused(rest, elsewhere, &["run 2: at rest", "elsewhere", "--base MARKER"]);
        right(rest);
    }
}
