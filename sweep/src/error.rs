//! What can go wrong in a sweep.

use compare::CompareError;
use fem::FemError;
use std::path::{Path, PathBuf};

/// Reason for which a sweep did not run to its end.
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
    /// Parts that are not there yet.
    #[error("{0} parts of the study are missing")]
    Missing(usize),
    /// A file of a part that is not the one that was written.
    #[error("{}: {cause}", path.display())]
    Damaged { path: PathBuf, cause: String },
    /// A scheduler that did not do what it was asked.
    #[error("{message}")]
    Cluster { message: String, help: String },
}

impl SweepError {
    pub(crate) fn unwritable(path: &Path, cause: &std::io::Error) -> SweepError {
        SweepError::Write { path: path.to_path_buf(), cause: cause.to_string() }
    }

    /// The same as an error of several runs, which end at it.
    pub(crate) fn of_run(self, folder: &Path) -> FemError {
        FemError::Folder { path: folder.to_path_buf(), cause: self.to_string(), help: self.help() }
    }

    /// Remedy in one sentence; empty where the message already contains it.
    pub fn help(&self) -> String {
        match self {
            SweepError::Study(error) => error.help().unwrap_or_default().into(),
            SweepError::Run(_) => String::new(),
            SweepError::Write { .. } => "choose another folder with --out".into(),
            SweepError::Missing(_) => "run the other shards, or the command without a shard".into(),
            SweepError::Damaged { .. } => "delete the file and give the command again: it recomputes that part".into(),
            SweepError::Cluster { help, .. } => help.clone(),
        }
    }

    /// A file whose checksum, or whose contents, cannot be.
    pub(crate) fn damaged(path: &Path) -> SweepError {
        let cause = "the file is damaged: its checksum differs";
        SweepError::Damaged { path: path.to_path_buf(), cause: cause.into() }
    }
}
