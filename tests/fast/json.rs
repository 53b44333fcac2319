//! The JSON that other programs build on.

use crate::support::Folder;
use serde_json::Value;

#[test]
fn every_command_that_prints_results_prints_one_json_object_and_nothing_else() {
    let folder = Folder::new();
    let commands: [(&[&str], &str); 13] = [
        (&["predict", "epam-textbook"], "ibr.predict"),
        (&["predict", "fpam", "--inverse", "tip=50mm"], "ibr.predict"),
        (&["compare", "epam-textbook", "synthetic-epam"], "ibr.compare"),
        (&["diagnose", "epam-textbook", "synthetic-epam"], "ibr.diagnose"),
        (&["data", "check", "synthetic-cpam"], "ibr.data.check"),
        (&["data", "list"], "ibr.list"),
        (&["data", "generate", "spam", "--out", "made"], "ibr.data.generate"),
        (&["list"], "ibr.list"),
        (&["list", "effects"], "ibr.list"),
        (&["new", "cpam"], "ibr.new"),
        (&["tradeoff"], "ibr.tradeoff"),
        (&["verify"], "ibr.verify"),
        (&["bench"], "ibr.bench"),
    ];
    for (args, schema) in commands {
        let ran = folder.run(&[args, &["--json"]].concat());
        ran.json(schema);
        assert_eq!(ran.stderr, "", "{args:?}");
    }
}

#[test]
fn a_prediction_holds_per_state_pressures_markers_tip_curvature_and_ledger() {
    let ran = Folder::new().run(&["predict", "epam-textbook", "--pressure", "10kPa,20kPa,30kPa", "--json"]);
    let answer = ran.json("ibr.predict");
    let states = answer["states"].as_array().unwrap();
    assert_eq!(states.iter().map(|s| number(&s["p_act_kpa"])).collect::<Vec<_>>(), [10.0, 20.0, 30.0]);
    for state in states {
        assert_eq!(number(&state["p_body_kpa"]), 2.0);
        let stations = state["markers"].as_array().unwrap().iter().map(|m| number(&m["s_mm"]).round());
        assert_eq!(stations.collect::<Vec<_>>(), [30.0, 90.0, 150.0, 210.0, 270.0, 330.0]);
        for marker in state["markers"].as_array().unwrap() {
            let [s, x, y] = ["s_mm", "x_mm", "y_mm"].map(|key| number(&marker[key]));
            assert!(x.hypot(y) < s && y > 0.0, "a bent robot brings its markers nearer to the base: {marker}");
        }
        let terms: Vec<_> = state["ledger"].as_array().unwrap().iter().map(|l| l["term"].as_str().unwrap()).collect();
        assert_eq!(terms, ["actuator_pressure", "body_pressure", "bending"]);
        assert!(number(&state["ledger"][0]["energy_mj"]) < 0.0, "the actuator does work");
        assert!((number(&state["tip"]["angle_deg"]) - heading_deg(state)).abs() < 1e-6);
    }
    // The published robot at 30 kPa, bare model: the last marker is 161.6 mm high on paper at 6 pouches of 60 mm.
    assert!((number(&states[2]["markers"][5]["y_mm"]) - 161.55).abs() < 0.05, "{}", states[2]["markers"][5]);
}

/// Σ κ L of the segments, which is the angle of the tip.
fn heading_deg(state: &Value) -> f64 {
    let segments = state["segments"].as_array().unwrap();
    let curvature = state["curvature_per_m"].as_array().unwrap();
    assert_eq!(segments.len(), curvature.len());
    let turn = segments.iter().zip(curvature).map(|(s, kappa)| number(&s["length_mm"]) / 1e3 * number(kappa));
    turn.sum::<f64>().to_degrees()
}

#[test]
fn a_comparison_holds_per_hold_the_accuracy_and_its_companions_and_a_residual_map() {
    let ran = Folder::new().run(&["compare", "epam-textbook", "synthetic-epam", "--json"]);
    let answer = ran.json("ibr.compare");
    let holds = answer["holds"].as_array().unwrap();
    let protocol: Vec<_> = holds.iter().map(|h| (number(&h["p_act_kpa"]), h["phase"].as_str().unwrap())).collect();
    assert_eq!(protocol, [(0.0, "load"), (10.0, "load"), (20.0, "load"), (30.0, "load"), (0.0, "unload")]);
    for hold in &holds[1..4] {
        let [a, ceiling, relative] = ["paper_accuracy", "noise_ceiling", "rms_relative_pct"].map(|k| number(&hold[k]));
        assert!(a < ceiling && ceiling < 1.0, "{hold}");
        assert!((relative - 100.0 * (1.0 - a).sqrt()).abs() < 1e-9, "{hold}");
        let [rmse, floor, beyond] = ["rmse_mm", "noise_floor_mm", "systematic_mm"].map(|k| number(&hold[k]));
        assert!((beyond - (rmse * rmse - floor * floor).sqrt()).abs() < 1e-6, "{hold}");
        assert!(number(&hold["tip_error_mm"]) > 40.0, "the bare model bends too far: {hold}");
    }
    assert!(holds[0]["paper_accuracy"].is_null(), "undefined where the model does not move");
    let map = &answer["residual_map"]["cells"];
    assert_eq!(map.as_array().unwrap().len(), 6, "marker by hold");
    assert!(map.as_array().unwrap().iter().all(|row| row.as_array().unwrap().len() == 5));
    assert!(number(&map[5][3]["y"]["in_noise"]) > 10.0, "{}", map[5][3]);
    assert!(!answer["where_it_fails"].as_array().unwrap().is_empty());
}

#[test]
fn accuracy_and_rmse_of_a_hold_come_out_of_the_printed_positions_by_hand() {
    let folder = Folder::new();
    let predicted = folder.run(&["predict", "epam-textbook", "--pressure", "30kPa", "--json"]).json("ibr.predict");
    let compared = folder.run(&["compare", "epam-textbook", "synthetic-epam", "--json"]).json("ibr.compare");
    let table = data::set_file("synthetic-epam", "markers.csv").unwrap();
    // [marker][sample][x, y], mean over the five runs [mm]
    let mut mean = vec![vec![[0.0; 2]; 5]; 6];
    for line in table.lines().skip(1).filter(|line| line.contains(",30.0000,load,")) {
        let cells: Vec<&str> = line.split(',').collect();
        let [t, marker, x, y] = [2, 6, 7, 8].map(|i| cells[i].parse::<f64>().unwrap());
        let place = &mut mean[marker as usize - 1][(t as usize - 1) % 5];
        *place = [place[0] + x / 5.0, place[1] + y / 5.0];
    }
    let (mut squares, mut relative) = (0.0, 0.0);
    for (model, measured) in predicted["states"][0]["markers"].as_array().unwrap().iter().zip(&mean) {
        let [x, y] = ["x_mm", "y_mm"].map(|key| number(&model[key]));
        squares += measured.iter().map(|m| (x - m[0]).powi(2) + (y - m[1]).powi(2)).sum::<f64>();
        let y_mean = measured.iter().map(|m| m[1]).sum::<f64>() / 5.0;
        relative += ((y - y_mean) / y).powi(2);
    }
    let hold = &compared["holds"][3];
    assert!((number(&hold["rmse_mm"]) - (squares / 60.0).sqrt()).abs() < 1e-6, "{hold}");
    assert!((number(&hold["paper_accuracy"]) - (1.0 - relative / 6.0)).abs() < 1e-9, "{hold}");
}

#[test]
fn a_missed_threshold_still_prints_its_json_and_exits_with_1() {
    let ran = Folder::new().run(&["compare", "epam-textbook", "synthetic-epam", "--max-error", "5mm", "--json"]);
    assert_eq!(ran.code, 1);
    assert!(serde_json::from_str::<Value>(&ran.stdout).is_ok());
    assert!(ran.stderr.contains("exceeds --max-error 5.00 mm"), "{}", ran.stderr);
    let ran = Folder::new().run(&["compare", "epam-textbook", "synthetic-epam", "--max-error", "5cm", "--json"]);
    assert_eq!(ran.code, 0);
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}
