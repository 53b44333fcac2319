//! Checkpoints: where a stopped run goes on.
//!
//! ```text
//! "ibr-fem\n" | version             | the checkpoint as `postcard` … | CRC-32 of all before
//!   8 bytes      u64, little-endian                                   u32, little-endian
//! ```
//!
//! A folder holds `checkpoint` and the one before it, `checkpoint.previous`. A new one is written under a third name and
//! handed to the disk before two renames, so that a kill or a power cut at any moment leaves at least one that is good.

use std::io::{Error, Write};
use std::path::{Path, PathBuf};

use crate::bytes::{pack, unpack};
use crate::output::replace;
use crate::{FemError, Result};
use serde::{Deserialize, Serialize};
use spelling::files::{sealed, sync_folder, unsealed, write_new};

const MAGIC: &[u8; 8] = b"ibr-fem\n";
/// Raised whenever the meaning of the bytes changes.
const VERSION: u64 = 8;
/// Where a checkpoint is written before it takes its place: a kill leaves it, and the next one overwrites it.
const PARTIAL: &str = "checkpoint.partial";
/// The end of a complete run, from which another one may go on.
const END: &str = "checkpoint.end";

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    /// Hash of the problem; a run of another problem must not resume from here.
    pub fingerprint: u64,
    pub step: u64,
    pub time_s: f64,
    /// Bytes from [`crate::Simulation::save`], for an exact continuation.
    pub payload: Vec<u8>,
}

/// Writes `checkpoint` to `folder`, which is created; the one before it is kept.
pub(crate) fn write_checkpoint(folder: &Path, checkpoint: &Checkpoint) -> Result<PathBuf> {
    write_through(folder, checkpoint, &mut |out, bytes| out.write_all(bytes))
}

/// A checkpoint; with a notice for the user if the newest one was damaged, and this is the one before it.
type LoadedCheckpoint = (Checkpoint, Option<String>);

/// Reads the newest good checkpoint of the problem with this `fingerprint`; `None` if the folder has none.
pub(crate) fn read_checkpoint(folder: &Path, fingerprint: u64) -> Result<Option<LoadedCheckpoint>> {
    let (newest, previous) = names(folder);
    let fault = match read_file(&newest, fingerprint)? {
        FoundCheckpoint::Good(checkpoint) => return Ok(Some((checkpoint, None))),
        FoundCheckpoint::Foreign(reason) => return Err(FemError::checkpoint(newest, reason)),
        FoundCheckpoint::Damaged(reason) => Some(reason),
        FoundCheckpoint::Nothing => None,
    };
    match (read_file(&previous, fingerprint)?, fault) {
        (FoundCheckpoint::Good(checkpoint), fault) => {
            let why = fault.unwrap_or_else(|| "is missing (the run was killed while replacing it)".into());
            let (step, time) = (checkpoint.step, checkpoint.time_s);
            let notice = format!(
                "checkpoint {} {why}: going on from the one before it, step {step}, t = {time:.6} s",
                newest.display()
            );
            Ok(Some((checkpoint, Some(notice))))
        }
        (FoundCheckpoint::Foreign(reason), _) => Err(FemError::checkpoint(previous, reason)),
        (FoundCheckpoint::Nothing, None) => Ok(None),
        (FoundCheckpoint::Damaged(reason), None) => Err(start_anew(previous, &reason)),
        (_, Some(reason)) => Err(start_anew(newest, &reason)),
    }
}

/// Writes the end of a complete run to `folder`; its `fingerprint` is the structure's.
pub(crate) fn write_end(folder: &Path, end: &Checkpoint) -> Result<()> {
    replace(&folder.join(END), &mut |out| out.write_all(&encode(end)))
}

/// Reads the end of the complete run in a folder, with the bytes of the file; `None` if it keeps none.
pub(crate) fn read_end(folder: &Path) -> Result<Option<(Checkpoint, Vec<u8>)>> {
    let path = folder.join(END);
    let bytes = match std::fs::read(&path) {
        Err(source) if source.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        read => read.map_err(FemError::io(&path))?,
    };
    match decode(&bytes, None) {
        FoundCheckpoint::Good(end) => Ok(Some((end, bytes))),
        FoundCheckpoint::Foreign(reason) => Err(FemError::checkpoint(path, reason)),
        FoundCheckpoint::Damaged(reason) => Err(start_anew(path, &reason)),
        FoundCheckpoint::Nothing => Ok(None),
    }
}

fn start_anew(path: PathBuf, reason: &str) -> FemError {
    let reason = format!("the file {reason}, and no other checkpoint is good. Restart the run with --force");
    FemError::checkpoint(path, reason)
}

fn names(folder: &Path) -> (PathBuf, PathBuf) {
    (folder.join("checkpoint"), folder.join("checkpoint.previous"))
}

/// How bytes get to the file; tests put a full disk here.
type Put<'a> = &'a mut dyn FnMut(&mut dyn Write, &[u8]) -> Result<(), Error>;

fn write_through(folder: &Path, checkpoint: &Checkpoint, put: Put) -> Result<PathBuf> {
    let (newest, previous) = names(folder);
    let (partial, bytes) = (folder.join(PARTIAL), encode(checkpoint));
    let written = std::fs::create_dir_all(folder).and_then(|()| write_new(&partial, &mut |out| put(out, &bytes)));
    let replaced = written.and_then(|()| {
        if newest.exists() {
            std::fs::rename(&newest, &previous)?;
        }
        std::fs::rename(&partial, &newest)?;
        sync_folder(folder)
    });
    replaced.map_err(|source| {
        // The first failure is the one to report.
        let _ = std::fs::remove_file(&partial);
        FemError::io(&newest)(source)
    })?;
    Ok(newest)
}

fn encode(checkpoint: &Checkpoint) -> Vec<u8> {
    sealed([&MAGIC[..], &VERSION.to_le_bytes(), &pack(checkpoint)].concat())
}

enum FoundCheckpoint {
    Good(Checkpoint),
    /// Whole, but not for this problem or program.
    Foreign(String),
    /// Cut, changed, or something else; completes "the file …".
    Damaged(String),
    Nothing,
}

fn read_file(path: &Path, fingerprint: u64) -> Result<FoundCheckpoint> {
    match std::fs::read(path) {
        Ok(bytes) => Ok(decode(&bytes, Some(fingerprint))),
        Err(source) if source.kind() == std::io::ErrorKind::NotFound => Ok(FoundCheckpoint::Nothing),
        Err(source) => Err(FemError::io(path)(source)),
    }
}

fn decode(bytes: &[u8], fingerprint: Option<u64>) -> FoundCheckpoint {
    if bytes.len() < MAGIC.len() {
        return FoundCheckpoint::Damaged(format!("is cut off after {} bytes", bytes.len()));
    }
    if !bytes.starts_with(MAGIC) {
        return FoundCheckpoint::Damaged("is not a checkpoint of this program".into());
    }
    let Some(body) = unsealed(bytes).filter(|body| body.starts_with(MAGIC)) else {
        return FoundCheckpoint::Damaged(format!("is cut off or damaged (checksum of {} bytes differs)", bytes.len()));
    };
    let Some((version, state)) = body[MAGIC.len()..].split_first_chunk().map(|(v, s)| (u64::from_le_bytes(*v), s))
    else {
        return FoundCheckpoint::Damaged("is cut off before its version".into());
    };
    if version != VERSION {
        return FoundCheckpoint::Foreign(format!(
            "its format version is {version}, this program reads {VERSION}: go on with the program that wrote it, or start \
             anew with --force"
        ));
    }
    let Some(checkpoint) = unpack::<Checkpoint>(state) else {
        return FoundCheckpoint::Damaged("has fields of the wrong length".into());
    };
    if let Some(fingerprint) = fingerprint.filter(|wanted| *wanted != checkpoint.fingerprint) {
        return FoundCheckpoint::Foreign(format!(
            "it belongs to another problem ({:016x}, this one is {fingerprint:016x}): the case or mesh was changed. Undo \
             the change, choose another folder, or start anew with --force",
            checkpoint.fingerprint
        ));
    }
    FoundCheckpoint::Good(checkpoint)
}

#[cfg(test)]
#[path = "checkpoint_tests.rs"]
mod tests;
