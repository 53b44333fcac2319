//! `ibr challenge reveal`

use super::super::{Context, Outcome, inputs};
use super::seal::{FILE, SEALED, Seal, VERSION};
use crate::failure::Failure;
use crate::output::sha256;
use challenge::truth::known;
use challenge::{Answer, Score, Truth, score};
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::Path;

/// A truth and the hashes of the files it belongs to, in the order of [`SEALED`].
#[derive(Deserialize)]
struct Opened {
    files_sha256: [String; SEALED.len()],
    #[serde(flatten)]
    truth: Truth,
}

pub fn run(folder: &Path, diagnosis: Option<&Path>, context: &mut Context) -> Result<Outcome, Failure> {
    let (opened, seal) = open(folder)?;
    let truth = &opened.truth;
    let mut text = format!("The seal {} is intact.\n{}", seal.sha256, told(truth));
    let mut scored = Value::Null;
    if let Some(path) = diagnosis {
        let data = inputs::evidence(&folder.display().to_string(), context)?;
        let answer = answer(path, folder, &data.sha256()?)?;
        // Without a verdict there is nothing to be right or wrong.
        let score = answer.verdict.as_ref().map(|_| score(truth, &answer));
        text.push_str(&verdict(truth, &answer, score.as_ref()));
        scored =
            json!({"answer": {"verdict": answer.verdict, "set": answer.set, "added": answer.added}, "score": score});
    }
    let json = json!({
        "schema": "ibr.challenge.reveal", "version": 1, "sha256": seal.sha256, "truth": truth, "diagnosis": scored,
    });
    Ok(Outcome::new(text, json))
}

fn refused(path: &Path, cause: impl ToString, help: &str) -> Failure {
    Failure::Read { path: path.display().to_string(), cause: cause.to_string(), help: help.to_string() }
}

fn read(path: &Path, help: &str) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|cause| refused(path, cause, help))
}

fn read_text(path: &Path, help: &str) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|cause| refused(path, cause, help))
}

/// Opens the seal of a folder and checks that its files are those of the truth.
fn open(folder: &Path) -> Result<(Opened, Seal), Failure> {
    let path = folder.join(FILE);
    let text = read_text(&path, "give the folder that `ibr challenge new --out FOLDER` made")?;
    let restore = "take the files as they were when the challenge was made";
    let seal: Seal = toml::from_str(&text).map_err(|error| refused(&path, error.message(), restore))?;
    if seal.version != VERSION {
        let cause = format!("the seal is of format {}, this program opens format {VERSION}", seal.version);
        return Err(refused(&path, cause, "open it with the version of ibr that made it, or make a new challenge"));
    }
    let truth =
        seal.open().ok_or_else(|| refused(&path, "the seal is broken: its hash does not fit the truth", restore))?;
    let opened: Opened = toml::from_str(&truth).map_err(|error| refused(&path, error.message(), restore))?;
    for (name, sealed) in SEALED.iter().zip(&opened.files_sha256) {
        let file = folder.join(name);
        if sha256(&read(&file, restore)?) != *sealed {
            return Err(refused(&file, "the file is not the one that was sealed", restore));
        }
    }
    Ok((opened, seal))
}

/// The truth in words.
fn told(truth: &Truth) -> String {
    let mut text = format!(
        "Robot: actuator {}, bending stiffness {:.3} N m², {} runs, camera noise {:.2} mm{}{}.\n",
        truth.actuator,
        truth.bending_nm2,
        truth.runs,
        truth.camera_sd_m * 1e3,
        if truth.heavy_tails { " with heavy tails" } else { "" },
        if truth.lost_markers { ", markers lost" } else { "" }
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

/// Reads the JSON of `ibr diagnose --json`, which must be of the data in the folder.
fn answer(path: &Path, folder: &Path, data_sha256: &str) -> Result<Answer, Failure> {
    let folder = folder.display();
    let help = format!("give the file of `ibr diagnose {folder}/scenario.toml {folder} --json > answer.json`");
    let text = read_text(path, &help)?;
    let bad = |cause: String| refused(path, cause, &help);
    let value: Value = serde_json::from_str(&text).map_err(|error| bad(format!("not JSON: {error}")))?;
    let verdict = match value.get("verdict") {
        Some(Value::Null) => None,
        Some(Value::String(word)) if ["none", "effect", "out_of_catalog"].contains(&word.as_str()) => {
            Some(word.clone())
        }
        Some(other) => return Err(bad(format!("its `verdict` {other} is none of none, effect, out_of_catalog"))),
        None => return Err(bad("it has no `verdict`".into())),
    };
    match value.get("data_sha256").and_then(|hashes| hashes.get(0)?.as_str()) {
        Some(hash) if hash == data_sha256 => {}
        Some(_) => {
            let name = value.get("dataset").and_then(Value::as_str).unwrap_or_default();
            return Err(bad(format!("it is a diagnosis of other data (`{name}`), not of {folder}")));
        }
        None => return Err(bad("it does not say of which data it is: it has no `data_sha256`".into())),
    }
    let names = |key: &str, field: &str| -> Vec<String> {
        let list = value.get(key).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
        let kept = list.iter().filter(|item| item.get("at_bound") != Some(&Value::Bool(true)));
        kept.filter_map(|item| item.as_str().or_else(|| item.get(field)?.as_str()).map(str::to_string)).collect()
    };
    Ok(Answer {
        verdict,
        ranked: names("ranked", "effect"),
        set: names("indistinguishable", "effect"),
        added: names("added", "effect"),
    })
}

/// The score in words.
fn verdict(truth: &Truth, answer: &Answer, score: Option<&Score>) -> String {
    let (Some(said), Some(score)) = (&answer.verdict, score) else {
        return "The diagnosis gives no verdict: it is not scored. Three runs or more are needed for one.\n".into();
    };
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
