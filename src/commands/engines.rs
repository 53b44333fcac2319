//! `ibr compare --engines`: both engines and the published numbers.

use super::fem_inputs::{kept, pressures, robots};
use crate::cli::CompareArgs;
use crate::prelude::*;
use crate::shown::engines as shown;
use compare::study::engines::{
    EngineLine, EnginePair, EngineRun, Engines, all_runs, engines, lines, runs_json, runs_of, seed_jobs, stored,
};
use fem::session::RunSource;
use ibr::pages::engines_page;

pub(super) fn run(args: &CompareArgs, context: &mut Context) -> Result<Outcome> {
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
    let mut outcome = Outcome::answer(text(&all, &found)?, "ibr.engines", &engines_answer(&all, &found));
    (context.progress)("drawing the report", None);
    let mut files = engines_page(&found, &maker())?;
    files.files.insert(0, ("runs.json".into(), runs_json(&runs).into_bytes()));
    write_files(&folder, &files, &inputs, context)?;
    outcome.report(&folder);
    Ok(outcome)
}

/// Runs of the folder; missing runs are made there.
fn made(args: &CompareArgs, robots: &[(RunSource, Scenario)], context: &mut Context) -> Result<Vec<EngineRun>> {
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

/// `ibr.engines`: `ibr compare --engines`
#[derive(Serialize)]
struct EnginesAnswer<'a> {
    /// Height by every source for every robot and pressure
    lines: &'a [EngineLine],
    /// Energies of both engines, robot by robot
    ledgers: Vec<RobotLedgers<'a>>,
}

#[derive(Serialize)]
struct RobotLedgers<'a> {
    /// Name of the robot in its scenario
    robot: &'a str,
    /// Ledgers of both engines, by pressure
    pairs: &'a [EnginePair],
}

fn engines_answer<'a>(lines: &'a [EngineLine], engines: &'a Engines) -> EnginesAnswer<'a> {
    let ledgers = engines.robots.iter().map(|r| RobotLedgers { robot: &r.scenario.name, pairs: &r.pairs });
    EnginesAnswer { lines, ledgers: ledgers.collect() }
}

fn text(lines: &[EngineLine], Engines { robots, .. }: &Engines) -> Result<String> {
    let tables = [
        shown::summary(robots)?.under(shown::SUMMARY),
        shown::line_table(lines).under(shown::LINES),
        shown::branches(robots).under(shown::BRANCHES),
        shown::ledgers(robots).under(shown::LEDGERS),
    ];
    Ok(tables.concat().trim_start().to_string())
}
