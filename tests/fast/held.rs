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
    let answer = folder.run(&["compare", "festo-bolen-2026", "--json"]).json("ibr.compare.bench");
    assert_eq!(
        (answer["kind"].as_str(), answer["provenance"].as_str()),
        (Some("force_contraction"), Some("published"))
    );
    assert_eq!(answer["held"]["rows"].as_array().unwrap().len(), 4);
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
    refuse(
        &folder,
        &["diagnose", "fpam", "mckibben-free"],
        2,
        &["force_contraction table", "ibr compare mckibben-free"],
    );
    refuse(&folder, &["characterize", "bad.csv"], 3, &["deflection_mm"]);
    refuse(&folder, &["compare", "mckibben-free"], 3, &["bias_deg", "--calibrate"]);
    refuse(&folder, &["compare", "breukels-2011-beams", "--sigma", "1mm"], 2, &["--sigma", "leave"]);
}
