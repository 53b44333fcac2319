//! `ibr list` and `ibr new`

use super::Outcome;
use crate::failure::Failure;
use crate::shown::lists::{actuators, cases, datasets, effects};
use fem::case::{SHIPPED_CASES, shipped_case};
use ibr::studies::{STUDIES, study};
use models::scenario::SHIPPED;
use serde_json::{Value, json};

/// Makes a list as text and as JSON.
type List = fn() -> (String, Value);

pub fn run(what: Option<&str>) -> Result<Outcome, Failure> {
    let wanted = |name: &str| what.is_none_or(|w| w == name);
    let mut text = String::new();
    let mut object = serde_json::Map::new();
    object.insert("schema".into(), "ibr.list".into());
    object.insert("version".into(), 1.into());
    let parts: [(&str, List); 4] =
        [("actuators", actuators), ("effects", effects), ("datasets", datasets), ("cases", cases)];
    for (name, list) in parts {
        if wanted(name) {
            let (words, value) = list();
            text.push_str(&words);
            object.insert(name.into(), value);
        }
    }
    Ok(Outcome::new(text, Value::Object(object)))
}

pub fn new(kind: &str) -> Result<Outcome, Failure> {
    let (key, text) = match (models::shipped(kind).or(study(kind)), shipped_case(kind)) {
        (Some(text), _) => ("scenario_toml", text),
        (None, Some(text)) => ("case_toml", text),
        (None, None) => {
            let names = SHIPPED.iter().chain(SHIPPED_CASES).map(|s| s.0).chain(STUDIES.iter().map(|s| s.0));
            let help = spelling::known(kind, &names.collect::<Vec<_>>());
            return Err(Failure::usage(format!("no shipped scenario `{kind}`"), help));
        }
    };
    Ok(Outcome::new(text.to_string(), json!({"schema": "ibr.new", "version": 1, key: text})))
}
