//! A robot that goes elsewhere and comes back within a hold: the pressure log does not show a hold that the camera saw.

use super::seen::{Doubt, Level, Seen, SeenRun, middle, minus, size};
use crate::units::mm;

/// Movement that is judged \[m\], and as a part of the robot's length; a robot that settles or creeps does not come back.
const LEAST: (f64, f64) = (0.015, 0.05);
/// Fewest frames of a hold that is judged.
const FEWEST: usize = 20;

/// In the middle of a hold a marker is elsewhere than at both its ends.
pub(super) fn unsteady(seen: &Seen) -> Option<Doubt> {
    let least_m = LEAST.0.max(LEAST.1 * seen.length_m());
    let (run, level, marker, by_m) = seen.runs.iter().find_map(|run| {
        let away = |level, marker| Some((run, level, marker, away_m(run, level, marker)?));
        let all =
            run.levels.iter().flat_map(|level| (0..seen.markers.len()).filter_map(move |marker| away(level, marker)));
        { all }.find(|(.., by_m)| *by_m > least_m)
    })?;
    let [from_s, to_s] = [level.frames.first()?, level.frames.last()?].map(|k| run.times_s[*k]);
    let message = format!(
        "run {}: from {from_s:.1} to {to_s:.1} s marker {} moves by {:.1} mm and comes back at one pressure",
        run.label,
        seen.markers[marker].0,
        mm(by_m)
    );
    Some(Doubt::new(message, "check the pressure log: readings of these times are missing or repeated"))
}

/// Distance of a marker in the middle of a hold from the nearer one of its places at the ends \[m\].
fn away_m(run: &SeenRun, level: &Level, marker: usize) -> Option<f64> {
    let count = level.frames.len();
    let at = |from: usize, to: usize| middle(level.frames[from..to].iter().map(|k| run.places_m[marker][*k]));
    let part = count / 10;
    (count >= FEWEST).then_some(())?;
    let [begin, mid, end] = [at(0, part)?, at(4 * part, 6 * part)?, at(count - part, count)?];
    Some(size(minus(mid, begin)).min(size(minus(mid, end))))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::unsteady;

    #[test]
    fn a_hold_that_the_log_does_not_show_is_refused() {
        let away = |made: &mut Made| {
            made.each(|run, t, _, place| {
                if run == 1 && (16.6..18.8).contains(&t) {
                    place[1] += 0.03
                }
            })
        };
        refused(unsteady, away, &["run 2: from 15", "comes back at one pressure", "log"]);
        right(unsteady);
    }
}
