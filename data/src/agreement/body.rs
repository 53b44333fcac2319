//! The body's pressure: a sensor that is not connected, or a body that leaks until it is empty.

use super::seen::{Doubt, Seen, SeenRun, minus, size};
use crate::units::{kpa, mm};

/// A body that bends has at least this pressure \[Pa\].
const LEAST_PA: f64 = 500.0;
/// Movement of a robot that bends \[m\].
const BENDS_M: f64 = 0.005;

/// The body has hardly any pressure in a hold, and the robot bends.
pub(super) fn body(seen: &Seen) -> Option<Doubt> {
    let empty = |run: &SeenRun| run.levels.iter().find(|level| level.pressures_pa[0] < LEAST_PA).cloned();
    let (run, level) = seen.runs.iter().find_map(|run| Some((run, empty(run)?)))?;
    let rest = run.rest()?;
    let moved = |level: &super::seen::Level| {
        let steps = level.places_m.iter().zip(&rest.places_m).filter_map(|(to, from)| Some(minus((*to)?, (*from)?)));
        steps.map(size).fold(0.0, f64::max)
    };
    let moved_m = run.levels.iter().map(moved).fold(0.0, f64::max);
    let message = format!(
        "run {}: at {:.1} s the body has {:.2} kPa, and in this run the robot bends by {:.1} mm: a body that bends has at least {} kPa",
        run.label,
        run.times_s[*level.frames.first()?],
        kpa(level.pressures_pa[0]),
        mm(moved_m),
        kpa(LEAST_PA)
    );
    let help = "check sensor, column and unit of the body's pressure, or leave the column out and give --body-pressure 2kPa; leave out holds after a leak";
    (moved_m > BENDS_M).then(|| Doubt::new(message, help))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::body;

    #[test]
    fn a_body_without_pressure_is_refused() {
        refused(
            body,
            |made: &mut Made| made.body_kpa = [0.0, 0.0],
            &["run 1: at", "the body has 0.00 kPa", "--body-pressure"],
        );
        refused(body, |made: &mut Made| made.body_kpa = [2.0, 0.3], &["the body has 0.", "leak"]);
        right(body);
    }
}
