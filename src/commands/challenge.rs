//! `ibr challenge new | reveal | list`: data with a hidden effect whose truth is sealed until someone asks for it.

use super::inputs::scatter;
use super::tables::table;
use super::{Context, Outcome, inputs};
use crate::cli::{ChallengeCommand, ChallengeNewArgs};
use crate::failure::Failure;
use crate::output::{check_set_folder, replace_files, set_name};
use challenge::{ALSO, Claim, HIDDEN, HiddenEffect, Laws, OUTSIDE, Riddle, score};
use ibr::pages::Files;
use serde_json::{Value, json};
use std::path::Path;

pub fn run(command: &ChallengeCommand, context: &mut Context) -> Result<Outcome, Failure> {
    match command {
        ChallengeCommand::New(args) => make(args, context),
        ChallengeCommand::Reveal { folder, diagnosis } => reveal(folder, diagnosis.as_deref(), context),
        ChallengeCommand::List => Ok(list()),
    }
}

fn make(args: &ChallengeNewArgs, context: &mut Context) -> Result<Outcome, Failure> {
    check_set_folder(&args.out, args.force)?;
    let ChallengeNewArgs { seed, effect, actuator, runs, sigma, protocol, .. } = args.clone();
    let camera_sd_m = sigma.map(|text| scatter("--sigma", &text)).transpose()?;
    let riddle = Riddle { seed, effects: effect, actuator, runs: runs.map(|n| n as usize), camera_sd_m, protocol };
    let made = riddle.make(&set_name(&args.out, "challenge"))?;
    replace_files(&args.out, &Files { files: made.files, ..Files::default() }, &[], context)?;
    let folder = args.out.display();
    let text = format!(
        "A sealed challenge is in {folder}: {} runs of a robot with actuator {}.\nSeal (SHA-256): {}\n\
         Look for what is hidden:   ibr diagnose {folder}/scenario.toml {folder} --json > answer.json\n\
         Open the seal afterwards:  ibr challenge reveal {folder} --diagnosis answer.json\n",
        made.dataset.runs.len(),
        made.dataset.actuator,
        made.sha256
    );
    let json = json!({"schema": "ibr.challenge.new", "version": 1, "folder": folder.to_string(), "sha256": made.sha256,
        "runs": made.dataset.runs.len()});
    Ok(Outcome::new(text, json))
}

fn reveal(folder: &Path, diagnosis: Option<&Path>, context: &mut Context) -> Result<Outcome, Failure> {
    let (truth, sha256) = challenge::reveal(folder)?;
    let mut text = format!("The seal {sha256} is intact.\n{}", truth.words());
    let mut scored = Value::Null;
    if let Some(path) = diagnosis {
        let data = inputs::evidence(&folder.display().to_string(), context)?;
        let answer = Claim::read(path, folder, &data.sha256()?)?;
        // Without a verdict there is nothing to be right or wrong.
        let score = answer.verdict.as_ref().map(|_| score(&truth, &answer));
        text.push_str(&answer.words(&truth, score.as_ref()));
        scored =
            json!({"answer": {"verdict": answer.verdict, "set": answer.set, "added": answer.added}, "score": score});
    }
    let json =
        json!({"schema": "ibr.challenge.reveal", "version": 1, "sha256": sha256, "truth": truth, "diagnosis": scored});
    Ok(Outcome::new(text, json))
}

/// Everything that can be hidden.
fn list() -> Outcome {
    let mut text = String::from(
        "What `ibr challenge new --effect NAME` can hide; the catalogue knows the first group by another law\n",
    );
    let inside: Vec<&HiddenEffect> = HIDDEN.iter().chain(ALSO).collect();
    text.push_str(&rows(&inside));
    text.push_str("\nNo effect of the catalogue describes these\n");
    text.push_str(&rows(&OUTSIDE.iter().collect::<Vec<_>>()));
    text.push_str("\nThe second law of each mechanism, for `ibr bench discovery --laws second`\n");
    let second = |e: &&HiddenEffect| vec![e.name.to_string(), e.law(Laws::Second).words.to_string()];
    text.push_str(&table(&["effect", "law: its source"], 2, inside.iter().map(second).collect()));
    let entry = |effect: &HiddenEffect| {
        let second = (!effect.is_outside()).then(|| effect.law(Laws::Second).words);
        json!({"name": effect.name, "sentence": effect.sentence, "law": effect.law(Laws::First).words, "second_law": second,
            "in_catalog": !effect.is_outside()})
    };
    let all: Vec<Value> = inside.into_iter().chain(OUTSIDE).map(entry).collect();
    Outcome::new(text, json!({"schema": "ibr.challenge.list", "version": 1, "effects": all}))
}

fn rows(effects: &[&HiddenEffect]) -> String {
    let row = |e: &&HiddenEffect| [e.name, e.sentence, e.law(Laws::First).words].map(str::to_string).to_vec();
    table(&["effect", "what happens", "law"], 3, effects.iter().map(row).collect())
}
