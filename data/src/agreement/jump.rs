//! Markers that jump from one frame to the next at one pressure: the camera was turned or zoomed, a marker slid, or its label went elsewhere.

use super::seen::{Doubt, Level, Seen, SeenRun, middle, minus, size};
use crate::units::mm;

/// Smallest jump \[m\], and as a part of the robot's length.
const LEAST: (f64, f64) = (0.005, 0.015);
/// Frames on either side that keep their places.
const SIDE: usize = 4;
/// Part of a jump by which these frames may be off it: a robot that snaps takes several frames.
const OFF: f64 = 0.3;
/// Frames farther apart do not show a jump \[s\].
const NEXT_S: f64 = 0.1;

/// A marker changes its place between two frames of a hold, and keeps the places before and after.
pub(super) fn jump(seen: &Seen) -> Option<Doubt> {
    let least_m = LEAST.0.max(LEAST.1 * seen.length_m());
    let (run, frame, jumped) = seen.runs.iter().find_map(|run| {
        let (frame, jumped) = run.levels.iter().find_map(|level| of_level(run, level, least_m))?;
        Some((run, frame, jumped))
    })?;
    let names: Vec<&str> = jumped.iter().map(|(marker, _)| seen.markers[*marker].0.as_str()).collect();
    let most_m = jumped.iter().map(|(_, by)| *by).fold(0.0, f64::max);
    let (who, help) = if jumped.len() > 1 {
        (format!("markers {} jump", names.join(", ")), "leave the frames after it out, or record the run again")
    } else {
        (format!("marker {} jumps", names[0]), "track it again, or leave its positions blank after it")
    };
    let [before_s, after_s] = [run.times_s[frame - 1], run.times_s[frame]];
    let message = format!(
        "run {}: between {before_s:.2} and {after_s:.2} s {who} by up to {:.1} mm at one pressure: the camera was moved, or a marker",
        run.label,
        mm(most_m)
    );
    Some(Doubt::new(message, help))
}

/// The frame after a jump, and the markers that jump with their ways \[m\].
fn of_level(run: &SeenRun, level: &Level, least_m: f64) -> Option<(usize, Vec<(usize, f64)>)> {
    let frames = level.frames.get(SIDE..level.frames.len().saturating_sub(SIDE))?;
    frames.iter().find_map(|frame| {
        let is_next = *frame >= SIDE && run.times_s[*frame] - run.times_s[*frame - 1] <= NEXT_S;
        let by = |marker: usize| Some((marker, of_marker(&run.places_m[marker], *frame, least_m)?));
        let jumped: Vec<(usize, f64)> = (0..run.places_m.len()).filter(|_| is_next).filter_map(by).collect();
        (!jumped.is_empty()).then_some((*frame, jumped))
    })
}

/// How far a marker jumps to a frame \[m\]; `None` if the frames around it do not keep their places.
fn of_marker(column: &[[f64; 3]], frame: usize, least_m: f64) -> Option<f64> {
    let by = size(minus(column[frame], column[frame - 1]));
    if !(by > least_m && frame + SIDE <= column.len()) {
        return None;
    }
    let [before, after] = [&column[frame - SIDE..frame], &column[frame..frame + SIDE]];
    let keeps = |side: &[[f64; 3]]| {
        let at = middle(side.iter().copied())?;
        Some(side.iter().all(|place| size(minus(*place, at)) < OFF * by))
    };
    (keeps(before)? && keeps(after)?).then_some(by)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::jump;

    #[test]
    fn a_turned_camera_and_a_marker_that_slid_are_refused() {
        let turned = |made: &mut Made| {
            made.each(|run, t, _, place| {
                if run == 1 && t > 12.0 {
                    let [x, y] = [place[0] - 0.1, place[1] - 0.05];
                    *place = [0.1 + x - 0.08 * y, 0.05 + y + 0.08 * x]
                }
            })
        };
        refused(jump, turned, &["run 2: between 12.00 and 12.04 s", "jump", "the camera was moved"]);
        let slid = |made: &mut Made| {
            made.each(|_, t, marker, place| {
                if marker == 1 && t > 13.0 {
                    place[0] += 0.02
                }
            })
        };
        refused(jump, slid, &["run 1: between 13.00 and 13.04 s marker b jumps by up to 2", "track it again"]);
        right(jump);
    }
}
