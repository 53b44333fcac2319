//! Results to disk: everything is ready in memory before the first byte is written.

use crate::context::Context;
use crate::failure::Failure;
pub use compare::extension::today;
pub use fem::session::{FileHash as Input, sha256};
use fem::session::{MANIFEST, Maker, Manifest};
use ibr::pages::{Files, Imprint};
use serde::Deserialize;
use std::path::Path;
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
pub fn earlier(folder: &Path, names: &[String]) -> Vec<String> {
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

/// Removes files from a folder.
pub fn remove_all<'n>(folder: &Path, names: impl Iterator<Item = &'n String>) -> Result<(), Failure> {
    for name in names {
        let removed = std::fs::remove_file(folder.join(name));
        removed.map_err(|cause| unwritable(folder, &format!("{name}, of an earlier report: {cause}")))?;
    }
    Ok(())
}

/// Refuses a folder that cannot be made, before time is spent on its contents.
pub fn check_folder(folder: &Path) -> Result<(), Failure> {
    // An empty ancestor is the current folder.
    match folder.ancestors().find(|a| !a.as_os_str().is_empty() && a.exists()) {
        Some(there) if !there.is_dir() => Err(unwritable(folder, &format!("{} is a file", there.display()))),
        _ => Ok(()),
    }
}

/// The same for a set of data, which replaces one only if told.
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

/// Everything goes into a hidden folder first, so that a full disk or a failing table leaves earlier results alone; then
/// file by file is renamed into place.
fn write_all(folder: &Path, files: &Files, inputs: &[Input]) -> Result<(), Failure> {
    let staging = folder.join(format!(".incomplete-{}", std::process::id()));
    let made = std::fs::create_dir_all(&staging);
    made.map_err(|cause| unwritable(folder, &format!("the folder cannot be made: {cause}")))?;
    let result = stage(&staging, files, inputs).and_then(|names| {
        names.iter().try_for_each(|name| {
            let moved = std::fs::rename(staging.join(name), folder.join(name));
            moved.map_err(|cause| unwritable(folder, &format!("{name}: {cause}")))
        })
    });
    // What is left there is of no use; a folder that cannot be removed does no harm.
    let _ = std::fs::remove_dir_all(&staging);
    result
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

/// What a report says of its origin.
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
        remove_all(folder.path(), [names[0].clone()].iter()).unwrap();
        assert!(!folder.path().join("a.png").exists() && folder.path().join("b.png").exists());
    }
}
