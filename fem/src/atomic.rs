//! Files that are either whole or not there.

use std::fs::File;
use std::io::{BufWriter, Error, Write};
use std::path::{Path, PathBuf};

use crate::FemError;

/// Writes `path` through a file of another name in the same folder, which is renamed when it is complete. When anything
/// fails the temporary file is removed and an earlier file at `path` stays as it was.
pub(crate) fn replace(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>) -> Result<(), FemError> {
    let partial = partial_name(path);
    let written = write_whole(&partial, write).and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|source| {
        // The first failure is the one to report.
        let _ = std::fs::remove_file(&partial);
        FemError::io(path)(source)
    })
}

/// Writes a new file and waits until the disk has it.
pub(super) fn write_whole(
    path: &Path,
    write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut out = BufWriter::new(File::create(path)?);
    write(&mut out)?;
    // Not on drop: a full disk would go unnoticed.
    out.into_inner().map_err(|failed| failed.into_error())?.sync_all()
}

/// Name of a file while it is being written: fixed, so that what a kill left behind is overwritten next time.
pub(super) fn partial_name(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{name}.partial"))
}

/// Makes renames in `folder` survive a power cut, where the system allows to say so.
pub(super) fn sync_folder(folder: &Path) -> Result<(), Error> {
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// Creates a folder and those above it.
pub(super) fn make_folder(folder: &Path) -> Result<(), FemError> {
    std::fs::create_dir_all(folder).map_err(FemError::io(folder))
}

#[cfg(test)]
#[path = "atomic_tests.rs"]
pub(crate) mod tests;
