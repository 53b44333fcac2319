//! `ibr challenge reveal`

use super::super::Outcome;
use super::seal::{FILE, Seal, hex};
use crate::failure::Failure;
use compare::hidden::truth::known;
use compare::hidden::{Answer, Score, Truth, score};
use serde::Deserialize;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::path::Path;

/// A truth and the hash of its data.
#[derive(Deserialize)]
struct Opened {
    markers_sha256: String,
    #[serde(flatten)]
    truth: Truth,
}

pub fn run(folder: &Path, diagnosis: Option<&Path>) -> Result<Outcome, Failure> {
    let (opened, seal) = open(folder)?;
    let truth = &opened.truth;
    let mut text = format!("The seal {} is intact.\n{}", seal.sha256, told(truth));
    let mut scored = Value::Null;
    if let Some(path) = diagnosis {
        let answer = answer(path)?;
        let score = score(truth, &answer);
        text.push_str(&verdict(truth, &answer, &score));
        scored =
            json!({"answer": {"verdict": answer.verdict, "set": answer.set, "added": answer.added}, "score": score});
    }
    let json = json!({
        "schema": "ibr.challenge.reveal", "version": 1, "sha256": seal.sha256, "truth": truth, "diagnosis": scored,
    });
    Ok(Outcome::new(text, json))
}

fn read(path: &Path, help: &str) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|cause| Failure::Read {
        path: path.display().to_string(),
        cause: cause.to_string(),
        help: help.to_string(),
    })
}

/// Opens the seal of a folder and checks that its data are those of the truth.
fn open(folder: &Path) -> Result<(Opened, Seal), Failure> {
    let path = folder.join(FILE);
    let broken = |path: &Path, cause: &str, help: &str| Failure::Read {
        path: path.display().to_string(),
        cause: cause.to_string(),
        help: help.to_string(),
    };
    let text = read(&path, "give the folder that `ibr challenge new --out FOLDER` made")?;
    let restore = "take the files as they were when the challenge was made";
    let seal: Seal = toml::from_str(&text).map_err(|error| broken(&path, error.message(), restore))?;
    let truth =
        seal.open().ok_or_else(|| broken(&path, "the seal is broken: its hash does not fit the truth", restore))?;
    let opened: Opened = toml::from_str(&truth).map_err(|error| broken(&path, error.message(), restore))?;
    let markers = folder.join("markers.csv");
    let csv = read(&markers, restore)?;
    if hex(&Sha256::digest(csv.as_bytes())) != opened.markers_sha256 {
        return Err(broken(&markers, "the data are not those that were sealed", restore));
    }
    Ok((opened, seal))
}

/// The truth in words.
fn told(truth: &Truth) -> String {
    let mut text = format!(
        "Robot: actuator {}, bending stiffness {:.3} N m², {} runs, camera noise {:.2} mm{}.\n",
        truth.actuator,
        truth.bending_nm2,
        truth.runs,
        truth.camera_sd_m * 1e3,
        if truth.heavy_tails { " with heavy tails" } else { "" }
    );
    if truth.effects.is_empty() {
        text.push_str("Hidden: nothing.\n");
    }
    for choice in &truth.effects {
        let effect = known(&choice.name).ok();
        let sentence = effect.map_or("", |effect| effect.sentence);
        let outside = if effect.is_some_and(|effect| effect.is_outside()) { ", outside the catalogue" } else { "" };
        text.push_str(&format!(
            "Hidden: {} ({:.2} typical sizes{outside}). {sentence}\n",
            choice.name, choice.times_typical
        ));
    }
    text
}

/// Reads the JSON of `ibr diagnose --json`.
fn answer(path: &Path) -> Result<Answer, Failure> {
    let help = "give the file of `ibr diagnose SCENARIO DATA --json > answer.json`";
    let text = read(path, help)?;
    let bad = |cause: String| Failure::Read { path: path.display().to_string(), cause, help: help.to_string() };
    let value: Value = serde_json::from_str(&text).map_err(|error| bad(format!("not JSON: {error}")))?;
    let inner = value.get("diagnosis").unwrap_or(&value);
    let found = inner.get("verdict").ok_or_else(|| bad("it has no `verdict`".into()))?;
    let names = |key: &str, field: &str| -> Vec<String> {
        let list = inner.get(key).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
        let kept = list.iter().filter(|item| item.get("at_bound") != Some(&Value::Bool(true)));
        kept.filter_map(|item| item.as_str().or_else(|| item.get(field)?.as_str()).map(str::to_string)).collect()
    };
    Ok(Answer {
        verdict: found.as_str().unwrap_or_default().to_string(),
        ranked: names("ranked", "effect"),
        set: names("indistinguishable", "effect"),
        added: names("added", "effect"),
    })
}

/// The score in words.
fn verdict(truth: &Truth, answer: &Answer, score: &Score) -> String {
    let said = if answer.verdict.is_empty() { "no verdict" } else { &answer.verdict };
    let mut text = format!(
        "The diagnosis says: {said}, {}.\n",
        if score.verdict_right { "which is right" } else { "which is wrong" }
    );
    if truth.effects.is_empty() || score.rank.is_none() && !score.in_set {
        return text;
    }
    let place = score.rank.map_or("not in the ranking".to_string(), |place| format!("place {place} of the ranking"));
    let set = if score.in_set { "in" } else { "not in" };
    text.push_str(&format!(
        "The truth is at {place} and {set} the stated set of {} ({}).\n",
        score.set_size,
        answer.set.join(", ")
    ));
    text
}
