//! The figures of speed that the commands print, and the known numbers.

use crate::alone;
use crate::support::Folder;

/// The targets hold on a quiet machine; a shared one may be this much slower.
const SLACK: f64 = 3.0;

#[test]
fn predictions_and_inverses_are_as_fast_as_a_controller_needs() {
    let _alone = alone();
    let answer = Folder::new().run(&["bench", "--json"]).json("ibr.bench");
    println!("{}", answer["machine"]);
    let figures = answer["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 16, "four figures of four robots, with those of their textbook models beside");
    for figure in figures {
        let [textbook, target, ratio] = ["textbook_us", "target_us", "ratio"].map(|key| figure[key].as_f64().unwrap());
        println!("{}: {textbook:.3} µs, wanted {target} µs; shipped {ratio:.2} of it", figure["id"]);
        assert!(textbook < SLACK * target && ratio < SLACK, "{figure}");
    }
}

#[test]
fn every_model_has_a_time_and_an_error() {
    let _alone = alone();
    let answer = Folder::new().run(&["tradeoff", "--json"]).json("ibr.tradeoff");
    let models = answer["models"].as_array().unwrap();
    for kind in ["spam", "cpam", "epam", "fpam"] {
        assert!(models.iter().filter(|m| m["actuator"] == kind).count() >= 2, "{kind}: {models:?}");
    }
    for model in models {
        assert!(model["prediction_us"].as_f64().unwrap() > 0.0 && model["error_mm"].is_f64(), "{model}");
    }
}

#[test]
fn every_known_number_is_reproduced() {
    let _alone = alone();
    let answer = Folder::new().run(&["verify", "--json"]).json("ibr.verify");
    assert_eq!(answer["wrong"], 0, "{answer}");
    assert!(answer["rows"].as_array().unwrap().len() > 50);
}
