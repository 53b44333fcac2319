//! What a run leaves behind.
//!
//! Files that are replaced (frames, series, checkpoints) are written under another name and renamed, so that a reader, a
//! full disk or a kill never meets half a file. Tables grow line by line and are cut back to the checkpoint on resume:
//! an interrupted and resumed run leaves the same bytes as an uninterrupted one.

pub(crate) mod centre_line;
pub(crate) mod checkpoint;
pub(crate) mod deck;
mod frame;
pub(crate) mod history;
pub(crate) mod picture;
pub(crate) mod pvd;
pub(crate) mod table;
pub(crate) mod vtu;

pub(crate) use frame::MeshFrame;

use crate::{FemError, Result};
use std::io::{Error, Write};
use std::path::Path;

/// Writes `path` whole or not at all.
pub(crate) fn replace(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> Result<(), Error>) -> Result<()> {
    spelling::files::replace(path, write).map_err(FemError::io(path))
}
