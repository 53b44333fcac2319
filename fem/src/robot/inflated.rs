//! Shape of inflated pouches, read off the deformed mesh: arm, width and height.
//!
//! | quantity | between | mean over |
//! |---|---|---|
//! | arm | the middle of a weld across the robot and the taut generator on the far side | welds between two pouches |
//! | width | the two ends of the sheet where it meets the wall, in the middle of a pouch | pouches between others |
//! | height | sheet and wall in the middle of a pouch | pouches between others |
//!
//! The first and the last pouch are next to the round base and the cap, which hold them; with three pouches or fewer all count.
//! **Validity**: actuators of several units. Definitions derived here; the reduced model's are `models::PouchShape`.

use models::Scenario;
use serde::{Deserialize, Serialize};

use super::body_parts;
use crate::Mesh;
use crate::vec3::{V3, along, dot, norm, share, sub};

/// Mean shape of a robot's pouches \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct InflatedPouch {
    /// From a weld to the far side.
    pub arm_m: f64,
    /// Between the sides of a pouch in its middle.
    pub width_m: f64,
    /// Of a pouch in its middle.
    pub height_m: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tape {
    welds: Vec<u32>,
    far: Vec<u32>,
    sides: Vec<[u32; 2]>,
    sheets: Vec<[u32; 2]>,
}

impl Tape {
    /// `None` for an actuator of one unit.
    pub(super) fn of(scenario: &Scenario, mesh: &Mesh) -> Option<Tape> {
        let (actuator, radius_m) = (&scenario.actuator, scenario.radius_m);
        let far = mesh.sets.get("far_generator").filter(|_| actuator.count > 1)?.clone();
        let own = body_parts(mesh);
        let [wall, sheet] = [true, false].map(|of_body| {
            let parts = mesh.parts.iter().filter(|p| p.name != "tip_cap" && own.contains(&p.name) == of_body);
            let mut nodes: Vec<u32> = parts.flat_map(|p| p.faces().flatten().copied()).collect();
            nodes.sort_unstable();
            nodes.dedup();
            nodes
        });
        let (joined, free): (Vec<u32>, Vec<u32>) = sheet.iter().partition(|node| wall.binary_search(node).is_ok());
        let at = |k: f64| actuator.start_m + k * actuator.shape.length_m;
        let units = if actuator.count > 3 { 1..actuator.count - 1 } else { 0..actuator.count };
        let (mut sides, mut sheets) = (Vec::new(), Vec::new());
        for unit in units {
            let middle = [at(unit as f64 + 0.5), radius_m, 0.0];
            let edge = |side: f64| nearest(mesh, &joined, [middle[0], 0.0, side * radius_m]);
            sides.push([edge(-1.0)?, edge(1.0)?]);
            sheets.push([nearest(mesh, &wall, middle)?, nearest(mesh, &free, middle)?]);
        }
        let weld = |k: usize| nearest(mesh, &wall, [at(k as f64), radius_m, 0.0]);
        let welds = (1..actuator.count).map(weld).collect::<Option<_>>()?;
        Some(Tape { welds, far, sides, sheets })
    }

    pub(super) fn read(&self, positions: &[V3]) -> InflatedPouch {
        let place = |node: &u32| positions[*node as usize];
        let apart = |pair: &[u32; 2]| distance(place(&pair[0]), place(&pair[1]));
        let line: Vec<[f64; 3]> = self.far.iter().map(place).collect();
        let arm =
            |node: &u32| line.windows(2).map(|piece| from_piece(place(node), piece)).fold(f64::INFINITY, f64::min);
        InflatedPouch {
            arm_m: mean(self.welds.iter().map(arm)),
            width_m: mean(self.sides.iter().map(apart)),
            height_m: mean(self.sheets.iter().map(apart)),
        }
    }
}

fn nearest(mesh: &Mesh, nodes: &[u32], place: V3) -> Option<u32> {
    let far = |node: &u32| distance(mesh.points[*node as usize], place);
    nodes.iter().copied().min_by(|a, b| far(a).total_cmp(&far(b)))
}

fn distance(a: V3, b: V3) -> f64 {
    norm(sub(a, b))
}

/// Distance of a point from a straight piece.
fn from_piece(p: V3, piece: &[V3]) -> f64 {
    let [a, b] = [piece[0], piece[1]];
    let way = sub(b, a);
    let square = dot(way, way);
    distance(p, along(a, share(dot(sub(p, a), way), square).clamp(0.0, 1.0), way))
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{RobotSettings, shipped};

    #[test]
    fn flat_pouches_on_a_round_body_have_its_diameter_its_chord_and_no_height() {
        let (scenario, problem) = shipped("epam", &RobotSettings::default()).unwrap();
        let found = Tape::of(&scenario, &problem.mesh).unwrap().read(&problem.mesh.points);
        let width_m = 0.057;
        let chord_m = 2.0 * 0.04 * f64::sin(0.5 * width_m / 0.04);
        assert!((found.arm_m - 0.08).abs() < 5e-5, "{found:?}");
        assert!((found.width_m - chord_m).abs() < 1e-5 && found.height_m < 2e-5, "{found:?}");
    }

    #[test]
    fn a_known_deformation_is_measured_and_one_muscle_has_no_pouches() {
        let (scenario, problem) = shipped("cpam", &RobotSettings::default()).unwrap();
        let tape = Tape::of(&scenario, &problem.mesh).unwrap();
        let flat = tape.read(&problem.mesh.points);
        let stretched: Vec<[f64; 3]> = problem.mesh.points.iter().map(|p| [p[0], 2.0 * p[1], 3.0 * p[2]]).collect();
        let found = tape.read(&stretched);
        assert!((found.arm_m / flat.arm_m - 2.0).abs() < 1e-3 && (found.width_m / flat.width_m - 3.0).abs() < 1e-9);
        let (muscle, problem) = shipped("fpam", &RobotSettings::default()).unwrap();
        assert_eq!(Tape::of(&muscle, &problem.mesh), None);
    }
}
