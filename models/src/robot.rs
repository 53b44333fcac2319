//! Equilibrium of the whole robot: every place alone, or coupled through transverse loads and the shape.

use crate::assembly::Assembly;
use crate::error::Unsolved;
use crate::root::NoRoot;
use crate::shape::{Arc, advance, arc};
use crate::site::{SiteLoads, SiteState};
use crate::term::Pose;
use crate::trig::sin_cos;

/// Buffers of a prediction; made once, so that predicting allocates nothing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Workspace {
    /// Equilibrium per segment.
    pub states: Vec<SiteState>,
    /// Actuator pressure per segment after the supply stage \[Pa\].
    pub p_act_pa: Vec<f64>,
    /// Node positions x₀, y₀, x₁, … \[m\].
    pub nodes: Vec<f64>,
    /// Direction (cos ψ, sin ψ) at each node.
    pub directions: Vec<[f64; 2]>,
    /// Heading at each node \[rad\].
    pub headings: Vec<f64>,
    arcs: Vec<Arc>,
    forces: Vec<f64>,
    moments: Vec<f64>,
    trial: Vec<f64>,
    residual: Vec<f64>,
    coupling: Vec<f64>,
    matrix: Vec<f64>,
}

impl Workspace {
    pub fn new(segments: usize, coupled: bool) -> Workspace {
        let flat = Arc { along: 0.0, across: 0.0, d_along: 0.0, d_across: 0.0 };
        Workspace {
            states: vec![SiteState::REST; segments],
            p_act_pa: vec![0.0; segments],
            nodes: vec![0.0; 2 * (segments + 1)],
            directions: vec![[1.0, 0.0]; segments + 1],
            headings: vec![0.0; segments + 1],
            arcs: vec![flat; segments],
            forces: vec![0.0; 2 * (segments + 1)],
            moments: vec![0.0; segments],
            trial: vec![0.0; segments],
            residual: vec![0.0; segments],
            coupling: vec![0.0; segments],
            matrix: vec![0.0; if coupled { segments * segments } else { 0 }],
        }
    }
}

/// Newton settles in 3–5 steps; 60 allows for the halvings near collapse.
const MAX_ITERATIONS: usize = 60;
/// Agreement of moments wanted, relative to the largest one.
const MOMENT_TOLERANCE: f64 = 1e-10;

/// Fills `work` with the equilibrium at body pressure `p_body_pa` and the actuator pressures already in it.
pub(crate) fn equilibrium(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Result<(), Unsolved> {
    if assembly.node_terms.is_empty() {
        for i in 0..work.states.len() {
            work.states[i] = solve_segment(assembly, i, p_body_pa, 0.0, work, false)?;
        }
        place_nodes(assembly, work);
        return Ok(());
    }
    coupled(assembly, p_body_pa, work)
}

/// Newton on the moments m of the transverse loads: `G(κ(m)) − m = 0`, each κ(m) by the bracketed solve of its place.
fn coupled(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Result<(), Unsolved> {
    work.moments.fill(0.0);
    let mut worst = update(assembly, p_body_pa, work, false)?;
    for _ in 0..MAX_ITERATIONS {
        let scale = work.moments.iter().fold(1e-6_f64, |s, m| s.max(m.abs()));
        if worst <= MOMENT_TOLERANCE * scale {
            return Ok(());
        }
        newton_step(assembly, work);
        worst = damped_step(assembly, p_body_pa, work, worst)?;
    }
    let p_act_kpa = work.p_act_pa.iter().fold(0.0_f64, |p, q| p.max(*q)) / 1e3;
    Err(Unsolved::NotConverged { iterations: MAX_ITERATIONS, p_act_kpa, residual: worst })
}

/// Takes the Newton step in `work.trial`, halved until the imbalance falls.
fn damped_step(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace, before: f64) -> Result<f64, Unsolved> {
    let mut share = 1.0;
    let mut taken = 0.0;
    let mut last = Err(Unsolved::NotConverged { iterations: 0, p_act_kpa: 0.0, residual: before });
    for _ in 0..12 {
        for (m, step) in work.moments.iter_mut().zip(&work.trial) {
            *m += (share - taken) * step;
        }
        taken = share;
        let step = std::mem::take(&mut work.trial);
        last = update(assembly, p_body_pa, work, true);
        work.trial = step;
        if last.as_ref().is_ok_and(|worst| *worst < before) {
            return last;
        }
        share *= 0.5;
    }
    last
}

/// Solves every place for its moment, then shape and loads; returns the largest disagreement of moments.
fn update(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace, warm: bool) -> Result<f64, Unsolved> {
    for i in 0..work.states.len() {
        let moment = work.moments[i];
        work.states[i] = solve_segment(assembly, i, p_body_pa, moment, work, warm)?;
    }
    place_nodes(assembly, work);
    work.forces.fill(0.0);
    let pose = Pose { q: &work.nodes, p_body_pa, p_act_pa: 0.0 };
    for term in &assembly.node_terms {
        term.add(&pose, &mut work.forces);
    }
    load_moments(assembly, work);
    Ok(work.residual.iter().fold(0.0_f64, |w, r| w.max(r.abs())))
}

fn solve_segment(
    assembly: &Assembly,
    index: usize,
    p_body_pa: f64,
    moment: f64,
    work: &Workspace,
    warm: bool,
) -> Result<SiteState, Unsolved> {
    let segment = &assembly.segments[index];
    let loads = SiteLoads { p_body_pa, p_act_pa: work.p_act_pa[index], moment };
    // Neighbours of equal design start close to each other, and every iteration close to the one before.
    let twin = index > 0 && assembly.segments[index - 1].site == segment.site && work.p_act_pa[index] > 0.0;
    let near = if warm { Some(&work.states[index]) } else { twin.then(|| &work.states[index - 1]) };
    assembly.sites[segment.site].solve(&loads, near).map_err(|error| unsolved(error, segment.start_m, &loads))
}

fn unsolved(error: NoRoot, start_m: f64, loads: &SiteLoads) -> Unsolved {
    let (low, high) = match error {
        NoRoot::SameSign { at_low, at_high } => (at_low, at_high),
        NoRoot::Stalled { f } => (f, f),
    };
    let (p_act_kpa, p_body_kpa) = (loads.p_act_pa / 1e3, loads.p_body_pa / 1e3);
    Unsolved::NoEquilibrium { s_mm: start_m * 1e3, p_act_kpa, p_body_kpa, low, high }
}

/// Integrates the heading along the arc.
fn place_nodes(assembly: &Assembly, work: &mut Workspace) {
    let (mut heading, mut xy) = (0.0, [0.0; 2]);
    let mut direction = [1.0, 0.0];
    for (i, segment) in assembly.segments.iter().enumerate() {
        let kappa = work.states[i].curvature;
        let step = arc(kappa, segment.length_m, assembly.sites[segment.site].radius_m);
        xy = advance(xy, direction, step.along, step.across);
        heading += kappa * segment.length_m;
        let (sin, cos) = sin_cos(heading);
        direction = [cos, sin];
        work.arcs[i] = step;
        work.nodes[2 * i + 2] = xy[0];
        work.nodes[2 * i + 3] = xy[1];
        work.headings[i + 1] = heading;
        work.directions[i + 1] = direction;
    }
}

/// Generalised force of the nodal forces on each κ, per length, minus the moment assumed: `work.residual`.
///
/// With S the force on all nodes beyond segment i, and x its end: a change of κᵢ moves them all by its own arc's
/// change Δ′ and turns them about x, so `Gᵢ = S·Δ′/h + Σ (x_k − x) × F_k`. `work.coupling` is ∂Gᵢ/∂κⱼ for i ≤ j.
fn load_moments(assembly: &Assembly, work: &mut Workspace) {
    let (mut sum, mut turn, mut reach) = ([0.0; 2], 0.0, 0.0);
    for i in (0..work.states.len()).rev() {
        let node = 2 * (i + 1);
        if node + 2 < work.nodes.len() {
            let lever = [work.nodes[node + 2] - work.nodes[node], work.nodes[node + 3] - work.nodes[node + 1]];
            turn += lever[0] * sum[1] - lever[1] * sum[0];
            reach += lever[0] * sum[0] + lever[1] * sum[1];
        }
        sum = [sum[0] + work.forces[node], sum[1] + work.forces[node + 1]];
        let h = assembly.segments[i].length_m;
        let [c, s] = work.directions[i];
        let own = &work.arcs[i];
        let change = [c * own.d_along - s * own.d_across, s * own.d_along + c * own.d_across];
        let moment = (sum[0] * change[0] + sum[1] * change[1]) / h + turn;
        work.residual[i] = moment - work.moments[i];
        work.coupling[i] = sum[1] * change[0] - sum[0] * change[1] - h * reach;
    }
}

/// Newton step of the moments into `work.trial`: `(1 − ∂G/∂κ·dκ/dm) δ = residual`, by elimination with pivoting.
fn newton_step(assembly: &Assembly, work: &mut Workspace) {
    let n = work.states.len();
    for i in 0..n {
        for j in 0..n {
            let ratio = assembly.segments[j].length_m / assembly.segments[i].length_m;
            let slope = if j >= i { work.coupling[j] } else { work.coupling[i] * ratio };
            let unit = f64::from(u8::from(i == j));
            work.matrix[i * n + j] = unit - slope * work.states[j].compliance;
        }
        work.trial[i] = work.residual[i];
    }
    eliminate(&mut work.matrix, &mut work.trial);
}

/// Solves `matrix · x = rhs` in place; a singular matrix leaves a large step, which the damping then cuts.
fn eliminate(matrix: &mut [f64], rhs: &mut [f64]) {
    let n = rhs.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|a, b| matrix[a * n + k].abs().total_cmp(&matrix[b * n + k].abs())).unwrap_or(k);
        if pivot != k {
            (0..n).for_each(|j| matrix.swap(k * n + j, pivot * n + j));
            rhs.swap(k, pivot);
        }
        let diagonal = if matrix[k * n + k] == 0.0 { f64::MIN_POSITIVE } else { matrix[k * n + k] };
        for i in k + 1..n {
            let factor = matrix[i * n + k] / diagonal;
            (k..n).for_each(|j| matrix[i * n + j] -= factor * matrix[k * n + j]);
            rhs[i] -= factor * rhs[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k * n + j] * rhs[j]).sum();
        rhs[k] = (rhs[k] - known) / matrix[k * n + k];
    }
}
