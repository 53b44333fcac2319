//! How the tip of a robot under loads gives way to a force: one Newton step of the loads for each direction.

use super::coupled::newton_step;
use super::workspace::Workspace;
use crate::assembly::Assembly;
use crate::shape::{advance, slid};
use crate::space::Matrix;
use crate::term::Pose;

/// Step of a displacement of the tip for the slope of a spring \[m\].
const STEP_M: f64 = 1e-6;

/// Compliance of the tip at the equilibrium in `work` \[m/N\]; see `tip_stiffness.rs`.
pub(crate) fn tip_compliance(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Matrix {
    let mut found = [[0.0; 3]; 3];
    for axis in 0..2 {
        for i in 0..work.states.len() {
            work.coupled.residual[i] = lever(assembly, work, i)[axis];
        }
        newton_step(assembly, work);
        for (i, segment) in assembly.segments.iter().enumerate() {
            let (turn, way) =
                (segment.length_m * work.states[i].compliance * work.coupled.step[i], lever(assembly, work, i));
            (found[0][axis], found[1][axis]) = (found[0][axis] + turn * way[0], found[1][axis] + turn * way[1]);
        }
    }
    for (i, segment) in assembly.segments.iter().enumerate().filter(|_| work.is_sheared()) {
        let [x, y] = chord(work, i);
        let per = 1.0 / (assembly.site(i).shear_stiffness_n(p_body_pa) * segment.length_m);
        let slide = [-y, x];
        for (j, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            found[j][k] += per * slide[j] * slide[k];
        }
    }
    if assembly.springs { sprung(assembly, p_body_pa, work, found) } else { found }
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

/// The compliance C under dead loads with springs at the tip of stiffness k: (1 + C k)⁻¹ C.
fn sprung(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace, dead: Matrix) -> Matrix {
    let tip = work.nodes.len() - 2;
    let mut stiffness = [[0.0; 2]; 2];
    for axis in 0..2 {
        let at = work.nodes[tip + axis];
        let [high, low] = [STEP_M, -STEP_M].map(|step| {
            work.nodes[tip + axis] = at + step;
            work.coupled.forces.fill(0.0);
            let pose = Pose::new(&work.nodes, p_body_pa, 0.0);
            assembly.node_terms.iter().for_each(|term| term.add_force(&pose, &mut work.coupled.forces));
            [work.coupled.forces[tip], work.coupled.forces[tip + 1]]
        });
        work.nodes[tip + axis] = at;
        (stiffness[0][axis], stiffness[1][axis]) =
            ((low[0] - high[0]) / (2.0 * STEP_M), (low[1] - high[1]) / (2.0 * STEP_M));
    }
    let c = |j: usize, k: usize| dead[j][k];
    let held =
        |j: usize, k: usize| (if j == k { 1.0 } else { 0.0 }) + c(j, 0) * stiffness[0][k] + c(j, 1) * stiffness[1][k];
    let det = held(0, 0) * held(1, 1) - held(0, 1) * held(1, 0);
    let [a, b, d, e] = [held(1, 1), -held(0, 1), -held(1, 0), held(0, 0)].map(|x| x / det);
    let row = |p: f64, q: f64| [p * c(0, 0) + q * c(1, 0), p * c(0, 1) + q * c(1, 1), 0.0];
    [row(a, b), row(d, e), [0.0; 3]]
}
