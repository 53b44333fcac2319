//! Equilibrium of the whole robot: every place alone, or coupled through transverse loads and the shape.

mod coupled;
mod held;
mod workspace;

use crate::assembly::Assembly;
use crate::error::Unsolved;
use crate::space;
use coupled::{coupled, place_nodes, solve_segment};
pub(crate) use held::bend;
use held::hold;
pub(crate) use workspace::{Held, Workspace};

/// Places the nodes at an equilibrium without transverse loads, which does not need them; with such loads they are placed.
pub(crate) fn place(assembly: &Assembly, work: &mut Workspace) {
    if assembly.node_terms.is_empty() {
        place_nodes(assembly, work);
    }
}

/// Fills `work` with the equilibrium at body pressure `p_body_pa` and the actuator pressures already in it; `warm` starts
/// from the equilibrium that `work` holds.
pub(crate) fn equilibrium(
    assembly: &Assembly,
    p_body_pa: f64,
    work: &mut Workspace,
    warm: bool,
) -> Result<(), Unsolved> {
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
