//! Positions such as 0, 0 that mean that a marker was not seen.

use super::{read, table};
use crate::check;

/// A table with the positions of some rows replaced.
fn replaced(wanted: &dyn Fn(&[&str]) -> Option<&'static str>) -> String {
    let text = table(5, 4);
    let row = |(i, line): (usize, &str)| {
        let cells: Vec<&str> = line.split(',').collect();
        match wanted(&cells) {
            Some(place) if i > 0 => format!("{},{place}\n", cells[..7].join(",")),
            _ => format!("{line}\n"),
        }
    };
    text.lines().enumerate().map(row).collect()
}

/// Marker 2 is lost at 30 kPa in the first run.
fn is_gone(cells: &[&str]) -> bool {
    cells[0] == "1" && cells[4] == "30" && cells[6] == "2"
}

#[test]
fn known_placeholders_are_lost_markers_and_told_with_their_line() {
    for place in ["0,0", "-1,-1", "-1.0,-1.00", "9999,9999", "-9999,-9999", "999,999", "65535,65535"] {
        let data = read(&replaced(&|cells| is_gone(cells).then_some(place))).unwrap();
        assert_eq!(data.lost.filled, [[0, 3, 1]], "{place}");
        let told = check(&data, None).warnings.join("\n");
        assert!(told.contains("4 rows have a marker at exactly ") && told.contains("first in line 27"), "{told}");
    }
}

#[test]
fn a_place_that_two_markers_share_to_the_last_digit_far_from_both_is_none() {
    let both = replaced(&|cells| {
        let lost = cells[4] == "20" && (cells[0] == "1" && cells[6] == "1" || cells[0] == "2" && cells[6] == "2");
        lost.then_some("640.25,-480.5")
    });
    let data = read(&both).unwrap();
    assert_eq!(data.lost.filled, [[0, 2, 0], [1, 2, 1]]);
    let told = check(&data, None).warnings.join("\n");
    assert!(told.contains("8 rows have a marker at exactly 640.25, -480.5 mm"), "{told}");
    // Of one marker alone it may be a place where the robot stuck.
    let one = read(&replaced(&|cells| is_gone(cells).then_some("640.25,480.5"))).unwrap();
    assert!(one.lost.filled.is_empty());
}
