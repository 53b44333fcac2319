//! Everything that can go wrong in a finite element run.

use std::path::PathBuf;

/// Why a run was refused, or stopped.
#[derive(Debug, thiserror::Error)]
pub enum FemError {
    /// The mesh cannot be simulated; the message names the part, element or node (counted from 1 as in mesh files).
    #[error("mesh: {0}")]
    Mesh(String),
    /// A mesh file was refused.
    #[error("{}:{line}: {message}", path.display())]
    MeshFile {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// What is wrong and what to write.
        message: String,
    },
    /// A case file was refused; `span` is a byte range in its text.
    #[error("{message}")]
    Case {
        /// What is wrong and what to write.
        message: String,
        /// Where.
        span: Option<std::ops::Range<usize>>,
    },
    /// The problem is inconsistent or a parameter is out of range.
    #[error("{0}")]
    Problem(String),
    /// The run was stopped because its result could not be trusted.
    #[error("stopped at step {step}, t = {time_s:.6} s: {reason}")]
    Stopped {
        /// Steps done.
        step: u64,
        /// Simulated time \[s\].
        time_s: f64,
        /// What was seen, where, and what to change.
        reason: String,
    },
    /// A checkpoint cannot be used.
    #[error("checkpoint {}: {reason}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// What is wrong and what to do.
        reason: String,
    },
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}
