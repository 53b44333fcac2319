//! `ibr compare --paper`: the paper's finite elements, reproduced.

use super::fem_inputs::{kept, pressures, robots, sizes};
use crate::cli::CompareArgs;
use crate::prelude::*;
use crate::shown::paper::{PaperAnswer, text};
use compare::study::engines::runs_of;
use compare::study::paper::{MESHES_MM, PaperRun, facts, heights, jobs, ordered, runs_below, runs_json, stored};

pub(super) fn run(args: &CompareArgs, context: &mut Context) -> Result<Outcome, Failure> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let runs = runs(args, context)?;
    let paper = data::published()?;
    let (against, rows) = (heights(&paper, &runs, &MESHES_MM), facts(&paper, &runs));
    let text = text(&against, &rows, &runs);
    let answer = PaperAnswer { runs: runs.len(), heights: &against, facts: &rows };
    let mut outcome = Outcome::answer(text.clone(), "ibr.paper", &answer);
    if let Some(folder) = &args.out {
        let mut files = Files::default();
        files.text("paper.md", text);
        files.text("paper-runs.json", runs_json(&runs));
        write_files(folder, &files, &[], context)?;
        outcome.notes.push(format!("runs: {}", folder.join("paper-runs.json").display()));
    }
    Ok(outcome)
}

/// Stored runs, or all in the folder, which gets what is missing.
fn runs(args: &CompareArgs, context: &mut Context) -> Result<Vec<PaperRun>, Failure> {
    let Some(folder) = &args.runs.runs else {
        if !args.inputs.is_empty() || args.pressure.is_some() {
            let help = "add --runs FOLDER to make runs; without it all that come with the program are printed";
            return Err(Failure::usage("--paper alone takes no scenario and no --pressure", help));
        }
        return Ok(ordered(stored()?));
    };
    let kpa = args.pressure.as_deref().map(pressures).transpose()?;
    let jobs = jobs(&robots(&args.inputs)?.0, &sizes(&args.mesh)?, kpa.as_deref())?;
    let settings = kept(folder, context);
    let made = context.fem(|progress| runs_of(&jobs, &settings, progress))?;
    made.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(ordered(runs_below(folder)?))
}
