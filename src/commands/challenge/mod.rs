//! `ibr challenge new | reveal | list`: data with a hidden effect whose truth is sealed until someone asks for it.

mod make;
mod reveal;
mod seal;

use super::tables::table;
use super::{Context, Outcome};
use crate::cli::ChallengeCommand;
use crate::failure::Failure;
use challenge::{HIDDEN, HiddenEffect, OUTSIDE};
use serde_json::{Value, json};

pub fn run(command: &ChallengeCommand, context: &mut Context) -> Result<Outcome, Failure> {
    match command {
        ChallengeCommand::New(args) => make::run(args, context),
        ChallengeCommand::Reveal { folder, diagnosis } => reveal::run(folder, diagnosis.as_deref(), context),
        ChallengeCommand::List => Ok(list()),
    }
}

/// Everything that can be hidden.
fn list() -> Outcome {
    let mut text = String::from(
        "What `ibr challenge new --effect NAME` can hide; the catalogue knows the first group by another law\n",
    );
    text.push_str(&rows(HIDDEN));
    text.push_str("\nNo effect of the catalogue describes these\n");
    text.push_str(&rows(OUTSIDE));
    let entry = |effect: &HiddenEffect| json!({"name": effect.name, "sentence": effect.sentence, "law": effect.law, "in_catalog": !effect.is_outside()});
    let all: Vec<Value> = HIDDEN.iter().chain(OUTSIDE).map(entry).collect();
    Outcome::new(text, json!({"schema": "ibr.challenge.list", "version": 1, "effects": all}))
}

fn rows(effects: &[HiddenEffect]) -> String {
    let row = |e: &HiddenEffect| [e.name, e.sentence, e.law].map(str::to_string).to_vec();
    table(&["effect", "what happens", "law"], 3, effects.iter().map(row).collect())
}
