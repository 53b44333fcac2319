//! `ibr add`, `ladder`, `validate` and the report of `diagnose`: new scenarios, the old one as it was, the fall of the error.

use crate::support::{Folder, assert_hashes, assert_opens_offline};
use sha2::{Digest, Sha256};

fn own() -> &'static str {
    models::shipped("epam-textbook").unwrap()
}

/// A folder with an ePAM of the user's own and data of it, five runs at 2 and at 4 kPa body pressure.
fn robot() -> Folder {
    let folder = Folder::new();
    folder.write("mine.toml", format!("# my robot\n{}", own()));
    let truth = own().replace("bending_stiffness_nm2 = 0 ", "bending_stiffness_nm2 = 1 ");
    folder.write("truth.toml", format!("{truth}\n[effects.end_constraint]\nbeta = 0.4\n"));
    for (name, body) in [("two", "2"), ("four", "4")] {
        let protocol = format!("0,10,20,30,0@{body}");
        let ran = folder.run(&["data", "generate", "truth.toml", "--out", name, "--protocol", &protocol]);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
    }
    folder
}

#[test]
fn an_effect_is_fitted_written_and_seen_to_help_and_the_old_scenario_stays() {
    let folder = robot();
    let before = folder.contents();
    let answer = folder.run(&["add", "mine.toml", "end_constraint", "two", "--json"]).json("ibr.add");
    let (old, new) = (&answer["before"], &answer["after"]);
    for key in ["training_mm", "heldout_pressure_mm", "heldout_run_mm"] {
        assert!(new[key].as_f64().unwrap() < 0.5 * old[key].as_f64().unwrap(), "{key}: {answer}");
    }
    let beta = &answer["effects"][0]["parameters"][0];
    assert!(beta["lo"].as_f64().unwrap() < 0.4 && 0.4 < beta["hi"].as_f64().unwrap(), "{beta}");
    assert!(before.iter().all(|(path, bytes)| std::fs::read(path).unwrap() == *bytes));
    assert_eq!(folder.contents().len(), before.len() + 1);

    let text = std::fs::read_to_string(folder.path("mine-end_constraint.toml")).unwrap();
    assert!(text.starts_with("# my robot\n") && text.contains("basis = \"calibrated\""), "{text}");
    for line in own().lines().filter(|l| !l.starts_with("bending")) {
        assert!(text.contains(line), "{line}");
    }
    let hash = answer["data"]["sha256"].as_str().unwrap();
    assert!(text.contains(&format!("SHA-256 {hash}")) && text.contains("interval = \"beta 0."), "{text}");

    let compare = |scenario: &str| {
        let answer = folder.run(&["compare", scenario, "two", "--json"]).json("ibr.compare");
        answer["overall"]["systematic_mm"].as_f64().unwrap()
    };
    assert!(compare("mine-end_constraint.toml") < 0.1 * compare("mine.toml"));
    for (data, own) in [("two", true), ("four", false)] {
        let answer = folder.run(&["compare", "mine-end_constraint.toml", data, "--json"]).json("ibr.compare");
        let added = &answer["added"];
        assert_eq!((&added["effects"][0], &added["fitted_to_these"]), (&"end_constraint".into(), &own.into()));
        let error = |key: &str| added[key]["beyond_noise_mm"].as_f64().unwrap();
        assert!(error("after") < 0.5 * error("before"), "{added}");
    }
    let told = folder.run(&["compare", "mine-end_constraint.toml", "four", "--out", "c"]);
    assert!(
        told.stdout.contains("without → with end_constraint") && told.stdout.contains("helps where it was not fitted")
    );
    assert!(folder.run(&["compare", "mine.toml", "two", "--json"]).json("ibr.compare")["added"].is_null());

    let answer = folder.run(&["validate", "mine-end_constraint.toml", "two", "four", "--json"]).json("ibr.validate");
    let sets = answer["datasets"].as_array().unwrap();
    assert_eq!([&sets[0]["verdict"], &sets[1]["verdict"]], ["fitted_to_these", "helps"], "{answer}");
}

#[test]
fn finite_elements_of_the_same_robot_stand_beside_the_diagnosis_and_their_ledger_speaks() {
    let folder = Folder::new();
    let answer = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--json"]).json("ibr.diagnose");
    let beside = &answer["finite_elements"];
    let models = beside["models"].as_array().unwrap();
    let apart = |name: &str| models.iter().find(|model| model["name"] == name).unwrap()["apart_mj"].as_f64().unwrap();
    assert_eq!([&models[0]["name"], &models[1]["name"]], ["base", "+ end_constraint"], "{beside}");
    let [base, edges, contact] = ["base", "+ end_constraint", "+ self_contact"].map(apart);
    assert!(edges < 0.5 * base && edges < 0.5 * contact, "{beside}");
    assert_eq!(beside["heights"].as_array().unwrap().len(), 3, "{beside}");

    folder.write("mine.toml", own().replace("radius_mm = ", "radius_mm = 1"));
    let other = folder.run(&["diagnose", "mine.toml", "synthetic-epam", "--json"]);
    assert!(other.code != 0 || other.json("ibr.diagnose")["finite_elements"].is_null(), "{}", other.stdout);
    let none = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--runs", "nowhere"]);
    assert!(none.code == 2 && none.stderr.contains("--runs nowhere"), "{}", none.stderr);
}

#[test]
fn a_value_given_is_called_assumed_and_no_file_is_replaced_unless_told() {
    let folder = Folder::new();
    let ran = folder.run(&["add", "epam", "friction=0.2"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let path = folder.path("epam-friction.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("[effects.friction]\nmoment_nm = 0.2\nbasis = \"assumed\""), "{text}");
    let hash = Sha256::digest(&text);
    let again = folder.run(&["add", "epam", "friction=0.3"]);
    assert_eq!(again.code, 2);
    assert!(again.stderr.contains("exists already") && again.stderr.contains("--force"), "{}", again.stderr);
    assert_eq!(Sha256::digest(std::fs::read(&path).unwrap()), hash);
    assert_eq!(folder.run(&["add", "epam", "friction=0.3", "--force"]).code, 0);
    let own = folder.run(&["add", "epam-friction.toml", "gravity=1", "--out", "epam-friction.toml", "--force"]);
    assert_eq!(own.code, 2);
    assert!(own.stderr.contains("the scenario itself"), "{}", own.stderr);
}

#[test]
fn what_cannot_be_added_is_said_and_nothing_is_written() {
    let folder = Folder::new();
    let refusals: &[(&[&str], &str)] = &[
        (&["add", "epam-textbook", "frictoin"], "unknown effect `frictoin`"),
        (&["add", "epam-textbook", "friction=much"], "is not a number"),
        (&["add", "epam-textbook", "friction", "--force", "--out", "."], ". is a folder, not a file"),
        (&["add", "epam-textbook", "friction=50"], "outside its usual bounds 0 to 5 N m"),
        (&["add", "epam-textbook", "friction=-1"], "outside its physical bounds 0 N m and above"),
        (&["add", "epam-textbook", "friction:mu=0.1"], "no parameter `mu`"),
        (&["add", "epam-textbook", "shear_stiffness"], "does not exist for the actuator epam"),
        (&["add", "epam-textbook", "best"], "needs data"),
        (&["add", "epam-textbook", "learned"], "needs data to learn from"),
        (&["add", "spam-textbook", "arm_growth"], "has arm_growth already"),
        (&["add", "epam-textbook", "friction", "synthetic-epam"], "do not ask for friction"),
        (&["validate", "epam-textbook", "synthetic-epam"], "was written by `ibr add`"),
        (&["validate", "epam-textbook", "synthetic-epam", "--without", "gravity"], "has no effect `gravity`"),
    ];
    for (args, words) in refusals {
        let ran = folder.run(args);
        assert_eq!(ran.code, 2, "{args:?}: {}", ran.stderr);
        assert!(ran.stderr.replace("\n  │ ", " ").contains(words), "{args:?}: {}", ran.stderr);
    }
    assert!(folder.contents().is_empty());
    assert_eq!(folder.run(&["add", "epam-textbook", "friction=0.1", "synthetic-spam"]).code, 3);
    assert!(folder.contents().is_empty());
}

#[test]
fn a_ladder_climbs_until_what_is_left_is_noise_and_keeps_every_scenario() {
    let folder = robot();
    let old = std::fs::read(folder.path("mine.toml")).unwrap();
    let ran = folder.run(&["ladder", "mine.toml", "two", "--out", "climb", "--json"]);
    let answer = ran.json("ibr.ladder");
    assert!(["noise", "tolerance"].contains(&answer["stopped"].as_str().unwrap()), "{answer}");
    let errors: Vec<f64> =
        answer["rungs"].as_array().unwrap().iter().map(|r| r["training_mm"].as_f64().unwrap()).collect();
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]) && errors.len() > 2, "{errors:?}");
    let held_out = |k: usize| answer["rungs"][k]["heldout_pressure_mm"].as_f64().unwrap();
    assert!(held_out(2) < 0.5 * held_out(1), "{answer}");
    let names = assert_hashes(&folder.path("climb"));
    let file = answer["steps"][0]["file"].as_str().unwrap();
    for name in [file, "step-0-calibrated.toml", "waterfall.png", "waterfall.svg", "report.html"] {
        assert!(names.iter().any(|n| n == name), "{name} of {names:?}");
    }
    assert_opens_offline(&std::fs::read_to_string(folder.path("climb/report.html")).unwrap());
    assert_eq!(std::fs::read(folder.path("mine.toml")).unwrap(), old);
    let written = format!("climb/{file}");
    let after = folder.run(&["compare", &written, "two", "--json"]).json("ibr.compare");
    assert!(after["overall"]["systematic_mm"].as_f64().unwrap() < 0.1 * errors[0]);

    folder.write("climb/step-2-friction.toml", "old");
    let again = folder.run(&["ladder", "mine.toml", "two", "--out", "climb"]);
    assert!(again.stderr.contains("earlier ladder, and not of this one: step-2-friction.toml"), "{}", again.stderr);
}

#[test]
fn two_runs_make_no_ladder_beyond_calibration_and_no_interval_is_claimed() {
    let folder = robot();
    let ran = folder.run(&["data", "generate", "truth.toml", "--out", "few", "--runs", "2"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let answer = folder.run(&["ladder", "mine.toml", "few", "--json"]).json("ibr.ladder");
    assert_eq!((answer["stopped"].as_str(), answer["steps"].as_array().unwrap().len()), (Some("no_p_values"), 0));
    let ran = folder.run(&["add", "mine.toml", "end_constraint", "few"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stderr.contains("at least three are needed for p-values"), "{}", ran.stderr);
}

#[test]
fn the_report_of_a_diagnosis_is_one_page_with_its_plots_and_the_answer_for_programs() {
    let folder = Folder::new();
    let answer =
        folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--out", "page", "--json"]).json("ibr.diagnose");
    let names = assert_hashes(&folder.path("page"));
    for plot in ["residuals_before", "residuals_after", "ranking", "before_after", "candidates", "ledger"] {
        for ending in ["svg", "png"] {
            assert!(names.contains(&format!("{plot}.{ending}")), "{plot} of {names:?}");
        }
    }
    let page = std::fs::read_to_string(folder.path("page/report.html")).unwrap();
    assert_opens_offline(&page);
    for id in ["missing", "where", "ranking", "candidates", "before-after", "differently", "unseen", "next"] {
        assert!(page.contains(&format!("id=\"{id}\"")), "{id}");
    }
    let first = answer["ranked"][0]["effect"].as_str().unwrap();
    assert!(page.contains(first) && page.contains("ibr add epam-textbook best synthetic-epam"));
    let kept: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path("page/diagnosis.json")).unwrap()).unwrap();
    assert_eq!(kept, answer);
    folder.write("file", "x");
    let ran = folder.run(&["diagnose", "epam-textbook", "synthetic-epam", "--out", "file"]);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
}

#[test]
fn one_published_displacement_is_met_by_several_effects_that_part_at_other_pressures() {
    let folder = Folder::new();
    let answer =
        folder.run(&["diagnose", "epam-textbook", "--published", "--out", "page", "--json"]).json("ibr.one_number");
    let met = answer["result"]["met_by"].as_array().unwrap();
    let lowest = met.iter().map(|e| e["y_mm"][0].as_f64().unwrap());
    let (low, high) = lowest.fold((f64::MAX, f64::MIN), |(a, b), y| (a.min(y), b.max(y)));
    assert!(met.len() > 3 && high - low > 10.0, "{answer}");
    assert!(folder.path("page/one_number_epam.png").exists());
    let ran = folder.run(&["diagnose", "mine.toml", "--published"]);
    assert_eq!(ran.code, 2, "{}", ran.stderr);
    assert_eq!(folder.run(&["diagnose", "epam-textbook"]).code, 2);
}

#[test]
fn an_effect_fitted_on_two_datasets_names_both_and_neither_can_test_it() {
    let folder = robot();
    let width = |args: &[&str]| {
        let answer = folder.run(args).json("ibr.add");
        let beta = &answer["effects"][0]["parameters"][0];
        beta["hi"].as_f64().unwrap() - beta["lo"].as_f64().unwrap()
    };
    let alone = width(&["add", "mine.toml", "end_constraint", "two", "--out", "alone.toml", "--json"]);
    let both = ["add", "mine.toml", "end_constraint", "two", "--also", "four", "--out", "both.toml", "--json"];
    assert!(width(&both) < alone);
    let answer = folder.run(&["validate", "both.toml", "two", "four", "--json"]).json("ibr.validate");
    let verdicts: Vec<_> = answer["datasets"].as_array().unwrap().iter().map(|set| &set["verdict"]).collect();
    assert_eq!(verdicts, ["fitted_to_these"; 2]);
    let climb = ["ladder", "mine.toml", "two", "--also", "four", "--json"];
    let answer = folder.run(&climb).json("ibr.ladder");
    assert_eq!(answer["also"][0], "four");
    assert_eq!(answer["steps"][0]["added"][0]["effect"], "end_constraint", "{answer}");
    assert_eq!(folder.run(&["add", "mine.toml", "friction=0.2", "--also", "four"]).code, 2, "without data");
}

#[test]
fn a_gauge_read_along_names_what_the_supply_does_and_the_step_is_taken() {
    let folder = robot();
    assert_eq!(folder.run(&["add", "truth.toml", "pressure_loss=0.12", "--out", "lossy.toml"]).code, 0);
    let protocol = "0,5,10,15,20,25,30,0@2";
    let ran = folder.run(&["data", "generate", "lossy.toml", "--gauge", "--protocol", protocol, "--out", "read"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let check = folder.run(&["data", "check", "read", "--json"]).json("ibr.data.check");
    let read = check["check"]["holds"][6]["gauge_kpa"].as_f64().unwrap();
    assert!((read - 0.88 * 30.0).abs() < 0.8, "{read}");

    let answer = folder.run(&["diagnose", "truth.toml", "read", "--json"]).json("ibr.diagnose");
    assert_eq!(answer["added"][0]["effect"], "pressure_loss", "{}", answer["summary"]);
    let gauge = &answer["gauges"][0];
    assert!(gauge["after_kpa"].as_f64().unwrap() < 0.2 * gauge["before_kpa"].as_f64().unwrap(), "{gauge}");
    let climbed = folder.run(&["ladder", "truth.toml", "read", "--out", "up"]);
    assert_eq!(climbed.code, 0, "{}", climbed.stderr);
    let error = |scenario: &str| {
        let answer = folder.run(&["compare", scenario, "read", "--json"]).json("ibr.compare");
        answer["overall"]["systematic_mm"].as_f64().unwrap()
    };
    assert!(error("up/step-1-pressure_loss.toml") < 0.3 * error("truth.toml"));
}
