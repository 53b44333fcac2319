//! `ibr data import`: from a tracking program's files to a named effect.

use crate::support::{Folder, assert_hashes, repository};

/// Files of the cases that are shared with the library's tests.
fn case(file: &str) -> String {
    repository().join("data/tests/cases").join(file).display().to_string()
}

/// The four commands of the guide, on a DeepLabCut folder and a pressure log: the effect that made the data is named.
#[test]
fn from_deeplabcut_to_the_named_effect() {
    let folder = Folder::new();
    let runs = [1, 2, 3].map(|run| case(&format!("c01-deeplabcut/run{run}.csv")));
    let log = case("c01-deeplabcut/pressure.csv");
    let mut args = vec!["data", "import", &runs[0], &runs[1], &runs[2], "--pressure", &log, "--scale", "3.1px/mm"];
    args.extend(["--base", "212,540", "--fps", "30", "--actuator", "epam", "--stations", "a=90mm,b=210mm,c=330mm"]);
    let only = folder.run(&args);
    assert!(only.stdout.contains("Nothing was written") && folder.contents().is_empty(), "{}", only.stderr);
    args.extend(["--out", "mine"]);
    let ran = folder.run(&args);
    assert!(ran.code == 0 && ran.stdout.contains("read as DeepLabCut: 3 runs, 45 frames"), "{}", ran.stderr);
    let mut names = assert_hashes(&folder.path("mine"));
    names.sort();
    let pictures = (1..=3)
        .flat_map(|k| ["png", "svg"].map(|e| if k == 1 { format!("tracks.{e}") } else { format!("tracks-{k}.{e}") }));
    let mut expected: Vec<String> = pictures.chain(["about.toml", "markers.csv"].map(String::from)).collect();
    expected.sort();
    assert_eq!(names, expected);
    let about = std::fs::read_to_string(folder.path("mine/about.toml")).unwrap();
    assert!(
        about.contains("# QUESTION: how large is the robot?") && about.contains("s_mm = [90.0, 210.0, 330.0]"),
        "{about}"
    );
    let checked = folder.run(&["data", "check", "mine"]);
    assert!(checked.stdout.contains("3 rows have no position"), "{}{}", checked.stdout, checked.stderr);
    let diagnosis = folder.run(&["diagnose", "epam-textbook", "mine", "--json"]).json("ibr.diagnose");
    let ranked = &diagnosis["ranked"][0];
    let (name, beta) = (ranked["effect"].as_str(), ranked["value"].as_f64().unwrap());
    assert!(name == Some("end_constraint") && (beta - 0.402).abs() < 0.008, "{name:?} {beta}");
    assert!(ranked["lo"].as_f64().unwrap() < 0.402 && ranked["hi"].as_f64().unwrap() > 0.402, "{ranked}");
    let again = folder.run(&args);
    assert!(again.code == 2 && again.stderr.contains("--force"), "{}", again.stderr);
}

/// A camera whose frame rate varies: the refusal comes with the picture of both tracks, and a dataset stays as it was.
#[test]
fn a_refused_clock_leaves_its_picture_and_no_dataset() {
    let folder = Folder::new();
    let [run, log] = ["vfr.csv", "pressure.csv"].map(|name| case(&format!("c39-frame-rate/{name}")));
    let mut args = vec!["data", "import", &run, "--pressure", &log, "--scale", "3.1px/mm", "--base", "212,540"];
    args.extend(["--fps", "30", "--actuator", "epam", "--out", "mine"]);
    let ran = folder.run(&args);
    assert!(ran.code == 3 && ran.stderr.contains("mine/clock.svg"), "{}", ran.stderr);
    let mut names = assert_hashes(&folder.path("mine"));
    names.sort();
    assert_eq!(names, ["clock.png", "clock.svg"]);
    let found = folder.run(&[&args[..], &["--clock-offset", "find"]].concat());
    assert!(found.code == 0 && folder.path("mine/markers.csv").exists(), "{}", found.stderr);
    let before = folder.contents();
    let again = folder.run(&[&args[..], &["--force"]].concat());
    assert!(again.code == 3 && folder.contents() == before, "{}", again.stderr);
}

/// Motion capture and a log of LabVIEW in four commands: import, check, compare, diagnose.
#[test]
fn from_vicon_and_labview_to_the_named_effect() {
    let folder = Folder::new();
    let runs = [1, 2, 3].map(|run| case(&format!("c21-vicon-nexus/trial{run}.csv")));
    let log = case("c26-pressure-loggers/labview.lvm");
    let mut args = vec!["data", "import", &runs[0], &runs[1], &runs[2], "--pressure", &log, "--actuator", "epam"];
    args.extend(["--stations", "a=90mm,b=210mm,c=330mm", "--out", "mine"]);
    assert_eq!(folder.run(&args).code, 0);
    let checked = folder.run(&["data", "check", "mine"]);
    assert!(checked.code == 0 && !checked.stdout.contains("looks like"), "{}{}", checked.stdout, checked.stderr);
    let compared = folder.run(&["compare", "epam-textbook", "mine", "--json"]).json("ibr.compare");
    assert!(compared["schema"] == "ibr.compare", "{compared}");
    let diagnosis = folder.run(&["diagnose", "epam-textbook", "mine", "--json"]).json("ibr.diagnose");
    let ranked = &diagnosis["ranked"][0];
    let (name, beta) = (ranked["effect"].as_str(), ranked["value"].as_f64().unwrap());
    assert!(name == Some("end_constraint") && (beta - 0.402).abs() < 0.008, "{name:?} {beta}");
}

/// A ramp is sent to the import by whatever reads it, and comes back binned.
#[test]
fn a_ramp_is_sent_to_the_import() {
    let folder = Folder::new();
    let refused = folder.run(&["compare", "epam-textbook", &case("c10-ramp")]);
    assert!(refused.code == 3 && refused.stderr.contains("looks like a ramp") && refused.stderr.contains("--bin 2kPa"));
    let args = [
        "data",
        "import",
        &case("c10-ramp/markers.csv"),
        "--bin",
        "2kPa",
        "--stations",
        "a=90mm,c=330mm",
        "--out",
        "r",
    ];
    let ran = folder.run(&args);
    assert!(ran.code == 0, "{}", ran.stderr);
    let diagnosis = folder.run(&["diagnose", "epam-textbook", "r", "--json"]).json("ibr.diagnose");
    let ranked = &diagnosis["ranked"][0];
    let beta = ranked["value"].as_f64().unwrap();
    assert!(ranked["effect"] == "end_constraint" && (beta - 0.4).abs() < 0.01, "{beta}");
}

#[test]
fn slips_of_the_command_line_say_what_to_write() {
    let folder = Folder::new();
    let file = case("c02-motive/vine_1.csv");
    for (option, value, help) in [
        ("--scale", "3.1", "3.1px/mm"),
        ("--scale", "px/mm", "3.1px/mm"),
        ("--scale", "a:b", "a:b=40mm"),
        ("--axes", "x,x", "x,-y"),
        ("--clock-offset", "soon", "write find"),
        ("--hold", "1", "units s, ms, min"),
        ("--map", "marker", "QUANTITY=COLUMN"),
        ("--map", "colour=Red", "QUANTITY is one of run"),
        ("--bin", "0kPa", "--bin 2kPa"),
        ("--stations", "a", "a=90mm"),
        ("--likelihood", "90", "0 to 1"),
        ("--pressure-unit", "torr", "kPa"),
    ] {
        let ran = folder.run(&["data", "import", &file, option, value]);
        assert!(ran.code == 2 && ran.stderr.contains(help), "{option} {value}: {}", ran.stderr);
    }
    let other = folder.run(&[
        "data",
        "import",
        &file,
        "--stations",
        "d=90mm",
        "--pressure",
        &case("c02-motive/pressure.csv"),
        "--actuator",
        "epam",
    ]);
    assert!(
        other.code == 3 && other.stderr.contains("d, which is not a marker") && other.stderr.contains("a, b, c"),
        "{}",
        other.stderr
    );
}
