//! Opens a seal, and compares a diagnosis with the revealed truth.

use super::seal::{FILE, SEALED, Seal, VERSION, hex};
use super::truth::known;
use super::{Claim, ClaimScore, Truth};
use compare::CompareError;
use serde::Deserialize;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::path::Path;

/// A truth and the hashes of the files it belongs to, in the order of [`SEALED`].
#[derive(Deserialize)]
struct Contents {
    files_sha256: [String; SEALED.len()],
    #[serde(flatten)]
    truth: Truth,
}

/// Opens the seal of a challenge's folder and checks that its files match the truth: returns the truth and the seal's hash.
///
/// # Errors
/// A seal that is broken or of another format, or a file that was changed.
pub fn reveal(folder: &Path) -> Result<(Truth, String), CompareError> {
    let path = folder.join(FILE);
    let text = read(&path, "give the folder that `ibr challenge new --out FOLDER` made")?;
    let restore = "take the files as they were when the challenge was made";
    let seal: Seal = toml::from_str(&text).map_err(|error| unread(&path, error.message(), restore))?;
    if seal.version != VERSION {
        let cause = format!("the seal is of format {}, this program opens format {VERSION}", seal.version);
        return Err(unread(&path, cause, "open it with the version of ibr that made it, or make a new challenge"));
    }
    let broken = || unread(&path, "the seal is broken: its hash does not fit the truth", restore);
    let truth = seal.open().ok_or_else(broken)?;
    let opened: Contents = toml::from_str(&truth).map_err(|error| unread(&path, error.message(), restore))?;
    for (name, sealed) in SEALED.iter().zip(&opened.files_sha256) {
        let file = folder.join(name);
        let bytes = std::fs::read(&file).map_err(|cause| unread(&file, cause, restore))?;
        if hex(&Sha256::digest(&bytes)) != *sealed {
            return Err(unread(&file, "the file is not the one that was sealed", restore));
        }
    }
    Ok((opened.truth, seal.sha256))
}

fn unread(path: &Path, cause: impl ToString, help: &str) -> CompareError {
    CompareError::Unread { path: path.display().to_string(), cause: cause.to_string(), help: help.to_string() }
}

fn read(path: &Path, help: &str) -> Result<String, CompareError> {
    std::fs::read_to_string(path).map_err(|cause| unread(path, cause, help))
}

impl Truth {
    /// Robot, noise and hidden effects, for the reader who opens the seal.
    pub fn words(&self) -> String {
        let mut text = format!(
            "Robot: actuator {}, bending stiffness {:.3} N m², {} runs, camera noise {:.2} mm{}{}{}.\n",
            self.actuator,
            self.bending_nm2,
            self.runs,
            self.camera_sd_m * 1e3,
            if self.heavy_tails { " with heavy tails" } else { "" },
            if self.lost_markers { ", markers lost" } else { "" },
            if self.holds_scatter { ", holds scatter" } else { "" }
        );
        if self.effects.is_empty() {
            text.push_str("Hidden: nothing.\n");
        }
        for choice in &self.effects {
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
}

impl Claim {
    /// Reads what `ibr diagnose --json` printed, which must be of the data in the folder, whose hash is given.
    ///
    /// # Errors
    /// No such JSON, or a diagnosis of other data.
    pub fn read(path: &Path, folder: &Path, data_sha256: &str) -> Result<Claim, CompareError> {
        let folder = folder.display();
        let help = format!("give the file of `ibr diagnose {folder}/scenario.toml {folder} --json > answer.json`");
        let text = read(path, &help)?;
        let bad = |cause: String| unread(path, cause, &help);
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
        let names = |key: &str| -> Vec<String> {
            let list = value.get(key).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
            let kept = list.iter().filter(|item| item.get("at_bound") != Some(&Value::Bool(true)));
            kept.filter_map(|item| item.as_str().or_else(|| item.get("effect")?.as_str()).map(str::to_string)).collect()
        };
        Ok(Claim { verdict, ranked: names("ranked"), set: names("indistinguishable"), added: names("added") })
    }

    /// The answer and its score in words; without a verdict there is none.
    pub fn words(&self, truth: &Truth, score: Option<&ClaimScore>) -> String {
        let (Some(said), Some(score)) = (&self.verdict, score) else {
            return "The diagnosis gives no verdict: it is not scored. Three runs or more are needed for one.\n".into();
        };
        let right = if score.verdict_right { "which is right" } else { "which is wrong" };
        let mut text = format!("The diagnosis states: {said}, {right}.\n");
        if truth.effects.is_empty() || score.rank.is_none() && !score.in_set {
            return text;
        }
        let place = score.rank.map_or("not in the ranking".into(), |place| format!("place {place} of the ranking"));
        text.push_str(&format!(
            "The truth is at {place} and {} the stated set of {} ({}).\n",
            if score.in_set { "in" } else { "not in" },
            score.set_size,
            self.set.join(", ")
        ));
        text
    }
}
