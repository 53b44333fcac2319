//! A third coordinate, and pressures of several supply channels.

use super::{read, table};
use crate::{Phase, losses, markers_of_table, write_markers_csv};

const SPACE: &str = include_str!("../../tests/cases/space_markers.csv");

/// The small table with a column of z, as a function of line and y.
fn with_z(text: &str, z_mm: impl Fn(usize, f64) -> String) -> String {
    let line = |(i, line): (usize, &str)| match i {
        0 => format!("{line},z_mm\n"),
        _ => format!("{line},{}\n", z_mm(i, line.rsplit(',').next().unwrap().parse().unwrap())),
    };
    text.lines().enumerate().map(line).collect()
}

#[test]
fn z_and_channels_are_read_and_come_back() {
    let dataset = read(SPACE).unwrap();
    assert_eq!((dataset.runs.len(), dataset.holds.len(), dataset.markers.len()), (3, 4, 2));
    assert_eq!(dataset.more_channels(), 1);
    assert!(dataset.is_spatial() && dataset.channels_differ());
    let channels: Vec<Vec<f64>> = dataset.holds.iter().map(|hold| hold.channels_pa().collect()).collect();
    assert_eq!(channels, [[0.0, 0.0], [20e3, 10e3], [10e3, 25e3], [0.0, 0.0]]);
    assert_eq!(dataset.holds.iter().map(|hold| hold.phase).collect::<Vec<_>>()[2..], [Phase::Load, Phase::Unload]);
    assert_eq!((dataset.axes, dataset.run(1).len()), (3, 4 * dataset.samples_per_hold * 2 * 3));
    assert_eq!(dataset.place(1, 2, 0, 1)[2], dataset.run(1)[dataset.offset(2, 0, 1) + 2]);
    assert!(dataset.travel_m(2) > 0.05 && dataset.clone().checked().is_ok());
    let mut csv = Vec::new();
    write_markers_csv(&dataset, &mut csv).unwrap();
    assert_eq!(String::from_utf8(csv.clone()).unwrap(), SPACE);
    let again = markers_of_table("markers.csv", &dataset.to_table(), None).unwrap();
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(close(&again.coordinates_m, &dataset.coordinates_m));
    assert!(again.holds.iter().zip(&dataset.holds).all(|(a, b)| close(&a.more_act_pa, &b.more_act_pa)));
}

#[test]
fn z_that_stands_still_changes_nothing_of_a_planar_table() {
    let plain = read(&table(3, 6)).unwrap();
    let flat = read(&with_z(&table(3, 6), |_, _| "7.5".into())).unwrap();
    assert_eq!(flat.in_plane(), plain);
    assert_eq!((flat.left_aside().unwrap(), plain.left_aside().unwrap()), (None, None));
    let wobbly = read(&with_z(&table(3, 6), |i, _| format!("{}", i % 7))).unwrap();
    let told = wobbly.left_aside().unwrap().unwrap();
    assert!(told.contains("z varies by up to") && told.contains("left aside"), "{told}");
    assert_eq!(wobbly.in_plane().coordinates_m, plain.coordinates_m);
}

#[test]
fn a_planar_robot_refuses_what_it_cannot_leave_aside() {
    let refused = |text: &str| read(text).unwrap().left_aside().unwrap_err().to_string();
    let exchanged = table(3, 6).replace("x_mm,y_mm", "x_mm,Y").replace(",Y", ",z_mm,y_mm").replace('\n', ",0\n");
    let exchanged = exchanged.replace("y_mm,0\n", "y_mm\n");
    let told = refused(&exchanged);
    assert!(told.contains("100.0 mm") || told.contains("120.0 mm"), "{told}");
    assert!(told.contains("towards z and 0.0 mm towards y"), "{told}");
    let down = with_z(&table(3, 6).replace("y_mm", "y_down_mm"), |_, _| "0".into());
    assert!(refused(&down).contains("y points down"));
    assert!(read(&table(3, 6).replace("y_mm", "y_down_mm")).is_err(), "without z it is told on reading");
    assert!(refused(SPACE).contains("2 supply channels"));
}

#[test]
fn bad_columns_of_space_are_named() {
    let told = |text: &str| read(text).unwrap_err().to_string();
    assert!(told(&SPACE.replace("z_mm", "z")).contains("column z has no unit"));
    assert!(told(&SPACE.replace("z_mm", "z_m")).contains("it looks like millimetres"));
    assert!(read(&SPACE.replace("z_mm", "z_px")).unwrap().axes == 2, "another program's column");
    assert!(told(&SPACE.replace("p_act_1_kpa", "p_act_1")).contains("column p_act_1 has no unit"));
    assert!(told(&SPACE.replace("p_act_1_kpa", "p_act_2_kpa")).contains("p_act_1_kpa is not"));
    let row = SPACE.lines().nth(5).unwrap();
    let z = row.split(',').nth(10).unwrap();
    let worded = told(&SPACE.replacen(row, &row.replace(z, "high"), 1));
    assert!(worded.contains("markers.csv:6, column z_mm"), "{worded}");
    let gone = told(&SPACE.replacen(row, &row.replace(z, ""), 1));
    assert!(gone.contains("the cell is empty"), "{gone}");
    let low = told(&SPACE.replace(",20.0000,10.0000,", ",20.0000,-10.0000,"));
    assert!(low.contains("p_act_1_kpa") && low.contains("must be from 0 to 1000 kPa"), "{low}");
}

#[test]
fn a_marker_that_was_not_seen_has_no_coordinate() {
    let empty = |row: &str| {
        let mut cells: Vec<&str> = row.split(',').collect();
        (8..11).for_each(|axis| cells[axis] = "");
        cells.join(",")
    };
    // Run 2 loses marker 6 in the third hold.
    let is_lost = |row: &&str| row.starts_with("2,epam") && row.contains(",10.0000,25.0000,load,6,");
    let text: String = SPACE.lines().map(|row| if is_lost(&row) { empty(row) } else { row.into() } + "\n").collect();
    let (lost, whole) = (read(&text).unwrap(), read(SPACE).unwrap());
    assert_eq!(lost.lost.filled, [[1, 2, 1]]);
    assert!(losses(&lost).iter().any(|told| told.contains("lost in single runs")));
    let [filled, seen] = [&lost, &whole].map(|set| set.place(1, 2, 0, 1)[2]);
    assert!((filled - seen).abs() < 4e-3 && filled != seen, "{filled} {seen}");
    // 0, 0 is a place where z is another; with z 0 it is none.
    let row = SPACE.lines().nth(5).unwrap();
    let at = |z: &str| {
        let mut cells: Vec<&str> = row.split(',').collect();
        (cells[8], cells[9], cells[10]) = ("0.0", "0.0", z);
        read(&SPACE.replacen(row, &cells.join(","), 1)).unwrap().told
    };
    assert!(at("0.0").iter().any(|told| told.contains("taken as not seen")) && at("12.5").is_empty());
}
