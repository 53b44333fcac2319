//! `ibr diagnose`: what it promises to programs and to readers.

use crate::support::{Folder, repository};

#[test]
fn a_diagnosis_as_json_holds_what_programs_build_on() {
    let folder = Folder::new();
    let answer = folder.run(&["diagnose", "spam-textbook", "synthetic-spam", "--json"]).json("ibr.diagnose");
    assert!(["none", "effect", "out_of_catalog"].contains(&answer["verdict"].as_str().unwrap()));
    assert!(answer["p_value"].as_f64().unwrap() <= 1.0);
    for key in ["noise", "base", "outliers"] {
        assert!(answer[key].is_object(), "{key}");
    }
    for key in [
        "indistinguishable",
        "added",
        "attempt",
        "attempt_alike",
        "undetectable",
        "pairs",
        "limits",
        "warnings",
        "summary",
    ] {
        assert!(answer[key].is_array(), "{key}");
    }
    assert!(answer.get("next_experiment").is_some());
    let ranked = answer["ranked"].as_array().unwrap();
    let keys = [
        "effect",
        "value",
        "unit",
        "lo",
        "hi",
        "at_bound",
        "systematic_before_mm",
        "systematic_after_mm",
        "heldout_mm",
        "p_corrected",
    ];
    for entry in ranked {
        keys.iter().for_each(|key| assert!(entry.get(*key).is_some(), "{key} in {entry}"));
    }
}

#[test]
fn the_text_puts_supply_and_measurement_before_physics_and_says_what_was_not_seen() {
    let folder = Folder::new();
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--tables"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let place = |words: &str| ran.stdout.find(words).unwrap_or_else(|| panic!("`{words}` in\n{}", ran.stdout));
    assert!(place("Supply and measurement") < place("Physics and loads"));
    assert!(place("Verdict:") < place("Effects not found"));
}

#[test]
fn the_page_that_is_printed_has_at_most_forty_lines() {
    let folder = Folder::new();
    for [robot, data] in
        [["epam-textbook", "synthetic-epam"], ["cpam", "fem-cpam"], ["spam", "fem-spam"], ["fpam", "fem-fpam"]]
    {
        let ran = folder.run(&["diagnose", robot, data]);
        assert!(ran.code == 0 && ran.stdout.contains("Verdict: ") && ran.stdout.contains("--tables"), "{}", ran.stdout);
        assert!(ran.stdout.lines().count() <= 40, "{}", ran.stdout);
    }
}

#[test]
fn data_of_another_robot_are_refused_and_nothing_is_written() {
    let folder = Folder::new();
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-spam"]);
    assert_eq!(ran.code, 3);
    assert!(ran.stderr.contains("are of actuator spam"), "{}", ran.stderr);
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--tolerance", "0mm"]);
    assert_eq!(ran.code, 2);
    assert!(!folder.path("ibr-report").exists());
}

#[test]
fn a_quantity_measured_by_itself_is_read_and_one_that_no_effect_has_is_refused() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("set")).unwrap();
    folder.write("set/markers.csv", data::set_file("synthetic-epam", "markers.csv").unwrap());
    let about = data::set_file("synthetic-epam", "about.toml").unwrap();
    let answer = |line: &str| {
        folder.write("set/about.toml", format!("{about}\n[measured.{line}"));
        folder.run(&["diagnose", "epam-textbook", "set", "--json"])
    };
    let ran = answer("fabric_stretch]\ncompliance_m_per_n = [8e-5, 4e-6]\n");
    let warnings = ran.json("ibr.diagnose")["warnings"].to_string();
    assert!(warnings.contains("fabric_stretch as measured: c = 8.00e-5 ± 4.00e-6 m/N"), "{warnings}");
    let place = format!("about.toml:{}: ", about.lines().count() + 3);
    for (line, words) in [
        ("fabric_strech]\ncompliance_m_per_n = [8e-5, 4e-6]\n", "fabric_stretch"),
        ("fabric_stretch]\ncompliance = [8e-5, 4e-6]\n", "compliance_m_per_n"),
        ("fabric_stretch]\ncompliance_m_per_n = [8e-5, 0]\n", "standard deviation"),
    ] {
        let ran = answer(line);
        assert_eq!(ran.code, 3, "{}", ran.stderr);
        assert!(ran.stderr.contains(words) && ran.stderr.contains(&place), "{}", ran.stderr);
    }
}

#[test]
fn further_data_of_the_robot_are_fitted_along_and_those_of_another_are_refused() {
    let folder = Folder::new();
    let typed = ["diagnose", "epam-textbook", "synthetic-epam", "--also", "synthetic-epam-two-bodies", "--json"];
    let answer = folder.run(&typed).json("ibr.diagnose");
    let beside = answer["beside"].as_array().unwrap();
    assert_eq!((beside.len(), &beside[0]["dataset"]), (1, &"synthetic-epam-two-bodies".into()));
    assert_eq!(answer["base"]["bending"].as_array().unwrap().len(), 2, "one for each body pressure of all data");
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--also", "synthetic-spam"]);
    assert_eq!(ran.code, 3);
    assert!(ran.stderr.contains("synthetic-spam") && ran.stderr.contains("are of actuator spam"), "{}", ran.stderr);
}

#[test]
fn pictures_of_an_earlier_report_that_this_one_has_not_are_taken_away_and_nothing_else_is() {
    let folder = Folder::new();
    assert_eq!(folder.run(&["data", "generate", "epam-textbook", "--out", "plain", "--seed", "3"]).code, 0);
    assert_eq!(folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--out", "d"]).code, 0);
    assert!(folder.path("d/residuals_after.png").exists() && folder.path("d/candidates.svg").exists());
    folder.write("d/mine.png", "a picture of my own");
    let ran = folder.run(&["diagnose", "epam-textbook", "plain", "--out", "d"]);
    assert!(ran.code == 0 && ran.stdout.contains("no missing effect detectable"), "{}{}", ran.stdout, ran.stderr);
    for gone in ["residuals_after.png", "residuals_after.svg", "candidates.png", "candidates.svg", "ledger.png"] {
        assert!(!folder.path("d").join(gone).exists(), "{gone} is of the earlier report");
    }
    for kept in ["mine.png", "residuals_before.png", "report.html"] {
        assert!(folder.path("d").join(kept).exists(), "{kept}");
    }
    crate::support::assert_hashes(&folder.path("d"));
}

#[test]
fn a_result_is_printed_although_its_report_cannot_be_written() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("d/report.html/in_the_way")).unwrap();
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--out", "d"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    assert!(ran.stdout.contains("Verdict: an effect is missing"), "{}", ran.stdout);
    assert!(ran.stderr.contains("cannot write to d") && !ran.stderr.contains("report: "), "{}", ran.stderr);
}

/// A marker out of the picture at the highest pressure, another behind a hand in one run, one that a tracker wrote as NaN.
#[test]
fn markers_that_were_lost_are_told_and_the_answer_stays() {
    let folder = Folder::new();
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let (run, pressure, marker) = (cells[0], cells[4], cells[6]);
        match (run, marker, pressure) {
            (_, "6", "30.0000") | ("2", "5", "20.0000") => String::new(),
            ("3", "4", "10.0000") => format!("{},NaN,NaN,{}\n", cells[..7].join(","), cells[9]),
            _ => format!("{line}\n"),
        }
    };
    let table: String = data::set_file("synthetic-epam", "markers.csv").unwrap().lines().map(line).collect();
    folder.write("lossy/markers.csv", table);
    folder.write("lossy/about.toml", data::set_file("synthetic-epam", "about.toml").unwrap());
    let ran = folder.run(&["diagnose", "epam-textbook", "lossy", "--json", "--out", "report"]);
    for words in
        ["left out: marker 6 at 30.0 kPa (load)", "run 2, marker 5 at 20.0 kPa (load)", "5 rows have no position"]
    {
        assert!(ran.stderr.contains(words), "{words}: {}", ran.stderr);
    }
    let answer = ran.json("ibr.diagnose");
    assert_eq!(answer["added"][0]["effect"], "end_constraint");
    let beta = answer["ranked"].as_array().unwrap().iter().find(|r| r["effect"] == "end_constraint").unwrap();
    assert!(beta["lo"].as_f64().unwrap() < 0.4 && beta["hi"].as_f64().unwrap() > 0.4, "{beta}");
    assert!(std::fs::read_to_string(folder.path("report/diagnosis.json")).unwrap().contains("\"seen\": false"));
    let compared = folder.run(&["compare", "epam-textbook", "lossy", "--calibrate"]);
    assert_eq!(compared.code, 0, "{}", compared.stderr);
}

/// Markers seen through a barrel lens, every mechanism known: a camera effect leads, and a board is proposed before new physics.
#[test]
fn an_uncorrected_lens_asks_for_a_board() {
    let folder = Folder::new();
    let case = |name: &str| repository().join("data/tests/cases/c38-lens-distortion").join(name).display().to_string();
    let ran = folder.run(&["diagnose", &case("robot.toml"), &case("null")]);
    let text = ran.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("Next: photograph a checkerboard") && text.contains("(ibr data import --board)"), "{text}");
}
