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

#[test]
fn what_is_refused_says_what_to_do() {
    let refused =
        |question: Value| serde_json::from_str::<Value>(&answer(&question.to_string())).unwrap()["error"].clone();
    let unknown = refused(json!({"ask": "robot", "robot": {"name": "epan"}}));
    assert!(unknown["help"].as_str().unwrap().contains("epam"), "{unknown}");
    let nonsense = refused(json!({"ask": "fly"}));
    assert!(nonsense["message"].as_str().unwrap().contains("unknown variant `fly`"), "{nonsense}");
    let table = json!({"name": "m.csv", "csv": "run,actuator\n1,epam\n"});
    let table = refused(json!({"ask": "compare", "robot": {"name": "epam"}, "data": table}));
    assert!(table["message"].as_str().unwrap().contains("m.csv"), "{table}");
    let lost = refused(json!({"ask": "predict", "robot": {"name": "epam"}, "actuator_kpa": []}));
    assert!(lost["message"].as_str().unwrap().contains("0 actuator pressures"), "{lost}");
}
