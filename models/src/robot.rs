//! Equilibrium of the whole robot: every place alone, or coupled through transverse loads and the shape.

mod coupled;
mod tip;
mod workspace;

use crate::assembly::Assembly;
use crate::error::Solved;
use crate::site::SiteState;
use crate::space;
use coupled::{coupled, disagreement, place_nodes, place_of, solve_segment};
pub(crate) use tip::tip_compliance;
pub(crate) use workspace::{HeldCurvatures, Workspace};

/// Places the nodes at an equilibrium without transverse loads, which does not need them; with such loads they are placed.
pub(crate) fn place(assembly: &Assembly, work: &mut Workspace) {
    if assembly.node_terms.is_empty() {
        place_nodes(assembly, work);
    }
}

/// Fills `work` with the equilibrium at body pressure `p_body_pa` and the actuator pressures already in it; `warm` starts
/// from the equilibrium that `work` holds.
pub(crate) fn equilibrium(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace, warm: bool) -> Solved {
    if !assembly.around.is_empty() {
        return space::equilibrium(assembly, p_body_pa, &mut work.space, &mut work.states);
    }
    if !work.held.curvatures.is_empty() {
        hold(assembly, p_body_pa, work);
        return Ok(());
    }
    if assembly.node_terms.is_empty() {
        for i in 0..work.states.len() {
            let near = if warm { Some(&work.states[i]) } else { None };
            work.states[i] = solve_segment(assembly, work, i, p_body_pa, 0.0, near)?;
        }
        return Ok(());
    }
    if warm && coupled(assembly, p_body_pa, work, true).is_ok() {
        return Ok(());
    }
    coupled(assembly, p_body_pa, work, false)
}

/// Takes the held curvatures, and the moments missing there for an equilibrium.
fn hold(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) {
    for i in 0..work.states.len() {
        let (site, loads) = place_of(assembly, work, i, p_body_pa, 0.0);
        let (state, missing) = site.held(work.held.curvatures[i], &loads, work.history.of_segment(i));
        (work.states[i], work.held.missing[i]) = (state, missing);
    }
    if !assembly.node_terms.is_empty() {
        across(assembly, p_body_pa, work);
        for (missing, moment) in work.held.missing.iter_mut().zip(&work.coupled.residual) {
            *missing -= moment;
        }
    }
}

/// Takes a shape as it is, with the shear of the loads across it.
pub(crate) fn bend(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace, curvatures: &[f64]) {
    for (state, curvature) in work.states.iter_mut().zip(curvatures) {
        *state = SiteState::REST;
        state.curvature = *curvature;
    }
    if !assembly.node_terms.is_empty() {
        across(assembly, p_body_pa, work);
    }
}

/// Loads across the body on the shape in `work`: their moments are the disagreement with none.
fn across(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) {
    work.coupled.moments.fill(0.0);
    disagreement(assembly, p_body_pa, work);
}
