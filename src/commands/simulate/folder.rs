//! The folder of a run: what it holds, who may write to it, and how a complete run takes the place of an older one.

use super::write_failure;
use crate::failure::Failure;
use crate::output::sha256;
use serde_json::{Value, json};
use std::fs::File;
use std::path::{Path, PathBuf};

/// There while a run is not complete; says what it is a run of.
const MARKER: &str = "unfinished.json";
/// The last file of a complete run.
const LAST: &str = "manifest.json";
/// Held by the process that writes to the folder.
const LOCK: &str = ".lock";
/// Everything that a run leaves behind, folders too.
const OWN: &[&str] = &[
    "case.toml",
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
];

/// What tells one run from another, besides the case itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// SHA-256 of the case's text.
    pub case_sha256: String,
    /// Simulated time \[s\].
    pub end_s: f64,
    /// Whether frames are written.
    pub frames: bool,
}

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct Wish<'a> {
    /// Folder.
    pub folder: &'a Path,
    /// Text of the case.
    pub text: &'a str,
    /// Go on with an interrupted run.
    pub resume: bool,
    /// Replace a run.
    pub force: bool,
}

/// A folder that may be written to.
#[derive(Debug)]
pub struct Workplace {
    /// Where files go while the run is not complete.
    pub folder: PathBuf,
    /// The interrupted run to go on with.
    pub interrupted: Option<Marker>,
    /// Where the complete run goes in the end.
    target: PathBuf,
    _lock: File,
}

/// What came of the wish.
#[derive(Debug)]
pub enum Opened {
    /// A run can start or go on.
    Work(Workplace),
    /// `--resume` of a run that is complete.
    Complete,
}

#[derive(Debug)]
enum Found {
    Nothing,
    Unfinished(Marker),
    Finished,
    Foreign(String),
}

/// Whether the folder holds a complete run, whatever else is in it.
pub fn is_finished(folder: &Path) -> bool {
    let has = |name| folder.join(name).exists();
    !has(MARKER) && has(LAST) && has("summary.json")
}

/// Finds out what can be done with the folder, and takes it.
///
/// # Errors
/// The folder holds another run, or files that are none of ours, or another process writes to it.
pub fn open(wish: &Wish) -> Result<Opened, Failure> {
    let refuse = |cause: &str, help: &str| Err(refused(wish.folder, cause, help));
    match (look(wish.folder)?, wish.resume, wish.force) {
        (Found::Nothing, ..) => take(wish.folder, wish.folder, None),
        (Found::Unfinished(marker), true, _) => {
            same_case(wish, &marker)?;
            take(wish.folder, wish.folder, Some(marker))
        }
        (Found::Unfinished(_), false, true) => take(wish.folder, wish.folder, None),
        (Found::Unfinished(_), false, false) => {
            refuse("it holds an interrupted run", "add --resume to go on with it, or --force to start again")
        }
        (Found::Finished, _, true) => open_beside(wish),
        (Found::Finished, true, false) => {
            // A kill after the last file of the run leaves them.
            remove(&wish.folder.join("checkpoint"))?;
            remove(&wish.folder.join("checkpoint.previous"))?;
            remove(&wish.folder.join(LOCK))?;
            Ok(Opened::Complete)
        }
        (Found::Finished, false, false) => {
            refuse("it holds a finished run", "choose another folder with --out, or add --force to replace it")
        }
        (Found::Foreign(name), ..) => {
            refuse(&format!("it holds other files ({name})"), "choose a new or empty folder with --out")
        }
    }
}

/// The new run is made beside the finished one, which stays until then.
fn open_beside(wish: &Wish) -> Result<Opened, Failure> {
    let mut name = wish.folder.file_name().unwrap_or_default().to_os_string();
    name.push(".new");
    let beside = wish.folder.with_file_name(name);
    match look(&beside)? {
        Found::Unfinished(marker) if wish.resume => {
            same_case(&Wish { folder: &beside, ..*wish }, &marker)?;
            take(&beside, wish.folder, Some(marker))
        }
        Found::Foreign(name) => {
            Err(refused(&beside, &format!("it holds other files ({name})"), "move that folder away"))
        }
        _ => take(&beside, wish.folder, None),
    }
}

fn refused(folder: &Path, cause: &str, help: &str) -> Failure {
    Failure::Write { path: folder.display().to_string(), cause: cause.into(), help: help.into() }
}

fn same_case(wish: &Wish, marker: &Marker) -> Result<(), Failure> {
    if marker.case_sha256 == sha256(wish.text.as_bytes()) {
        return Ok(());
    }
    let own = wish.folder.join("case.toml");
    let help = format!("give the case it was started with: {}; or start again with --force", own.display());
    Err(refused(wish.folder, "the interrupted run in it is of another case, or the case has changed", &help))
}

fn look(folder: &Path) -> Result<Found, Failure> {
    let names = match std::fs::read_dir(folder) {
        Ok(entries) => entries.filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned())),
        Err(_) if !folder.exists() => return Ok(Found::Nothing),
        Err(cause) => return Err(write_failure(folder, &cause)),
    };
    let has_marker = folder.join(MARKER).exists();
    // What a kill between two files can leave behind is of no use to anyone.
    let names: Vec<String> = names.filter(|n| n != LOCK && !is_leftover(n)).collect();
    if has_marker {
        let text = std::fs::read_to_string(folder.join(MARKER)).map_err(|cause| write_failure(folder, &cause))?;
        return Ok(read_marker(&text).map_or_else(|| Found::Foreign(MARKER.into()), Found::Unfinished));
    }
    match names.iter().find(|n| !OWN.contains(&n.as_str()) && *n != LAST) {
        Some(foreign) => Ok(Found::Foreign(foreign.clone())),
        None if names.is_empty() => Ok(Found::Nothing),
        None if names.iter().any(|n| n == LAST) && names.iter().any(|n| n == "summary.json") => Ok(Found::Finished),
        None => Ok(Found::Foreign(names[0].clone())),
    }
}

fn read_marker(text: &str) -> Option<Marker> {
    let value: Value = serde_json::from_str(text).ok()?;
    (value["schema"] == "ibr.unfinished" && value["version"] == 1).then_some(())?;
    Some(Marker {
        case_sha256: value["case_sha256"].as_str()?.into(),
        end_s: value["end_s"].as_f64()?,
        frames: value["frames"].as_bool()?,
    })
}

fn take(folder: &Path, target: &Path, interrupted: Option<Marker>) -> Result<Opened, Failure> {
    std::fs::create_dir_all(folder).map_err(|cause| write_failure(folder, &cause))?;
    let lock = File::create(folder.join(LOCK)).map_err(|cause| write_failure(folder, &cause))?;
    if let Err(std::fs::TryLockError::WouldBlock) = lock.try_lock() {
        return Err(refused(
            folder,
            "another run is writing to it",
            "wait for it, or choose another folder with --out",
        ));
    }
    sweep(folder)?;
    sweep(&folder.join("frames"))?;
    let target = target.to_path_buf();
    Ok(Opened::Work(Workplace { folder: folder.to_path_buf(), interrupted, target, _lock: lock }))
}

impl Workplace {
    /// Where the complete run goes in the end.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Clears away an earlier run and marks the folder as that of a run in progress.
    pub fn start(&self, marker: &Marker, text: &str) -> Result<(), Failure> {
        let value = json!({
            "schema": "ibr.unfinished", "version": 1, "case_sha256": marker.case_sha256,
            "end_s": marker.end_s, "frames": marker.frames,
        });
        // First the mark: whatever is killed from here on leaves a folder that is known as an unfinished run.
        data::write_atomically(&self.folder.join(MARKER), format!("{value:#}\n").as_bytes())?;
        for name in OWN.iter().chain(&[LAST]) {
            remove(&self.folder.join(name))?;
        }
        data::write_atomically(&self.folder.join("case.toml"), text.as_bytes())?;
        Ok(())
    }

    /// The files of the run, for its manifest.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        let mut found = Vec::new();
        for name in OWN.iter().filter(|name| !name.starts_with("checkpoint")) {
            let path = self.folder.join(name);
            let inner = match path.is_dir() {
                true => sorted(&path)?.into_iter().map(|file| format!("{name}/{file}")).collect(),
                false if path.exists() => vec![name.to_string()],
                false => Vec::new(),
            };
            for file in inner {
                let bytes = std::fs::read(self.folder.join(&file)).map_err(|cause| write_failure(&path, &cause))?;
                found.push((file, bytes));
            }
        }
        Ok(found)
    }

    /// Writes the manifest, and lets the complete run take its place.
    pub fn complete(self, manifest: &Value) -> Result<(), Failure> {
        data::write_atomically(&self.folder.join(LAST), format!("{manifest:#}\n").as_bytes())?;
        for name in [MARKER, "checkpoint", "checkpoint.previous", LOCK] {
            remove(&self.folder.join(name))?;
        }
        if self.folder == self.target {
            return Ok(());
        }
        let mut old = self.folder.as_os_str().to_os_string();
        old.push("-replaces");
        let old = PathBuf::from(old);
        remove(&old)?;
        let moved = std::fs::rename(&self.target, &old).and_then(|()| std::fs::rename(&self.folder, &self.target));
        moved.map_err(|cause| write_failure(&self.target, &cause))?;
        remove(&old)
    }
}

/// A file that was being written when a run was killed.
fn is_leftover(name: &str) -> bool {
    name.ends_with(".partial") || (name.starts_with('.') && name.ends_with(".tmp"))
}

/// Removes what a kill left behind.
fn sweep(folder: &Path) -> Result<(), Failure> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(()) };
    let leftovers = entries.filter_map(|e| Some(e.ok()?.path()));
    leftovers.filter(|p| is_leftover(&p.file_name().unwrap_or_default().to_string_lossy())).try_for_each(|p| remove(&p))
}

fn sorted(folder: &Path) -> Result<Vec<String>, Failure> {
    let entries = std::fs::read_dir(folder).map_err(|cause| write_failure(folder, &cause))?;
    let mut names: Vec<String> =
        entries.filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned())).collect();
    names.sort();
    Ok(names)
}

/// Removes a file or a folder that a run made, if it is there.
fn remove(path: &Path) -> Result<(), Failure> {
    let removed = match path.symlink_metadata() {
        Err(_) => return Ok(()),
        Ok(about) if about.is_dir() => std::fs::remove_dir_all(path),
        Ok(_) => std::fs::remove_file(path),
    };
    removed.map_err(|cause| write_failure(path, &cause))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_an_interrupted_run_comes_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        // The robots' end, which is not 0.46, and sums as ramps make them.
        let ends = [0.04 + 0.36 + 0.06].into_iter().chain((1..500).map(|i| 0.1 * f64::from(i) + 1.0 / f64::from(i)));
        for end_s in ends {
            let marker = Marker { case_sha256: "ab".into(), end_s, frames: false };
            let Ok(Opened::Work(place)) = take(folder.path(), folder.path(), None) else { panic!("not taken") };
            place.start(&marker, "").unwrap();
            let Ok(Found::Unfinished(read)) = look(folder.path()) else { panic!("no marker") };
            assert_eq!(read.end_s.to_bits(), end_s.to_bits(), "{end_s}");
        }
    }
}
