//! Places of the markers at rest, run against run: a camera or a base that was elsewhere in one of them.

use super::seen::{Doubt, Seen, mean, middle, minus, size};
use crate::import::median;
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
        return turned(seen);
    }
    let message = format!(
        "run {}: at rest the markers are {:.1} mm away from where they are in the other runs: the camera or the base was elsewhere",
        seen.runs[farthest].label,
        mm(away(farthest))
    );
    let help = "give --base MARKER with a marker at the clamp, so that each run has its own base, or import runs with another camera apart";
    Some(Doubt::new(message, help))
}

/// Angle between the line through the markers of a run at rest and through the markers of the others \[rad\].
const MOST_TURN: f64 = 0.04;

/// The robot at rest points another way in one run: a camera that was turned about the robot.
fn turned(seen: &Seen) -> Option<Doubt> {
    let angle = |run: &super::seen::SeenRun| {
        let mut places = run.at_rest()?;
        places.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
        let [x, y, _] = minus(*places.last()?, *places.first()?);
        (x > 0.0).then(|| y.atan2(x))
    };
    let angles: Vec<f64> = seen.runs.iter().map(angle).collect::<Option<_>>()?;
    let usual = median(angles.clone())?;
    let farthest =
        (0..angles.len()).max_by(|a, b| (angles[*a] - usual).abs().total_cmp(&(angles[*b] - usual).abs()))?;
    let by = angles[farthest] - usual;
    let message = format!(
        "run {}: at rest the robot is turned by {:.1} degrees from the other runs: the camera or the base was turned",
        seen.runs[farthest].label,
        by.to_degrees()
    );
    let help = "import this run separately with its own --turn, or leave it out";
    (by.abs() > MOST_TURN).then(|| Doubt::new(message, help))
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
        let turned = |made: &mut Made| {
            made.each(|run, _, _, place| {
                if run == 2 {
                    let [x, y] = [place[0] - 0.2, place[1]];
                    *place = [0.2 + x - 0.07 * y, y + 0.07 * x]
                }
            })
        };
        refused(rest, turned, &["run 3: at rest the robot is turned by", "degrees", "--turn"]);
        right(rest);
    }
}
