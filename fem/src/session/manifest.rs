//! `manifest.json`: what made the files of a folder, from what, where and when.

use super::summary::Cost;
use crate::record::RecordShape;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Name and version of the record in `manifest.json`.
pub const MANIFEST: RecordShape = RecordShape { schema: "ibr.manifest", version: 1 };

/// A file, as a manifest names it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileHash {
    /// File, or name of what comes with the program.
    pub name: String,
    /// SHA-256 of the file's bytes, in hexadecimal digits.
    pub sha256: String,
}

impl FileHash {
    /// Hashes the contents of a file that need not exist.
    pub fn of(name: &str, bytes: &[u8]) -> FileHash {
        FileHash { name: name.to_string(), sha256: sha256(bytes) }
    }
}

/// SHA-256 in hex.
///
/// ```
/// assert!(fem::session::sha256(b"abc").starts_with("ba7816bf8f01cfea"));
/// ```
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

/// Program, date and machine that made the files of a run.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Maker {
    /// Name and version of the program that made the files.
    pub program: String,
    /// Date on which the files were made, UTC.
    pub date: String,
    /// Processor and number of cores of the machine.
    pub machine: String,
    /// Command line as the user typed it.
    pub command: String,
}

/// Content of `manifest.json`: maker, inputs, hashes and cost of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Program, date, machine and command, as keys of the manifest.
    #[serde(flatten)]
    pub maker: Maker,
    /// Files and texts that the results depend on.
    pub inputs: Vec<FileHash>,
    /// Files that the command or run wrote.
    pub outputs: Vec<FileHash>,
    /// What a finite element run took.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<Cost>,
}

impl Manifest {
    /// Text of `manifest.json`, indented, with a line break at its end.
    pub fn text(&self) -> String {
        format!("{:#}\n", MANIFEST.stamped(self))
    }
}
