//! The folder of a run: what it holds, who may write to it, and how a complete run takes the place of an older one.

use super::manifest::{Manifest, sha256};
use crate::output::replace;
use crate::record::RecordShape;
use crate::{FemError, Result};
use serde::{Deserialize, Serialize};
use spelling::files::is_partial;
use spelling::folders::{self, exchange, mend};
use std::fs::File;
use std::path::{Path, PathBuf};

/// There while a run is not complete, with the identity of the run.
const MARKER: &str = "unfinished.json";
const UNFINISHED: RecordShape = RecordShape { schema: "ibr.unfinished", version: 1 };
/// The last file of a complete run.
const LAST: &str = "manifest.json";
/// Held by the process that writes to the folder.
const LOCK: &str = ".lock";
/// The case of the run; the mark of an unfinished one is believed only with it, or alone.
const CASE: &str = "case.toml";
/// Everything that a run leaves behind, folders too.
const OWN: &[&str] = &[
    CASE,
    "history.csv",
    "centre_line.csv",
    "run.pvd",
    "frames",
    "picture.png",
    "readings.csv",
    "markers.csv",
    "snaps.csv",
    "history.png",
    "displacement.png",
    "side.png",
    "section.png",
    "cut.png",
    "summary.json",
    "checkpoint",
    "checkpoint.previous",
    "checkpoint.end",
];

/// Separates one run from another, in addition to the case itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RunIdentity {
    pub case_sha256: String,
    pub end_s: f64,
    pub frames: bool,
    /// SHA-256 of the end of the run that it goes on from.
    #[serde(default)]
    pub from: Option<String>,
}

/// A folder that may be written to.
#[derive(Debug)]
pub(super) struct Workplace {
    /// Where files go while the run is not complete.
    pub folder: PathBuf,
    /// The interrupted run to go on with.
    pub interrupted: Option<RunIdentity>,
    /// Where the complete run goes in the end.
    pub target: PathBuf,
    _lock: File,
}

#[derive(Debug)]
enum FolderState {
    Nothing,
    Unfinished(RunIdentity),
    Finished,
    Foreign(String),
}

/// Whether the folder holds a complete run, whatever else is in it.
pub fn is_finished(folder: &Path) -> bool {
    let has = |name| folder.join(name).exists();
    !has(MARKER) && has(LAST) && has("summary.json")
}

/// Whether the run in the folder, complete or not, is of this case; `None` if there is none.
pub(super) fn is_of(folder: &Path, text: &str) -> Result<Option<bool>> {
    Ok(match look(folder)? {
        FolderState::Unfinished(marker) => Some(marker.case_sha256 == sha256(text.as_bytes())),
        FolderState::Finished => Some(case_sha256(folder).is_some_and(|of| of == sha256(text.as_bytes()))),
        FolderState::Nothing | FolderState::Foreign(_) => None,
    })
}

/// Finds out what can be done with the folder, to `resume` a run of the case in `text` or to replace one by `force`, and takes it; `None`
/// for a run to resume that is complete.
///
/// # Errors
/// The folder holds another run, or files that are none of ours, or another process writes to it.
pub(super) fn open(folder: &Path, text: &str, resume: bool, force: bool) -> Result<Option<Workplace>> {
    let refuse = |cause: &str, help: &str| Err(FemError::folder(folder, cause, help));
    if matches!(look(&aside(folder))?, FolderState::Finished) {
        mend(folder, &aside(folder)).map_err(|cause| unwritable(folder, &cause))?;
    }
    match (look(folder)?, resume, force) {
        (FolderState::Nothing, ..) | (FolderState::Unfinished(_), false, true) => take(folder, folder, None).map(Some),
        (FolderState::Unfinished(marker), true, _) => {
            same_case(folder, text, &marker.case_sha256)?;
            take(folder, folder, Some(marker)).map(Some)
        }
        (FolderState::Unfinished(_), false, false) => {
            let message = "it holds an interrupted run";
            let help = "add --resume to go on with it, or --force to start again";
            refuse(message, help)
        }
        (FolderState::Finished, _, true) => open_beside(folder, text, resume).map(Some),
        (FolderState::Finished, true, false) => {
            same_case(folder, text, &case_sha256(folder).unwrap_or_default())?;
            // A kill after the last file of the run leaves them.
            ["checkpoint", "checkpoint.previous", LOCK].iter().try_for_each(|name| remove(&folder.join(name)))?;
            Ok(None)
        }
        (FolderState::Finished, false, false) => {
            let message = "it holds a finished run";
            let help = "choose another folder with --out, or add --force to replace it";
            refuse(message, help)
        }
        (FolderState::Foreign(name), ..) => {
            let message = &format!("it holds other files ({name})");
            let help = "choose a new or empty folder with --out";
            refuse(message, help)
        }
    }
}

/// Makes a complete run an unfinished one again, with the checkpoint that `keep` writes. Killed at any point it is one of the two.
pub(crate) fn reopen(folder: &Path, marker: RunIdentity, keep: &dyn Fn() -> Result<()>) -> Result<Workplace> {
    let place = take(folder, folder, Some(marker.clone()))?;
    keep()?;
    place.mark(&marker)?;
    remove(&folder.join(LAST))?;
    Ok(place)
}

/// The new run is made next to the finished one, which stays until then.
fn open_beside(folder: &Path, text: &str, resume: bool) -> Result<Workplace> {
    let beside = named_like(folder, ".new");
    match look(&beside)? {
        FolderState::Unfinished(marker) if resume => {
            same_case(&beside, text, &marker.case_sha256)?;
            take(&beside, folder, Some(marker))
        }
        FolderState::Foreign(name) => {
            let cause = format!("it holds other files ({name})");
            let help = "move that folder away";
            Err(FemError::folder(&beside, cause, help))
        }
        _ => take(&beside, folder, None),
    }
}

fn named_like(folder: &Path, more: &str) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_os_string();
    name.push(more);
    folder.with_file_name(name)
}

/// Where an older run is for a moment while a new one takes its place, where folders cannot be exchanged.
fn aside(folder: &Path) -> PathBuf {
    named_like(folder, ".new-replaces")
}

/// Writes a file, whole or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    replace(path, &mut |out| out.write_all(bytes))
}

/// A file of the run that cannot be written, or read back.
pub(super) fn unwritable(path: &Path, cause: &std::io::Error) -> FemError {
    FemError::folder(path, cause.to_string(), "choose another folder with --out")
}

fn same_case(folder: &Path, text: &str, case_sha256: &str) -> Result<()> {
    if case_sha256 == sha256(text.as_bytes()) {
        return Ok(());
    }
    let own = folder.join("case.toml");
    let help = format!("give the case it was started with: {}; or start again with --force", own.display());
    let cause = "the run in it is of another case, or the case has changed";
    Err(FemError::folder(folder, cause, help))
}

fn look(folder: &Path) -> Result<FolderState> {
    if !folder.exists() {
        return Ok(FolderState::Nothing);
    }
    // What a kill between two files can leave behind is of no use to anyone.
    let names: Vec<String> = sorted(folder)?.into_iter().filter(|n| n != LOCK && !is_partial(n)).collect();
    let has = |name: &str| names.iter().any(|n| n == name);
    if let Some(name) = foreign(folder, &names)? {
        return Ok(FolderState::Foreign(name));
    }
    Ok(match names.first() {
        None => FolderState::Nothing,
        Some(_) if has(MARKER) => match read_marker(folder).filter(|m| is_believed(m, folder, &names)) {
            Some(marker) => FolderState::Unfinished(marker),
            None => FolderState::Foreign(format!("{MARKER}, and not the {CASE} that it names")),
        },
        Some(_) if has(LAST) && has("summary.json") => FolderState::Finished,
        Some(first) => FolderState::Foreign(first.clone()),
    })
}

/// A file that no run wrote, in the folder or among its frames.
fn foreign(folder: &Path, names: &[String]) -> Result<Option<String>> {
    let ours = |n: &String| OWN.contains(&n.as_str()) || n == LAST || n == MARKER;
    if let Some(name) = names.iter().find(|n| !ours(n)) {
        return Ok(Some(name.clone()));
    }
    let frames = Some(folder.join("frames")).filter(|frames| frames.is_dir());
    let frames = frames.map_or(Ok(Vec::new()), |frames| sorted(&frames))?;
    let is_frame = |n: &String| n.starts_with("run_") && n.ends_with(".vtu") || is_partial(n);
    Ok(frames.iter().find(|n| !is_frame(n)).map(|n| format!("frames/{n}")))
}

/// A run that was killed before it wrote its case has written nothing else.
fn is_believed(marker: &RunIdentity, folder: &Path, names: &[String]) -> bool {
    case_sha256(folder).map_or(names.len() == 1, |sha256| sha256 == marker.case_sha256)
}

fn case_sha256(folder: &Path) -> Option<String> {
    std::fs::read(folder.join(CASE)).ok().map(|bytes| sha256(&bytes))
}

fn read_marker(folder: &Path) -> Option<RunIdentity> {
    UNFINISHED.read(MARKER, &std::fs::read_to_string(folder.join(MARKER)).ok()?, "").ok()
}

fn take(folder: &Path, target: &Path, interrupted: Option<RunIdentity>) -> Result<Workplace> {
    std::fs::create_dir_all(folder).map_err(|cause| unwritable(folder, &cause))?;
    let lock = File::create(folder.join(LOCK)).map_err(|cause| unwritable(folder, &cause))?;
    if let Err(std::fs::TryLockError::WouldBlock) = lock.try_lock() {
        let help = "wait for it, or choose another folder with --out";
        return Err(FemError::folder(folder, "another run is writing to it", help));
    }
    sweep(folder)?;
    sweep(&folder.join("frames"))?;
    let target = target.to_path_buf();
    Ok(Workplace { folder: folder.to_path_buf(), interrupted, target, _lock: lock })
}

type FolderStep<'a> = &'a dyn Fn() -> Result<()>;

impl Workplace {
    /// Clears away an earlier run and marks the folder as a run in progress. Killed at any point, the folder is known as
    /// an unfinished run: of the earlier case until its files are gone, then of this one.
    pub(super) fn start(&self, marker: &RunIdentity, text: &str) -> Result<()> {
        self.begin(marker, text, &mut |step| step())
    }

    fn begin(&self, marker: &RunIdentity, text: &str, take: &mut dyn FnMut(FolderStep) -> Result<()>) -> Result<()> {
        if let (Some(case_sha256), false) = (case_sha256(&self.folder), self.folder.join(MARKER).exists()) {
            take(&|| self.mark(&RunIdentity { case_sha256: case_sha256.clone(), ..marker.clone() }))?;
        }
        // The case is the first of its files.
        for name in [LAST].iter().chain(OWN.iter().rev()) {
            take(&|| remove(&self.folder.join(name)))?;
        }
        take(&|| self.mark(marker))?;
        take(&|| self.keep_case(text))
    }

    fn mark(&self, marker: &RunIdentity) -> Result<()> {
        let text = format!("{:#}\n", UNFINISHED.stamped(marker));
        write(&self.folder.join(MARKER), text.as_bytes())
    }

    /// Writes the case, which a kill right after the mark leaves out.
    pub(crate) fn keep_case(&self, text: &str) -> Result<()> {
        write(&self.folder.join(CASE), text.as_bytes())
    }

    /// The files of the run, for its manifest.
    pub(super) fn files(&self) -> Result<Vec<(String, Vec<u8>)>> {
        let mut found = Vec::new();
        for name in OWN.iter().filter(|name| !name.starts_with("checkpoint")) {
            let path = self.folder.join(name);
            let inner = match path.is_dir() {
                true => sorted(&path)?.into_iter().map(|file| format!("{name}/{file}")).collect(),
                false if path.exists() => vec![name.to_string()],
                false => Vec::new(),
            };
            for file in inner {
                let bytes = std::fs::read(self.folder.join(&file)).map_err(|cause| unwritable(&path, &cause))?;
                found.push((file, bytes));
            }
        }
        Ok(found)
    }

    /// Writes the manifest, and lets the complete run take its place; returns a notice on an older one that was there.
    pub(super) fn complete(self, manifest: &Manifest) -> Result<Option<String>> {
        write(&self.folder.join(LAST), manifest.text().as_bytes())?;
        for name in [MARKER, "checkpoint", "checkpoint.previous", LOCK] {
            remove(&self.folder.join(name))?;
        }
        if self.folder == self.target {
            return Ok(None);
        }
        let exchanged = exchange(&self.folder, &self.target, &aside(&self.target));
        exchanged.map_err(|cause| unwritable(&self.target, &cause))?;
        match look(&self.folder)? {
            FolderState::Finished => remove(&self.folder).map(|()| None),
            _ => Ok(Some(format!("kept the older run in {}: other files are with it", self.folder.display()))),
        }
    }
}

/// Removes what a kill left behind; whoever holds the lock is alone.
fn sweep(folder: &Path) -> Result<()> {
    let leftovers = folders::names(folder).unwrap_or_default().into_iter().filter(|name| is_partial(name));
    leftovers.map(|name| folder.join(name)).try_for_each(|path| remove(&path))
}

fn sorted(folder: &Path) -> Result<Vec<String>> {
    folders::names(folder).map_err(|cause| unwritable(folder, &cause))
}

/// Removes a file or a folder that a run made, if it is there.
fn remove(path: &Path) -> Result<()> {
    folders::remove(path).map_err(|cause| unwritable(path, &cause))
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
