//! `ibr characterize`: what it writes can be used, and what it refuses it refuses whole.

use crate::refused::{refuse, with_report};
use crate::support::{Folder, assert_hashes};

fn example() -> Folder {
    let folder = Folder::new();
    assert_eq!(folder.run(&["characterize", "--example", "tests"]).code, 0);
    folder
}

const FILES: [&str; 4] = ["characterize", "tests/warp.csv", "tests/bias.csv", "tests/fill.csv"];

#[test]
fn the_fabric_that_it_writes_runs_in_a_case() {
    let folder = example();
    let ran = folder.run(&[&FILES[..], &["--name", "film", "--out", "out"]].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let names = assert_hashes(&folder.path("out"));
    for name in [
        "fabric.toml",
        "tension.png",
        "tension.svg",
        "bias.png",
        "shear.png",
        "mean_warp.csv",
        "mean_fill.csv",
        "mean_shear.csv",
    ] {
        assert!(names.iter().any(|n| n == name), "{name}");
    }
    let fragment = std::fs::read_to_string(folder.path("out/fabric.toml")).unwrap();
    assert_eq!(fragment.matches("[fabric.").count(), 3, "{fragment}");
    let case = fem::case::shipped_case("pillow").unwrap();
    let (head, rest) = case.split_once("[fabric.film]").unwrap();
    let tail = rest.split_once("[part.all]").unwrap().1;
    for name in ["film", "film-linear", "film-film"] {
        let part = tail.replace("fabric = \"film\"", &format!("fabric = \"{name}\""));
        let text = format!("{head}{fragment}\n[part.all]{part}");
        let read = fem::case::Case::parse(&text, &mut |_| unreachable!()).unwrap();
        let fabric = &read.problem.sections[0].plies[0].fabric;
        // The law that the case makes pulls back as the tests did: E0 = 96.5 MPa, within the scatter; six C10 for the film.
        let tension = fabric.tension([1e-4, 0.0, 0.0], &[0.0; 2])[0] / (1e-4 * fabric.thickness_m());
        let wanted = if name == "film-film" { 80e6..200e6 } else { 90e6..103e6 };
        assert!(wanted.contains(&tension), "{name}: {tension}");
    }
}

#[test]
fn what_it_writes_for_a_robot_is_read_by_a_diagnosis() {
    let folder = example();
    let tests = ["tests/warp.csv", "tests/bias.csv", "tests/fill.csv"];
    assert_eq!(folder.run(&[&["characterize"], &tests[..], &["--out", "out"]].concat()).code, 0);
    let measured = std::fs::read_to_string(folder.path("out/measured.toml")).unwrap();
    std::fs::create_dir(folder.path("set")).unwrap();
    folder.write("set/markers.csv", data::set_file("synthetic-fpam", "markers.csv").unwrap());
    folder.write("set/about.toml", data::set_file("synthetic-fpam", "about.toml").unwrap().to_string() + &measured);
    let answer = folder.run(&["diagnose", "fpam-textbook", "set", "--json"]).json("ibr.diagnose");
    let warnings = answer["warnings"].to_string();
    // Stretch and shear are there; that the weave locks far beyond a muscle's stroke is no lack of the model.
    for word in ["fabric_stretch as measured", "shear_stiffness as measured: G_t = 49.6 ±"] {
        assert!(warnings.contains(word), "{warnings}");
    }
    assert!(measured.contains("lock_rad = [0.78") && !warnings.contains("shear_lock"), "{measured} {warnings}");
}

#[test]
fn json_has_every_number_with_interval_and_how_it_is_known() {
    let answer = example().run(&[&FILES[..], &["--json"]].concat()).json("ibr.characterize");
    let quantities = answer["quantities"].as_array().unwrap();
    for key in ["e0", "e45", "e90", "c10", "g12", "g12_link", "locking"] {
        let q = quantities.iter().find(|q| q["key"] == key).unwrap_or_else(|| panic!("{key}"));
        assert!(q["mean"].is_f64() && q["how_known"].is_string() && q["interval"][1].is_f64(), "{q}");
    }
    assert_eq!(answer["specimens"].as_array().unwrap().len(), 15);
    assert!(answer["fabric_toml"].as_str().unwrap().contains("law = \"woven\""));
}

#[test]
fn a_cantilever_test_gives_the_bending_stiffness_and_every_test_is_replayed() {
    let folder = example();
    folder.write("droop.csv", "# areal_mass_g_m2: 155\noverhang_mm,droop_deg\n75,59.04\n");
    let answer = folder.run(&[&FILES[..], &["droop.csv", "--json"]].concat()).json("ibr.characterize");
    let quantities = answer["quantities"].as_array().unwrap();
    let value = |key: &str| quantities.iter().find(|q| q["key"] == key).unwrap()["mean"].as_f64().unwrap();
    // c = 75 mm [cos 29.52°/(8 tan 59.04°)]^⅓, D = 0.155 kg/m² g c³.
    assert!((value("bending_length") - 30.2).abs() < 0.1 && (value("bending_stiffness") - 41.9).abs() < 0.5);
    folder.write("any.csv", "# areal_mass_g_m2: 155\nspecimen,overhang_mm,droop_deg\nA1,75,59.04\n");
    let alone = folder.run(&["characterize", "any.csv"]);
    assert!(alone.code == 0 && alone.stdout.contains("30.19") && alone.stdout.contains("41.85"), "{}", alone.stderr);
    let replays = answer["replays"].as_array().unwrap();
    assert_eq!(replays.len(), 45, "15 specimens by three laws");
    let own: Vec<_> = replays.iter().filter(|r| r["law"] == "fabric").collect();
    assert!(own.iter().all(|r| r["rms"].as_f64().unwrap() < 0.15), "stiffness scatters by 4 %: {own:?}");
}

#[test]
fn one_direction_or_no_thickness_still_gives_what_it_can() {
    let folder = example();
    let ran = folder.run(&["characterize", "tests/fill.csv", "--out", "out"]);
    assert!(ran.code == 0 && ran.stdout.contains("E90") && folder.path("out/fabric.toml").exists(), "{}", ran.stdout);
    let bias = std::fs::read_to_string(folder.path("tests/bias.csv")).unwrap();
    folder.write("thin.csv", bias.replace("# thickness_mm: 0.05\n", ""));
    let ran = folder.run(&["characterize", "thin.csv", "--out", "thin"]);
    assert!(ran.code == 0 && ran.stdout.contains("No fabric.toml: the thickness is missing"), "{}", ran.stdout);
    assert!(folder.path("thin/mean_shear.csv").exists() && !folder.path("thin/fabric.toml").exists());
}

#[test]
fn wrong_tests_are_refused_and_earlier_results_stay() {
    let made = example();
    let warp = std::fs::read_to_string(made.path("tests/warp.csv")).unwrap();
    let bias = std::fs::read_to_string(made.path("tests/bias.csv")).unwrap();
    let folder = with_report();
    for (bad, words) in [
        (warp.replace("stress_mpa", "stress_kpa"), &["warp1 (0°)", "name it stress_mpa"][..]),
        (bias.replace("length_mm: 250", "length_mm: 35"), &["H = 35.000 mm", "W = 20.000 mm"]),
        (bias.replace("displacement_mm,", "displacement,"), &["displacement has no unit", "displacement_mm"]),
        (warp.replace("# direction_deg: 0\n", ""), &["direction of the pull is not known", "--direction 0"]),
        (warp.replace("# direction_deg: 0\n", "# direction_deg: 120\n"), &["120 degrees"]),
        (warp.lines().take(10).collect::<Vec<_>>().join("\n"), &["has 3 rows"]),
        (String::new(), &["the file is empty"]),
    ] {
        folder.write("bad.csv", bad);
        refuse(&folder, &["characterize", "bad.csv", "--out", "report"], 3, &[&["bad.csv"], words].concat());
    }
    refuse(&folder, &["characterize", "none.csv", "--out", "report"], 3, &["none.csv", "cannot open"]);
    folder.write("report/mean_warp.csv", &warp);
    refuse(
        &folder,
        &["characterize", "report/mean_warp.csv", "--out", "report"],
        2,
        &["would be written over", "--out"],
    );
    refuse(&folder, &["characterize"], 2, &["FILES"]);
    refuse(&folder, &["characterize", "bad.csv", "--width", "20"], 2, &["--width", "unit"]);
    refuse(&folder, &["characterize", "bad.csv", "--modulus-to", "0"], 2, &["--modulus-to"]);
}
