//! Sections coupled through loads on the nodes and the shape.
//!
//! With x_k the nodes, F_k the forces on them and q = (κ_y, κ_z, ε) of section i, the generalised force per length is exact:
//!
//! ```text
//! Gᵢ = (1/hᵢ) ∂(Σ F_k·x_k)/∂qᵢ = (S·∂Δᵢ/∂q + ∂φᵢ/∂q·Σ (x_k − x) × F_k)/hᵢ        sums over the nodes beyond
//! ```
//!
//! Equilibrium is G(q(g)) = g: every section at its own minimum under the loads g, as in the plane (`robot/coupled.rs`).

use super::lever::{Coupling, Lever, OuterForces, apply, dot, inverse, of_each, times, transposed};
use super::section::StripSection;
use super::state::{SpaceWork, place, stretch};
use crate::assembly::Assembly;
use crate::error::{Solved, Unsolved};
use crate::term::Pose;
use std::f64::consts::PI;

/// Limit of Newton's iterations, which settle in 3 to 8 steps.
const MAX_ITERATIONS: usize = 60;
/// Halvings of a Newton step before it is given up.
const HALVINGS: usize = 12;
/// Agreement of moments at the end, relative to the pressure's moment and the largest …
const MOMENT_TOLERANCE: f64 = 1e-12;
/// … and the agreement from which on one step more without progress is rounding.
const ROUNDING: f64 = 1e-10;

/// Newton on the loads of all sections, from the bends without loads in `work`.
pub(super) fn equilibrium(assembly: &Assembly, p_body_pa: f64, work: &mut SpaceWork) -> Solved {
    work.loaded.sections.fill(Coupling::default());
    let radius_m = assembly.sites[0].radius_m;
    let of_pressure = PI * p_body_pa * radius_m.powi(3);
    let mut worst = update(assembly, p_body_pa, work)?;
    for iterations in 0..MAX_ITERATIONS {
        let moment = |c: &Coupling| c.outer[0].hypot(c.outer[1]);
        let scale = work.loaded.sections.iter().fold(of_pressure, |most, c| most.max(moment(c)));
        if worst <= MOMENT_TOLERANCE * scale {
            return Ok(());
        }
        if !newton_step(assembly, &mut work.loaded.sections) {
            return Err(not_converged(work, iterations + 1, worst));
        }
        let halvings = if worst <= ROUNDING * scale { 1 } else { HALVINGS };
        match damped_step(assembly, p_body_pa, work, worst, halvings) {
            Ok(left) => worst = left,
            Err(_) if halvings == 1 => return Ok(()),
            Err(Some(error)) => return Err(error),
            Err(None) => return Err(not_converged(work, iterations + 1, worst)),
        }
    }
    Err(not_converged(work, MAX_ITERATIONS, worst))
}

fn not_converged(work: &SpaceWork, iterations: usize, residual: f64) -> Unsolved {
    let p_act_kpa = work.strips.iter().flatten().fold(0.0_f64, |p, strip| p.max(strip.p_act_pa)) / 1e3;
    Unsolved::NotConverged { iterations, p_act_kpa, residual }
}

/// Takes the Newton step, halved until the disagreement falls; returns the rest, or why a section has no equilibrium.
fn damped_step(
    assembly: &Assembly,
    p_body_pa: f64,
    work: &mut SpaceWork,
    before: f64,
    halvings: usize,
) -> Result<f64, Option<Unsolved>> {
    let (mut share, mut taken, mut failed) = (1.0, 0.0, None);
    for _ in 0..halvings {
        for section in &mut work.loaded.sections {
            for (load, step) in section.outer.iter_mut().zip(section.step) {
                *load += (share - taken) * step;
            }
        }
        taken = share;
        match update(assembly, p_body_pa, work) {
            Ok(worst) if worst < before => return Ok(worst),
            Ok(_) => failed = None,
            Err(error) => failed = Some(error),
        }
        share *= 0.5;
    }
    Err(failed)
}

/// Every section at its minimum under the assumed loads; returns the largest disagreement of moments \[N·m\], NaN if any is.
fn update(assembly: &Assembly, p_body_pa: f64, work: &mut SpaceWork) -> Solved<f64> {
    for i in 0..assembly.segments.len() {
        let section = StripSection::new(assembly, i, p_body_pa).under(work.loaded.sections[i].outer);
        let (bend, compliance) = section.solve_under(&mut work.strips[i], work.bends[i])?;
        (work.bends[i], work.loaded.sections[i].compliance) = (bend, compliance);
    }
    place(assembly, work);
    couple(assembly, p_body_pa, work);
    let radius_m = assembly.sites[0].radius_m;
    let sizes = work.loaded.sections.iter().flat_map(|c| [c.residual[0], c.residual[1], c.residual[2] * radius_m]);
    Ok(sizes.fold(0.0, |worst: f64, r| if r.abs() > worst || r.is_nan() { r.abs() } else { worst }))
}

/// Loads of the shape in `work`, and how they change with it.
pub(super) fn couple(assembly: &Assembly, p_body_pa: f64, work: &mut SpaceWork) {
    let mut loaded = std::mem::take(&mut work.loaded);
    for (node, frame) in loaded.nodes.chunks_exact_mut(3).zip(&work.frames) {
        node.copy_from_slice(&frame.at);
    }
    loaded.forces.fill(0.0);
    let pose = Pose::new(&loaded.nodes, p_body_pa, 0.0);
    for term in &assembly.node_terms {
        term.add_force(&pose, &mut loaded.forces);
    }
    let mut beyond = OuterForces::default();
    for (i, segment) in assembly.segments.iter().enumerate().rev() {
        let (own, end) = (stretch(assembly, work, i), work.frames[i + 1].at);
        let lever = Lever::new(&own, segment.length_m);
        beyond.add(&loaded.forces[3 * (i + 1)..3 * (i + 2)]);
        let (section, force) = (&mut loaded.sections[i], lever.work(&beyond));
        section.residual = std::array::from_fn(|q| force[q] / segment.length_m - section.outer[q]);
        (section.turn, section.turned, section.own) = (lever.turn, lever.turned(&beyond), lever.own(&beyond));
        beyond.about(std::array::from_fn(|k| end[k] - own.from.at[k]));
    }
    work.loaded = loaded;
}

/// Newton step δ of the loads: `δᵢ − Σⱼ ∂Gᵢ/∂qⱼ Cⱼ δⱼ = residualᵢ`, C the compliance of a section.
///
/// With A the turn and g the turned work of a section, `hᵢ ∂Gᵢ/∂qⱼ` is `Aᵢᵀ gⱼ` for i < j and `gᵢᵀ Aⱼ` for i > j. So row i needs of the
/// others only the turn Φ before it and Y = Σ g C δ beyond it: δ is affine in Φ, found from tip to base, then filled in. False if
/// the step is not finite: the loads are critical.
pub(super) fn newton_step(assembly: &Assembly, sections: &mut [Coupling]) -> bool {
    let (mut beyond, mut beyond_slope) = ([0.0; 3], [[0.0; 3]; 3]);
    for (section, segment) in sections.iter_mut().zip(&assembly.segments).rev() {
        let per_h = 1.0 / segment.length_m;
        let turn = times(&transposed(&section.turn), &section.compliance);
        // Y just before this section is beyond + beyond_slope (Φ + turn δ) + g C δ.
        let followed = times(&beyond_slope, &turn);
        let turned = times(&transposed(&section.turned), &section.compliance);
        let (own, back) = (times(&section.own, &section.compliance), times(&section.turn, &followed));
        let pivot = of_each(|p, q| if p == q { 1.0 } else { 0.0 } - per_h * (own[p][q] + back[p][q]));
        let (inverse, carried) = (inverse(&pivot), times(&section.turn, &beyond_slope));
        let constant = std::array::from_fn(|p| section.residual[p] + per_h * dot(section.turn[p], beyond));
        section.step = apply(&inverse, constant);
        section.slope = times(&inverse, &of_each(|p, s| per_h * (section.turned[p][s] + carried[p][s])));
        let gain = of_each(|s, q| followed[s][q] + turned[s][q]);
        let (more, more_slope) = (apply(&gain, section.step), times(&gain, &section.slope));
        beyond = std::array::from_fn(|s| beyond[s] + more[s]);
        beyond_slope = of_each(|s, r| beyond_slope[s][r] + more_slope[s][r]);
    }
    let mut before = [0.0; 3];
    for section in sections {
        let more = apply(&section.slope, before);
        section.step = std::array::from_fn(|p| section.step[p] + more[p]);
        let turn = apply(&transposed(&section.turn), apply(&section.compliance, section.step));
        before = std::array::from_fn(|s| before[s] + turn[s]);
    }
    before.iter().all(|x: &f64| x.is_finite())
}
