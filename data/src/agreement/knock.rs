//! A step that all markers share: the camera, its tripod or the base was knocked.

use super::seen::{Doubt, Level, Seen, SeenRun, common_shift, mean, minus, size};
use crate::units::mm;

/// Smallest step \[m\], and as a part of the robot's length.
const LEAST: (f64, f64) = (0.005, 0.015);
/// Fewest frames on either side of a step within a hold.
const SIDE: usize = 2;
/// Part of a step that the frames around it scatter at most.
const SCATTER: f64 = 0.3;

/// All markers step by the same vector within a hold, between holds of the same pressures, or at a hold against the other runs. A robot that
/// bends moves its outer markers more.
pub(super) fn knock(seen: &Seen) -> Option<Doubt> {
    if seen.markers.len() < 2 || !seen.separates_shifts() {
        return None;
    }
    let least_m = LEAST.0.max(LEAST.1 * seen.length_m());
    let within = |run: &SeenRun| run.levels.iter().find_map(|level| within_hold(run, level, least_m));
    let found = |run: &SeenRun| within(run).or_else(|| between_holds(run, least_m));
    let (run, (from_s, to_s, shift)) =
        seen.runs.iter().find_map(|run| Some((run, found(run)?))).or_else(|| against_others(seen, least_m))?;
    let message = format!(
        "run {}: between {from_s:.1} and {to_s:.1} s all markers step by the same {:.1} mm: the camera or the base was moved",
        run.label,
        mm(size(shift))
    );
    Some(Doubt::new(message, "leave the frames after it out, or record the run again with camera and base fixed"))
}

/// When a step is, and the step.
type PlaceStep = (f64, f64, [f64; 3]);

fn within_hold(run: &SeenRun, level: &Level, least_m: f64) -> Option<PlaceStep> {
    let frames: Vec<usize> =
        level.frames.iter().copied().filter(|k| run.places_m.iter().all(|column| column[*k][0].is_finite())).collect();
    if frames.len() < 2 * SIDE {
        return None;
    }
    let centre: Vec<[f64; 3]> =
        frames.iter().map(|k| mean(&run.places_m.iter().map(|column| column[*k]).collect::<Vec<_>>())).collect();
    let sums: Vec<[f64; 3]> = std::iter::once([0.0; 3])
        .chain(centre.iter().scan([0.0; 3], |sum, at| {
            (0..3).for_each(|axis| sum[axis] += at[axis]);
            Some(*sum)
        }))
        .collect();
    let part = |from: usize, to: usize| minus(sums[to], sums[from]).map(|sum| sum / (to - from) as f64);
    let step = |at: &usize| size(minus(part(*at, frames.len()), part(0, *at)));
    let at = (SIDE..=frames.len() - SIDE).max_by(|a, b| step(a).total_cmp(&step(b)))?;
    let [before, after] = [part(0, at), part(at, frames.len())];
    let of_marker = |column: &Vec<[f64; 3]>| {
        let over = |frames: &[usize]| mean(&frames.iter().map(|k| column[*k]).collect::<Vec<_>>());
        minus(over(&frames[at..]), over(&frames[..at]))
    };
    let steps: Vec<[f64; 3]> = run.places_m.iter().map(of_marker).collect();
    let shift = common_shift(&steps, least_m)?;
    let off = |(k, place): (usize, &[f64; 3])| size(minus(*place, if k < at { before } else { after })).powi(2);
    let scatter = (centre.iter().enumerate().map(off).sum::<f64>() / centre.len() as f64).sqrt();
    (scatter < SCATTER * size(shift)).then(|| (run.times_s[frames[at - 1]], run.times_s[frames[at]], shift))
}

fn steps(from: &Level, to: &Level) -> Option<Vec<[f64; 3]>> {
    from.places_m.iter().zip(&to.places_m).map(|(from, to)| Some(minus((*to)?, (*from)?))).collect()
}

fn span(run: &SeenRun, from: &Level, to: &Level) -> Option<[f64; 2]> {
    Some([run.times_s[*from.frames.last()?], run.times_s[*to.frames.first()?]])
}

fn between_holds(run: &SeenRun, least_m: f64) -> Option<PlaceStep> {
    for (k, to) in run.levels.iter().enumerate() {
        for from in run.levels[..k].iter().rev().filter(|from| from.is_like(to)) {
            if let Some(shift) = common_shift(&steps(from, to)?, least_m) {
                let [from_s, to_s] = span(run, from, to)?;
                return Some((from_s, to_s, shift));
            }
        }
    }
    None
}

/// Where a run steps from hold to hold by more than all the others.
fn against_others(seen: &Seen, least_m: f64) -> Option<(&SeenRun, PlaceStep)> {
    if seen.runs.len() < 3 || !seen.same_holds() {
        return None;
    }
    for (r, run) in seen.runs.iter().enumerate() {
        for k in 1..run.levels.len() {
            let of = |run: &SeenRun| steps(&run.levels[k - 1], &run.levels[k]);
            let Some(own) = of(run) else { continue };
            let others: Vec<Vec<[f64; 3]>> =
                seen.runs.iter().enumerate().filter(|(other, _)| *other != r).filter_map(|(_, run)| of(run)).collect();
            let usual = |marker: usize| super::seen::middle(others.iter().map(|steps| steps[marker]));
            let off: Option<Vec<[f64; 3]>> =
                own.iter().enumerate().map(|(marker, step)| Some(minus(*step, usual(marker)?))).collect();
            if let Some(shift) = common_shift(&off.unwrap_or_default(), least_m) {
                let [from_s, to_s] = span(run, &run.levels[k - 1], &run.levels[k])?;
                return Some((run, (from_s, to_s, shift)));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::knock;

    fn moved(after_s: f64) -> impl Fn(&mut Made) {
        move |made: &mut Made| {
            made.each(move |run, t, _, place| {
                if run == 0 && t > after_s {
                    *place = [place[0] + 0.012, place[1] - 0.015];
                }
            })
        }
    }

    #[test]
    fn a_camera_that_was_knocked_is_refused() {
        refused(knock, moved(17.5), &["run 1: between 17.5 and 17.5 s", "by the same 19.", "camera"]);
        refused(knock, moved(15.1), &["run 1", "all markers step"]);
        right(knock);
    }

    #[test]
    fn a_knock_between_holds_shows_against_the_other_runs() {
        let rising = |made: &mut Made| {
            made.levels.truncate(4);
            moved(10.1)(made);
        };
        refused(knock, rising, &["run 1: between 10.0", "all markers step"]);
    }
}
