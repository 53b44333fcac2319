//! Everything that can go wrong in a finite element run.

use std::path::{Path, PathBuf};

/// Why a run was refused, or stopped.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "fields that are not described are what their names say")]
pub enum FemError {
    /// The mesh cannot be simulated; the message names the part, element or node (counted from 1 as in mesh files).
    #[error("mesh: {0}")]
    Mesh(String),
    #[error("{}:{line}: {message}", path.display())]
    MeshFile {
        path: PathBuf,
        /// Line of the mesh file, counted from 1.
        line: usize,
        /// The fault and its remedy.
        message: String,
    },
    /// A case file was refused; `span` is a byte range in its text.
    #[error("{message}")]
    Case {
        /// The fault and, in further lines, its remedy.
        message: String,
        span: Option<std::ops::Range<usize>>,
    },
    /// What was to be simulated was refused.
    #[error("{}", .0.place())]
    Refused(Box<TextFault>),
    /// The problem is inconsistent or a parameter is out of range.
    #[error("{0}")]
    Problem(String),
    /// Settings of a run that cannot be had together.
    #[error("{message}")]
    Setting { message: String, help: String },
    /// The run was stopped because its result could not be trusted.
    #[error("stopped at step {step}, t = {time_s:.6} s: {reason}")]
    Stopped {
        step: u64,
        time_s: f64,
        /// What was seen, where, and what to change.
        reason: String,
    },
    /// The same, of a run in a folder.
    #[error("{error}")]
    StoppedIn { error: Box<FemError>, help: String },
    /// The progress callback asked to end.
    #[error("interrupted{}", so_far(*time_s, *step, *done, *of))]
    Interrupted {
        /// Simulated time that the last one reached \[s\].
        time_s: f64,
        step: u64,
        done: usize,
        of: usize,
    },
    #[error("checkpoint {}: {reason}", path.display())]
    Checkpoint {
        path: PathBuf,
        /// The fault and its remedy.
        reason: String,
    },
    /// A folder of a run that cannot be written to.
    #[error("cannot write to {}: {cause}", path.display())]
    Folder {
        /// The folder, or the file in it.
        path: PathBuf,
        cause: String,
        help: String,
    },
    /// A record of a run cannot be read.
    #[error("{}", .0.place())]
    Record(Box<Damage>),
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
}

fn so_far(time_s: f64, step: u64, done: usize, of: usize) -> String {
    match of {
        1 => format!(" at t = {time_s:.6} s, step {step}"),
        _ => format!("; {done} of {of} runs are complete"),
    }
}

/// A fault in the text of a case or a scenario.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextFault {
    /// File, or name of what comes with the program.
    pub file: String,
    /// Whole text of the file, which the message quotes.
    pub text: String,
    /// The fault: the key, its value and the allowed range.
    pub message: String,
    /// What to write; may be empty.
    pub help: String,
    /// Byte range of the fault in the text; `None` if it concerns the whole.
    pub span: Option<std::ops::Range<usize>>,
}

impl TextFault {
    /// File, line and fault.
    fn place(&self) -> String {
        let TextFault { file, message, .. } = self;
        self.line().map_or_else(|| message.clone(), |line| format!("{file}:{line}: {message}"))
    }

    fn line(&self) -> Option<usize> {
        let before = self.text.bytes().take(self.span.as_ref()?.start);
        Some(before.filter(|byte| *byte == b'\n').count() + 1)
    }
}

/// A fault in a record, and its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Damage {
    /// Path of the damaged file, as in the message.
    pub file: String,
    /// Line, counted from 1; `None` if the whole file is of another kind.
    pub line: Option<u64>,
    /// The fault, without file and line.
    pub message: String,
    /// Remedy: what to do with the file.
    pub help: String,
}

impl Damage {
    pub(crate) fn error(file: &str, line: Option<u64>, message: String, help: &str) -> FemError {
        FemError::Record(Box::new(Damage { file: file.into(), line, message, help: help.into() }))
    }

    /// A file whose checksum differs from its manifest.
    pub(crate) fn changed(file: &str, help: &str) -> FemError {
        let message = "is not the file that was written: its SHA-256 differs from that in manifest.json";
        Damage::error(file, None, message.into(), help)
    }

    /// File, line and fault.
    fn place(&self) -> String {
        let Damage { file, line, message, .. } = self;
        line.map_or_else(|| format!("{file}: {message}"), |line| format!("{file}:{line}: {message}"))
    }
}

impl FemError {
    /// File and line of what was refused, where it is known.
    pub fn place(&self) -> Option<String> {
        match self {
            FemError::Refused(refusal) => refusal.line().map(|line| format!("{}:{line}", refusal.file)),
            FemError::MeshFile { path, line, .. } => Some(format!("{}:{line}", path.display())),
            _ => None,
        }
    }

    /// What to do about it, where the message does not say it itself.
    pub fn help(&self) -> Option<&str> {
        match self {
            FemError::Setting { help, .. } | FemError::StoppedIn { help, .. } | FemError::Folder { help, .. } => {
                Some(help)
            }
            FemError::Refused(refusal) => Some(refusal.help.as_str()).filter(|help| !help.is_empty()),
            FemError::Record(damage) => Some(&damage.help),
            FemError::MeshFile { .. } => {
                Some("correct that line, or write the mesh again; docs/case.md lists the file formats that are read")
            }
            FemError::Io { .. } => Some("check the path, and that the disk can be read and has room"),
            FemError::Interrupted { .. } => Some("completed work is kept; the same command resumes"),
            _ => None,
        }
    }

    /// Whether a guard stopped the run: the problem was sound, its result is not.
    pub fn is_stop(&self) -> bool {
        matches!(self, FemError::Stopped { .. } | FemError::StoppedIn { .. })
    }

    /// A file that could not be read or written.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> FemError {
        let path = path.to_path_buf();
        |source| FemError::Io { path, source }
    }

    /// A run whose result cannot be trusted.
    pub(crate) fn stopped(step: u64, time_s: f64, reason: String) -> FemError {
        FemError::Stopped { step, time_s, reason }
    }

    pub(crate) fn checkpoint(path: PathBuf, reason: impl Into<String>) -> FemError {
        FemError::Checkpoint { path, reason: reason.into() }
    }

    /// A fault of a case at a place in its text; further lines of the message say what to write.
    pub(crate) fn case(message: String, span: std::ops::Range<usize>) -> FemError {
        FemError::Case { message, span: Some(span) }
    }

    /// An interrupt of several runs or parts.
    pub fn interrupted(done: usize, of: usize) -> FemError {
        FemError::Interrupted { time_s: 0.0, step: 0, done, of }
    }

    /// A folder that cannot be used as it is.
    pub(crate) fn folder(path: &Path, cause: impl Into<String>, help: impl Into<String>) -> FemError {
        FemError::Folder { path: path.into(), cause: cause.into(), help: help.into() }
    }

    /// A setting that is not possible, and what to do.
    pub(crate) fn setting(message: impl Into<String>, help: impl Into<String>) -> FemError {
        FemError::Setting { message: message.into(), help: help.into() }
    }
}
