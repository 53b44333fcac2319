//! `ibr challenge new | reveal | export | score | list`: data with a hidden effect whose truth is sealed until someone asks for it.

use super::inputs;
use super::inputs::scatter;
use crate::cli::{ChallengeCommand, ChallengeNewArgs};
use crate::prelude::*;
use challenge::entry::{self, EntryScore};
use challenge::{ALSO, Claim, ClaimScore, HIDDEN, HiddenEffect, Laws, OUTSIDE, Riddle, Truth, score};
use compare::CompareError;
use spelling::files::{MOST_TEXT, read_whole};

pub(super) fn run(command: &ChallengeCommand, context: &mut Context) -> Result<Outcome> {
    match command {
        ChallengeCommand::New(args) => make(args, context),
        ChallengeCommand::Reveal { folder, diagnosis } => reveal(folder, diagnosis.as_deref(), context),
        ChallengeCommand::Export { out, cases, seed } => export(out, *cases as usize, *seed, context),
        ChallengeCommand::Score { folder, entry } => scored(folder, entry),
        ChallengeCommand::List => Ok(list()),
    }
}

fn make(args: &ChallengeNewArgs, context: &mut Context) -> Result<Outcome> {
    check_set_folder(&args.out, context.force)?;
    let ChallengeNewArgs { seed, effect, actuator, runs, sigma, protocol, scatter: white, .. } = args.clone();
    let white = white.is_some();
    let camera_sd_m = sigma.map(|text| scatter("--sigma", &text)).transpose()?;
    let riddle =
        Riddle { seed, effects: effect, actuator, runs: runs.map(|n| n as usize), camera_sd_m, protocol, white };
    let made = riddle.make(&set_name(&args.out, "challenge"))?;
    replace_files(&args.out, &Files { files: made.files, ..Files::default() }, &[], context)?;
    let folder = args.out.display();
    let text = format!(
        "A sealed challenge is in {folder}: {} runs of a robot with actuator {}.\nSeal (SHA-256): {}\n\
         Look for what is hidden:   ibr diagnose {folder}/scenario.toml {folder} --json > answer.json\n\
         Open the seal afterwards:  ibr challenge reveal {folder} answer.json\n",
        made.dataset.runs.len(),
        made.dataset.actuator,
        made.sha256
    );
    let answer = NewChallenge { folder: folder.to_string(), sha256: made.sha256, runs: made.dataset.runs.len() };
    Ok(Outcome::answer(text, "ibr.challenge.new", &answer))
}

fn reveal(folder: &Path, diagnosis: Option<&Path>, context: &mut Context) -> Result<Outcome> {
    let (truth, sha256) = challenge::reveal(folder)?;
    let mut text = format!("The seal {sha256} is intact.\n{}", truth.words());
    let mut diagnosis_scored = None;
    if let Some(path) = diagnosis {
        let data = inputs::evidence(&folder.display().to_string(), context)?;
        let answer = Claim::read(path, folder, &data.sha256()?)?;
        // Without a verdict there is nothing to be right or wrong.
        let score = answer.verdict.as_ref().map(|_| score(&truth, &answer));
        text.push_str(&answer.words(&truth, score.as_ref()));
        diagnosis_scored = Some(Scored { answer, score });
    }
    Ok(Outcome::answer(text, "ibr.challenge.reveal", &Revealed { sha256, truth, diagnosis: diagnosis_scored }))
}

fn export(folder: &Path, cases: usize, seed: Option<u64>, context: &mut Context) -> Result<Outcome> {
    let own = |k: usize| folder.join(entry::case_name(k));
    (1..=cases).try_for_each(|k| check_set_folder(&own(k), context.force))?;
    if own(cases + 1).exists() {
        let help = "choose another folder, or as many cases as it has";
        return Err(Failure::usage(format!("{} has more cases than {cases}", folder.display()), help));
    }
    write_files(folder, &Files { files: entry::common_files(cases), ..Files::default() }, &[], context)?;
    for k in 1..=cases {
        (context.progress)("making cases", Some((k - 1) as f64 / cases as f64));
        replace_files(&own(k), &Files { files: entry::case(k, seed)?, ..Files::default() }, &[], context)?;
    }
    let shown = folder.display();
    let text = format!(
        "{cases} sealed cases are in {shown}, with their rules in README.md.\n\
         An entry by ibr:  (cd {shown} && python entry.py)\nIts score:        ibr challenge score {shown} {shown}/entry.csv\n"
    );
    Ok(Outcome::answer(text, "ibr.challenge.export", &ExportedCases { folder: shown.to_string(), cases }))
}

fn scored(folder: &Path, entry: &Path) -> Result<Outcome> {
    let name = entry.display().to_string();
    let bytes = read_whole(entry, MOST_TEXT).map_err(|cause| CompareError::Unread {
        path: name.clone(),
        cause: cause.to_string(),
        help: "give a table case,verdict,names; README.md of the cases has the rules".into(),
    })?;
    let score = entry::score_entry(folder, &name, &String::from_utf8_lossy(&bytes))?;
    let EntryScore { cases, verdicts_right, with_effect, first_true, among_names, mean_names, false_names } = &score;
    let rows = TextTable::of(cases)
        .words("case", |c| &c.case)
        .words("hidden", |c| c.hidden.join(", "))
        .words("verdict", |c| c.answer.verdict.clone().unwrap_or_default())
        .words("names", |c| c.answer.set.join(", "))
        .words("right", |c| if c.score.verdict_right { "yes" } else { "no" });
    let all = cases.len();
    let mean = mean_names.map_or("–".to_string(), |mean| format!("{mean:.1}"));
    let text = format!(
        "{}{verdicts_right} of {all} verdicts are right. Of {with_effect} cases with an effect of the catalogue the first name is true in {first_true}, \
         and a true one is among all names in {among_names} ({mean} names on average). In {false_names} of the {} others an effect is named.\n",
        rows.text(),
        all - with_effect
    );
    Ok(Outcome::answer(text, "ibr.challenge.score", &score))
}

fn list() -> Outcome {
    let mut text = String::from(
        "What `ibr challenge new --effect NAME` can hide; the catalogue knows the first group by another law\n",
    );
    let inside: Vec<&HiddenEffect> = HIDDEN.iter().chain(ALSO).collect();
    text.push_str(&rows(&inside));
    text.push_str("\nNo effect of the catalogue describes these\n");
    text.push_str(&rows(&OUTSIDE.iter().collect::<Vec<_>>()));
    text.push_str("\nThe second law of each mechanism, for `ibr bench discovery --laws second`\n");
    text += &TextTable::of(&inside)
        .words("effect", |e| e.name)
        .words("law: its source", |e| e.equation(Laws::Second))
        .text();
    let entry = |effect: &'static HiddenEffect| HiddenEntry {
        name: effect.name,
        sentence: effect.sentence,
        law: effect.equation(Laws::First),
        second_law: (!effect.is_outside()).then(|| effect.equation(Laws::Second)),
        in_catalog: !effect.is_outside(),
    };
    let effects = inside.into_iter().chain(OUTSIDE).map(entry).collect();
    Outcome::answer(text, "ibr.challenge.list", &HiddenEntries { effects })
}

fn rows(effects: &[&HiddenEffect]) -> String {
    let table = TextTable::of(effects).words("effect", |e| e.name).words("what happens", |e| e.sentence);
    table.words("law", |e| e.equation(Laws::First)).text()
}

/// `ibr.challenge.new`: `ibr challenge new`
#[derive(Serialize)]
struct NewChallenge {
    /// Folder in which robot, data and sealed truth were written
    folder: String,
    /// SHA-256 of salt and truth, which seals the hidden effect
    sha256: String,
    /// Number of runs in the data
    runs: usize,
}

/// `ibr.challenge.export`: `ibr challenge export --out FOLDER`
#[derive(Serialize)]
struct ExportedCases {
    /// Folder in which cases and rules were written
    folder: String,
    /// Number of cases
    cases: usize,
}

/// `ibr.challenge.reveal`: `ibr challenge reveal FOLDER`
#[derive(Serialize)]
struct Revealed {
    /// SHA-256 of salt and truth, recomputed from the files
    sha256: String,
    /// Effect that was hidden, with its values
    truth: Truth,
    /// The diagnosis and its score; null without one
    diagnosis: Option<Scored>,
}

#[derive(Serialize)]
struct Scored {
    /// Answer of the diagnosis to all data of the challenge
    answer: Claim,
    /// Its score; null without a verdict
    score: Option<ClaimScore>,
}

/// `ibr.challenge.list`: `ibr challenge list`
#[derive(Serialize)]
struct HiddenEntries {
    /// Effects that a challenge can hide
    effects: Vec<HiddenEntry>,
}

#[derive(Serialize)]
struct HiddenEntry {
    /// Name of the hidden effect or law
    name: &'static str,
    /// One plain sentence about its mechanism
    sentence: &'static str,
    /// Formula of the law that the data follow
    law: &'static str,
    /// Another law of it; null where the catalogue has none
    second_law: Option<&'static str>,
    /// Whether the catalogue of effects has it, by another law
    in_catalog: bool,
}
