//! Files that are whole or not there, with the errors of this crate.

use std::path::Path;

use crate::error::{DataError, Result};
use spelling::files::{clear, folder_of, replace};

/// Writes `bytes` to `path`, whole or not at all, and removes what a kill left of earlier tries. The folder must exist.
///
/// # Errors
/// The folder does not exist or is not writable, or the disk is full; an earlier file at `path` is then untouched.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    clear(&folder_of(path), &|whole| whole == name);
    replace(path, &mut |out| out.write_all(bytes)).map_err(|cause| cannot_write(&path.display().to_string(), &cause))
}

/// A file that the disk did not take.
pub(crate) fn cannot_write(shown: &str, cause: &std::io::Error) -> DataError {
    let help = match cause.kind() {
        std::io::ErrorKind::NotFound => "the folder does not exist: create it, or give another with --out",
        std::io::ErrorKind::PermissionDenied => "the folder is not writable: give another, or change its permissions",
        std::io::ErrorKind::StorageFull => "free some disk space, or give a folder on another disk",
        _ => "give another path",
    };
    DataError::file(shown, format!("cannot write: {cause}"), help)
}
