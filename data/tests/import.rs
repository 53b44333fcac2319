//! Files of tracking programs against the marker table that they were made from.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

use std::collections::BTreeMap;
use std::path::PathBuf;

use data::import::{Imported, Options, Place, Scale, import};

fn case(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(file)
}

fn read(files: &[&str], options: &Options) -> Imported {
    let files: Vec<PathBuf> = files.iter().map(|file| case(file)).collect();
    import(&files, options, &mut |_, _| ()).unwrap_or_else(|error| panic!("{error}\n{}", error.help()))
}

fn refused(files: &[&str], options: &Options, words: &[&str]) {
    let files: Vec<PathBuf> = files.iter().map(|file| case(file)).collect();
    let error = import(&files, options, &mut |_, _| ()).unwrap_err();
    let said = format!("{error} | {}", error.help());
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

/// What all of these files come from.
fn known(log: &str) -> Options {
    Options { pressure_logs: vec![case(log)], actuator: Some("epam".into()), ..Options::default() }
}

/// 3.1 px to a millimetre, the base at pixel 212, 540.
fn pixels(log: &str) -> Options {
    Options {
        scale: Scale::PixelsPerMetre(3100.0),
        base: Some(Place::At(vec![212.0, 540.0])),
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

/// Every row is that of the reference, to what the file's digits allow; returns the rows without a position.
fn equals_reference(made: &Imported, runs: usize, digits_mm: f64) -> Vec<(String, String, String)> {
    let reference = rows(&std::fs::read_to_string(case("reference_markers.csv")).unwrap());
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

#[test]
fn deeplabcut_is_scaled_placed_joined_and_its_wild_points_are_lost() {
    let files = ["c01-deeplabcut/run1.csv", "c01-deeplabcut/run2.csv", "c01-deeplabcut/run3.csv"];
    let made = read(&files, &pixels("c01-deeplabcut/pressure.csv"));
    let lost = equals_reference(&made, 3, 0.0);
    assert_eq!(lost, ["1", "2", "3"].map(|run| (run.to_string(), "6.0000".to_string(), "b".to_string())));
    told(&made, &["written by DeepLabCut", "3.1 px", "3 positions are below the limit", "towards the actuator its -y"]);
    assert_eq!((made.dataset.runs.len(), made.dataset.holds.len(), made.about.markers.len()), (3, 5, 3));
    assert_eq!(made.program, "DeepLabCut");
    let files = &files[..1];
    refused(
        files,
        &Options { frames_per_s: None, ..pixels("c01-deeplabcut/pressure.csv") },
        &["run1.csv", "frames", "--fps 30"],
    );
    refused(files, &Options { base: None, ..pixels("c01-deeplabcut/pressure.csv") }, &["base", "--base X,Y"]);
    refused(
        files,
        &Options { scale: Scale::OfFile, ..pixels("c01-deeplabcut/pressure.csv") },
        &["scale", "--scale 3.1px/mm"],
    );
    refused(
        files,
        &Options { pressure_logs: Vec::new(), ..pixels("c01-deeplabcut/pressure.csv") },
        &["pressure", "--pressure"],
    );
    refused(files, &Options { actuator: None, ..pixels("c01-deeplabcut/pressure.csv") }, &["actuator", "--actuator"]);
}

#[test]
fn motive_gives_its_unit_and_its_plane_is_found() {
    let files = ["c02-motive/vine_1.csv", "c02-motive/vine_2.csv", "c02-motive/vine_3.csv"];
    let made = read(&files, &known("c02-motive/pressure.csv"));
    let lost = equals_reference(&made, 3, 6e-4);
    assert_eq!(lost, ["1", "2", "3"].map(|run| (run.to_string(), "8.0000".to_string(), "b".to_string())));
    told(&made, &["Motive", "lengths are in m", "towards the actuator its -z", "3 positions are blank"]);
}

#[test]
fn both_kinds_of_kinovea_are_read() {
    let table = read(&["c04-kinovea/run1_kinematics.csv"], &known("c01-deeplabcut/pressure.csv"));
    assert!(equals_reference(&table, 1, 6e-3).is_empty());
    told(&table, &["Kinovea, kinematics", "lengths are in cm"]);
    let options =
        Options { markers: ["a", "b", "c"].map(String::from).to_vec(), ..pixels("c01-deeplabcut/pressure.csv") };
    let text = read(&["c04-kinovea/run1_trajectories.txt"], &options);
    assert!(equals_reference(&text, 1, 2e-3).is_empty());
    told(&text, &["Kinovea, trajectories", "numbered from the base outwards"]);
}

#[test]
fn a_wide_table_needs_nothing_else() {
    let made = read(&["c07-table-dialects/wide.csv"], &Options::default());
    assert!(equals_reference(&made, 3, 0.0).is_empty());
    told(&made, &["a wide table", "lengths are in mm"]);
}

#[test]
fn this_program_s_own_table_and_any_long_table_are_read() {
    let made = read(&["reference_markers.csv"], &Options::default());
    assert!(equals_reference(&made, 3, 0.0).is_empty());
    told(&made, &["a long table"]);
}

#[test]
fn a_ramp_is_binned() {
    refused(&["c10-ramp/markers.csv"], &Options::default(), &["--bin 2kPa"]);
    let made = read(&["c10-ramp/markers.csv"], &Options { bin_pa: Some(2e3), ..Options::default() });
    assert_eq!(made.dataset.runs.len(), 3);
    told(&made, &["steps of 2 kPa"]);
}
