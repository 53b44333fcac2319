//! The TOML file that describes a finite element run.
//!
//! Kilopascals, megapascals, millimetres and degrees exist here only, with the unit in the key; what comes out is SI.
//! Every fault is a [`FemError::Case`] with its place; the first line of its message names the fault, the second
//! what to type. All keys: `docs/case.md`.

mod enclosed;
mod law;
mod load;
mod mesh;
pub(crate) mod range;
mod raw;
mod section;
mod settings;

pub(crate) use load::encastre;
pub(crate) use mesh::ReadMesh;
pub use mesh::{GENERATORS, GeneratorKey, MeshGenerator};
pub use range::DeclaredKey;
pub use settings::Outputs;

use crate::mesh::file::MeshFile;
pub use crate::output::picture::Viewpoint;
use crate::{FemError, Problem};

/// A run as the user describes it, in SI, checked.
#[derive(Debug, Clone)]
pub struct Case {
    /// Mesh, loads and settings of the run, in SI.
    pub problem: Problem,
    /// Files that the run writes, in addition to the energy ledger.
    pub outputs: Outputs,
    /// What was understood of a mesh file, and changed in it.
    pub notices: Vec<String>,
}

/// The cases that come with the library, by name.
pub fn shipped_case(name: &str) -> Option<&'static str> {
    SHIPPED_CASES.iter().find(|(key, _)| *key == name).map(|(_, text)| *text)
}

/// Names and texts of the shipped cases.
pub const SHIPPED_CASES: &[(&str, &str)] = &[
    ("pillow", include_str!("../../cases/pillow.toml")),
    ("tube", include_str!("../../cases/tube.toml")),
    ("blocked-pouch", include_str!("../../cases/blocked-pouch.toml")),
];

/// True if the text has the tables of a finite element case, whether or not the case is valid.
///
/// ```
/// assert!(fem::case::is_case("kind = \"fem\"\n[mesh]\n") && !fem::case::is_case("[body]\nkind = \"fem\"\n"));
/// ```
pub fn is_case(text: &str) -> bool {
    let kind = |line: &str| {
        line.split_once('=').is_some_and(|(key, value)| {
            key.trim() == "kind" && value.trim_start().trim_start_matches(['"', '\'']).starts_with("fem")
        })
    };
    text.lines().take_while(|line| !line.trim_start().starts_with('[')).any(kind)
}

impl Case {
    /// Reads a case from TOML text. A mesh file is read through `read_mesh`; this function touches no file itself.
    ///
    /// # Errors
    /// [`FemError::Case`] with the place of the fault; an error in the mesh file itself as `read_mesh` gives it.
    pub fn parse(text: &str, read_mesh: ReadMesh) -> Result<Case, FemError> {
        let raw = raw::read(text)?;
        range::choice("kind", &raw.kind, &[("fem", ())])?;
        let mut file = mesh::mesh(&raw.mesh, read_mesh)?;
        enclosed::chambers(&raw, &mut file)?;
        let MeshFile { mut mesh, unread, told: mut notices, .. } = file;
        let chambers = load::chambers(&raw, &mesh)?;
        section::forget_warps(&raw, &mut mesh);
        mesh::check(&raw.mesh, &mesh, &chambers)?;
        let sections = section::sections(&raw, &mut mesh, &unread)?;
        notices.extend(load::vacuum(&raw, &chambers));
        let outputs = settings::outputs(&raw.output, &mesh)?;
        let supports = load::supports(&raw, &mut mesh)?;
        let open = mesh::open_at(&mesh, &chambers).into_iter().map(String::from).collect();
        let problem = Problem {
            name: raw.name.clone(),
            open,
            sections,
            chambers,
            supports,
            rigid: load::rigid(&raw, &mesh)?,
            forces: load::forces(&raw, &mesh)?,
            gravity: load::gravity(&raw)?,
            obstacles: load::obstacles(&raw)?,
            contact: load::contact(&raw, &mesh)?,
            settings: settings::settings(&raw.settings)?,
            mesh,
        };
        Ok(Case { problem, outputs, notices })
    }
}

#[cfg(test)]
mod start_tests;
#[cfg(test)]
mod tests;
