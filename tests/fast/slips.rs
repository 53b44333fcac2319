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

/// Pressures of the actuator as a gauge in psi shows them.
fn in_psi(cells: &mut [String]) {
    cells[4] = format!("{:.4}", cells[4].parse::<f64>().unwrap() / 6.894757);
}

#[test]
fn pressures_in_psi_are_told_by_every_command_and_the_verdict_waits() {
    let folder = Folder::new();
    let robot = models::shipped("epam-textbook")
        .unwrap()
        .replace("bending_stiffness_nm2 = 0 ", "bending_stiffness_nm2 = 1.35 ");
    folder.write("robot.toml", &robot);
    folder.run(&["data", "generate", "robot.toml", "--out", "made"]);
    let table = std::fs::read_to_string(folder.path("made/markers.csv")).unwrap();
    let row = |(i, line): (usize, &str)| {
        let mut cells: Vec<String> = line.split(',').map(str::to_string).collect();
        if i > 0 {
            in_psi(&mut cells);
        }
        cells.join(",") + "\n"
    };
    folder.write("made/markers.csv", table.lines().enumerate().map(row).collect::<String>());
    let words = "the actuator pressures look as if they were psi under a name of kPa: with 6.8948 times the numbers";
    let ran = folder.run(&["diagnose", "robot.toml", "made"]);
    let place = |words: &str| ran.stdout.find(words).unwrap_or_else(|| panic!("`{words}` in\n{}", ran.stdout));
    assert!(place(words) < place("Verdict: withheld until the pressures are right"));
    place("name the column p_act_psi in place of p_act_kpa");
    assert!(!ran.stdout.contains("p corrected"), "no ranking: {}", ran.stdout);
    let ran = folder.run(&["compare", "robot.toml", "made"]);
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
    let ran = folder.run(&["data", "check", "made", "robot.toml"]);
    assert!(ran.stdout.contains(words), "{}", ran.stdout);
    let answer = folder.run(&["diagnose", "robot.toml", "made", "--json"]).json("ibr.diagnose");
    assert!(answer["verdict"].is_null() && answer["pressure_slip"]["after_mm"].as_f64().unwrap() < 0.5);
    // What was told to type mends it.
    let mended = std::fs::read_to_string(folder.path("made/markers.csv")).unwrap();
    folder.write("made/markers.csv", mended.replacen("p_act_kpa", "p_act_psi", 1));
    let answer = folder.run(&["diagnose", "robot.toml", "made", "--json"]).json("ibr.diagnose");
    assert!(answer["verdict"] == "none" && answer["pressure_slip"].is_null(), "{}", answer["summary"]);
}

#[test]
fn what_cannot_be_here_is_left_out_and_a_misspelt_name_gets_the_right_one() {
    let folder = Folder::new();
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--not", "end_constraint"]);
    assert!(ran.stdout.contains("cannot be here: end_constraint"), "{}", ran.stdout);
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--not", "end_constrain"]);
    assert!(ran.code != 0 && ran.stderr.contains("end_constraint"), "{}", ran.stderr);
}

#[test]
fn absolute_pressures_are_told_with_what_to_subtract() {
    let folder = Folder::new();
    set(&folder, |cells| {
        for pressure in [3, 4] {
            cells[pressure] = format!("{:.4}", cells[pressure].parse::<f64>().unwrap() + 101.3);
        }
    });
    let ran = folder.run(&["data", "check", "set"]);
    for column in ["p_body", "p_act"] {
        let words = format!("from the column {column}");
        assert!(ran.stdout.contains("look absolute") && ran.stdout.contains(&words), "{}{}", ran.stdout, ran.stderr);
    }
}
