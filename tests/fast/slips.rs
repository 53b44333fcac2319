//! Slips in a table of markers: what a user is told, and where.

use crate::support::Folder;

/// The embedded set with every row, cut into its cells, edited.
fn set(folder: &Folder, edit: impl Fn(&mut Vec<String>)) {
    folder.write("set/about.toml", data::set_file("synthetic-epam", "about.toml").unwrap());
    let table = data::set_file("synthetic-epam", "markers.csv").unwrap();
    let row = |(i, line): (usize, &str)| {
        let mut cells: Vec<String> = line.split(',').map(str::to_string).collect();
        if i > 0 {
            edit(&mut cells);
        }
        cells.join(",") + "\n"
    };
    folder.write("set/markers.csv", table.lines().enumerate().map(row).collect::<String>());
}

const X: usize = 7;

fn add_to_x(cells: &mut [String], mm: f64) {
    cells[X] = format!("{:.4}", cells[X].parse::<f64>().unwrap() + mm);
}

/// Exchanges markers 3 and 4 with their stations.
fn exchange(cells: &mut [String]) {
    let (marker, station) = match cells[6].as_str() {
        "3" => ("4", "210"),
        "4" => ("3", "150"),
        _ => return,
    };
    (cells[6], cells[9]) = (marker.into(), station.into());
}

#[test]
fn a_shifted_origin_is_told_before_the_verdict_with_what_to_subtract() {
    let folder = Folder::new();
    set(&folder, |cells| add_to_x(cells, 20.0));
    let ran = folder.run(&["diagnose", "epam", "set"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let place = |words: &str| ran.stdout.find(words).unwrap_or_else(|| panic!("`{words}` in\n{}", ran.stdout));
    assert!(place("set: the origin of coordinates looks shifted: at 0 kPa already") < place("Verdict:"));
    place("every marker is off by x +20.5 mm");
    place("subtract 20.5 mm from column x\n");
    assert!(!ran.stderr.contains("origin of coordinates"), "told twice: {}", ran.stderr);
    let answer = folder.run(&["diagnose", "epam", "set", "--json"]).json("ibr.diagnose");
    assert_eq!(answer["slips"].as_array().unwrap().len(), 1);
    assert!(answer["warnings"].as_array().unwrap().contains(&answer["slips"][0]));
}

#[test]
fn exchanged_labels_are_told_with_run_and_holds_by_every_command_that_reads_data() {
    let folder = Folder::new();
    set(&folder, |cells| {
        if cells[0] == "2" {
            exchange(cells)
        }
    });
    let words = "markers 3 and 4 look exchanged in run 2: ";
    let ran = folder.run(&["compare", "epam", "set"]);
    assert!(ran.stderr.contains(&format!("warning: set: {words}")), "{}", ran.stderr);
    let ran = folder.run(&["data", "check", "set"]);
    assert!(ran.stdout.contains(&format!("note: set: {words}")), "{}", ran.stdout);
    let ran = folder.run(&["diagnose", "epam", "set"]);
    assert!(ran.stdout.contains(words), "{}", ran.stdout);
}

#[test]
fn right_data_are_diagnosed_without_such_a_word() {
    let ran = Folder::new().run(&["diagnose", "epam", "synthetic-epam"]);
    assert!(!ran.stdout.contains("Before the verdict"), "{}", ran.stdout);
}
