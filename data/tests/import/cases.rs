//! Tracking files as laboratories have them, with their usual faults.

use super::{case, equals_reference, known, pixels, read, refused, told};
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

/// The reference's first run, whose first frame is at 1 s.
fn equals_first_run(made: &data::import::Imported) {
    let reference = super::reference();
    let found = super::rows(&made.markers_csv);
    assert_eq!(found.len(), 45, "{:?}", made.told);
    for ((_, time, marker), cells) in &found {
        let time = format!("{:.4}", time.parse::<f64>().unwrap() + 1.0);
        let right = &reference[&("1".to_string(), time, marker.clone())];
        assert_eq!(cells[3..6], right[3..6]);
        let off = |k: usize| (cells[k].parse::<f64>().unwrap() - right[k].parse::<f64>().unwrap()).abs();
        assert!(off(7) <= 1.01e-4 && off(8) <= 1.01e-4, "{marker}: {cells:?} and not {right:?}");
    }
}

#[test]
fn topics_of_ros_in_one_file_or_a_file_for_every_marker_equal_the_reference() {
    let options = ImportOptions { body_pa: Some(2e3), ..known("cases/c25-ros-echo/pressure.csv") };
    let files = ["a", "b", "c"].map(|name| format!("cases/c25-ros-echo/marker_{name}.csv"));
    let made = read(&files.each_ref().map(String::as_str), &options);
    equals_first_run(&made);
    assert_eq!(made.dataset.runs, ["1"]);
    told(
        &made,
        &["read as ROS (topic print): 1 run, 15 frames", "lengths are in m", "here at 1766000001.000", "of ROS"],
    );
    let names = ["a", "b", "c"].map(String::from).to_vec();
    equals_first_run(&read(
        &["cases/c25-ros-echo/all_markers.csv"],
        &ImportOptions { markers: names, ..options.clone() },
    ));
    let names = ["a", "b", "c"].map(String::from).to_vec();
    equals_first_run(&read(&["made/ros_transforms.csv"], &ImportOptions { markers: names, ..options.clone() }));
    let folder = tempfile::tempdir().unwrap();
    let late =
        std::fs::read_to_string(case("cases/c25-ros-echo/marker_a.csv")).unwrap().replace("17660000", "17661000");
    let path = folder.path().join("marker_d.csv");
    std::fs::write(&path, late).unwrap();
    let files = [case("cases/c25-ros-echo/marker_a.csv"), path];
    let found = data::import::import(&files, &options, &mut |_, _| ()).unwrap_err().to_string();
    assert!(found.contains("no frame is within the pressure log"), "files of other times are other runs: {found}");
}

#[test]
fn binary_files_are_named_by_their_first_bytes() {
    let hdf5 = |inside: &[u8]| [b"\x89HDF\r\n\x1a\n\0\0", inside].concat();
    let folder = tempfile::tempdir().unwrap();
    for (bytes, name, export) in [
        (hdf5(b"df_with_missing\0block0_values"), "DeepLabCut", "save_as_csv"),
        (hdf5(b"node_names\0"), "SLEAP", "Export Analysis CSV"),
        (hdf5(b"_NCProperties\0"), "netCDF", "to_dlc_file"),
        (hdf5(b"else"), "HDF5", "to_csv"),
        (b"CDF\x01\0".to_vec(), "netCDF", "to_dlc_file"),
        (b"MATLAB 5.0 MAT-file, Platform: GLNXA64".to_vec(), "MATLAB", "writetable"),
        ([b"MATLAB 7.3 MAT-file", &[b' '; 493][..], &hdf5(b"")].concat(), "MATLAB", "writetable"),
        (b"TDSm\x0e\0\0\0".to_vec(), "TDMS", "rename_axis('time_s')"),
        (b"PK\x03\x04\x14\0xl/workbook.xml".to_vec(), "Excel", "CSV UTF-8"),
        (b"PK\x03\x04\x14\0run1.csv".to_vec(), "zip", "unpack"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1".to_vec(), "Excel", "CSV UTF-8"),
        (b"\x02\x50\x03\0".to_vec(), "C3D", "TRC"),
        (b"\0\0\0\x20ftypisom".to_vec(), "video", "track the markers"),
        (b"\0\x01\x02".to_vec(), "not text", "CSV"),
    ] {
        let path = folder.path().join("file");
        std::fs::write(&path, bytes).unwrap();
        super::refused_paths(std::slice::from_ref(&path), &ImportOptions::default(), &[name, export]);
        let log = ImportOptions { pressure_logs: vec![path], ..pixels("cases/c01-deeplabcut/pressure.csv") };
        refused(&["cases/c01-deeplabcut/run1.csv"], &log, &[name, export]);
    }
    let path = folder.path().join("large.h5");
    std::fs::write(&path, hdf5(b"")).unwrap();
    std::fs::OpenOptions::new().write(true).open(&path).unwrap().set_len(3 << 30).unwrap();
    super::refused_paths(&[path], &ImportOptions::default(), &["HDF5", "to_csv"]);
    let path = folder.path().join("zeros.csv");
    std::fs::File::create(&path).unwrap().set_len(1 << 41).unwrap();
    super::refused_paths(&[path], &ImportOptions::default(), &["zeros.csv: the file is not text", "CSV"]);
}
