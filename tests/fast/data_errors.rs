//! Marker data that are wrong: file, line, column or cell, what was expected, what to type; an earlier report stays.

use crate::refused::{refuse, with_report};

fn table() -> &'static str {
    data::set_file("synthetic-epam", "markers.csv").unwrap()
}

/// Writes a marker table, and has it refused by every command that reads one.
fn refused(bytes: impl AsRef<[u8]>, words: &[&str]) {
    let folder = with_report();
    folder.write("bad.csv", bytes);
    for args in [&["compare", "epam", "bad.csv", "--out", "report"][..], &["data", "check", "bad.csv"]] {
        refuse(&folder, args, 3, &[&["bad.csv"], words].concat());
    }
}

/// The table with the header changed.
fn with_header(old: &str, new: &str) -> String {
    assert_eq!(table().lines().next().unwrap().matches(old).count(), 1, "{old}");
    table().replacen(old, new, 1)
}

/// The table with the cells of every row changed; columns: run 0, actuator 1, t 2, body 3, act 4, phase 5, marker 6,
/// x 7, y 8, s 9.
fn with_cells(change: impl Fn(usize, &mut Vec<String>)) -> String {
    let mut lines = vec![table().lines().next().unwrap().to_string()];
    for (row, line) in table().lines().enumerate().skip(1) {
        let mut cells: Vec<String> = line.split(',').map(str::to_string).collect();
        change(row + 1, &mut cells);
        lines.push(cells.join(","));
    }
    lines.join("\n") + "\n"
}

/// The table with one cell changed; lines count from 1, as in an editor.
fn with_cell(line: usize, column: usize, text: &str) -> String {
    with_cells(|at, cells| {
        if at == line {
            cells[column] = text.to_string();
        }
    })
}

fn scaled(columns: &[usize], factor: f64) -> String {
    with_cells(|_, cells| {
        for column in columns {
            cells[*column] = format!("{}", cells[*column].parse::<f64>().unwrap() * factor);
        }
    })
}

#[test]
fn a_missing_duplicated_or_misspelt_column_is_named() {
    let without_y = with_cells(|_, cells| {
        cells.remove(8);
    });
    refused(
        without_y.replacen(",y_mm", "", 1),
        &["bad.csv:1", "column y_mm is missing", "add it; the columns are run,"],
    );
    refused(with_header("x_mm", "y_mm"), &["bad.csv:1, column y_mm", "y_mm is there twice", "keep one of them"]);
    refused(
        with_header("p_act_kpa", "p_atc_kpa"),
        &["column p_act_kpa is missing", "bad.csv:1:", "did you mean p_act_kpa"],
    );
    refused(with_header("x_mm", "x_mn"), &["column x_mn has an unknown unit", "name it x_mm"]);
    refused(with_header("x_mm", "x"), &["column x has no unit", "name it x_mm"]);
    let headless: String = table().lines().skip(1).map(|line| format!("{line}\n")).collect();
    refused(headless, &["column run is missing", "the columns are run,"]);
}

#[test]
fn a_cell_that_is_not_a_number_is_shown() {
    let number = "type a plain number such as 12.5";
    refused(with_cell(17, 7, "abc"), &["bad.csv:17, column x_mm", "expected a number, found \"abc\"", number]);
    refused(with_cell(17, 7, "NaN"), &["bad.csv:17, column x_mm", "expected a finite number, found \"NaN\"", number]);
    refused(with_cell(17, 8, "inf"), &["bad.csv:17, column y_mm", "finite number", number]);
    refused(with_cell(17, 7, ""), &["bad.csv:17, column x_mm", "the cell is empty", number]);
    refused(with_cell(17, 7, "12.5 mm"), &["bad.csv:17, column x_mm", "found \"12.5 mm\"", "the unit belongs to"]);
    refused(with_cell(17, 7, "\"12,5\""), &["bad.csv:17, column x_mm", "write decimals with a point: 12.5"]);
    refused(with_cell(17, 5, "laod"), &["bad.csv:17, column phase", "unknown phase \"laod\"", "write load"]);
    refused(with_cell(17, 0, ""), &["bad.csv:17, column run", "the cell is empty"]);
    refused(with_cell(17, 7, "1e300"), &["bad.csv:17, column x_mm", "\"1e300\" is farther than any robot reaches"]);
    refused(
        with_cell(17, 9, "-30"),
        &["bad.csv:17, column s_mm", "station must be from 0.001 to 100000 mm, not -30", "help:"],
    );
    refused(
        with_cell(17, 4, "-30"),
        &["bad.csv:17, column p_act_kpa", "actuator pressure must be from 0 to 1000 kPa, not -30", "gauge pressure"],
    );
}

#[test]
fn a_marker_missing_in_one_run_or_a_hold_missing_is_named() {
    let fewer = |leave_out: &dyn Fn(&[&str]) -> bool| -> String {
        let kept = table().lines().filter(|line| !leave_out(&line.split(',').collect::<Vec<_>>()));
        kept.map(|line| format!("{line}\n")).collect()
    };
    let text = fewer(&|cells| cells[0] == "3" && cells[6] == "4");
    refused(text, &["marker 4 appears in run 1 but not in run 3", "column marker", "every run needs the same markers"]);
    let text = fewer(&|cells| cells[0] == "3" && cells[4] == "30.0000");
    refused(text, &["run 3, marker 1 lacks a hold that run 1", "30.0 kPa", "every run needs the same holds"]);
}

#[test]
fn y_pointing_down_is_noticed() {
    let words = ["column y_mm", "y points down", "multiply it by -1, or name the column y_down_mm"];
    refused(scaled(&[8], -1.0), &words);
}

#[test]
fn metres_pascals_and_psi_are_recognised() {
    refused(scaled(&[7, 8], 1e-3), &["column x_mm", "it looks like metres", "name the column x_m"]);
    refused(scaled(&[7, 8, 9], 1e-3), &["column x_mm", "it looks like metres", "name the column x_m"]);
    refused(
        scaled(&[4], 1e3),
        &["column p_act_kpa", "must be from 0 to 1000 kPa", "it looks like Pa", "name the column p_act_pa"],
    );
    refused(scaled(&[3, 4], 1e3), &["_kpa", "looks like Pa", "_pa"]);
    refused(scaled(&[3, 4], 1.0 / 6.894757), &["column p_act_kpa", "look like psi", "p_act_psi"]);
}

#[test]
fn what_is_no_table_is_refused() {
    let header = table().lines().next().unwrap();
    refused("", &["the file is empty", "the first line must name the columns: run,actuator,"]);
    refused("\n\n\n", &["the file is empty"]);
    refused(header, &["the file has a header and no rows", "add one row per run"]);
    let cut = &table()[..5000];
    let last = format!("bad.csv:{}:", cut.lines().count());
    refused(cut, &["the file ends in the middle of a row", &last, "copy the file again"]);
    let whole_lines = table().lines().take(260).map(|line| format!("{line}\n")).collect::<String>();
    refused(whole_lines, &["every run needs the same"]);
    refused((0..=255).rev().cycle().take(5000).collect::<Vec<u8>>(), &["bad.csv:1", "not UTF-8"]);
    refused(table().replacen("1,epam", "1,cpam", 1), &["several actuators in one file: cpam and epam", "#cpam"]);
}

#[test]
fn a_wrong_description_beside_the_table_has_its_place() {
    let described = |about: &str, words: &[&str]| {
        let folder = with_report();
        folder.write("set/markers.csv", table());
        folder.write("set/about.toml", format!("title = \"t\"\nsource = \"s\"\nlicence = \"l\"\n{about}\n"));
        refuse(&folder, &["compare", "epam", "set", "--out", "report"], 3, words);
    };
    described(
        "provenance = \"measurd\"",
        &["about.toml:4", "unknown variant `measurd`", "`measured`", "docs/scenario.md"],
    );
    let measured = "provenance = \"measured\"\n";
    let run = format!("{measured}[[run]]\nid = \"9\"");
    described(&run, &["describes run 9, which has no rows", "correct `id = \"9\"`"]);
    let metres = format!("{measured}[geometry]\nbody_radius_mm = 0.04\nbody_length_mm = 0.36");
    described(&metres, &["about.toml:6", "looks like metres", "multiply by 1000"]);
    let forces = format!("{measured}[[run]]\nid = \"1\"\ntip_force_n = [0, -0.3]");
    described(&forces, &["different known tip forces", "a separate dataset"]);
    let kind = format!("actuator = \"cpam\"\n{measured}");
    described(&kind, &["the table is of actuator epam, its about.toml names cpam"]);
}

#[test]
fn data_that_do_not_fit_the_scenario_are_refused() {
    let folder = with_report();
    let compare = |scenario: &str, data: &str, words: &[&str]| {
        refuse(&folder, &["compare", scenario, data, "--out", "report"], 3, words);
    };
    compare("cpam", "synthetic-epam", &["synthetic-epam", "epam", "cpam", "use the matching scenario"]);
    compare("epam", "nosuch", &["nosuch: no such file, folder or embedded set", "synthetic-epam"]);
    compare("epam", "synthetic-epma", &["did you mean synthetic-epam?"]);
    compare("epam", "du-pasquier-2023", &["has no marker positions", "ibr data list"]);
    compare("epam", "report", &["the folder has no markers.csv"]);
    let stationless = with_cells(|_, cells| cells.truncate(9)).replacen(",s_mm", "", 1);
    folder.write("stationless.csv", stationless);
    let text = models::shipped("epam").unwrap();
    folder.write("two.toml", text.replace("[30, 90, 150, 210, 270, 330]", "[30, 90]"));
    compare("two.toml", "stationless.csv", &["station of marker `1` is not known", "6 stations", "it has 2"]);
    let short = text.replace("length_mm = 360", "length_mm = 300").replace("count = 6", "count = 5");
    folder.write("short.toml", short.replace(", 330]", "]"));
    compare("short.toml", "synthetic-epam", &["marker `6` at s = 330 mm is beyond the robot's end at 300 mm"]);
}

#[test]
fn a_very_long_line_is_shown_around_its_fault_only() {
    let folder = with_report();
    let long = with_cells(|at, cells| {
        if at == 2 {
            cells.extend((0..5000).map(|i| format!("more{i}")));
        }
    });
    folder.write("bad.csv", long);
    let ran = folder.run(&["data", "check", "bad.csv"]);
    assert!(ran.code == 3 && ran.stderr.contains("found more than 10"), "{}", &ran.stderr[..500]);
    assert!(ran.stderr.contains("more1,") && ran.stderr.len() < 2000, "{} bytes", ran.stderr.len());
}

#[test]
fn phases_that_contradict_the_pressures_are_a_warning_wherever_data_are_read() {
    let folder = with_report();
    folder.write("bad.csv", with_cells(|_, cells| cells[5] = "load".into()));
    for args in [&["compare", "epam", "bad.csv"][..], &["diagnose", "epam", "bad.csv"], &["data", "check", "bad.csv"]] {
        let ran = folder.run(args);
        let words = "contradicts the actuator's pressure in 1 of 5 holds: hold 5 goes from 30.0 to 0.0 kPa";
        assert!(ran.code == 0 && format!("{}{}", ran.stdout, ran.stderr).contains(words), "{args:?}: {}", ran.stderr);
    }
}
