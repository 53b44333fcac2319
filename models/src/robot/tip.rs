//! How the tip of a robot under loads gives way to a force: one Newton step of the loads for each direction.

use super::coupled::{newton_step, node_forces};
use super::workspace::Workspace;
use crate::assembly::Assembly;
use crate::shape::{advance, slid};
use crate::space::{Matrix, inverse, of_each, outer, times};

/// Step of a displacement of the tip for the slope of a spring \[m\].
const STEP_M: f64 = 1e-6;

/// Compliance of the tip at the equilibrium in `work` \[m/N\]; see `tip_stiffness.rs`.
pub(crate) fn tip_compliance(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Matrix {
    let mut found = [[0.0; 3]; 3];
    for i in 0..work.states.len() {
        work.states[i].compliance = assembly.site(i).compliance(&work.states[i], work.history.of_segment(i));
    }
    // Symmetric under dead loads (Betti), so a row is a column.
    for (axis, row) in found.iter_mut().enumerate().take(2) {
        for i in 0..work.states.len() {
            work.coupled.residual[i] = lever(assembly, work, i)[axis];
        }
        newton_step(assembly, work);
        for (i, segment) in assembly.segments.iter().enumerate() {
            let turn = segment.length_m * work.states[i].compliance * work.coupled.step[i];
            let way = lever(assembly, work, i);
            (row[0], row[1]) = (row[0] + turn * way[0], row[1] + turn * way[1]);
        }
    }
    for (i, segment) in assembly.segments.iter().enumerate().filter(|_| work.is_sheared()) {
        let [x, y] = chord(work, i);
        let per = 1.0 / (assembly.site(i).shear_stiffness_n(p_body_pa) * segment.length_m);
        let slide = outer([-y, x, 0.0], [-y, x, 0.0]);
        found = of_each(|j, k| found[j][k] + per * slide[j][k]);
    }
    if !assembly.springs {
        return found;
    }
    // With springs at the tip of stiffness k: (1 + C k)⁻¹ C.
    let held = times(&found, &springs(assembly, p_body_pa, work));
    times(&inverse(&of_each(|j, k| held[j][k] + if j == k { 1.0 } else { 0.0 })), &found)
}

/// From the start of a segment to its end.
fn chord(work: &Workspace, i: usize) -> [f64; 2] {
    [work.nodes[2 * i + 2] - work.nodes[2 * i], work.nodes[2 * i + 3] - work.nodes[2 * i + 1]]
}

/// Displacement of the tip per change of the curvature of a segment and per length: its own arc's change, and the turn beyond.
fn lever(assembly: &Assembly, work: &Workspace, i: usize) -> [f64; 2] {
    let direction = slid(work.directions[i], work.shear(i));
    let own = advance([0.0; 2], direction, work.coupled.arcs[i].slope).map(|x| x / assembly.segments[i].length_m);
    let (end, tip) = (2 * (i + 1), work.nodes.len() - 2);
    let way = [work.nodes[tip] - work.nodes[end], work.nodes[tip + 1] - work.nodes[end + 1]];
    [own[0] - way[1], own[1] + way[0]]
}

/// Force that holds the tip back per displacement of it; symmetric \[N/m\].
fn springs(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Matrix {
    let tip = work.nodes.len() - 2;
    let mut found = [[0.0; 3]; 3];
    for (axis, row) in found.iter_mut().enumerate().take(2) {
        let at = work.nodes[tip + axis];
        let [high, low] = [STEP_M, -STEP_M].map(|step| {
            work.nodes[tip + axis] = at + step;
            node_forces(assembly, p_body_pa, work);
            [work.coupled.forces[tip], work.coupled.forces[tip + 1]]
        });
        work.nodes[tip + axis] = at;
        (row[0], row[1]) = ((low[0] - high[0]) / (2.0 * STEP_M), (low[1] - high[1]) / (2.0 * STEP_M));
    }
    found
}
