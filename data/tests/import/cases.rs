//! Files as people have them.

use super::{equals_reference, known, pixels, read, refused, told};
use data::import::{ImportOptions, Scale};

#[test]
fn deeplabcut_is_scaled_placed_joined_and_its_wild_points_are_lost() {
    let files = ["cases/c01-deeplabcut/run1.csv", "cases/c01-deeplabcut/run2.csv", "cases/c01-deeplabcut/run3.csv"];
    let made = read(&files, &pixels("cases/c01-deeplabcut/pressure.csv"));
    let lost = equals_reference(&made, 3, 0.0);
    assert_eq!(lost, ["1", "2", "3"].map(|run| (run.to_string(), "6.0000".to_string(), "b".to_string())));
    told(&made, &["read as DeepLabCut", "3.1 px", "3 positions below the limit", "towards the actuator its -y"]);
    assert_eq!((made.dataset.runs.len(), made.dataset.holds.len(), made.about.markers.len()), (3, 5, 3));
    assert_eq!(made.program, "DeepLabCut");
    let files = &files[..1];
    refused(
        files,
        &ImportOptions { frames_per_s: None, ..pixels("cases/c01-deeplabcut/pressure.csv") },
        &["run1.csv", "frames", "--fps 30"],
    );
    refused(
        files,
        &ImportOptions { base: None, ..pixels("cases/c01-deeplabcut/pressure.csv") },
        &["base", "--base X,Y"],
    );
    refused(
        files,
        &ImportOptions { scale: Scale::OfFile, ..pixels("cases/c01-deeplabcut/pressure.csv") },
        &["scale", "--scale 3.1px/mm"],
    );
    refused(
        files,
        &ImportOptions { pressure_logs: Vec::new(), ..pixels("cases/c01-deeplabcut/pressure.csv") },
        &["pressure", "--pressure"],
    );
    refused(
        files,
        &ImportOptions { actuator: None, ..pixels("cases/c01-deeplabcut/pressure.csv") },
        &["actuator", "--actuator"],
    );
}

#[test]
fn motive_gives_its_unit_and_its_plane_is_found() {
    let files = ["cases/c02-motive/vine_1.csv", "cases/c02-motive/vine_2.csv", "cases/c02-motive/vine_3.csv"];
    let made = read(&files, &known("cases/c02-motive/pressure.csv"));
    let lost = equals_reference(&made, 3, 6e-4);
    assert_eq!(lost, ["1", "2", "3"].map(|run| (run.to_string(), "8.0000".to_string(), "b".to_string())));
    told(&made, &["Motive", "lengths are in m", "towards the actuator its -z", "3 positions blank"]);
}

#[test]
fn motion_capture_of_vicon_trc_and_qualisys_equals_the_reference() {
    let [vicon, qualisys] = [("c21-vicon-nexus/trial", "csv"), ("c23-qualisys-tsv/m", "tsv")]
        .map(|(stem, end)| [1, 2, 3].map(|run| format!("cases/{stem}{run}.{end}")));
    let log = known("cases/c01-deeplabcut/pressure.csv");
    let made = read(&vicon.each_ref().map(String::as_str), &log);
    assert_eq!(equals_reference(&made, 3, 0.0).len(), 2, "{:?}", made.told);
    told(&made, &["read as Vicon Nexus", "lengths are in mm", "towards the actuator its z", "2 positions blank"]);
    let made = read(&["cases/c22-trc/run1.trc"], &log);
    assert!(equals_reference(&made, 1, 0.0).is_empty());
    told(&made, &["read as TRC (OpenSim)", "lengths are in mm"]);
    let made = read(&qualisys.each_ref().map(String::as_str), &log);
    let lost = equals_reference(&made, 3, 6e-4);
    assert!(!lost.is_empty(), "{:?}", made.told);
    told(&made, &["read as Qualisys (TSV)", "written as 0, 0"]);
}

#[test]
fn both_kinds_of_kinovea_are_read() {
    let table = read(&["cases/c04-kinovea/run1_kinematics.csv"], &known("cases/c01-deeplabcut/pressure.csv"));
    assert!(equals_reference(&table, 1, 6e-3).is_empty());
    told(&table, &["Kinovea, kinematics", "lengths are in cm"]);
    let options = ImportOptions {
        markers: ["a", "b", "c"].map(String::from).to_vec(),
        ..pixels("cases/c01-deeplabcut/pressure.csv")
    };
    let text = read(&["cases/c04-kinovea/run1_trajectories.txt"], &options);
    assert!(equals_reference(&text, 1, 2e-3).is_empty());
    told(&text, &["Kinovea, trajectories", "numbered from the base outwards"]);
}

#[test]
fn a_wide_table_needs_nothing_else() {
    let made = read(&["cases/c07-table-dialects/wide.csv"], &ImportOptions::default());
    assert!(equals_reference(&made, 3, 0.0).is_empty());
    told(&made, &["a wide table", "lengths are in mm", "columns that are not used: phase"]);
}

#[test]
fn this_program_s_own_table_and_any_long_table_are_read() {
    let made = read(&["cases/reference_markers.csv"], &ImportOptions::default());
    assert!(equals_reference(&made, 3, 0.0).is_empty());
    told(&made, &["a long table"]);
}

#[test]
fn a_ramp_is_binned() {
    refused(&["cases/c10-ramp/markers.csv"], &ImportOptions::default(), &["--bin 2kPa"]);
    let made = read(&["cases/c10-ramp/markers.csv"], &ImportOptions { bin_pa: Some(2e3), ..ImportOptions::default() });
    assert_eq!(made.dataset.runs.len(), 3);
    told(&made, &["steps of 2 kPa"]);
}
