//! The base and the size of the robot against the markers: a base or an axis in another unit, or a base of another picture.

use super::seen::{Doubt, Level, Seen, SeenRun, middle, minus, size as length};
use crate::import::median;
use crate::policy::{LONGEST_ROBOT_M, SHORTEST_ROBOT_M};
use crate::units::mm;

/// The line through the markers at rest passes the base within this part of the distance of the farthest one.
const BESIDE: f64 = 0.25;

/// Distances from the base that a marker moves at most: a half turn about the base is two.
const FARTHEST_WAY: f64 = 2.4;

/// Places of all markers at rest, by their distance from the base \[m\].
fn at_rest(seen: &Seen) -> Vec<[f64; 3]> {
    let at = |marker: usize| middle(seen.runs.iter().filter_map(|run| run.rest()?.places_m[marker]));
    let mut places: Vec<[f64; 3]> = (0..seen.markers.len()).filter_map(at).collect();
    places.sort_by(|a, b| length(*a).total_cmp(&length(*b)));
    places
}

/// The robot has no size of a robot, or most of its markers move farther than its size allows: lengths along one axis or both are in
/// another unit.
pub(super) fn size(seen: &Seen) -> Option<Doubt> {
    let length_m = length(*at_rest(seen).last()?);
    let way = |run: &SeenRun, to: &Level| {
        let pairs = run.rest()?.places_m.iter().zip(&to.places_m);
        median(pairs.filter_map(|(from, to)| Some(length(minus((*to)?, (*from)?)))).collect())
    };
    let farthest = |run: &SeenRun| run.levels.iter().filter_map(|level| way(run, level)).reduce(f64::max);
    let way_m = median(seen.runs.iter().filter_map(farthest).collect())?;
    let message = format!("at rest the farthest marker is {:.4} mm from the base", mm(length_m));
    if way_m > FARTHEST_WAY * length_m {
        let message = format!("{message}, and most markers move by {:.1} mm or more: no robot does", mm(way_m));
        let help = "x and y are in two units, or the scale is wrong: name each column by its own unit, or correct --scale or --base";
        return Some(Doubt::new(message, help));
    }
    let help = "correct --scale, or the unit of the positions";
    let is_size = (SHORTEST_ROBOT_M..=LONGEST_ROBOT_M).contains(&length_m);
    (!is_size).then(|| Doubt::new(format!("{message}: no robot has this size"), help))
}

/// The robot at rest does not begin at its base.
pub(super) fn base(seen: &Seen) -> Option<Doubt> {
    let places = at_rest(seen);
    let (near, far) = (*places.first()?, *places.last()?);
    let length_m = length(far);
    let along = minus(far, near);
    let beside_m = match length(along) {
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
    use super::{base, size};

    #[test]
    fn a_base_in_another_unit_and_a_robot_of_another_size_are_refused() {
        let moved = |made: &mut Made| made.each(|_, _, _, place| *place = [place[0] + 0.046, place[1] - 0.118]);
        refused(base, moved, &["misses the base by 11", "--base", "pixels"]);
        let small = |made: &mut Made| made.each(|_, _, _, place| *place = place.map(|v| 1e-3 * v));
        refused(size, small, &["no robot has this size", "--scale"]);
        let of_x = |made: &mut Made| made.each(|_, _, _, place| place[0] *= 1e-3);
        refused(size, of_x, &["most markers move by", "no robot does", "x and y are in two units"]);
        let mut made = Made::new(1);
        of_x(&mut made);
        assert_eq!(super::super::doubts(&made.seen()).len(), 1);
        right(base);
        right(size);
    }
}
