//! A second file of each kind, made after the programs' public descriptions from the same marker table.

use super::{Rows, case, known, pixels, read, reference, refused, refused_paths, rows, told};
use data::import::{FilePlace, ImportOptions, Imported, Scale, import};

const LOG: &str = "cases/c01-deeplabcut/pressure.csv";

/// Rows of a run, which must be those of a run of the reference for these markers, but for `lost` positions.
fn equals(made: &Imported, run: &str, markers: &[&str], lost: usize, digits_mm: f64) {
    let reference: Rows = reference();
    let found = rows(&made.markers_csv);
    assert_eq!(found.len(), 15 * markers.len(), "{:?}", made.told);
    let mut blank = 0;
    for ((_, time, marker), cells) in &found {
        assert!(markers.contains(&marker.as_str()), "{marker}");
        let right = &reference[&(run.to_string(), time.clone(), marker.clone())];
        assert_eq!(cells[3..6], right[3..6]);
        blank += usize::from(cells[7].is_empty());
        for k in [7, 8].into_iter().filter(|_| !cells[7].is_empty()) {
            let off = cells[k].parse::<f64>().unwrap() - right[k].parse::<f64>().unwrap();
            assert!(off.abs() <= digits_mm + 1.01e-4, "{time} s, marker {marker}: {} and not {}", cells[k], right[k]);
        }
    }
    assert_eq!(blank, lost, "{:?}", made.told);
}

#[test]
fn deeplabcut_with_several_animals() {
    let names = ["a", "c", "b"].map(String::from).to_vec();
    let made = read(&["made/deeplabcut_multi.csv"], &ImportOptions { markers: names, ..pixels(LOG) });
    equals(&made, "1", &["a", "b", "c"], 0, 0.0);
    told(&made, &["read as DeepLabCut", "vine_a, vine_c, rig_b are called a, c, b"]);
}

#[test]
fn sleap() {
    let made = read(&["made/sleap.csv"], &pixels(LOG));
    equals(&made, "2", &["a", "b", "c"], 2, 0.0);
    told(&made, &["read as SLEAP", "1 position blank", "1 position below the limit"]);
}

/// A newer version: millimetres, a rigid body beside the markers, along z, y up.
#[test]
fn motive_with_rigid_bodies() {
    let base = Some(FilePlace::At(vec![500.0, 0.0, 0.0]));
    let made = read(&["made/motive_mm.csv"], &ImportOptions { base, ..known(LOG) });
    let found = rows(&made.markers_csv);
    assert_eq!(found.len(), 45, "the body's own marker is one more");
    told(
        &made,
        &[
            "Motive",
            "lengths are in mm",
            "along the robot is the file's z, towards the actuator its y",
            "1 unlabeled marker",
        ],
    );
    let base = Some(FilePlace::Marker("clamp:Marker1".into()));
    equals(&read(&["made/motive_mm.csv"], &ImportOptions { base, ..known(LOG) }), "3", &["a", "b"], 0, 0.0);
}

#[test]
fn tracker_with_several_tracks_and_with_one() {
    refused(&["made/tracker_multi.txt"], &known(LOG), &["does not say the unit", "--scale mm, cm, m"]);
    let metres = ImportOptions { scale: Scale::Unit(1.0), ..known(LOG) };
    let made = read(&["made/tracker_multi.txt"], &metres);
    equals(&made, "1", &["a", "b", "c"], 0, 0.0);
    told(&made, &["read as Tracker (physlets.org)"]);
    let made = read(&["made/tracker_one.txt"], &ImportOptions { markers: vec!["c".into()], ..metres });
    equals(&made, "1", &["c"], 0, 0.0);
}

#[test]
fn kinovea_in_other_units() {
    let made = read(&["made/kinovea_seconds.csv"], &known(LOG));
    equals(&made, "2", &["a", "c"], 0, 0.0);
    let names = ["a", "c"].map(String::from).to_vec();
    let made = read(&["made/kinovea_trajectory.txt"], &ImportOptions { markers: names, ..pixels(LOG) });
    equals(&made, "2", &["a", "c"], 0, 2e-4);
}

#[test]
fn trackmate_spots_tracks_and_model() {
    let names = ["a", "b", "c"].map(String::from).to_vec();
    let base = Some(FilePlace::At(vec![50_000.0, 400_000.0]));
    let made = read(&["made/trackmate_spots.csv"], &ImportOptions { markers: names.clone(), base, ..known(LOG) });
    equals(&made, "3", &["a", "b", "c"], 0, 1e-4);
    told(&made, &["TrackMate, spots", "lengths are in µm", "1 spot of no track", "numbered from the base outwards"]);
    let made = read(&["made/trackmate_tracks.xml"], &ImportOptions { markers: names.clone(), ..pixels(LOG) });
    equals(&made, "1", &["a", "b", "c"], 0, 1e-4);
    let base = Some(FilePlace::At(vec![0.0, 300.0]));
    let made = read(&["made/trackmate_model.xml"], &ImportOptions { markers: names, base, ..known(LOG) });
    equals(&made, "1", &["a", "b", "c"], 0, 0.0);
    told(&made, &["TrackMate, XML", "1 spot of no track"]);
}

#[test]
fn wide_tables_of_pixels_and_long_tables_of_any_names() {
    let names = ["a", "b", "c"].map(String::from).to_vec();
    let made = read(&["made/wide_pixels.csv"], &ImportOptions { markers: names, ..pixels(LOG) });
    equals(&made, "1", &["a", "b", "c"], 0, 4e-4);
    let map = [
        ("run", "Trial"),
        ("marker", "Point"),
        ("t", "Elapsed (ms)"),
        ("x", "PosX (cm)"),
        ("y", "PosY (cm)"),
        ("p_act", "Sensor A (mbar)"),
        ("p_body", "Sensor B (mbar)"),
    ];
    let columns = map.map(|(what, column)| (what.to_string(), column.to_string())).to_vec();
    let options = ImportOptions { columns, actuator: Some("epam".into()), ..ImportOptions::default() };
    let made = read(&["made/long_foreign.tsv"], &options);
    assert_eq!(super::equals_reference(&made, 3, 1e-4).len(), 3);
    refused(&["made/long_foreign.tsv"], &ImportOptions::default(), &["no program is known", "--map", "DeepLabCut"]);
}

#[test]
fn anipose_and_trackpy() {
    let mm = ImportOptions { scale: Scale::Unit(1e-3), frames_per_s: Some(30.0), ..known(LOG) };
    let made = read(&["made/anipose.csv"], &mm);
    equals(&made, "1", &["a", "b", "c"], 1, 0.0);
    told(&made, &["read as Anipose (3D)", "towards the actuator its -z", "less likely than 0.9", "1 position below"]);
    let names = ["a", "b", "c"].map(String::from).to_vec();
    let made = read(&["made/trackpy.csv"], &ImportOptions { markers: names, ..pixels(LOG) });
    equals(&made, "1", &["a", "b", "c"], 0, 4e-4);
    told(&made, &["read as trackpy", "numbered from the base outwards"]);
}

/// A table with one more column for each marker, whose second row has a wild and unlikely place.
fn likely(file: &str, columns: &str, sign: char, wild: &str, count: usize) -> tempfile::NamedTempFile {
    let text = std::fs::read_to_string(case(file)).unwrap();
    let row = |(k, line): (usize, &str)| match k {
        0 => format!("{line}{sign}{columns}\n"),
        2 => format!("{}{}\n", line.replacen(wild, "999", 1), format!("{sign}0.2").repeat(count)),
        _ => format!("{line}{}\n", format!("{sign}0.95").repeat(count)),
    };
    let made = tempfile::Builder::new().suffix(".csv").tempfile().unwrap();
    std::fs::write(made.path(), text.lines().enumerate().map(row).collect::<String>()).unwrap();
    made
}

#[test]
fn likelihoods_of_wide_and_long_tables_are_those_of_deeplabcut() {
    for columns in
        ["a_likelihood,b_likelihood,c_likelihood", "score_a,score_b,score_c", "a.confidence,b.confidence,c.confidence"]
    {
        let wide = likely("cases/c07-table-dialects/wide.csv", columns, ',', "88.5362", 3);
        let made = import(&[wide.path().to_path_buf()], &ImportOptions::default(), &mut |_, _| ()).unwrap();
        assert_eq!(super::equals_reference(&made, 3, 0.0).len(), 3, "{:?}", made.told);
        told(&made, &["less likely than 0.9 are lost markers", "3 positions below the limit"]);
        let all = ImportOptions { likelihood: Some(0.1), ..ImportOptions::default() };
        super::refused_paths(&[wide.path().to_path_buf()], &all, &["marker a moves", "on the background"]);
    }
    let long = likely("cases/reference_markers.csv", "likelihood", ',', "207.2848", 1);
    let made = import(&[long.path().to_path_buf()], &ImportOptions::default(), &mut |_, _| ()).unwrap();
    assert_eq!(super::equals_reference(&made, 3, 0.0).len(), 1, "{:?}", made.told);
    let wide = likely("cases/c07-table-dialects/wide.csv", "a_likelihood,score", ',', "x", 2);
    let made = import(&[wide.path().to_path_buf()], &ImportOptions::default(), &mut |_, _| ()).unwrap();
    assert_eq!(super::equals_reference(&made, 3, 0.0).len(), 1, "a score of no marker is not used");
    let bad = likely("cases/c07-table-dialects/wide.csv", "a_likelihood", ',', "x", 1);
    std::fs::write(bad.path(), std::fs::read_to_string(bad.path()).unwrap().replace(",0.95\n", ",95\n")).unwrap();
    super::refused_paths(
        &[bad.path().to_path_buf()],
        &ImportOptions::default(),
        &["a likelihood of 95 is not from 0 to 1"],
    );
}

#[test]
fn options_that_fit_no_file_and_runs_in_one_file_are_told() {
    let map = vec![("t".to_string(), "Zeit".to_string())];
    let options = ImportOptions { columns: map, ..pixels(LOG) };
    refused(&["made/wide_pixels.csv"], &options, &["column Zeit", "--map"]);
    let made = read(&["made/kinovea_seconds.csv"], &ImportOptions { likelihood: Some(0.5), ..known(LOG) });
    told(&made, &["--likelihood was not used"]);
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(case("made/kinovea_seconds.csv")).unwrap();
    let again = text.lines().skip(1).fold(text.clone(), |all, line| all + line + "\n");
    let path = folder.path().join("two_runs.csv");
    std::fs::write(&path, again).unwrap();
    super::refused_paths(&[path], &known(LOG), &["two_runs.csv:17", "goes back", "--map run="]);
}

#[test]
fn a_checkerboard_seen_askew_gives_the_plane() {
    let scale = Scale::Board(data::import::read_board(&case("made/board.csv")).unwrap(), 0.025);
    let base = Some(FilePlace::At(vec![300.0, 700.0]));
    let made = read(&["made/askew.csv"], &ImportOptions { scale, base, ..pixels(LOG) });
    equals(&made, "1", &["a", "b", "c"], 0, 1e-3);
    told(&made, &["a homography of 84 corners"]);
}

#[test]
fn a_known_distance_gives_the_scale() {
    let places = [FilePlace::At(vec![212.0, 540.0]), FilePlace::At(vec![212.0, 230.0])];
    let made =
        read(&["cases/c01-deeplabcut/run1.csv"], &ImportOptions { scale: Scale::Known(places, 0.1), ..pixels(LOG) });
    told(&made, &["310.00 units of the file are 100.00 mm: 3.1 to a millimetre"]);
    equals(&made, "1", &["a", "b", "c"], 1, 0.0);
}

/// Files of motion capture and logs as their makers describe them: other sections, orders, units and columns than in `cases`.
#[test]
fn second_files_of_motion_capture_ros_and_logs_equal_the_reference() {
    let vicon = read(&["made/vicon_devices.csv"], &known(LOG));
    equals(&vicon, "2", &["a", "b", "c"], 0, 1e-4);
    told(&vicon, &["read as Vicon Nexus", "along the robot is the file's z, towards the actuator its y"]);
    let trc = read(&["made/run3.trc"], &known(LOG));
    equals(&trc, "3", &["a", "b", "c"], 0, 1e-4);
    told(&trc, &["read as TRC (OpenSim)", "lengths are in m,"]);
    let qualisys = read(&["made/qualisys_events.tsv"], &known(LOG));
    equals(&qualisys, "2", &["a", "b", "c"], 0, 1e-4);
    let anipose = ImportOptions { scale: Scale::Unit(1e-3), frames_per_s: Some(30.0), ..known(LOG) };
    equals(&read(&["made/anipose_unfiltered.csv"], &anipose), "2", &["a", "b", "c"], 0, 1e-4);
    let names = ["a", "b", "c"].map(String::from).to_vec();
    let trackpy = ImportOptions { markers: names, ..pixels(LOG) };
    equals(&read(&["made/trackpy_linked.csv"], &trackpy), "3", &["a", "b", "c"], 0, 4e-4);
    for log in ["made/labview_comma.lvm", "made/serial_millis.txt"] {
        equals(&read(&["made/sleap.csv"], &pixels(log)), "2", &["a", "b", "c"], 2, 0.0);
    }
}

/// The text of a file of `cases` after a change, in a temporary folder.
fn changed(file: &str, change: impl Fn(String) -> String) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(case(file).file_name().unwrap());
    std::fs::write(&path, change(std::fs::read_to_string(case(file)).unwrap())).unwrap();
    (folder, path)
}

const VICON: &str = "cases/c21-vicon-nexus/trial1.csv";

#[test]
fn trajectories_in_two_units_are_refused() {
    let units = |of_b: &str| format!("\n,,mm,mm,mm,{of_b},mm,mm,mm\n");
    let with = |of_b: &'static str| changed(VICON, move |text| text.replace(&units("mm,mm,mm"), &units(of_b)));
    let (_folder, path) = with("m,m,m");
    refused_paths(&[path], &known(LOG), &["trial1.csv:5", "column 6 is in m, and an earlier one in mm"]);
    let (_folder, path) = with(",mm,millimeters");
    equals(&import(&[path], &known(LOG), &mut |_, _| ()).unwrap(), "1", &["a", "b", "c"], 0, 1e-4);
}

/// The three trials of [`VICON`] after a yaw about the file's z and a roll about the robot \[rad\].
fn turned(yaw: f64, roll: f64, options: &ImportOptions) -> Result<Imported, data::DataError> {
    let turn = |at: &[f64]| {
        let [y, z] = [at[1] * roll.cos() - at[2] * roll.sin(), at[1] * roll.sin() + at[2] * roll.cos()];
        [at[0] * yaw.cos() - y * yaw.sin(), at[0] * yaw.sin() + y * yaw.cos(), z]
    };
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        if cells.len() != 11 || cells[0].parse::<f64>().is_err() {
            return line.to_string();
        }
        let place = |cells: &[&str]| match cells.iter().map(|cell| cell.parse().ok()).collect::<Option<Vec<f64>>>() {
            Some(at) => turn(&at).map(|v| format!("{v:.4}")).join(","),
            None => cells.join(","),
        };
        format!("{},{},{}", cells[0], cells[1], cells[2..].chunks(3).map(place).collect::<Vec<_>>().join(","))
    };
    let trial = |k: u32| {
        let text = |text: String| text.lines().map(|line| row(line) + "\n").collect();
        changed(&format!("cases/c21-vicon-nexus/trial{k}.csv"), text)
    };
    let trials = [1, 2, 3].map(trial);
    import(&trials.each_ref().map(|(_, path)| path.clone()), options, &mut |_, _| ())
}

#[test]
fn a_robot_in_any_plane_of_the_laboratory_equals_the_reference() {
    for (yaw, roll) in
        [(0.0, 0.0), (0.2, 0.0), (0.5, 0.0), (-1.2, 0.0), (0.0, 0.5), (0.0, -0.7), (0.4, 0.5), (2.5, 0.3)]
    {
        let made =
            turned(yaw, roll, &known(LOG)).unwrap_or_else(|error| panic!("{yaw}, {roll}: {error}; {}", error.help()));
        // Without an axis of the file in the plane, the robot at rest is straight: 2 mrad of noise.
        super::equals_reference(&made, 3, if yaw * roll == 0.0 { 0.01 } else { 1.0 });
        let found = if yaw == 0.0 && roll == 0.0 {
            "along the robot is the file's x"
        } else {
            "the plane of the motion is not"
        };
        told(&made, &[found, "a 90 mm, b 210 mm, c 330 mm"]);
    }
    let axes = Some(data::import::typed::axes("x,z").unwrap());
    let said = turned(0.5, 0.0, &ImportOptions { axes, ..known(LOG) }).unwrap_err();
    assert!(
        said.to_string().contains("29 degrees out of the plane of --axes") && said.help().contains("leave --axes out")
    );
}

#[test]
fn stations_that_contradict_a_turned_robot_at_rest_are_refused() {
    let with = |stations: [f64; 3]| {
        let stations_m = ["a", "b", "c"].map(String::from).into_iter().zip(stations).collect();
        turned(0.5, 0.0, &ImportOptions { stations_m, ..known(LOG) })
    };
    super::equals_reference(&with([0.09, 0.21, 0.33]).unwrap(), 3, 0.01);
    for wrong in [[0.078, 0.184, 0.29], [0.103, 0.24, 0.377]] {
        let said = with(wrong).unwrap_err().to_string();
        assert!(said.contains("mm apart at rest, and") && said.contains("by their stations"), "{said}");
    }
}
