//! The whole robot held in a shape, or taken as it is.

use super::coupled::{disagreement, place_of};
use super::workspace::Workspace;
use crate::assembly::Assembly;
use crate::site::SiteState;

/// Takes the held curvatures, and the moments missing there for an equilibrium.
pub(crate) fn hold(assembly: &Assembly, p_body_pa: f64, work: &mut Workspace) {
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
