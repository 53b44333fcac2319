//! Where the markers are at rest and how they move: the direction of the robot, and the plane of its motion.

use super::options::FileAxis;
use super::vectors::{along, cross, towards, unit_vector};

/// Largest angle between the plane of the motion and a plane of the file's axes \[rad\]: lengths shrink by 0.1 %.
pub(super) const TILTED: f64 = 0.05;
/// A robot bends without pressure if it is bent so many times as much at the lowest one as at the highest.
const STRAIGHTENS: f64 = 2.0;

/// Where markers are at rest from the base, and how they move to the highest pressure, means over runs \[m\].
pub(super) struct Moved {
    pub rest: Vec<[f64; 3]>,
    pub by: Vec<[f64; 3]>,
}

impl Moved {
    /// The axis along which the markers are at rest: of their spread, or of a single one's distance from the base.
    pub(super) fn along(&self) -> usize {
        let seen: Vec<&[f64; 3]> = self.rest.iter().filter(|at| at[0].is_finite()).collect();
        let spread = |axis: usize| {
            let values = seen.iter().map(|at| at[axis]);
            values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
        };
        let size = |axis: usize| match seen[..] {
            [] => 0.0,
            [only] => only[axis].abs(),
            _ => spread(axis),
        };
        (0..3).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(0)
    }

    /// From the nearest marker at rest, or the base, to the farthest \[m\].
    pub(super) fn line(&self, [near, far]: [usize; 2]) -> [f64; 3] {
        let from = if near == far { [0.0; 3] } else { self.rest[near] };
        [0, 1, 2].map(|axis| self.rest[far][axis] - from[axis])
    }

    /// Directions along the robot and towards the actuator in the plane of the line at rest and of the farthest marker's motion, if this
    /// plane is tilted out of the plane of two axes. One of these axes that is in the plane is kept; without one, the robot at rest is
    /// straight. One marker may be off the line from the base, so it shows no tilt.
    pub(super) fn tilted(&self, axes: [FileAxis; 2], ends: [usize; 2]) -> Option<[[f64; 3]; 2]> {
        if ends[0] == ends[1] {
            return None;
        }
        let (line, by) = (self.line(ends), self.by[ends[1]]);
        let normal = unit_vector(cross(unit_vector(line)?, by))?;
        if normal[third(axes)].abs() >= TILTED.cos() {
            return None;
        }
        let [first, second] = axes.map(FileAxis::direction);
        let is_kept = |axis: [f64; 3]| along(axis, normal).abs() <= TILTED;
        let x = match [first, second].map(is_kept) {
            [true, _] => cross(normal, cross(first, normal)),
            [false, true] => cross(second, normal),
            [false, false] => line,
        };
        let x = unit_vector(towards(x, line))?;
        Some([x, towards(cross(normal, x), by)])
    }

    pub(super) fn ends(&self, axis: usize) -> Option<[usize; 2]> {
        let by = |a: &usize, b: &usize| self.rest[*a][axis].abs().total_cmp(&self.rest[*b][axis].abs());
        let seen = || (0..self.rest.len()).filter(|k| self.rest[*k][0].is_finite());
        Some([seen().min_by(by)?, seen().max_by(by)?])
    }

    /// How far a marker is at most from the line from the base to the farthest one, at rest and at the highest pressure \[m\], if the
    /// robot is bent at rest and straight there: its pressures belong to other times.
    pub(super) fn straightens(&self, far: usize) -> Option<[f64; 2]> {
        let top = |at: &[f64; 3], by: &[f64; 3]| [0, 1, 2].map(|axis| at[axis] + by[axis]);
        let top: Vec<[f64; 3]> = self.rest.iter().zip(&self.by).map(|(at, by)| top(at, by)).collect();
        let bow = |places: &[[f64; 3]]| {
            let line = unit_vector(places[far])?;
            let off = |place: &[f64; 3]| along(cross(line, *place), cross(line, *place)).sqrt();
            Some(places.iter().map(off).filter(|off| off.is_finite()).fold(0.0, f64::max))
        };
        let [rest, top] = [bow(&self.rest)?, bow(&top)?];
        (rest > STRAIGHTENS * top).then_some([rest, top])
    }
}

/// The file's axis across two others.
pub(super) fn third(axes: [FileAxis; 2]) -> usize {
    3 - axes[0].index - axes[1].index
}

impl FileAxis {
    pub(super) fn direction(self) -> [f64; 3] {
        let mut direction = [0.0; 3];
        direction[self.index] = if self.turned { -1.0 } else { 1.0 };
        direction
    }
}
