//! `ibr breakdown`: over which pressures and pouches the reduced model parts from the finite elements.

use super::fem_inputs::{kept, list, robots, sizes};
use super::shards::shared;
use crate::cli::BreakdownArgs;
use crate::prelude::*;
use compare::study::breakdown::{PARTINGS_CSV, Parting, Ranges, jobs, partings};
use compare::study::columns::csv;
use compare::study::engines::{EngineRun, SHAPE, engines, runs_json, runs_of, stored};
use ibr::pages::parting_plot;

pub(super) fn run(args: &BreakdownArgs, context: &mut Context) -> Result<Outcome> {
    check_folder(&args.out)?;
    let (runs, stopped) = match runs(args, context)? {
        Ok(made) => made,
        Err(told) => return Ok(told),
    };
    let scenarios: Vec<Scenario> = robots(&args.scenarios)?.0.into_iter().map(|r| r.1).collect();
    let rows = partings(&scenarios, &runs)?;
    let mut files = Files::default();
    for (k, map) in engines(&scenarios, &runs)?.maps.iter().enumerate() {
        files.plot(&format!("breakdown_{}_{k}", map.actuator), parting_plot(map)?);
    }
    files.text("breakdown.csv", csv(&PARTINGS_CSV, &rows));
    files.text("runs.json", runs_json(&runs));
    write_files(&args.out, &files, &[], context)?;
    let mut outcome = Outcome::answer(text(&rows), "ibr.breakdown", &Breakdown { cells: &rows });
    outcome.notes.extend(stopped.iter().map(|error| format!("left out of the map: {}", error.render().trim())));
    outcome.notes.push(format!("maps and tables: {}", args.out.display()));
    Ok(outcome)
}

type MadeRuns = (Vec<EngineRun>, Vec<Failure>);

/// Runs that come with the program, or runs in the folder, completed there; for a shard the outcome to print.
fn runs(args: &BreakdownArgs, context: &mut Context) -> Result<Result<MadeRuns, Outcome>> {
    if args.runs.stored {
        return Ok(Ok((stored()?.into_iter().filter(|run| run.seed == 1).collect(), Vec::new())));
    }
    let meshes = args.mesh.as_deref().map(sizes).transpose()?.unwrap_or_default();
    let message = "--mesh takes one size here";
    let help = "write for example --mesh 8mm/4mm";
    refuse_if(meshes.len() > 1, message, help)?;
    let ranges = Ranges {
        body_kpa: list("--body-pressure", &args.body_pressure, Quantity::Pressure, 1e-3)?,
        pouch_mm: list("--pouch", &args.pouch, Quantity::Length, 1e3)?,
        actuator_kpa: list("--pressure", &args.pressure, Quantity::Pressure, 1e-3)?,
        mesh_mm: meshes.first().copied(),
        carriers: args.carriers,
    };
    let (jobs, settings) = (jobs(&robots(&args.scenarios)?.0, &ranges)?, kept(&args.runs.folder(), context));
    if let Some(told) = shared(&args.shards, &jobs, &settings, context)? {
        return Ok(Err(told));
    }
    let (mut runs, mut stopped) = (Vec::new(), Vec::new());
    for run in context.fem(|progress| runs_of(&jobs, &settings, progress))? {
        match run {
            Ok(run) => runs.push(run),
            Err(error) => stopped.push(Failure::from(error)),
        }
    }
    match runs.is_empty() && !stopped.is_empty() {
        true => Err(stopped.remove(0)),
        false => Ok(Ok((runs, stopped))),
    }
}

/// `ibr.breakdown`: `ibr breakdown`
#[derive(Serialize)]
struct Breakdown<'a> {
    /// One robot at one pressure, in both engines
    cells: &'a [Parting],
}

fn carried(row: &Parting) -> String {
    let words = row.carried_by.map(|c| format!("{} ({:+.0} % without)", c.term, 100.0 * c.difference_without));
    words.unwrap_or("–".into())
}

/// Every run at every pressure; then arm, width, height and volumes of both engines, where a run kept them.
fn text(rows: &[Parting]) -> String {
    let percent = |share: Option<f64>| share.map(|d| 100.0 * d);
    let all = TextTable::of(rows)
        .words("robot", |row| &row.robot)
        .right("mesh mm", |row| row.mesh_mm.to_string())
        .right("body kPa", |row| row.body_kpa.to_string())
        .right("pouch mm", |row| row.pouch_mm.to_string())
        .number("actuator kPa", 0, |row| row.actuator_kpa)
        .number("FE tip mm", 1, |row| row.fe_tip_mm)
        .number("bare tip mm", 1, |row| row.bare_tip_mm)
        .signed("difference %", 0, |row| percent(row.bare_difference))
        .number("reduced tip mm", 1, |row| row.reduced_tip_mm)
        .signed("difference %", 0, |row| percent(row.difference))
        .right("carried by", |row| carried(row));
    let mut shapes = TextTable::of(rows.iter().filter_map(|row| Some((row, row.shape.as_ref()?))))
        .words("robot", |(row, _)| &row.robot)
        .right("body kPa", |(row, _)| row.body_kpa.to_string())
        .right("pouch mm", |(row, _)| row.pouch_mm.to_string())
        .number("actuator kPa", 0, |(row, _)| row.actuator_kpa);
    for (k, name) in SHAPE.iter().enumerate() {
        shapes = shapes.right(format!("{name} {}", if k < 3 { "mm" } else { "cm³" }), |(_, shape)| {
            let (own, fe) = (shape.reduced[k], shape.fe[k]);
            format!("{own:.1} / {fe:.1} ({:+.1})", 100.0 * (own / fe - 1.0))
        });
    }
    all.text() + &shapes.under("Inflated pouches and body: reduced model / finite elements (difference in %)")
}
