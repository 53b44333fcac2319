//! `ibr design` with corrections by finite elements.

use crate::refused::refuse;
use crate::support::Folder;

/// An ePAM on a coarse mesh, inflated in a hundredth of a second, and an angle of its tip: what it gives is no result.
pub(crate) fn with_wish(tolerance: f64) -> Folder {
    let folder = Folder::new();
    let quick = "\n[fem]\nbody_mesh_mm = 14\nactuator_mesh_mm = 14\nbody_ramp_s = 0.004\nactuator_ramp_s = 0.006\nguard_hourglass = 1\n";
    folder.write("quick.toml", models::shipped("epam").unwrap().to_string() + quick);
    let free = "[[free]]\nkey = \"pressure_kpa\"\nfrom = 5\nto = 30\n";
    let wish = format!("scenario = \"quick.toml\"\n[wish]\ntip_angle_deg = 36\ntolerance = {tolerance}\n{free}");
    folder.write("wish.toml", wish);
    folder
}

const CORRECTED: [&str; 6] = ["design", "wish.toml", "--correct", "2", "--out", "d"];

#[test]
fn the_model_is_corrected_by_finite_elements_and_the_best_checked_design_is_written() {
    let folder = with_wish(0.0001);
    let ran = folder.run(&[&CORRECTED[..], &["--json"]].concat());
    let told: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
    let designs = told["designs"].as_array().unwrap();
    assert_eq!((designs.len(), ran.code), (3, u8::from(!told["reached"].as_bool().unwrap()).into()), "{}", ran.stderr);
    let worst = |design: &serde_json::Value| design["worst_mm"].as_f64().unwrap();
    let written = designs.iter().find(|design| design["written"] == true).unwrap();
    assert!(designs.iter().all(|design| worst(written) <= worst(design)) && worst(written) < worst(&designs[0]));
    assert_eq!((&told["chosen"], &told["misses"]), (&written["chosen"], &written["misses"]));
    let text = std::fs::read_to_string(folder.path("d/design.toml")).unwrap();
    let kpa = written["chosen"][0]["value"].as_str().unwrap();
    assert!(text.contains(&format!("pressures_kpa = [{kpa}]")), "{kpa}: {text}");
    // Finite elements less the model is what the next search had added to the model.
    let number = |of: &serde_json::Value| of[0]["found"][0].as_f64().unwrap();
    let [first, second] = [&designs[0], &designs[1]];
    let lacks = number(&first["finite_elements"]["misses"]) - number(&first["misses"]);
    let corrected = number(&second["corrected_by_finite_elements"]);
    assert!(
        (number(&second["misses"]) + lacks - corrected).abs() < 1e-9 && first["corrected_by_finite_elements"].is_null()
    );
}

#[test]
fn runs_are_kept_and_the_same_command_makes_none_again() {
    let folder = with_wish(0.0001);
    let first = folder.run(&CORRECTED);
    assert!(
        first.stdout.contains("corrected by finite elements") && first.code <= 1,
        "{}{}",
        first.stdout,
        first.stderr
    );
    let before = folder.contents();
    let runs = std::fs::read_dir(folder.path("d/runs")).unwrap().count();
    // With one more only that one is new; the same command gives the same bytes.
    let again = folder.run(&CORRECTED);
    assert_eq!((again.code, again.stdout, folder.contents() == before), (first.code, first.stdout, true));
    folder.run(&["design", "wish.toml", "--correct", "3", "--out", "d"]);
    assert_eq!(std::fs::read_dir(folder.path("d/runs")).unwrap().count(), runs + 1);
    assert!(
        before
            .iter()
            .filter(|(path, _)| path.to_string_lossy().contains("/runs/"))
            .all(|(path, bytes)| { std::fs::read(path).is_ok_and(|now| now == *bytes) })
    );
    // Without corrections nothing is kept but the design, and nothing is told of them.
    let plain = folder.run(&["design", "wish.toml", "--out", "plain"]);
    assert!(!folder.path("plain/runs").exists() && !plain.stdout.contains("orrect"), "{}", plain.stdout);
    refuse(&folder, &["design", "wish.toml", "--correct", "1", "--no-check"], 2, &["--no-check"]);
}
