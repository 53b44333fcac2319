//! Finite element robots on the command line: settings, several pressures and runs, both engines. The robots are coarse and
//! fast: what they give is no result.

use crate::refused::{refuse, with_report};
use crate::support::{Folder, assert_hashes, assert_opens_offline};
use serde_json::Value;

/// A tenth of a second of processor time.
const QUICK: [&str; 9] = [
    "--mesh",
    "14mm",
    "--set",
    "body_ramp_s=0.004",
    "--set",
    "actuator_ramp_s=0.006",
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
        assert!(reading["body_m3"].as_f64().unwrap() > 1.5e-3 && reading["seam_n_per_m"].as_f64().unwrap() > 1.0);
    }
    let names = assert_hashes(&folder.path("run"));
    for name in ["readings.csv", "markers.csv", "snaps.csv", "history.png", "side.png", "section.png", "cut.png"] {
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
fn seeds_and_separate_pressures_are_runs_of_their_own_which_are_kept() {
    let folder = Folder::new();
    let more = ["--pressure", "10kPa,15kPa", "--separate", "--seeds", "2", "--out", "batch"];
    let answer = simulate(&folder, &more);
    let runs = answer["runs"].as_array().unwrap();
    let labels: Vec<&str> = runs.iter().map(|r| r["run"].as_str().unwrap()).collect();
    assert_eq!(labels, ["seed-1-10kPa", "seed-1-15kPa", "seed-2-10kPa", "seed-2-15kPa"]);
    let groups = answer["groups"].as_array().unwrap();
    assert_eq!(groups.len(), 2, "one mean per pressure");
    let tip = |k: usize| runs[k]["heights"][0]["tip_mm"].as_f64().unwrap();
    let mean = groups[0]["tip_mean_mm"].as_f64().unwrap();
    assert!((mean - 0.5 * (tip(0) + tip(2))).abs() < 1e-12 && tip(0) != tip(2), "{groups:?}");
    let before = std::fs::metadata(folder.path("batch/seed-1-10kPa/manifest.json")).unwrap().modified().unwrap();
    assert_eq!(simulate(&folder, &more)["runs"], answer["runs"], "the same from what is kept");
    let after = std::fs::metadata(folder.path("batch/seed-1-10kPa/manifest.json")).unwrap().modified().unwrap();
    assert_eq!(before, after);
    let other = [&["simulate", "epam"], &QUICK[..], &more, &["--set", "hourglass=0.02"]].concat();
    refuse(&folder, &other, 3, &["batch/seed-1-10kPa", "another case", "--force"]);
}

#[test]
fn sensitivity_tells_what_each_assumed_number_does_and_which_do_nothing_here() {
    let folder = Folder::new();
    let answer = simulate(&folder, &["--sensitivity", "--out", "s"]);
    let runs = answer["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 1 + 2 * fem::robot::ASSUMED.len());
    let base = answer["tip_mm"].as_f64().unwrap();
    let tip = |name: &str| {
        let run = runs.iter().find(|r| r["run"].as_str().unwrap().starts_with(name)).unwrap();
        run["heights"][0]["tip_mm"].as_f64().unwrap()
    };
    assert_eq!(tip("glue_mm"), base, "an ePAM has no glue");
    assert_ne!(tip("bending_factor"), base);
    assert!(folder.path("s/tornado.png").exists() && read(&folder, "s/table.csv").contains("bending_factor=0.02"));
}

#[test]
fn wrong_settings_are_refused_before_anything_is_run() {
    let folder = with_report();
    for (args, words) in [
        (["--pressure", "1kPa"], ["1 kPa in a body at 2 kPa", "raise the actuator pressure"]),
        (["--pressure", "10"], ["--pressure", "no unit"]),
        (["--mesh", "4"], ["--mesh", "no unit"]),
        (["--mesh", "40mm"], ["elements", "lower actuator_size_m"]),
        (["--set", "bnd=1"], ["unknown key `bnd`", "hourglass"]),
        (["--set", "bond=2"], ["bond must be from 0 to 1, not 2", "here"]),
        (["--set", "weld_mm=70"], ["welds of 70 mm every 60 mm overlap", "below 60 mm"]),
    ] {
        let code = if words[0].starts_with("--") || words[0].starts_with("unknown") { 2 } else { 3 };
        refuse(&folder, &[&["simulate", "epam"], &args[..]].concat(), code, &words);
    }
    refuse(&folder, &["simulate", "pillow", "--seeds", "3"], 2, &["--seeds is for robots", "case file"]);
    folder.write("my.toml", format!("{}\n[fem]\nhourglas = 0.1\n", models::shipped("epam").unwrap()));
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
    assert_opens_offline(&page);
    assert_hashes(&folder.path("page"));
    let wrong = folder.run(&["compare", "epam"]);
    assert!(wrong.code == 2 && wrong.stderr.contains("a scenario and data, not 1 names"), "{}", wrong.stderr);
}

#[test]
fn a_breakdown_is_drawn_from_runs_that_are_kept() {
    let folder = Folder::new();
    folder.write(
        "quick.toml",
        models::shipped("fpam").unwrap().to_string() + "\n[fem]\nbody_ramp_s = 0.004\nactuator_ramp_s = 0.006\n",
    );
    let args = [
        "breakdown",
        "quick.toml",
        "--mesh",
        "14mm",
        "--pressure",
        "10kPa,20kPa",
        "--body-pressure",
        "3kPa",
        "--out",
        "map",
        "--runs",
        "runs",
        "--json",
    ];
    let answer = folder.run(&args).json("ibr.breakdown");
    let cells = answer["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 4, "two pressures at the body's own and at 3 kPa; no pouches to vary");
    assert!(cells.iter().any(|c| c["body_kpa"] == 3.0) && folder.path("map/breakdown_fpam_0.png").exists());
    let first = std::fs::read(folder.path("map/breakdown.csv")).unwrap();
    folder.run(&args).json("ibr.breakdown");
    assert_eq!(std::fs::read(folder.path("map/breakdown.csv")).unwrap(), first);
    assert_eq!(std::fs::read_dir(folder.path("runs")).unwrap().count(), 2);
}

#[test]
fn every_study_is_listed_printed_read_by_both_engines_and_starts() {
    let folder = Folder::new();
    let listed = folder.run(&["list", "cases", "--json"]).json("ibr.list");
    let names: Vec<&str> =
        listed["cases"]["studies"].as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["cpam-11-12-13", "long", "tip-load", "obstacle"]);
    for name in names {
        folder.write("mine.toml", folder.run(&["new", name]).stdout);
        let predicted = folder.run(&["predict", "mine.toml"]);
        assert_eq!(predicted.code, 0, "{name}: {}", predicted.stderr);
        let more = ["--mesh", "12mm", "--end", "0.1ms", "--no-frames", "--quiet", "--out", name];
        let ran = folder.run(&[&["simulate", name], &more[..]].concat());
        assert_eq!(ran.code, 0, "{name}: {}", ran.stderr);
    }
}
