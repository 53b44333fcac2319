//! Mesh files of other programs, each format in a separate file and in the list of `known.rs`. The content determines the format.

mod abaqus;
mod build;
mod corners;
mod gmsh;
mod known;
mod scan;
mod stl;

use crate::{FemError, Result};
pub use build::{MeshFile, Surface};
use known::Read;
use scan::Scan;
use spelling::files::{MOST_DATA, read_whole};
use std::path::Path;

/// Reads a mesh file without judging the mesh: see [`crate::mesh::check::check`].
///
/// # Errors
/// [`FemError::Io`] if it cannot be read, [`FemError::MeshFile`] with the line of the first fault.
pub fn read(path: &Path) -> Result<MeshFile> {
    let bytes = read_whole(path, MOST_DATA).map_err(FemError::io(path))?;
    let mut file = understood(&bytes, path)?;
    file.told.extend(corners::turn(&mut file.mesh).map_err(|message| FemError::MeshFile {
        path: path.to_path_buf(),
        line: 1,
        message,
    })?);
    Ok(file)
}

fn understood(bytes: &[u8], path: &Path) -> Result<MeshFile> {
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
