//! Results to disk: everything is ready in memory before the first byte is written.

use crate::context::Context;
use crate::failure::{Failure, Result};
pub(crate) use compare::extension::today;
pub(crate) use fem::session::{FileHash as Input, sha256};
use fem::session::{MANIFEST, Maker, Manifest};
use ibr::pages::Files;
use serde::Deserialize;
use spelling::folders::Staged;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::PoisonError;

/// Writes all files into a folder, the report last; each replaces its older one only when complete. Files that this program did not
/// write are not replaced.
pub(crate) fn write_files(folder: &Path, files: &Files, inputs: &[Input], context: &mut Context) -> Result<()> {
    let names = files.files.iter().map(|(name, _)| name).chain(files.parquet.iter().map(|(name, _)| name));
    check_own(folder, names.map(String::as_str))?;
    replace_files(folder, files, inputs, context)
}

/// The same after the command has asked itself: whatever has these names is replaced.
pub(crate) fn replace_files(folder: &Path, files: &Files, inputs: &[Input], context: &mut Context) -> Result<()> {
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    write_all(folder, files, inputs)?;
    *written = true;
    Ok(())
}

/// Writes a dataset with what made it.
pub(crate) fn write_dataset(
    folder: &Path,
    dataset: &data::Dataset,
    about: &data::About,
    truth: String,
    inputs: &[Input],
    context: &mut Context,
) -> Result<()> {
    let mut files = Files { files: data::set_files(dataset, about)?.into(), ..Files::default() };
    files.text("truth.toml", truth);
    replace_files(folder, &files, inputs, context)
}

/// Refuses to replace files of these names that no manifest in the folder lists.
fn check_own<'n>(folder: &Path, names: impl Iterator<Item = &'n str>) -> Result<()> {
    let listed = listed(folder);
    let is_own = |name: &str| name == MANIFEST_FILE || listed.iter().any(|ours| ours.name == name);
    let is_foreign = |name: &&str| folder.join(name).is_file() && (listed.is_empty() || !is_own(name));
    match names.chain([MANIFEST_FILE]).find(is_foreign) {
        Some(name) => {
            let message = format!("{} exists, and ibr did not write it", folder.join(name).display());
            Err(Failure::usage(message, "choose another folder with --out, or move the file away"))
        }
        None => Ok(()),
    }
}

/// Writes single texts, each whole or not at all. A file that is there is replaced only if its beginning has [`MADE_HERE`].
pub(crate) fn write_texts(files: &[(PathBuf, String)], context: &mut Context) -> Result<()> {
    let is_own = |path: &Path| {
        let mut start = Vec::new();
        let read = std::fs::File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut start));
        let start = String::from_utf8_lossy(&start);
        read.is_ok() && MADE_HERE.iter().any(|words| start.contains(words))
    };
    if let Some((path, _)) = files.iter().find(|(path, _)| path.exists() && !is_own(path)) {
        let message = format!("{} exists, and ibr did not write it", path.display());
        return Err(Failure::usage(message, "choose another file with --out, or move that one away"));
    }
    write_whole(files, context)
}

/// Writes files, each whole or not at all; an interrupt waits until all are written.
pub(crate) fn write_whole(files: &[(PathBuf, impl AsRef<[u8]>)], context: &mut Context) -> Result<()> {
    let mut written = context.written.lock().unwrap_or_else(PoisonError::into_inner);
    files.iter().try_for_each(|(path, bytes)| data::write_atomically(path, bytes.as_ref()))?;
    *written = true;
    Ok(())
}

/// Words of this program's texts within so many bytes from their beginning.
const MADE_HERE: [&str; 2] = ["made by ibr", "Made by: ibr"];
const BEGINNING: u64 = 512;

const MANIFEST_FILE: &str = "manifest.json";

/// The files that the manifest in a folder lists; none without one.
fn listed(folder: &Path) -> Vec<Input> {
    #[derive(Deserialize)]
    struct ListedOutputs {
        outputs: Vec<Input>,
    }
    let text = std::fs::read_to_string(folder.join(MANIFEST_FILE)).unwrap_or_default();
    MANIFEST.read::<ListedOutputs>(MANIFEST_FILE, &text, "").map_or(Vec::new(), |manifest| manifest.outputs)
}

fn unchanged(folder: &Path) -> Vec<Input> {
    let same = |ours: &Input| std::fs::read(folder.join(&ours.name)).is_ok_and(|bytes| sha256(&bytes) == ours.sha256);
    listed(folder).into_iter().filter(same).collect()
}

/// Refuses a folder that cannot be made, before time is spent on its contents.
pub(crate) fn check_folder(folder: &Path) -> Result<()> {
    check_own(folder, ["report.html", "table.csv"].into_iter())?;
    can_be_made(folder)
}

fn can_be_made(folder: &Path) -> Result<()> {
    // An empty ancestor is the current folder.
    match folder.ancestors().find(|a| !a.as_os_str().is_empty() && a.exists()) {
        Some(there) if !there.is_dir() => Err(unwritable(folder, &format!("{} is a file", there.display()))),
        _ => Ok(()),
    }
}

/// The same for a set of data, which is replaced only with `--force`.
pub(crate) fn check_set_folder(folder: &Path, force: bool) -> Result<()> {
    let there = [
        ("seal.toml", "a challenge"),
        ("markers.csv", "a dataset"),
        ("about.toml", "a description of data"),
        ("truth.toml", "a scenario"),
        ("scenario.toml", "a scenario"),
    ];
    match there.iter().find(|(file, _)| !force && folder.join(file).exists()) {
        Some((_, what)) => {
            let message = format!("{} already holds {what}", folder.display());
            Err(Failure::usage(message, "choose another folder, or add --force to replace it"))
        }
        None => can_be_made(folder),
    }
}

/// Writes made-up files that are not there yet; returns their paths.
pub(crate) fn write_example(folder: &Path, made: Vec<(String, String)>, context: &mut Context) -> Result<Vec<String>> {
    check_folder(folder)?;
    if let Some((name, _)) = made.iter().find(|(name, _)| folder.join(name).exists()) {
        let message = format!("{} exists", folder.join(name).display());
        return Err(Failure::usage(message, "give another folder to --example"));
    }
    let paths = made.iter().map(|(name, _)| folder.join(name).display().to_string()).collect();
    let mut files = Files::default();
    made.into_iter().for_each(|(name, text)| files.text(&name, text));
    write_files(folder, &files, &[], context)?;
    Ok(paths)
}

pub(crate) fn read_input(path: &Path) -> Input {
    Input::of(&path.display().to_string(), &std::fs::read(path).unwrap_or_default())
}

pub(crate) fn spares_inputs(folder: &Path, files: &Files, inputs: &[String]) -> Result<()> {
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

pub(crate) fn set_name(folder: &Path, default: &str) -> String {
    folder.file_name().map_or(default.into(), |name| name.to_string_lossy().into_owned())
}

fn unwritable(folder: &Path, cause: &str) -> Failure {
    Failure::Write {
        path: folder.display().to_string(),
        cause: cause.to_string(),
        help: "choose another folder with --out".into(),
    }
}

/// Everything goes into a hidden folder first, so that a full disk or a failing table leaves earlier results alone.
fn write_all(folder: &Path, files: &Files, inputs: &[Input]) -> Result<()> {
    let is_made = |name: &String| files.files.iter().any(|(made, _)| made == name);
    let (retired, kept) = unchanged(folder)
        .into_iter()
        .filter(|ours| !is_made(&ours.name))
        .partition::<Vec<_>, _>(|ours| files.retired.contains(&ours.name));
    let retired: Vec<String> = retired.into_iter().map(|ours| ours.name).collect();
    let unmade = |cause| unwritable(folder, &format!("the folder cannot be made: {cause}"));
    let staged = Staged::of(folder).map_err(unmade)?;
    let names = stage(staged.path(), files, inputs, kept)?;
    staged.finish(&names, &retired).map_err(|cause| unwritable(folder, &cause.to_string()))
}

/// Writes all files into the staging folder; returns their names, the report last. The manifest lists the files that are `kept` too.
fn stage(staging: &Path, files: &Files, inputs: &[Input], kept: Vec<Input>) -> Result<Vec<String>> {
    let (mut names, mut outputs) = (Vec::new(), Vec::new());
    for (name, table) in &files.parquet {
        let path = staging.join(name);
        table.to_parquet(&path, &notes(inputs))?;
        let bytes = std::fs::read(&path).map_err(|cause| unwritable(staging, &format!("{name}: {cause}")))?;
        outputs.push(Input::of(name, &bytes));
        names.push(name.clone());
    }
    outputs.extend(files.files.iter().map(|(name, bytes)| Input::of(name, bytes)));
    outputs.extend(kept.into_iter().filter(|ours| !names.contains(&ours.name)));
    let manifest = Manifest { maker: maker(), inputs: inputs.to_vec(), outputs, cost: None }.text();
    data::write_atomically(&staging.join(MANIFEST_FILE), manifest.as_bytes())?;
    names.insert(0, MANIFEST_FILE.into());
    for (name, bytes) in &files.files {
        data::write_atomically(&staging.join(name), bytes)?;
        names.push(name.clone());
    }
    Ok(names)
}

/// Program and hashes of the inputs, for the metadata of a Parquet file.
fn notes(inputs: &[Input]) -> Vec<(String, String)> {
    let hashes = inputs.iter().map(|input| (format!("ibr.sha256.{}", input.name), input.sha256.clone()));
    std::iter::once(("ibr.program".into(), program())).chain(hashes).collect()
}

/// Program, date, machine and command of the written files.
pub fn maker() -> Maker {
    let command = std::env::args_os().map(|a| a.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ");
    Maker { program: program(), date: today(), machine: machine(), command }
}

pub(crate) fn program() -> String {
    format!("ibr {}", env!("CARGO_PKG_VERSION"))
}

pub(crate) fn machine() -> String {
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

    fn files(names: &[&str], retired: &[&str]) -> Files {
        let files = names.iter().map(|name| (name.to_string(), b"new".to_vec())).collect();
        Files { files, retired: retired.iter().map(ToString::to_string).collect(), ..Files::default() }
    }

    fn names(inputs: Vec<Input>) -> Vec<String> {
        inputs.into_iter().map(|ours| ours.name).collect()
    }

    #[test]
    fn files_that_a_manifest_lists_are_replaced_and_others_are_not() {
        let folder = tempfile::tempdir().unwrap();
        let (at, asked) = (folder.path(), |name: &'static str| check_own(folder.path(), [name].into_iter()));
        write_all(at, &files(&["a.png", "b.png"], &[]), &[]).unwrap();
        std::fs::write(at.join("b.png"), "somebody's own").unwrap();
        std::fs::write(at.join("c.png"), "never listed").unwrap();
        assert_eq!(names(unchanged(at)), ["a.png"]);
        assert!(asked("a.png").is_ok() && asked("b.png").is_ok() && asked("new.png").is_ok());
        assert!(asked("c.png").unwrap_err().render().contains("c.png exists, and ibr did not write it"));
        write_all(at, &files(&["d.png"], &[]), &[]).unwrap();
        assert_eq!(names(listed(at)), ["d.png", "a.png"]);
        std::fs::write(at.join("manifest.json"), "{}").unwrap();
        assert!(asked("new.png").unwrap_err().render().contains("manifest.json exists"));
    }

    #[test]
    fn a_new_report_removes_what_it_retires_and_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("report");
        write_all(&folder, &files(&["a.png", "old.png", "report.html"], &[]), &[]).unwrap();
        std::fs::write(folder.join("notes.txt"), "somebody's own").unwrap();
        write_all(&folder, &files(&["a.png", "report.html"], &["a.png", "old.png", "notes.txt"]), &[]).unwrap();
        let expected = ["a.png", "manifest.json", "notes.txt", "report.html"];
        assert_eq!(spelling::folders::names(&folder).unwrap(), expected);
        assert_eq!(std::fs::read_to_string(folder.join("notes.txt")).unwrap(), "somebody's own");
        assert_eq!(spelling::folders::names(root.path()).unwrap(), ["report"]);
    }
}
