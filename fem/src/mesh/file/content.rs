//! Content of a mesh file: mesh, surfaces, and what was not read.

use crate::mesh::Mesh;

/// Mesh of a file in its unit, with named surfaces and notices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshFile {
    /// Its mesh, in the unit of the file.
    pub mesh: Mesh,
    /// Name of the format; empty for a generated mesh, which is in metres and names its chambers.
    pub format: &'static str,
    /// Named surfaces, of which a case may make chambers.
    pub surfaces: Vec<Surface>,
    /// Parts, and the orientations of the file that are not read.
    pub unread: Vec<(String, String)>,
    /// What was left out or changed.
    pub told: Vec<String>,
}

/// A named surface of parts seen from one side each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// Name of the surface in the file.
    pub name: String,
    /// Parts, and whether their back is meant.
    pub faces: Vec<(String, bool)>,
    /// A pressure of the file acts on it.
    pub is_pressed: bool,
    /// Why it cannot be a chamber.
    pub fault: Option<String>,
}

impl From<Mesh> for MeshFile {
    fn from(mesh: Mesh) -> MeshFile {
        MeshFile { mesh, ..MeshFile::default() }
    }
}
