//! Files of tracking programs against the marker table that they were made from: `cases` as people have them, `kinds` a second
//! file of each kind after its public description, `formats` the list of kinds, `boards` cameras with a lens, `broken` files with damage, `clocks` pressure logs that do not run with the camera, `slips` recordings that contradict themselves.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

mod boards;
mod broken;
mod cases;
mod clocks;
mod formats;
mod kinds;
mod logs;
mod slips;

use std::collections::BTreeMap;
use std::path::PathBuf;

use data::import::{FilePlace, ImportOptions, Imported, Scale, import};

fn case(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests").join(file)
}

fn read(files: &[&str], options: &ImportOptions) -> Imported {
    let files: Vec<PathBuf> = files.iter().map(|file| case(file)).collect();
    import(&files, options, &mut |_, _| ()).unwrap_or_else(|error| panic!("{error}\n{}", error.help()))
}

fn refused(files: &[&str], options: &ImportOptions, words: &[&str]) {
    let files: Vec<PathBuf> = files.iter().map(|file| case(file)).collect();
    refused_paths(&files, options, words);
}

fn refused_paths(files: &[PathBuf], options: &ImportOptions, words: &[&str]) {
    let error = import(files, options, &mut |_, _| ()).unwrap_err();
    let said = format!("{error} | {}", error.help());
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

/// What all of these files come from.
fn known(log: &str) -> ImportOptions {
    ImportOptions { pressure_logs: vec![case(log)], actuator: Some("epam".into()), ..ImportOptions::default() }
}

/// 3.1 px to a millimetre, the base at pixel 212, 540.
fn pixels(log: &str) -> ImportOptions {
    ImportOptions {
        scale: Scale::PixelsPerMetre(3100.0),
        base: Some(FilePlace::At(vec![212.0, 540.0])),
        frames_per_s: Some(30.0),
        ..known(log)
    }
}

type Rows = BTreeMap<(String, String, String), Vec<String>>;

/// Cells of a marker table by run, time and marker.
fn rows(text: &str) -> Rows {
    let row = |line: &str| {
        let cells: Vec<String> = line.split(',').map(str::to_string).collect();
        ((cells[0].clone(), cells[2].clone(), cells[6].clone()), cells)
    };
    text.lines().skip(1).map(row).collect()
}

fn reference() -> Rows {
    rows(&std::fs::read_to_string(case("cases/reference_markers.csv")).unwrap())
}

/// Every row is that of the reference, to what the file's digits allow; returns the rows without a position.
fn equals_reference(made: &Imported, runs: usize, digits_mm: f64) -> Vec<(String, String, String)> {
    let reference = reference();
    let found = rows(&made.markers_csv);
    assert_eq!(found.len(), 45 * runs);
    let mut lost = Vec::new();
    for (key, cells) in &found {
        let right = &reference[key];
        assert_eq!(cells[..7], right[..7], "{key:?}");
        if cells[7].is_empty() {
            lost.push(key.clone());
            continue;
        }
        for k in [7, 8] {
            let off = cells[k].parse::<f64>().unwrap() - right[k].parse::<f64>().unwrap();
            assert!(off.abs() <= digits_mm + 1.01e-4, "{key:?}: {} and not {}", cells[k], right[k]);
        }
    }
    lost
}

fn told(made: &Imported, words: &[&str]) {
    let all = made.told.join("\n");
    assert!(words.iter().all(|word| all.contains(word)), "{all}");
}
