//! Places coupled through transverse loads and the shape.

use super::workspace::Workspace;
use crate::assembly::Assembly;
use crate::error::{FailurePlace, Solved, Unsolved};
use crate::history::History;
use crate::root::NoRoot;
use crate::shape::{Arc, advance, arc, slid, turned};
use crate::site::{Site, SiteLoads, SiteState};
use crate::term::Pose;

/// Newton settles in 3–5 steps; 60 allows for the halvings near collapse.
const MAX_ITERATIONS: usize = 60;
/// Halvings of a Newton step before it is given up.
const HALVINGS: usize = 12;
/// Agreement of moments at the end, relative to the largest one.
const MOMENT_TOLERANCE: f64 = 1e-10;

/// Rounds in which the slide of the wall and a spring at the nodes agree: each leaves the share k L/(G t π R) of the gap, some 1e-3.
const SPRING_ROUNDS: usize = 4;
/// Newton steps of a slide, which is some hundredths.
const SLIDE_STEPS: usize = 4;

/// Newton on the moments m of the transverse loads: `G(κ(m)) − m = 0`, each κ(m) by the bracketed solve of its place.
pub(super) fn coupled(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace, warm: bool) -> Solved {
    let mut worst = if warm {
        update(assembly, p_body_pa, work)?
    } else {
        unloaded(assembly, p_body_pa, work)?;
        disagreement(assembly, p_body_pa, work)
    };
    for iterations in 0..MAX_ITERATIONS {
        let scale = work.coupled.moments.iter().fold(1e-6_f64, |s, m| s.max(m.abs()));
        if worst <= MOMENT_TOLERANCE * scale {
            return Ok(());
        }
        if !newton_step(assembly, work) {
            return Err(not_converged(work, iterations + 1, worst));
        }
        worst = damped_step(assembly, p_body_pa, work, worst, iterations)?;
    }
    Err(not_converged(work, MAX_ITERATIONS, worst))
}

fn not_converged(work: &Workspace, iterations: usize, residual: f64) -> Unsolved {
    let p_act_kpa = work.p_act_pa.iter().fold(0.0_f64, |p, q| p.max(*q)) / 1e3;
    Unsolved::NotConverged { iterations, p_act_kpa, residual }
}

/// Takes the Newton step, halved until the disagreement falls; returns the rest.
fn damped_step(
    assembly: &Assembly,
    p_body_pa: f64,
    work: &mut Workspace,
    before: f64,
    iterations: usize,
) -> Solved<f64> {
    let mut share = 1.0;
    let mut taken = 0.0;
    let mut failed = None;
    for _ in 0..HALVINGS {
        for (m, step) in work.coupled.moments.iter_mut().zip(&work.coupled.step) {
            *m += (share - taken) * step;
        }
        taken = share;
        match update(assembly, p_body_pa, work) {
            Ok(worst) if worst < before => return Ok(worst),
            Ok(_) => failed = None,
            Err(error) => failed = Some(error),
        }
        share *= 0.5;
    }
    Err(failed.unwrap_or_else(|| not_converged(work, iterations + 1, before)))
}

/// Solves every place without moment; neighbours of equal design and pressure are solved once.
fn unloaded(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Solved {
    work.coupled.moments.fill(0.0);
    for i in 0..work.states.len() {
        let alike = i > 0 && assembly.segments[i - 1].site == assembly.segments[i].site;
        let twin = alike && !assembly.varies && work.history.of_segment(i).is_empty();
        work.states[i] =
            if twin { work.states[i - 1] } else { solve_segment(assembly, work, i, p_body_pa, 0.0, None)? };
    }
    Ok(())
}

/// Solves every place for its moment from where it is; returns the largest disagreement of moments.
fn update(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> Solved<f64> {
    for i in 0..work.states.len() {
        let moment = work.coupled.moments[i];
        work.states[i] = solve_segment(assembly, work, i, p_body_pa, moment, Some(&work.states[i]))?;
    }
    Ok(disagreement(assembly, p_body_pa, work))
}

/// Shape and loads at the curvatures in `work`, and the largest disagreement of moments (NaN if any is).
pub(super) fn disagreement(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) -> f64 {
    let (sheared, springs) = (work.is_sheared(), assembly.springs);
    if springs {
        work.coupled.shear.fill(0.0);
    }
    place_nodes(assembly, work);
    node_forces(assembly, p_body_pa, work);
    for _ in 0..usize::from(sheared) * if springs { SPRING_ROUNDS } else { 1 } {
        shear(assembly, p_body_pa, work);
        place_nodes(assembly, work);
        if springs {
            node_forces(assembly, p_body_pa, work);
        }
    }
    load_moments(assembly, work);
    work.coupled.residual.iter().fold(0.0, |w, r| if r.abs() > w || r.is_nan() { r.abs() } else { w })
}

pub(super) fn node_forces(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) {
    work.coupled.forces.fill(0.0);
    let pose = Pose::new(&work.nodes, p_body_pa, 0.0);
    for term in &assembly.node_terms {
        term.add(&pose, &mut work.coupled.forces);
    }
}

pub(super) fn solve_segment(
    assembly: &Assembly,
    work: &Workspace,
    index: usize,
    p_body_pa: f64,
    moment: f64,
    near: Option<&SiteState>,
) -> Solved<SiteState> {
    let (site, loads) = place_of(assembly, work, index, p_body_pa, moment);
    let solved = site.solve(&loads, work.history.of_segment(index), near);
    solved.map_err(|error| unsolved(error, site, assembly.segments[index].start_m, &loads))
}

pub(super) fn place_of<'a>(
    assembly: &'a Assembly,
    work: &Workspace,
    index: usize,
    p_body_pa: f64,
    moment: f64,
) -> (&'a Site, SiteLoads) {
    let segment = &assembly.segments[index];
    let History { dt_s, stamp, .. } = work.history;
    let loads = SiteLoads { p_body_pa, p_act_pa: work.p_act_pa[index], moment, s_m: segment.middle_m(), dt_s, stamp };
    (&assembly.sites[segment.site], loads)
}

/// Share of the imbalance above which a formula of the scenario is named: the catalogue's own laws are tested to leave an equilibrium.
const TO_BLAME: f64 = 0.1;

fn unsolved(error: NoRoot, site: &Site, start_m: f64, loads: &SiteLoads) -> Unsolved {
    let (low, high) = match error {
        NoRoot::SameSign { at_low, at_high } => (at_low, at_high),
        NoRoot::Stalled { f } => (f, f),
    };
    let [s_mm, p_act_kpa, p_body_kpa] = [start_m * 1e3, loads.p_act_pa / 1e3, loads.p_body_pa / 1e3];
    let place = FailurePlace { s_mm, p_act_kpa, p_body_kpa };
    let imbalance = low.abs().max(high.abs());
    let extreme = site.extreme(loads).filter(|extreme| extreme.moment > TO_BLAME * imbalance || !imbalance.is_finite());
    let law = if imbalance.is_finite() { None } else { site.without_value(loads) };
    match (extreme, law) {
        (Some(extreme), _) => Unsolved::Formula { extreme, place },
        (None, Some(law)) => Unsolved::NoValue { law, place },
        (None, None) => Unsolved::NoEquilibrium { place, low, high },
    }
}

pub(super) fn place_nodes(assembly: &Assembly, work: &mut Workspace) {
    let (mut heading, mut xy) = (0.0, [0.0; 2]);
    let mut direction = [1.0, 0.0];
    for (i, segment) in assembly.segments.iter().enumerate() {
        let kappa = work.states[i].curvature;
        let centre = assembly.site(i).centre_line;
        // Without transverse loads the derivatives are not needed, and the compiler drops them.
        let Arc { chord, turn, .. } = match work.coupled.arcs.get_mut(i) {
            Some(kept) => {
                *kept = arc(kappa, segment.length_m, centre);
                *kept
            }
            None => arc(kappa, segment.length_m, centre),
        };
        xy = advance(xy, slid(direction, work.shear(i)), chord);
        heading += kappa * segment.length_m;
        direction = turned(direction, turn);
        work.nodes[2 * i + 2] = xy[0];
        work.nodes[2 * i + 3] = xy[1];
        work.headings[i + 1] = heading;
        work.directions[i + 1] = direction;
    }
}

/// Shear angles γ: the slide of a segment turns its chord d by γ and keeps its length, as inextensible fabric does. With S the
/// force on all nodes beyond, `K γ h = S·∂(R(γ) d)/∂γ`, K the shear stiffness. Sheared nodes change no dead load.
fn shear(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) {
    let mut beyond = [0.0; 2];
    for (i, segment) in assembly.segments.iter().enumerate().rev() {
        let (node, own) = (2 * (i + 1), &work.coupled.arcs[i]);
        beyond = [beyond[0] + work.coupled.forces[node], beyond[1] + work.coupled.forces[node + 1]];
        let chord = advance([0.0; 2], work.directions[i], own.chord).map(|d| d / segment.length_m);
        let across = chord[0] * beyond[1] - chord[1] * beyond[0];
        let along = chord[0] * beyond[0] + chord[1] * beyond[1];
        let stiffness = assembly.site(i).shear_stiffness_n(p_body_pa);
        let step = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            angle - (stiffness * angle - across * cos + along * sin) / (stiffness + across * sin + along * cos)
        };
        work.coupled.shear[i] =
            if stiffness.is_finite() { (0..SLIDE_STEPS).fold(0.0, |angle, _| step(angle)) } else { 0.0 };
    }
}

/// Generalised force G of the nodal forces on each κ, per length, minus the moment assumed, and its slopes.
///
/// With S the force on all nodes beyond segment i, and x its end: a change of κᵢ moves them all by its own arc's
/// change Δ′ and turns them about x, so `Gᵢ = S·Δ′/h + Σ (x_k − x) × F_k`.
fn load_moments(assembly: &Assembly, work: &mut Workspace) {
    let (mut sum, mut turn, mut reach) = ([0.0; 2], 0.0, 0.0);
    let load = &mut work.coupled;
    for i in (0..work.states.len()).rev() {
        let node = 2 * (i + 1);
        if node + 2 < work.nodes.len() {
            let lever = [work.nodes[node + 2] - work.nodes[node], work.nodes[node + 3] - work.nodes[node + 1]];
            turn += lever[0] * sum[1] - lever[1] * sum[0];
            reach += lever[0] * sum[0] + lever[1] * sum[1];
        }
        sum = [sum[0] + load.forces[node], sum[1] + load.forces[node + 1]];
        let per_h = 1.0 / assembly.segments[i].length_m;
        let own = &load.arcs[i];
        let direction = slid(work.directions[i], load.shear.get(i).copied().unwrap_or(0.0));
        let change = advance([0.0; 2], direction, own.slope);
        let second = advance([0.0; 2], direction, own.bend);
        load.residual[i] = (sum[0] * change[0] + sum[1] * change[1]) * per_h + turn - load.moments[i];
        load.coupling[i] = (sum[1] * change[0] - sum[0] * change[1]) * per_h - reach;
        load.diagonal[i] = (sum[0] * second[0] + sum[1] * second[1]) * per_h - reach * assembly.segments[i].length_m;
    }
}

/// Newton step δ of the moments: `δᵢ − Σⱼ ∂Gᵢ/∂κⱼ Cⱼ δⱼ = residualᵢ`, C the compliance of a place.
///
/// With g the coupling and z = h C δ the turn of a segment, `∂Gᵢ/∂κⱼ = hⱼ g_max(i,j)` off the diagonal. So row i needs of
/// the others only the turn Z before it and Σ g z beyond it: δ is affine in Z, found from tip to base, then filled in.
/// `step` and `residual` hold the two coefficients meanwhile. False if the step is not finite: the loads are critical.
pub(super) fn newton_step(assembly: &Assembly, work: &mut Workspace) -> bool {
    let load = &mut work.coupled;
    let (mut beyond, mut beyond_slope) = (0.0, 0.0);
    for i in (0..work.states.len()).rev() {
        let (c, h, g) = (work.states[i].compliance, assembly.segments[i].length_m, load.coupling[i]);
        // Σ_{j>i} g z = beyond + beyond_slope · (Z + h C δ), and the row is (1 − diagonal C) δ − g Z − that = residual.
        let pivot = 1.0 - load.diagonal[i] * c - beyond_slope * h * c;
        let constant = (load.residual[i] + beyond) / pivot;
        let slope = (g + beyond_slope) / pivot;
        beyond += (g + beyond_slope) * h * c * constant;
        beyond_slope += (g + beyond_slope) * h * c * slope;
        load.step[i] = constant;
        load.residual[i] = slope;
    }
    let mut turn = 0.0_f64;
    for (i, segment) in assembly.segments.iter().enumerate() {
        let step = load.step[i] + load.residual[i] * turn;
        turn += segment.length_m * work.states[i].compliance * step;
        load.step[i] = step;
    }
    turn.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::Segment;
    use crate::body::WallBending;

    /// Segments of unequal length; only their lengths matter here.
    fn assembly(lengths: &[f64]) -> Assembly {
        let segments = lengths.iter().map(|h| Segment { site: 0, start_m: 0.0, length_m: *h }).collect();
        Assembly { segments, ..Assembly::empty([0.0, -1.0, 0.0]) }
    }

    #[test]
    fn the_newton_step_solves_the_dense_system() {
        let lengths = [0.03, 0.05, 0.02, 0.04, 0.03];
        let n = lengths.len();
        let number = |i: usize, k: usize| ((i * 37 + k * 11) % 17) as f64 / 17.0 - 0.4;
        let mut assembly = assembly(&lengths);
        assembly.node_terms.push(Box::new(WallBending { stiffness: 0.0 }));
        let mut work = Workspace::new(&assembly);
        for i in 0..n {
            work.states[i].compliance = 0.5 + number(i, 1);
            work.coupled.coupling[i] = number(i, 2);
            work.coupled.diagonal[i] = number(i, 3);
            work.coupled.residual[i] = number(i, 4);
        }
        let before = work.clone();
        assert!(newton_step(&assembly, &mut work));
        for i in 0..n {
            // Σⱼ ∂Gᵢ/∂κⱼ Cⱼ δⱼ, with ∂Gᵢ/∂κⱼ = hⱼ g_max(i,j) off the diagonal.
            let slope = |j: usize| {
                if i == j { before.coupled.diagonal[i] } else { lengths[j] * before.coupled.coupling[i.max(j)] }
            };
            let moved: f64 = (0..n).map(|j| slope(j) * before.states[j].compliance * work.coupled.step[j]).sum();
            let left = work.coupled.step[i] - moved - before.coupled.residual[i];
            assert!(left.abs() < 1e-14, "row {i}: {left:e}");
        }
    }
}
