//! `ibr compare` on data that are small or odd and yet good.

use crate::support::{Folder, Ran};

/// Says of the cells of a row whether it stays.
type Keep<'a> = &'a dyn Fn(&[&str]) -> bool;

fn table(keep: impl Fn(&[&str]) -> bool) -> String {
    let text = data::set_file("synthetic-epam", "markers.csv").unwrap();
    let header = text.lines().next().unwrap();
    let kept = text.lines().skip(1).filter(|line| keep(&line.split(',').collect::<Vec<_>>()));
    std::iter::once(header).chain(kept).map(|line| format!("{line}\n")).collect()
}

fn compared(csv: &str, more: &[&str]) -> Ran {
    let folder = Folder::new();
    folder.write("some.csv", csv);
    folder.run(&[&["compare", "epam-textbook", "some.csv", "--json"], more].concat())
}

#[test]
fn one_run_is_compared_without_p_values_and_says_so() {
    let answer = compared(&table(|cells| cells[0] == "1"), &[]).json("ibr.compare");
    assert_eq!(answer["noise"]["p_values"], false);
    let said = answer["noise"]["sentence"].as_str().unwrap();
    assert!(said.contains("one run only") && said.contains("no significance"), "{said}");
    for hold in answer["holds"].as_array().unwrap() {
        assert!(hold["p_value"].is_null() && hold["noise_floor_mm"].is_null() && hold["rmse_mm"].is_f64(), "{hold}");
    }
    assert!(answer["overall"]["p_value"].is_null());
}

#[test]
fn camera_noise_given_for_one_run_brings_a_noise_floor_back() {
    let csv = table(|cells| cells[0] == "1");
    let answer = compared(&csv, &["--sigma", "1mm"]).json("ibr.compare");
    assert!(answer["holds"][1]["noise_floor_mm"].as_f64().unwrap() > 0.1, "{}", answer["holds"][1]);
    let several = compared(&table(|_| true), &["--sigma", "1mm"]);
    assert!(several.stderr.contains("--sigma is for a single run and was not used"), "{}", several.stderr);
}

#[test]
fn two_runs_have_a_noise_floor_and_no_p_values() {
    let answer = compared(&table(|cells| cells[0] <= "2"), &[]).json("ibr.compare");
    assert_eq!(answer["noise"]["p_values"], false);
    assert!(answer["noise"]["sentence"].as_str().unwrap().contains("two runs only"));
    assert!(answer["holds"][1]["noise_floor_mm"].as_f64().unwrap() > 0.0);
    assert!(answer["holds"][1]["p_value"].is_null());
}

#[test]
fn copies_of_one_run_are_called_copies() {
    let first = table(|cells| cells[0] == "1");
    let (header, rows) = first.split_once('\n').unwrap();
    let copies =
        ["1", "2", "3"].map(|run| rows.replace("\n1,", &format!("\n{run},")).replacen("1,", &format!("{run},"), 1));
    let ran = compared(&format!("{header}\n{}", copies.concat()), &[]);
    let said = ran.json("ibr.compare")["noise"]["sentence"].to_string();
    assert!(said.contains("one run only"), "{said}");
    for words in ["run 2 is a copy of run 1 and was left out", "run 3 is a copy"] {
        assert!(ran.stderr.contains(words), "{}", ran.stderr);
    }
}

#[test]
fn one_marker_one_hold_or_one_row_is_enough() {
    let cases: [(&str, Keep); 4] = [
        ("one marker", &|cells| cells[6] == "6"),
        ("one hold", &|cells| cells[4] == "30.0000"),
        ("one marker and hold", &|cells| cells[6] == "6" && cells[4] == "30.0000"),
        ("one row", &|cells| cells[..3] == ["1", "epam", "16.0000"] && cells[6] == "6"),
    ];
    for (what, keep) in cases {
        let answer = compared(&table(keep), &[]).json("ibr.compare");
        let hold = answer["holds"].as_array().unwrap().iter().find(|h| h["p_act_kpa"] == 30.0).unwrap();
        assert!((hold["tip_error_mm"].as_f64().unwrap() - 45.8).abs() < 2.0, "{what}: {hold}");
    }
}

#[test]
fn line_ends_of_windows_a_byte_order_mark_semicolons_and_odd_run_names_change_nothing() {
    let text = table(|_| true);
    let (header, rows) = text.split_once('\n').unwrap();
    let plain = compared(&text, &[]).json("ibr.compare");
    let variants = [
        text.replace('\n', "\r\n"),
        format!("\u{feff}{text}"),
        text.replace(',', ";"),
        format!("# made by hand\n\n{text}"),
        format!("{header}\nläuf ✓ {}", rows.trim_end().replace('\n', "\nläuf ✓ ")),
        format!("{header},note\n{},\"a, b\"\n", rows.trim_end().replace('\n', ",\"a, b\"\n")),
    ];
    for csv in variants {
        assert_eq!(compared(&csv, &[]).json("ibr.compare")["holds"], plain["holds"]);
    }
}

#[test]
fn a_sample_far_from_the_other_runs_is_warned_of() {
    let text = table(|_| true);
    let line = text.lines().nth(300).unwrap();
    let mut cells: Vec<&str> = line.split(',').collect();
    cells[8] = "900";
    let ran = compared(&text.replace(line, &cells.join(",")), &[]);
    let warnings = ran.json("ibr.compare")["warnings"].to_string();
    assert!(warnings.contains("far from the other runs") && warnings.contains("ibr data check some.csv"), "{warnings}");
    assert!(ran.stderr.contains("warning: "), "{}", ran.stderr);
}

#[test]
fn an_effect_that_made_the_data_takes_the_error_away() {
    let args =
        ["compare", "epam-textbook", "synthetic-epam", "--effect", "end_constraint:beta=0.4", "--calibrate", "--json"];
    let answer = Folder::new().run(&args).json("ibr.compare");
    let error = |model: &serde_json::Value| model["overall"]["systematic_mm"].as_f64().unwrap();
    let models = answer["models"].as_array().unwrap();
    assert!(error(&models[0]) > 20.0 && error(models.last().unwrap()) < 1.0, "{models:?}");
    let fitted = models.last().unwrap();
    assert_eq!(fitted["how_known"], "calibrated");
    assert!((fitted["bending_nm2"].as_f64().unwrap() - 0.15).abs() < 0.05, "the data were made with 0.15: {fitted}");
}
