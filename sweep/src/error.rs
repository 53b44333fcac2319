//! What can go wrong in a sweep.

use compare::CompareError;
use fem::FemError;
use std::path::{Path, PathBuf};

/// Why a sweep ended.
#[expect(missing_docs, reason = "fields have the words and units of their message")]
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// A study or a robot with a fault.
    #[error(transparent)]
    Study(#[from] CompareError),
    /// A finite element run that was refused or interrupted; an interrupted part of the reduced model too.
    #[error(transparent)]
    Run(#[from] FemError),
    /// A folder that cannot be written to.
    #[error("cannot write to {}: {cause}", path.display())]
    Write { path: PathBuf, cause: String },
    /// A scheduler that did not do what it was asked.
    #[error("{message}")]
    Cluster { message: String, help: String },
}

impl SweepError {
    /// A file that cannot be written.
    pub(crate) fn unwritable(path: &Path, cause: &std::io::Error) -> SweepError {
        SweepError::Write { path: path.to_path_buf(), cause: cause.to_string() }
    }
}
