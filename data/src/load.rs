//! From what a user types to a dataset: an embedded set, a folder, a CSV or a Parquet file.

use std::path::Path;

use crate::about::{About, read_about};
use crate::dataset::Dataset;
use crate::error::{DataError, Result};
use crate::lines::Progress;
use crate::parquet::read_parquet;
use crate::read::{ReadOptions, parse_markers, read_markers_of};
use crate::sets::{names, set_about, set_file, shown};
use crate::table::TableReader;

/// A dataset, and its description where it has one.
type LoadedSet = (Dataset, Option<About>);

/// Loads the dataset that `spec` names: an embedded set, a folder with `markers.csv` (or `.parquet`) and `about.toml`,
/// a `.csv` or a `.parquet` file (an `about.toml` next to it is used). `#kind` at the end chooses one actuator.
///
/// # Errors
/// Nothing of that name, or any fault of its files.
pub fn load(spec: &str, progress: Progress) -> Result<(Dataset, Option<About>)> {
    let (place, actuator) = split_kind(spec);
    if names().contains(&place) {
        return load_set(place, actuator, progress);
    }
    let path = Path::new(place);
    if path.is_dir() {
        return load_folder(path, actuator, progress);
    }
    if !path.exists() {
        return Err(nothing(place));
    }
    load_file(path, actuator, progress)
}

/// `markers.csv#epam` → (`markers.csv`, `epam`), unless a file of the full name exists.
fn split_kind(spec: &str) -> (&str, Option<&str>) {
    match spec.rsplit_once('#') {
        Some((place, kind)) if !kind.is_empty() && !Path::new(spec).exists() => (place, Some(kind)),
        _ => (spec, None),
    }
}

fn load_set(name: &str, actuator: Option<&str>, progress: Progress) -> Result<LoadedSet> {
    let about = set_about(name)?;
    let file = shown(name, "markers.csv");
    let text = set_file(name, "markers.csv").map_err(|_| {
        let message = format!("the set {name} has no marker positions");
        let help = "it holds published tables only; `ibr data list` shows the sets with marker positions";
        DataError::file(&file, message, help)
    })?;
    let options = ReadOptions { about: Some(&about), actuator, bytes_total: text.len() as u64 };
    let mut dataset = parse_markers(&file, &mut text.as_bytes(), options, progress)?;
    dataset.name = name.to_string();
    Ok((dataset, Some(about)))
}

fn load_folder(folder: &Path, actuator: Option<&str>, progress: Progress) -> Result<LoadedSet> {
    let candidates = ["markers.csv", "markers.parquet"].map(|file| folder.join(file));
    let Some(file) = candidates.iter().find(|file| file.is_file()) else {
        let (shown, message) = (folder.display().to_string(), "the folder has no markers.csv");
        let help = "put the table there as markers.csv, together with an about.toml";
        return Err(DataError::file(&shown, message, help));
    };
    let (mut dataset, about) = load_file(file, actuator, progress)?;
    let full = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    if let Some(name) = full.file_name() {
        dataset.name = name.to_string_lossy().into_owned();
    }
    Ok((dataset, about))
}

fn load_file(file: &Path, actuator: Option<&str>, progress: Progress) -> Result<LoadedSet> {
    let beside = file.with_file_name("about.toml");
    // A link that leads nowhere was meant to be read.
    let is_there = beside.symlink_metadata().is_ok();
    let about = is_there.then(|| read_about(&beside)).transpose()?;
    let options = ReadOptions { actuator, ..ReadOptions::of(about.as_ref()) };
    let is_parquet = file.extension().is_some_and(|end| end.eq_ignore_ascii_case("parquet"));
    let dataset = if is_parquet {
        let (shown, table) = (file.display().to_string(), read_parquet(file)?);
        parse_markers(&shown, &mut TableReader::new(&table), options, progress)?
    } else {
        read_markers_of(file, options, progress)?
    };
    Ok((dataset, about))
}

fn nothing(place: &str) -> DataError {
    let known = names();
    let meant = spelling::meant(place, known.iter().copied());
    let sets = known.join(", ");
    let help = format!("{meant}give a .csv or .parquet file, a folder with markers.csv, or one of {sets}");
    DataError::file(place, "no such file, folder or embedded set", help)
}
