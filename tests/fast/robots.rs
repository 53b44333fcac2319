//! Finite element robots on the command line: settings, several pressures and runs, both engines. The robots are coarse and
//! fast: what they give is no result.

use crate::refused::{refuse, with_report};
use crate::support::{Folder, assert_hashes, assert_opens_offline};
use serde_json::Value;

/// A tenth of a second of processor time.
const QUICK: [&str; 11] = [
    "--mesh",
    "14mm",
    "--set",
    "body_ramp_s=0.004",
    "--set",
    "actuator_ramp_s=0.006",
    "--set",
    "guard_hourglass=1",
    "--no-frames",
    "--quiet",
    "--json",
];

fn simulate(folder: &Folder, more: &[&str]) -> Value {
    let ran = folder.run(&[&["simulate", "epam"], &QUICK[..], more].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).unwrap()
}

fn read(folder: &Folder, name: &str) -> String {
    String::from_utf8(std::fs::read(folder.path(name)).unwrap()).unwrap()
}

#[test]
fn a_robot_is_read_at_every_pressure_of_one_ramp_and_its_markers_are_a_dataset() {
    let folder = Folder::new();
    let answer = simulate(&folder, &["--pressure", "10kPa,15kPa", "--out", "run"]);
    let readings = answer["robot"]["readings"].as_array().unwrap();
    let pressures: Vec<f64> = readings.iter().map(|r| (r["actuator_pa"].as_f64().unwrap() * 1e-3).round()).collect();
    assert_eq!(pressures, [0.0, 10.0, 15.0]);
    for reading in readings {
        assert_eq!(reading["stations_m"].as_array().unwrap().len(), 7, "six markers and the tip");
        assert!((1.3e-3..1.9e-3).contains(&reading["body_m3"].as_f64().unwrap()), "{reading}");
        assert!(reading["seam_n_per_m"].as_f64().unwrap() > 1.0);
    }
    let names = assert_hashes(&folder.path("run"));
    let tables = ["readings.csv", "markers.csv", "snaps.csv"];
    for name in tables.into_iter().chain(["history.png", "displacement.png", "side.png", "section.png", "cut.png"]) {
        assert!(names.iter().any(|n| n == name), "{name} of {names:?}");
    }
    let checked = folder.run(&["data", "check", "run/markers.csv"]);
    assert_eq!(checked.code, 0, "{}", checked.stderr);
    // The case in the folder is complete: it runs to the same end without any option.
    let again = folder.run(&["simulate", "run/case.toml", "--out", "again", "--no-frames", "--quiet"]);
    assert_eq!(again.code, 0, "{}", again.stderr);
    assert_eq!(read(&folder, "run/readings.csv"), read(&folder, "again/readings.csv"));
}

#[test]
fn wrong_settings_are_refused_before_anything_is_run() {
    let folder = with_report();
    for (args, words) in [
        (["--pressure", "1kPa"], ["1 kPa in a body at 2 kPa", "raise the actuator pressure"]),
        (["--pressure", "10"], ["--pressure", "no unit"]),
        (["--mesh", "4"], ["--mesh", "no unit"]),
        (["--mesh", "40mm"], ["elements", "lower actuator_mesh_mm from 40"]),
        (["--set", "bnd=1"], ["unknown key `bnd`", "hourglass"]),
        (["--set", "model=papers"], ["unknown model", "known here: recommended, paper"]),
        (["--set", "bond=2"], ["bond must be from 0 to 1, not 2", "here"]),
        (["--set", "body.radius_mm=0"], ["radius must be from 1 to 1000 mm, not 0", "here"]),
        (["--set", "weld_mm=70"], ["welds of 70 mm every 60 mm overlap", "below 60 mm"]),
    ] {
        let code = if words[0].starts_with("--") || words[0].starts_with("unknown key") { 2 } else { 3 };
        refuse(&folder, &[&["simulate", "epam"], &args[..]].concat(), code, &words);
    }
    refuse(&folder, &["simulate", "pillow", "--seeds", "3"], 2, &["--seeds is for robots", "case file"]);
    folder.write("my.toml", format!("{}\n[fem]\nhourglas = 0.1\n", models::shipped("epam-textbook").unwrap()));
    refuse(&folder, &["simulate", "my.toml"], 3, &["my.toml:26:1", "did you mean `hourglass`?"]);
}

#[test]
fn both_engines_stand_beside_the_published_numbers_from_stored_runs() {
    let folder = Folder::new();
    let ran = folder.run(&["compare", "--engines", "--stored", "--out", "page"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    for words in ["measured, published", "predicted", "67.5", "159.7", "119.4", "67.2", "94.9"] {
        assert!(ran.stdout.contains(words), "{words}: {}", ran.stdout);
    }
    let page = read(&folder, "page/report.html");
    assert!(page.contains("Ledgers side by side") && folder.path("page/engines.png").exists());
    assert_opens_offline(&page);
    assert_hashes(&folder.path("page"));
    let wrong = folder.run(&["compare", "epam"]);
    assert!(wrong.code == 2 && wrong.stderr.contains("alone: a scenario and data are needed"), "{}", wrong.stderr);
}

#[test]
fn the_papers_own_model_makes_a_run_of_every_pressure_and_its_table_comes_from_stored_ones() {
    let folder = Folder::new();
    let more = ["--mesh", "14mm", "--end", "0.1ms", "--no-frames", "--quiet", "--out", "batch"];
    let ran = folder.run(&[&["simulate", "epam-paper"], &more[..]].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    for kpa in ["10", "20", "30"] {
        let summary: Value = serde_json::from_str(&read(&folder, &format!("batch/{kpa}kPa/summary.json"))).unwrap();
        assert_eq!(summary["robot"]["model"], "paper");
    }
    let answer = folder.run(&["compare", "--paper", "--out", "page", "--json"]).json("ibr.paper");
    let facts = answer["facts"].as_array().unwrap();
    assert!(facts.iter().any(|f| f["id"] == "area" && f["verdict"]["is"] == "holds"), "{facts:?}");
    assert_eq!(answer["heights"].as_array().unwrap().is_empty(), answer["runs"] == 0);
    assert_hashes(&folder.path("page"));
    let wrong = folder.run(&["compare", "--paper", "epam"]);
    assert!(wrong.code == 2 && wrong.stderr.contains("--runs FOLDER compares them"), "{}", wrong.stderr);
}

#[test]
fn every_study_is_listed_printed_and_predicted_and_starts_in_finite_elements() {
    let folder = Folder::new();
    let listed = folder.run(&["list", "cases", "--json"]).json("ibr.list");
    let names: Vec<&str> =
        listed["cases"]["studies"].as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    let paper = ["spam-paper", "cpam-paper", "epam-paper", "fpam-paper"];
    let in_space = ["epam-two-strips", "epam-helix"];
    assert_eq!(
        names,
        [&["cpam-11-12-13", "cpam-mesh"], &paper[..], &["long", "tip-load"], &in_space, &["obstacle"]].concat()
    );
    for name in names {
        folder.write("mine.toml", folder.run(&["new", name]).stdout);
        let predicted = folder.run(&["predict", "mine.toml"]);
        assert_eq!(predicted.code, 0, "{name}: {}", predicted.stderr);
        let more = ["--mesh", "12mm", "--end", "0.1ms", "--no-frames", "--quiet", "--out", name];
        let ran = folder.run(&[&["simulate", name], &more[..]].concat());
        assert_eq!(ran.code, 0, "{name}: {}", ran.stderr);
    }
}
