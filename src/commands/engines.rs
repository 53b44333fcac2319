//! `ibr compare --engines`: both engines and the published numbers.

use super::simulate::{Keeper, Named, all_runs, named, pressures};
use super::tables::table;
use super::{Context, Outcome};
use crate::cli::Compare;
use crate::failure::{Failure, INTERRUPTED};
use crate::output::{Input, check_folder, machine, program, today, write_files};
use compare::study::engines::{
    EngineLine, Engines, HEADS, SUMMARY, VOLUMES, VOLUMES_CAPTION, cells, engines, lines, summary, volume_cells,
};
use compare::study::engines::{FeRun, TERMS, runs_json, stored};
use ibr::pages::{Imprint, engines_page};
use models::Scenario;
use serde_json::json;
use std::path::{Path, PathBuf};

/// The robots of the paper.
const PUBLISHED: [&str; 4] = ["spam", "cpam", "epam", "fpam"];

pub fn run(args: &Compare, context: &mut Context) -> Result<Outcome, Failure> {
    let folder = args.out.clone().unwrap_or_else(|| PathBuf::from("ibr-report/compare-engines"));
    check_folder(&folder)?;
    let (scenarios, inputs) = robots(&args.inputs)?;
    let Some(runs) = runs(args, &scenarios, context)? else {
        let note = "interrupted; finished runs are kept, the same command goes on".to_string();
        return Ok(Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() });
    };
    let scenarios: Vec<Scenario> = scenarios.into_iter().map(|s| s.1).collect();
    let found = engines(&scenarios, &runs)?;
    let mut all: Vec<EngineLine> = Vec::new();
    for robot in &found.robots {
        all.extend(lines(robot)?);
    }
    let mut outcome = Outcome::new(
        text(&all, &found)?,
        json!({
            "schema": "ibr.engines", "version": 1, "lines": all,
            "ledgers": found.robots.iter().map(|r| json!({"robot": r.scenario.name, "pairs": r.pairs})).collect::<Vec<_>>(),
            "volumes": found.robots.iter().flat_map(|r| &r.bodies).collect::<Vec<_>>(),
        }),
    );
    (context.progress)("drawing the report", None);
    let imprint = Imprint { program: program(), date: today(), machine: machine() };
    let mut files = engines_page(&found, &imprint)?;
    files.files.insert(0, ("runs.json".into(), runs_json(&runs).into_bytes()));
    write_files(&folder, &files, &inputs, context)?;
    outcome.notes.push(format!("report: {}", folder.join("report.html").display()));
    Ok(outcome)
}

/// A scenario as typed, and as read.
pub type Robot = (Named, Scenario);

/// Scenarios named, or those of the paper.
pub fn robots(specs: &[String]) -> Result<(Vec<Robot>, Vec<Input>), Failure> {
    let own: Vec<String> = PUBLISHED.map(String::from).to_vec();
    let specs = if specs.is_empty() { &own } else { specs };
    let (mut found, mut inputs) = (Vec::new(), Vec::new());
    for spec in specs {
        let named = named(spec)?;
        if !named.is_robot() {
            let message = format!("{spec} is not the scenario of a robot");
            return Err(Failure::usage(message, "give scenarios such as spam cpam epam fpam"));
        }
        let (scenario, _) = named.robot_run()?;
        inputs.push(Input::of(spec, named.text.as_bytes()));
        found.push((named, scenario));
    }
    Ok((found, inputs))
}

/// Stored runs, or those of the folder, which gets what is missing.
fn runs(args: &Compare, scenarios: &[(Named, Scenario)], context: &mut Context) -> Result<Option<Vec<FeRun>>, Failure> {
    if args.stored {
        return Ok(Some(stored()?));
    }
    let keeper = Keeper { folder: args.runs_folder(), threads: args.threads as usize };
    let Ok(own) = keeper.run_all(&cases(args, scenarios)?, context)? else { return Ok(None) };
    let mut own = own.into_iter().collect::<Result<Vec<FeRun>, Failure>>()?;
    // Runs of the map are there if they were made.
    let others = all_runs(&keeper.folder)?.into_iter().filter(|r| !own.contains(r)).collect::<Vec<_>>();
    own.extend(others);
    Ok(Some(own))
}

/// Every robot with every seed.
fn cases(args: &Compare, scenarios: &[Robot]) -> Result<Vec<(Named, String)>, Failure> {
    let mut cases = Vec::new();
    for (named, scenario) in scenarios {
        for seed in 1..=args.seeds {
            let mut changes = vec![("seed".to_string(), seed.to_string())];
            if let Some(list) = &args.pressure {
                changes.push(("pressures_kpa".into(), format!("{:?}", pressures(list)?)));
            }
            cases.push((named.with(&changes)?, format!("{}, seed {seed}", scenario.name)));
        }
    }
    Ok(cases)
}

fn text(lines: &[EngineLine], engines: &Engines) -> Result<String, Failure> {
    let mut out = String::new();
    let short: Vec<Vec<String>> = engines.robots.iter().map(summary).collect::<Result<Vec<_>, _>>()?.concat();
    if !short.is_empty() {
        out.push_str(
            "Outermost marker at 30 kPa; finite elements: median and 80 % interval over all numbers that nobody measured; as recommended: mean ± standard deviation over seeds\n",
        );
        out.push_str(&table(&SUMMARY, 1, short));
        out.push('\n');
    }
    out.push_str("All pressures that the paper prints\n");
    out.push_str(&table(&HEADS, 1, lines.iter().map(cells).collect()));
    Ok(out + &ledgers(engines) + &volumes(engines))
}

fn ledgers(engines: &Engines) -> String {
    let (mut out, mut rows) = (String::new(), Vec::new());
    for robot in &engines.robots {
        let Some(pair) = robot.pairs.last() else { continue };
        for (engine, energies) in [
            ("reduced", Some(pair.reduced_mj)),
            ("finite elements", Some(pair.fe_mj)),
            ("excess at the same bend", pair.excess_mj),
        ] {
            let Some(energies) = energies else { continue };
            let mut row = vec![robot.scenario.actuator.kind.name.to_string(), engine.to_string()];
            row.extend(energies.map(|e| format!("{e:.0}")));
            row.push(if engine == "finite elements" { format!("{:.0}", pair.lost_mj) } else { "–".into() });
            rows.push(row);
        }
        if let Some(carrier) = pair.carrier() {
            let mut row = vec![String::new(), format!("carried by: {carrier}")];
            row.resize(TERMS.len() + 3, String::new());
            rows.push(row);
        }
    }
    if !rows.is_empty() {
        out.push_str("\nLedgers at the highest pressure [mJ]: gas −P ΔV, what is stored, what was lost\n");
        let mut head = vec!["robot", "engine"];
        head.extend(TERMS);
        head.push("lost");
        out.push_str(&table(&head, 2, rows));
    }
    out
}

fn volumes(engines: &Engines) -> String {
    let rows = volume_cells(&engines.robots);
    if rows.is_empty() { String::new() } else { format!("\n{VOLUMES_CAPTION}\n{}", table(&VOLUMES, 1, rows)) }
}

/// Runs for other commands: those stored in the program, or those of a folder if one is named.
pub fn known_runs(folder: Option<&Path>) -> Result<Vec<FeRun>, Failure> {
    let Some(folder) = folder else { return Ok(stored()?) };
    let found = all_runs(folder)?;
    if found.is_empty() {
        let message = format!("{}: no finished finite element run of a robot", folder.display());
        let make = format!("make them with: ibr compare --engines SCENARIO --runs {}", folder.display());
        return Err(Failure::usage(message, &make));
    }
    Ok(found)
}
