//! Results to disk: everything is ready in memory before the first byte is written.

use crate::context::Context;
use crate::failure::Failure;
pub use compare::extension::today;
pub use fem::session::{FileHash as Input, sha256};
use fem::session::{MANIFEST, Maker, Manifest};
use ibr::pages::{Files, Imprint};
use serde::Deserialize;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::PoisonError;

/// Writes all files into a folder, the report last; each replaces its older one only when complete.
pub fn write_files(folder: &Path, files: &Files, inputs: &[Input], context: &mut Context) -> Result<(), Failure> {
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    write_all(folder, files, inputs)?;
    *written = true;
    Ok(())
}

/// Of these names those that an earlier manifest in the folder lists, with the bytes that it lists: files that this program wrote
/// and nobody changed.
fn earlier(folder: &Path, names: &[String]) -> Vec<String> {
    #[derive(Deserialize)]
    struct Listed {
        outputs: Vec<Input>,
    }
    let text = std::fs::read_to_string(folder.join("manifest.json")).unwrap_or_default();
    let listed = MANIFEST.read::<Listed>("manifest.json", &text, "").map_or(Vec::new(), |manifest| manifest.outputs);
    let same = |name: &str, hash: &str| std::fs::read(folder.join(name)).is_ok_and(|bytes| sha256(&bytes) == hash);
    let stale = listed.into_iter().filter(|ours| names.contains(&ours.name) && same(&ours.name, &ours.sha256));
    stale.map(|ours| ours.name).collect()
}

/// Refuses a folder that cannot be made, before time is spent on its contents.
pub fn check_folder(folder: &Path) -> Result<(), Failure> {
    // An empty ancestor is the current folder.
    match folder.ancestors().find(|a| !a.as_os_str().is_empty() && a.exists()) {
        Some(there) if !there.is_dir() => Err(unwritable(folder, &format!("{} is a file", there.display()))),
        _ => Ok(()),
    }
}

/// The same for a set of data, which replaces one only with --force.
pub fn check_set_folder(folder: &Path, force: bool) -> Result<(), Failure> {
    let there = [("seal.toml", "a challenge"), ("markers.csv", "a dataset")];
    match there.iter().find(|(file, _)| !force && folder.join(file).exists()) {
        Some((_, what)) => {
            let message = format!("{} already holds {what}", folder.display());
            Err(Failure::usage(message, "choose another folder, or add --force to replace it"))
        }
        None => check_folder(folder),
    }
}

/// Refuses to write over a file that was read.
pub fn spares_inputs(folder: &Path, files: &Files, inputs: &[String]) -> Result<(), Failure> {
    let read: Vec<_> = inputs.iter().filter_map(|file| std::fs::canonicalize(file).ok()).collect();
    let same = |name: &&String| std::fs::canonicalize(folder.join(name)).is_ok_and(|path| read.contains(&path));
    match files.files.iter().map(|(name, _)| name).find(same) {
        Some(name) => {
            let message = format!("{} was read and would be written over", folder.join(name).display());
            Err(Failure::usage(message, "choose another folder with --out"))
        }
        None => Ok(()),
    }
}

/// What a set in a folder is called.
pub fn set_name(folder: &Path, default: &str) -> String {
    folder.file_name().map_or(default.into(), |name| name.to_string_lossy().into_owned())
}

fn unwritable(folder: &Path, cause: &str) -> Failure {
    Failure::Write {
        path: folder.display().to_string(),
        cause: cause.to_string(),
        help: "choose another folder with --out".into(),
    }
}

/// Everything goes into a hidden folder first, so that a full disk or a failing table leaves earlier results alone. That folder
/// then takes the place of the older one in one step; where it cannot, file by file is renamed.
fn write_all(folder: &Path, files: &Files, inputs: &[Input]) -> Result<(), Failure> {
    let unmade = |cause| unwritable(folder, &format!("the folder cannot be made: {cause}"));
    let is_made = |name: &&String| files.files.iter().any(|(made, _)| made == *name);
    let gone: Vec<String> = files.retired.iter().filter(|name| !is_made(name)).cloned().collect();
    let retired = earlier(folder, &gone);
    let place = Place::of(folder).map_err(unmade)?;
    let result = stage(&place.staging, files, inputs).and_then(|names| {
        let moved = match place.is_beside && place.replace(&retired).is_ok() {
            true => Ok(()),
            false => place.rename(&names, &retired),
        };
        moved.map_err(|cause| unwritable(folder, &cause.to_string()))
    });
    // What is left there is of no use; a folder that cannot be removed does no harm.
    let _ = std::fs::remove_dir_all(&place.staging);
    result
}

/// A folder of results, and where they are made ready.
struct Place {
    /// The folder itself, where a link to it leads.
    folder: PathBuf,
    /// Beside it, or in it.
    staging: PathBuf,
    /// It can take the place of the folder.
    is_beside: bool,
}

impl Place {
    /// Makes the staging folder.
    fn of(folder: &Path) -> io::Result<Place> {
        let folder = match folder.canonicalize() {
            Ok(there) => there,
            Err(_) => real(folder)?,
        };
        if let Some(name) = folder.file_name().filter(|_| is_results_only(&folder)) {
            let prefix = format!(".{}.incomplete-", name.to_string_lossy());
            sweep(&folder, &prefix);
            let staging = folder.with_file_name(format!("{prefix}{}", std::process::id()));
            if std::fs::create_dir(&staging).is_ok() {
                return Ok(Place { folder, staging, is_beside: true });
            }
        }
        let staging = folder.join(format!(".incomplete-{}", std::process::id()));
        std::fs::create_dir_all(&staging)?;
        Ok(Place { folder, staging, is_beside: false })
    }

    /// The staging folder takes its place, with what else was in it.
    fn replace(&self, retired: &[String]) -> io::Result<()> {
        let Place { folder, staging, .. } = self;
        if !folder.exists() {
            return std::fs::rename(staging, folder);
        }
        let kept = |into: &Path, keep: fn(PathBuf, PathBuf) -> io::Result<()>, from: &Path| {
            let names = std::fs::read_dir(from)?.map(|entry| Ok(entry?.file_name())).collect::<io::Result<Vec<_>>>()?;
            let mut others =
                names.iter().filter(|name| !into.join(name).exists() && !retired.iter().any(|old| **name == **old));
            others.try_for_each(|name| keep(from.join(name), into.join(name)))
        };
        kept(staging, std::fs::hard_link, folder)?;
        std::fs::set_permissions(staging, std::fs::metadata(folder)?.permissions())?;
        fem::session::exchange_folders(staging, folder)?;
        // What somebody wrote there meanwhile.
        kept(folder, std::fs::rename, staging)
    }

    /// File by file; the report is the last.
    fn rename(&self, names: &[String], retired: &[String]) -> io::Result<()> {
        let Place { folder, staging, .. } = self;
        std::fs::create_dir_all(folder)?;
        names.iter().try_for_each(|name| std::fs::rename(staging.join(name), folder.join(name)))?;
        retired.iter().try_for_each(|name| std::fs::remove_file(folder.join(name)))
    }
}

/// Removes what processes that were killed made ready beside a folder, where the system tells whether they live.
fn sweep(folder: &Path, prefix: &str) {
    let Some(entries) = folder.parent().and_then(|above| std::fs::read_dir(above).ok()) else { return };
    let processes = Path::new("/proc");
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let process = name.strip_prefix(prefix).filter(|id| id.bytes().all(|byte| byte.is_ascii_digit()));
        if process.is_some_and(|id| processes.join("self").exists() && !processes.join(id).exists()) {
            // What cannot be removed does no harm.
            let _ = std::fs::remove_dir_all(&path);
        }
    }
}

/// Where a folder will be that is not there yet; those above it are made.
fn real(folder: &Path) -> io::Result<PathBuf> {
    let above = folder.parent().filter(|above| !above.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(above)?;
    Ok(folder.file_name().map_or_else(|| folder.to_path_buf(), |name| above.join(name)))
}

/// A folder that nobody misses when another takes its place: files only, and nobody at work in it.
fn is_results_only(folder: &Path) -> bool {
    let is_here = std::env::current_dir().is_ok_and(|here| here.starts_with(folder));
    let Ok(mut entries) = std::fs::read_dir(folder) else { return !folder.exists() };
    !is_here && entries.all(|entry| entry.and_then(|e| e.file_type()).is_ok_and(|kind| kind.is_file()))
}

/// Writes all files into the staging folder; returns their names, the report last.
fn stage(staging: &Path, files: &Files, inputs: &[Input]) -> Result<Vec<String>, Failure> {
    let (mut names, mut outputs) = (Vec::new(), Vec::new());
    for (name, table) in &files.parquet {
        let path = staging.join(name);
        table.to_parquet(&path)?;
        let bytes = std::fs::read(&path).map_err(|cause| unwritable(staging, &format!("{name}: {cause}")))?;
        outputs.push(Input::of(name, &bytes));
        names.push(name.clone());
    }
    outputs.extend(files.files.iter().map(|(name, bytes)| Input::of(name, bytes)));
    let manifest = Manifest { maker: maker(), inputs: inputs.to_vec(), outputs, cost: None }.text();
    data::write_atomically(&staging.join("manifest.json"), manifest.as_bytes())?;
    names.push("manifest.json".into());
    for (name, bytes) in &files.files {
        data::write_atomically(&staging.join(name), bytes)?;
        names.push(name.clone());
    }
    Ok(names)
}

/// Who makes files.
pub fn maker() -> Maker {
    let command = std::env::args_os().map(|a| a.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ");
    Maker { program: program(), date: today(), machine: machine(), command }
}

/// Program and version.
pub fn program() -> String {
    format!("ibr {}", env!("CARGO_PKG_VERSION"))
}

/// Origin of a report.
pub fn imprint() -> Imprint {
    Imprint { program: program(), date: today(), machine: machine() }
}

/// Processor and number of cores, for timings.
pub fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let cpu = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|l| l.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_string())
    });
    let cpu = cpu.unwrap_or_else(|| std::env::consts::ARCH.to_string());
    format!("{cpu}, {cores} cores, {}", std::env::consts::OS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_earlier_report_s_files_are_known_by_name_and_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let files =
            Files { files: vec![("a.png".into(), b"a".to_vec()), ("b.png".into(), b"b".to_vec())], ..Files::default() };
        let names = ["a.png", "b.png", "c.png"].map(String::from);
        assert!(earlier(folder.path(), &names).is_empty(), "no report");
        write_all(folder.path(), &files, &[]).unwrap();
        std::fs::write(folder.path().join("b.png"), "somebody's own").unwrap();
        std::fs::write(folder.path().join("c.png"), "never listed").unwrap();
        assert_eq!(earlier(folder.path(), &names), ["a.png"]);
        assert!(earlier(folder.path(), &names[1..]).is_empty());
    }

    fn files(names: &[&str], retired: &[&str]) -> Files {
        let files = names.iter().map(|name| (name.to_string(), b"new".to_vec())).collect();
        Files { files, retired: retired.iter().map(ToString::to_string).collect(), ..Files::default() }
    }

    fn listed(folder: &Path) -> Vec<String> {
        let names = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// In one step, and file by file where somebody keeps a folder there.
    #[test]
    fn a_new_report_replaces_the_older_one_and_nothing_else() {
        for own in ["notes.txt", "sub/notes.txt"] {
            let root = tempfile::tempdir().unwrap();
            let folder = root.path().join("report");
            write_all(&folder, &files(&["a.png", "old.png", "report.html"], &[]), &[]).unwrap();
            std::fs::create_dir_all(folder.join(own).parent().unwrap()).unwrap();
            std::fs::write(folder.join(own), "somebody's own").unwrap();
            assert_eq!(is_results_only(&folder), own == "notes.txt");
            write_all(&folder, &files(&["a.png", "report.html"], &["a.png", "old.png", "notes.txt"]), &[]).unwrap();
            let top = own.split('/').next().unwrap();
            let mut expected = ["a.png", "manifest.json", "report.html", top];
            expected.sort_unstable();
            assert_eq!(listed(&folder), expected);
            assert_eq!(std::fs::read_to_string(folder.join(own)).unwrap(), "somebody's own");
            assert_eq!(listed(root.path()), ["report"]);
        }
    }
}
