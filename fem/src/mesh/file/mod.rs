//! Mesh files of other programs, each format in a file of its own and in the list of `known.rs`. The content tells the format.

mod abaqus;
mod build;
mod corners;
mod gmsh;
mod known;
mod scan;
mod stl;

use crate::FemError;
use crate::mesh::Mesh;
use known::Read;
use scan::Scan;
use spelling::files::{MOST_DATA, read_whole};
use std::path::Path;

/// What a mesh file says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshFile {
    /// Its mesh, in the unit of the file.
    pub mesh: Mesh,
    /// Name of the format; empty for a generated mesh, which is in metres and names its chambers.
    pub format: &'static str,
    /// Surfaces that may be chambers.
    pub surfaces: Vec<Surface>,
    /// Parts, and what the file says of their warp that is not read.
    pub unread: Vec<(String, String)>,
    /// What was left out or changed.
    pub told: Vec<String>,
}

/// A named surface of parts seen from one side each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// Its name.
    pub name: String,
    /// Parts, and whether their back is meant.
    pub faces: Vec<(String, bool)>,
    /// A pressure of the file acts on it.
    pub is_pressed: bool,
    /// Why it is no chamber.
    pub fault: Option<String>,
}

impl From<Mesh> for MeshFile {
    /// A generated mesh.
    fn from(mesh: Mesh) -> MeshFile {
        MeshFile { mesh, ..MeshFile::default() }
    }
}

/// Reads a mesh file. Says nothing about its fitness: see [`crate::mesh::check::check`].
///
/// # Errors
/// [`FemError::Io`] if it cannot be read, [`FemError::MeshFile`] with the line of the first fault.
pub fn read(path: &Path) -> Result<MeshFile, FemError> {
    let bytes = read_whole(path, MOST_DATA).map_err(|source| FemError::Io { path: path.to_path_buf(), source })?;
    let mut file = understood(&bytes, path)?;
    file.told.extend(corners::turn(&mut file.mesh).map_err(|message| FemError::MeshFile {
        path: path.to_path_buf(),
        line: 1,
        message,
    })?);
    Ok(file)
}

fn understood(bytes: &[u8], path: &Path) -> Result<MeshFile, FemError> {
    let fault = |line: usize, message: String| FemError::MeshFile { path: path.to_path_buf(), line, message };
    let format = known::format(bytes).map_err(|message| fault(1, message))?;
    let file = match format.read {
        Read::Bytes(read) => read(bytes).map_err(|message| fault(1, message))?,
        Read::Text(read) => {
            // Names in other encodings are names still.
            let text = String::from_utf8_lossy(bytes);
            let mut scan = Scan::new(&text);
            read(&mut scan).map_err(|message| fault(scan.number.max(1), message))?
        }
    };
    Ok(MeshFile { format: format.name, ..file })
}
