//! How the tip of a robot under loads gives way to a force: one Newton step of the loads for each direction.

use super::lever::{Lever, Matrix, OuterForces, apply, dot, outer};
use super::loaded::newton_step;
use super::state::{SpaceWork, stretch};
use crate::assembly::Assembly;

/// Compliance of the tip at the equilibrium in `work` \[m/N\]; see `tip_stiffness.rs`.
pub(crate) fn tip_compliance(assembly: &Assembly, work: &mut SpaceWork) -> Matrix {
    let tip = work.frames[assembly.segments.len()].at;
    // Displacement of the tip along an axis per change of the bend and contraction of a section.
    let levers = |work: &SpaceWork, i: usize, axis: usize| {
        let (end, mut force) = (work.frames[i + 1].at, [0.0; 3]);
        force[axis] = 1.0;
        let tensor = outer(force, std::array::from_fn(|k| tip[k] - end[k]));
        Lever::new(&stretch(assembly, work, i), assembly.segments[i].length_m).work(&OuterForces { force, tensor })
    };
    let mut found = [[0.0; 3]; 3];
    for column in 0..3 {
        for (i, segment) in assembly.segments.iter().enumerate() {
            work.loaded.sections[i].residual = levers(work, i, column).map(|work| work / segment.length_m);
        }
        newton_step(assembly, &mut work.loaded.sections);
        for (i, section) in work.loaded.sections.iter().enumerate() {
            let moved = apply(&section.compliance, section.step);
            found.iter_mut().enumerate().for_each(|(row, of)| of[column] += dot(levers(work, i, row), moved));
        }
    }
    found
}
