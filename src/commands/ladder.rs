//! `ibr ladder`

use super::inputs::{self, READ, plain, positive};
use super::{Context, Outcome};
use crate::cli::Ladder;
use crate::failure::Failure;
use crate::output::{Input, check_folder, imprint, write_files};
use crate::shown::extension::steps_text;
use compare::diagnosis::ErrorRung;
use compare::diagnosis::Options;
use compare::extension::ErrorStep;
use compare::ladder::{Climb, ladder};
use compare::progress::part;
use fem::record::Shape;
use ibr::pages::{LadderPage, ladder_page};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// What is printed.
#[derive(Serialize)]
struct Answer<'a> {
    #[serde(flatten)]
    climb: &'a Climb,
    scenario_file: &'a str,
    data: &'a str,
    also: &'a [String],
}

pub fn run(args: &Ladder, context: &mut Context) -> Result<Outcome, Failure> {
    let tolerance_m = positive("--tolerance", args.tolerance.as_ref())?;
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let file = inputs::scenario(&args.scenario)?;
    let evidence = inputs::all_evidence(&args.data, &args.also, context)?;
    let options =
        Options { tolerance_m, keep_bending: args.keep_bending, next_experiment: false, ..Options::default() };
    let climb = ladder(&file, &evidence, &options, args.effects as usize, &mut part(context.progress, [READ, 0.95]))?;
    let Ladder { scenario, data, also, .. } = args;
    let answer = Answer { climb: &climb, scenario_file: scenario, data, also };
    let answer = Shape { schema: "ibr.ladder", version: 1 }.stamped(&answer);
    let mut outcome = Outcome::new(text(&climb), answer);
    outcome.notes.extend(climb.warnings.iter().map(|w| format!("warning: {w}")));
    let name = &evidence[0].dataset.name;
    let folder = || PathBuf::from(format!("ibr-report/ladder-{}", plain(name)));
    if let Some(folder) = args.out.clone().or_else(|| (!context.json).then(folder)) {
        let page = LadderPage {
            title: format!("{}: one effect after the other, on {name}", file.scenario.name),
            lead: climb.ending.clone(),
            rungs: &climb.rungs.iter().map(drawn).collect::<Vec<_>>(),
            floor_mm: climb.noise_floor_mm,
            told: climb.told.clone(),
            typed: [scenario, data],
            also,
        };
        // What was found took long, and is printed where it cannot be written.
        match report(&folder, &page, &climb, &inputs::named(&file, &evidence)?, context) {
            Ok(notes) => outcome.notes.extend(notes),
            Err(failure) => outcome.fail(&failure),
        }
    }
    Ok(outcome)
}

fn drawn(step: &ErrorStep) -> ErrorRung {
    let ErrorStep { model, how_known, training_mm, heldout_pressure_mm, heldout_run_mm, .. } = step.clone();
    let label = if model.ends_with(how_known) { model } else { format!("{model} ({how_known})") };
    ErrorRung { label, training_mm, heldout_pressure_mm, heldout_run_mm }
}

/// Writes report and scenarios; what to say of them.
fn report(
    folder: &Path,
    page: &LadderPage,
    climb: &Climb,
    inputs: &[Input],
    context: &mut Context,
) -> Result<Vec<String>, Failure> {
    let mut files = ladder_page(page, &imprint())?;
    for (name, text) in &climb.files {
        files.files.insert(0, (name.clone(), text.clone().into_bytes()));
    }
    write_files(folder, &files, inputs, context)?;
    let names: Vec<&str> = climb.files.iter().map(|(name, _)| name.as_str()).collect();
    let mut notes = vec![format!("scenarios in {}: {}", folder.display(), names.join(", "))];
    let old = earlier_steps(folder, &names);
    if !old.is_empty() {
        notes.push(format!("warning: of an earlier ladder, and not of this one: {}", old.join(", ")));
    }
    notes.push(format!("report: {}", folder.join("report.html").display()));
    Ok(notes)
}

/// Scenarios in the folder that look like steps and are none of these.
fn earlier_steps(folder: &Path, names: &[&str]) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let there = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let is_old = |n: &String| n.starts_with("step-") && n.ends_with(".toml") && !names.contains(&n.as_str());
    let mut old: Vec<String> = there.filter(is_old).collect();
    old.sort();
    old
}

fn text(climb: &Climb) -> String {
    let mut out = steps_text(&climb.rungs, climb.noise_floor_mm);
    climb.told.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    if climb.steps.len() > 1 {
        out.push_str("Effects of earlier steps keep the values of their step; B is fitted anew on each.\n");
    }
    if !climb.steps.is_empty() {
        out.push_str("A smaller error does not prove a name: `ibr validate` tries it on data it was not fitted to.\n");
    }
    out
}
