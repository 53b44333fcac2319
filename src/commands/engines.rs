//! `ibr compare --engines`: both engines and the published numbers.

use super::fem_inputs::{kept, pressures, robots};
use crate::cli::CompareArgs;
use crate::prelude::*;
use crate::shown::engines::{EnginesAnswer, text};
use compare::study::engines::{EngineLine, EngineRun, all_runs, engines, lines, runs_json, runs_of, seed_jobs, stored};
use fem::session::Source;
use ibr::pages::engines_page;

pub(super) fn run(args: &CompareArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from("ibr-report/compare-engines"));
    check_folder(&folder)?;
    let (named, inputs) = robots(&args.inputs)?;
    let runs = if args.runs.stored { stored()? } else { made(args, &named, context)? };
    let scenarios: Vec<Scenario> = named.into_iter().map(|s| s.1).collect();
    let found = engines(&scenarios, &runs)?;
    let mut all: Vec<EngineLine> = Vec::new();
    for robot in &found.robots {
        all.extend(lines(robot)?);
    }
    let mut outcome = Outcome::answer(text(&all, &found)?, "ibr.engines", &EnginesAnswer::of(&all, &found));
    (context.progress)("drawing the report", None);
    let imprint = imprint();
    let mut files = engines_page(&found, &imprint)?;
    files.files.insert(0, ("runs.json".into(), runs_json(&runs).into_bytes()));
    write_files(&folder, &files, &inputs, context)?;
    outcome.report(&folder);
    Ok(outcome)
}

/// Runs of the folder, which gets what is missing.
fn made(args: &CompareArgs, robots: &[(Source, Scenario)], context: &mut Context) -> Result<Vec<EngineRun>, Failure> {
    let kpa = args.pressure.as_deref().map(pressures).transpose()?;
    let (jobs, folder) = (seed_jobs(robots, args.seeds, kpa.as_deref())?, args.runs.folder());
    let settings = kept(&folder, context);
    let own = context.fem(|progress| runs_of(&jobs, &settings, progress))?;
    let mut own = own.into_iter().collect::<Result<Vec<EngineRun>, _>>()?;
    // Runs of the map are there if they were made.
    let others = all_runs(&folder)?.into_iter().filter(|r| !own.contains(r)).collect::<Vec<_>>();
    own.extend(others);
    Ok(own)
}
