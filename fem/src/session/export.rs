//! A problem before it runs, as a file for another program.

use super::RunSource;
pub use crate::output::deck::Solver;
use crate::output::{MeshFrame, deck, vtu};
use crate::{FemError, Result, Simulation};
use std::path::Path;

/// Size of an exported mesh, and what its file does not contain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Export {
    /// Number of nodes in the file.
    pub nodes: usize,
    /// Number of elements in the file.
    pub elements: usize,
    /// What to know about what was read.
    pub notices: Vec<String>,
    /// What the file does not say.
    pub left_out: Vec<String>,
}

/// Writes the problem that a text describes: `.inp` for a solver with materials, loads and a step, `.vtu` for
/// ParaView. An earlier file stays until the new one is complete.
///
/// # Errors
/// [`FemError::Setting`] for another ending, and for a solver that does not read the format; as [`super::simulate`] for the text; [`FemError::Io`].
pub fn export(source: &RunSource, path: &Path, solver: Solver) -> Result<Export> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    if solver != Solver::Abaqus && ending.as_deref() != Some("inp") {
        let message = format!("CalculiX does not read {}", path.display());
        return Err(FemError::setting(message, "end it with .inp, or leave out --for"));
    }
    let loaded = source.load()?;
    let problem = &loaded.case.problem;
    let mut left_out = Vec::new();
    match ending.as_deref() {
        Some("inp") => {
            problem.check().map_err(|error| source.refused(error))?;
            let (text, missing) = deck::text(problem, solver);
            left_out = missing;
            crate::output::replace(path, &mut |out| out.write_all(text.as_bytes()))?;
        }
        Some("vtu") => {
            let start = Simulation::new(problem).map_err(|error| source.refused(error))?;
            vtu::write_vtu(path, &problem.mesh, &MeshFrame::of(&start))?;
        }
        _ => {
            let message = format!("the ending of {} names no known format", path.display());
            let help = "end it with .inp (Abaqus, CalculiX) or .vtu (ParaView)";
            return Err(FemError::setting(message, help));
        }
    }
    let (nodes, elements) = (problem.mesh.points.len(), problem.mesh.elements());
    Ok(Export { nodes, elements, notices: loaded.case.notices, left_out })
}
