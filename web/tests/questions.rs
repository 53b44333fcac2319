//! What the page asks, asked here: answers are the library's, and what is switched goes back.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use ibr_web::question::answer;
use ibr_web::robot::shipped_names;
use serde_json::{Value, json};

fn ask(question: &Value) -> Value {
    let told: Value = serde_json::from_str(&answer(&question.to_string())).unwrap();
    assert!(told["ok"].is_object(), "{question}: {}", told["error"]);
    told["ok"].clone()
}

fn robot(name: &str, changes: &Value) -> Value {
    json!({"name": name, "changes": changes})
}

fn tip(robot: &Value) -> Value {
    ask(&json!({"ask": "predict", "robot": robot, "actuator_kpa": [20.0]}))["tip"].clone()
}

/// Every parameter of an effect with one of its values, as changes.
fn set(effect: &Value, to: &str) -> Vec<[String; 2]> {
    let parameters = effect["parameters"].as_array().unwrap().iter();
    parameters.map(|p| [p["place"].as_str().unwrap().to_string(), p[to].to_string()]).collect()
}

#[test]
fn every_effect_of_every_robot_can_be_switched() {
    for name in shipped_names() {
        let given = robot(&name, &json!([]));
        let before = tip(&given);
        let told = ask(&json!({"ask": "robot", "robot": given}));
        let effects = told["effects"].as_array().unwrap();
        let mut all_off = Vec::new();
        for effect in effects.iter().filter(|e| e["is_on"] == true) {
            all_off.extend(set(effect, "off"));
            let on_again = robot(&name, &json!(set(effect, "on")));
            assert_eq!(tip(&on_again), before, "{name}: {} as it was", effect["name"]);
        }
        let state = ask(&json!({"ask": "predict", "robot": robot(&name, &json!(all_off)), "actuator_kpa": [20.0]}));
        assert_eq!(state["tip"], state["bare"]["tip"], "{name}: all off is the bare model");
        for effect in effects.iter().filter(|e| e["is_on"] == false) {
            let mut on = set(effect, "on");
            let basis = &effect["basis"];
            on.push([basis["place"].as_str().unwrap().into(), basis["by_hand"].to_string()]);
            let now = ask(&json!({"ask": "robot", "robot": robot(&name, &json!(on))}));
            let own = now["effects"].as_array().unwrap().iter().find(|e| e["name"] == effect["name"]).unwrap();
            assert_eq!(own["is_on"], true, "{name}: {}", effect["name"]);
        }
    }
}

fn refused(question: &Value) -> Value {
    serde_json::from_str::<Value>(&answer(&question.to_string())).unwrap()["error"].clone()
}

/// Both trees are the same, numbers to a share of them.
fn same(a: &Value, b: &Value, share: f64) {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            assert!((a - b).abs() <= share * a.abs().max(b.abs()).max(1e-9), "{a} and {b}");
        }
        (Value::Array(a), Value::Array(b)) => a.iter().zip(b).for_each(|(a, b)| same(a, b, share)),
        (Value::Object(a), Value::Object(_)) => a.iter().for_each(|(key, a)| same(a, &b[key], share)),
        _ => assert_eq!(a, b),
    }
}

#[test]
fn robots_with_strips_round_the_body_are_the_library_s() {
    for (name, kpa) in [("epam-two-strips", vec![20.0, 10.0]), ("epam-helix", vec![20.0])] {
        let given = robot(name, &json!([]));
        let told = ask(&json!({"ask": "robot", "robot": given}));
        assert_eq!((&told["is_spatial"], told["channels"].as_array().unwrap().len()), (&json!(true), kpa.len()));
        let strange = |e: &&Value| !models::space::IN_SPACE.contains(&e["name"].as_str().unwrap());
        assert_eq!(told["effects"].as_array().unwrap().iter().find(strange), None);
        let found = ask(&json!({"ask": "predict", "robot": given, "actuator_kpa": kpa}));
        let pa: Vec<f64> = kpa.iter().map(|p| 1e3 * p).collect();
        let own = ibr::Predictor::new(&ibr::studies::scenario(name).unwrap());
        let state = own.state(&own.loads(None, &pa).unwrap()).unwrap();
        let wanted = ibr::shown::predicted::PredictedState::of(&own.model, &own.scenario, &state).json();
        assert!(wanted["tip"]["z_mm"].as_f64().unwrap().abs() > 1.0 && wanted["sections"].is_array());
        same(&wanted, &found, 1e-12);
        // The edges of both sides end around the tip.
        for (view, up) in found["views"].as_array().unwrap().iter().zip(["y_mm", "z_mm"]) {
            let end = |edge: usize, k: usize| view["sides"][edge][96][k].as_f64().unwrap();
            for (k, place) in [(0, "x_mm"), (1, up)] {
                let middle_mm = 500.0 * (end(0, k) + end(1, k));
                assert!((middle_mm - wanted["tip"][place].as_f64().unwrap()).abs() < 1e-9, "{name} {place}");
            }
            let count = if kpa.len() == 2 { 12 } else { 6 };
            assert_eq!(view["units"].as_array().unwrap().len(), count);
        }
    }
    // Turned by hand the helix lies along the body: a robot of one plane.
    let flat = robot("epam-helix", &json!([["actuator.turns", "0"]]));
    assert_eq!(ask(&json!({"ask": "robot", "robot": flat}))["is_spatial"], false);
    assert!(ask(&json!({"ask": "predict", "robot": flat, "actuator_kpa": [20.0]}))["views"].is_null());
}

#[test]
fn what_is_built_for_planar_robots_says_so() {
    let data = json!({"name": "synthetic-epam"});
    for question in ["compare", "diagnose"] {
        let told = refused(&json!({"ask": question, "robot": {"name": "epam-helix"}, "data": data}));
        assert!(told["message"].as_str().unwrap().contains("built for planar robots"), "{told}");
    }
    // A table with z beside a planar robot: left aside and told, or refused.
    let table = |name: &str| data::set_file("synthetic-epam", name).unwrap();
    let with_z = |z: &dyn Fn(usize) -> String| -> String {
        let (mut rows, mut out) = (0, String::new());
        for line in table("markers.csv").lines() {
            let more = match line {
                _ if line.starts_with('#') => String::new(),
                _ if rows == 0 => ",z_mm".into(),
                _ => format!(",{}", z(rows)),
            };
            rows += usize::from(!line.starts_with('#'));
            out.push_str(&format!("{line}{more}\n"));
        }
        out
    };
    let asked = |csv: String| {
        json!({"ask": "compare", "robot": {"name": "epam-textbook"},
            "data": {"name": "z.csv", "csv": csv, "about": table("about.toml")}})
    };
    let beside = ask(&asked(with_z(&|i| format!("{}", i % 7))));
    let plain = ask(&json!({"ask": "compare", "robot": {"name": "epam-textbook"}, "data": data}));
    same(&plain["overall"], &beside["overall"], 1e-9);
    let warnings = beside["warnings"].to_string();
    assert!(warnings.contains("z varies by up to") && warnings.contains("left aside"), "{warnings}");
    let away = refused(&asked(with_z(&|i| format!("{}", 977 * i % 1000))));
    assert!(away["message"].as_str().unwrap().contains("the robot is planar"), "{away}");
}

#[test]
fn what_is_refused_says_what_to_do() {
    let unknown = refused(&json!({"ask": "robot", "robot": {"name": "epan"}}));
    assert!(unknown["help"].as_str().unwrap().contains("epam"), "{unknown}");
    let nonsense = refused(&json!({"ask": "fly"}));
    assert!(nonsense["message"].as_str().unwrap().contains("unknown variant `fly`"), "{nonsense}");
    let table = json!({"name": "m.csv", "csv": "run,actuator\n1,epam\n"});
    let table = refused(&json!({"ask": "compare", "robot": {"name": "epam"}, "data": table}));
    assert!(table["message"].as_str().unwrap().contains("m.csv"), "{table}");
    let lost = refused(&json!({"ask": "predict", "robot": {"name": "epam"}, "actuator_kpa": []}));
    assert!(lost["message"].as_str().unwrap().contains("0 actuator pressures"), "{lost}");
}

#[test]
fn the_page_opens_with_the_five_panels_of_the_demo() {
    let told = ask(&json!({"ask": "demo"}));
    let panels = told["panels"].as_array().unwrap();
    assert_eq!(panels.len(), 5);
    for panel in panels {
        let picture = told["pictures"][panel["picture"].as_str().unwrap()].as_str().unwrap_or_default();
        assert!(picture.contains("<svg") && !panel["lead"].as_str().unwrap().is_empty(), "{}", panel["title"]);
    }
    assert!(panels[3]["table"]["rows"].as_array().unwrap().len() > 3);
}
