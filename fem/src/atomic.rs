//! Files that are either whole or not there, with the errors of this crate.

use std::io::{Error, Write};
use std::path::Path;

use crate::FemError;

/// Writes `path` whole or not at all.
pub(crate) fn replace(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>) -> Result<(), FemError> {
    spelling::files::replace(path, write).map_err(FemError::io(path))
}
