//! The base against the markers at rest: a base in another unit, or of another picture.

use super::seen::{Doubt, Seen, middle, minus, size};
use crate::policy::{LONGEST_ROBOT_M, SHORTEST_ROBOT_M};
use crate::units::mm;

/// The line through the markers at rest passes the base within this part of the distance of the farthest one.
const BESIDE: f64 = 0.25;

/// The robot at rest does not begin at its base, or has no size of a robot: its lengths are in another unit.
pub(super) fn base(seen: &Seen) -> Option<Doubt> {
    let at = |marker: usize| middle(seen.runs.iter().filter_map(|run| run.rest()?.places_m[marker]));
    let mut places: Vec<[f64; 3]> = (0..seen.markers.len()).filter_map(at).collect();
    places.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
    let (near, far) = (*places.first()?, *places.last()?);
    let length_m = size(far);
    if !(SHORTEST_ROBOT_M..=LONGEST_ROBOT_M).contains(&length_m) {
        let message =
            format!("at rest the farthest marker is {:.4} mm from the base: no robot has this size", mm(length_m));
        return Some(Doubt::new(message, "correct --scale, or the unit of the positions"));
    }
    let along = minus(far, near);
    let beside_m = match size(along) {
        apart if apart > 0.1 * length_m => {
            let dot: f64 = far.iter().zip(along).map(|(a, b)| a * b / apart).sum();
            (length_m.powi(2) - dot.powi(2)).max(0.0).sqrt()
        }
        // Markers near each other, or one: the robot is along x.
        _ => far[1].hypot(far[2]),
    };
    let message = format!(
        "at rest the line through the markers misses the base by {:.1} mm, and the farthest marker is {:.1} mm away",
        mm(beside_m),
        mm(length_m)
    );
    let help =
        "give --base in the units of the file, in pixels where the positions are pixels, or as a marker at the clamp";
    (beside_m > BESIDE * length_m).then(|| Doubt::new(message, help))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::base;

    #[test]
    fn a_base_in_another_unit_and_a_robot_of_another_size_are_refused() {
        let moved = |made: &mut Made| made.each(|_, _, _, place| *place = [place[0] + 0.046, place[1] - 0.118]);
        refused(base, moved, &["misses the base by 11", "--base", "pixels"]);
        let small = |made: &mut Made| made.each(|_, _, _, place| *place = place.map(|v| 1e-3 * v));
        refused(base, small, &["no robot has this size", "--scale"]);
        right(base);
    }
}
