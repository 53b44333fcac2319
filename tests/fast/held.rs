//! Bench tests held against models: tables beside markers, each with its own scenario or none.

use crate::refused::refuse;
use crate::support::Folder;

#[test]
fn a_beam_and_a_muscle_are_compared_like_markers() {
    let folder = Folder::new();
    let beam = folder.run(&["compare", "breukels-2011-beams", "--calibrate"]);
    assert_eq!(beam.code, 0, "{}", beam.stderr);
    assert!(
        beam.stdout.contains("(calibrated)") && beam.stdout.contains("calibrated on the first load"),
        "{}",
        beam.stdout
    );
    let stiff = folder.run(&["compare", "breukels-2011-beams"]);
    assert!(stiff.stdout.contains("note: the scenario has no wall_stiffness_n_per_m"), "{}", stiff.stdout);
    let answer = folder.run(&["compare", "festo-bolen-2026", "--json"]).json("ibr.compare.bench");
    assert_eq!(
        (answer["kind"].as_str(), answer["provenance"].as_str()),
        (Some("force_contraction"), Some("published"))
    );
    assert_eq!(answer["held"]["rows"].as_array().unwrap().len(), 4);
    let least = answer["held"]["rows"][1]["model"].as_f64().unwrap();
    assert!((least - 89.08).abs() < 0.01, "the short muscle pulls less for its plugs: {least}");
    // A table of one's own, with scatter, beside its scenario.
    folder.write("scenario.toml", data::set_file("breukels-2011-beams", "scenario.toml").unwrap());
    folder.write("mine.csv", "p_body_kpa,load_n,deflection_mm,deflection_sd_mm,n\n30,4,5,50,3\n30,4,5,0.001,3\n");
    let mine = folder.run(&["compare", "mine.csv", "-e", "gravity:weight_n_per_m=0.01"]);
    assert!(
        mine.code == 0 && mine.stdout.contains("agrees") && mine.stdout.contains("off by"),
        "{}{}",
        mine.stdout,
        mine.stderr
    );
    assert!(folder.run(&["data", "check", "mine.csv"]).stdout.contains("2 rows (measured)"));
}

#[test]
fn a_robot_with_a_scenario_of_its_own_needs_no_other() {
    let folder = Folder::new();
    let ran = folder.run(&["compare", "jitosho-2023-arm", "--sigma", "1mm", "--out", "report"]);
    assert!(ran.code == 0 && ran.stdout.contains("fPAM arm"), "{}{}", ran.stdout, ran.stderr);
}

#[test]
fn what_a_table_is_not_for_is_refused_with_the_command_that_is() {
    let folder = Folder::new();
    folder.write("bad.csv", "p_body_kpa,load_n,deflection_mm\n30,4,none\n");
    refuse(&folder, &["compare", "bad.csv"], 3, &["bad.csv:2, column deflection_mm", "found \"none\""]);
    refuse(&folder, &["diagnose", "bad.csv"], 3, &["bad.csv:2, column deflection_mm", "found \"none\""]);
    refuse(
        &folder,
        &["diagnose", "epam", "synthetic-epam", "--also", "festo-bolen-2026"],
        2,
        &["not markers", "ibr compare"],
    );
    for (option, value, words) in [
        ("--also", "mckibben-free", "one table"),
        ("--out", "d", "--json"),
        ("--tolerance", "1mm", "--sigma 3%"),
        ("--sigma", "1mm", "per cent"),
    ] {
        refuse(&folder, &["diagnose", "festo-bolen-2026", option, value], 2, &[option, words]);
    }
    refuse(&folder, &["diagnose", "epam"], 2, &["a scenario and data are needed", "ibr diagnose epam synthetic-epam"]);
    folder.write("muscle.csv", "p_act_kpa,contraction_pct,force_n\n20,5,30\n");
    refuse(&folder, &["diagnose", "muscle.csv"], 3, &["muscle.csv", "line 2", "diameter_mm"]);
    refuse(&folder, &["characterize", "bad.csv"], 3, &["deflection_mm"]);
    refuse(&folder, &["compare", "mckibben-free"], 3, &["bias_deg", "--calibrate"]);
    refuse(&folder, &["compare", "breukels-2011-beams", "--sigma", "1mm"], 2, &["--sigma", "leave"]);
}

/// A beam whose wall stretches, with the scatter of four tests: `ibr diagnose` names it, ranks what else was tried and says where
/// the model fails.
#[test]
fn a_table_is_diagnosed_like_markers() {
    let folder = Folder::new();
    let text = folder.run(&["diagnose", "fpam-textbook", "festo-bolen-2026"]);
    assert_eq!(text.code, 0, "{}", text.stderr);
    for words in ["ranking only", "end_fittings", "left-out specimen", "Where the model as it is fails", "line 6"] {
        assert!(text.stdout.contains(words), "no `{words}` in {}", text.stdout);
    }
    let answer = folder
        .run(&["diagnose", "fpam-textbook", "festo-bolen-2026", "--sigma", "10%", "--json"])
        .json("ibr.diagnose.bench");
    assert!(answer["verdict"].is_string() && answer["p_value"].is_number(), "{answer}");
    assert_eq!((answer["rows"].as_u64(), answer["provenance"].as_str()), (Some(4), Some("published")));
    assert_eq!(answer["ranked"][0]["effect"], "end_fittings");
}

/// What acts in a muscle acts on the bench too, and is no longer passed over.
#[test]
fn an_effect_of_the_scenario_changes_what_a_muscle_pulls() {
    let folder = Folder::new();
    folder.write("muscle.csv", "# diameter_mm: 38\np_act_kpa,contraction_pct,force_n\n20,5,30\n");
    let pull = |more: &[&str]| {
        let answer = folder
            .run(&[&["compare", "fpam-textbook", "muscle.csv", "--json"], more].concat())
            .json("ibr.compare.bench");
        answer["held"]["rows"][0]["model"].as_f64().unwrap()
    };
    let (plain, lossy) = (pull(&[]), pull(&["-e", "pressure_loss:fraction=0.1,exponent=1"]));
    assert!((lossy / plain - 0.9).abs() < 1e-9, "{plain} {lossy}");
}
