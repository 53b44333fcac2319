//! A second file of each kind, made after the programs' public descriptions from the same marker table.

use super::{Rows, case, known, pixels, read, reference, refused, rows, told};
use data::import::{FilePlace, ImportOptions, Imported, Scale};

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
