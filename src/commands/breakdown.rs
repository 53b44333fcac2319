//! `ibr breakdown`: over which pressures and pouches the reduced model parts from the finite elements.

use super::fem_inputs::{kept, list, robots, sizes};
use super::shards::shared;
use crate::cli::BreakdownArgs;
use crate::prelude::*;
use compare::study::breakdown::Parting;
use compare::study::breakdown::{PARTINGS_CSV, Ranges, jobs, partings};
use compare::study::columns::csv;
use compare::study::columns::{TextColumn, TextTable};
use compare::study::engines::SHAPE;
use compare::study::engines::{EngineRun, engines, runs_json, runs_of, stored};
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

type Made = (Vec<EngineRun>, Vec<Failure>);

/// Runs that come with the program or those of the folder, which gets what is missing; or what is said of a shard of them.
fn runs(args: &BreakdownArgs, context: &mut Context) -> Result<Result<Made, Outcome>> {
    if args.runs.stored {
        return Ok(Ok((stored()?.into_iter().filter(|run| run.seed == 1).collect(), Vec::new())));
    }
    let meshes = args.mesh.as_deref().map(sizes).transpose()?.unwrap_or_default();
    if meshes.len() > 1 {
        return Err(Failure::usage("--mesh takes one size here", "write for example --mesh 8mm/4mm"));
    }
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
    /// One robot at one pressure
    cells: &'a [Parting],
}

const COLUMNS: [TextColumn<Parting>; 11] = [
    ("robot", |row| row.robot.clone()),
    ("mesh mm", |row| row.mesh_mm.to_string()),
    ("body kPa", |row| row.body_kpa.to_string()),
    ("pouch mm", |row| row.pouch_mm.to_string()),
    ("actuator kPa", |row| format!("{:.0}", row.actuator_kpa)),
    ("FE tip mm", |row| format!("{:.1}", row.fe_tip_mm)),
    ("bare tip mm", |row| format!("{:.1}", row.bare_tip_mm)),
    ("difference %", |row| percent(row.bare_difference)),
    ("reduced tip mm", |row| format!("{:.1}", row.reduced_tip_mm)),
    ("difference %", |row| percent(row.difference)),
    ("carried by", |row| {
        let words = row.carried_by.map(|c| format!("{} ({:+.0} % without)", c.term, 100.0 * c.difference_without));
        words.unwrap_or("–".into())
    }),
];

fn percent(share: Option<f64>) -> String {
    share.map_or("–".into(), |d| format!("{:+.0}", 100.0 * d))
}

/// Every run at every pressure; then arm, width, height and volumes of both engines, where a run kept them.
fn text(rows: &[Parting]) -> String {
    let all = TextTable::of("", 1, &COLUMNS, rows);
    let shape = |row: &Parting| {
        let shape = row.shape.as_ref()?;
        let both = shape.reduced.iter().zip(shape.fe);
        let both = both.map(|(own, fe)| format!("{own:.1} / {fe:.1} ({:+.1})", 100.0 * (own / fe - 1.0)));
        let place = [0, 2, 3, 4].map(|column| COLUMNS[column].1(row));
        Some(place.into_iter().chain(both).collect())
    };
    let shapes: Vec<Vec<String>> = rows.iter().filter_map(shape).collect();
    if shapes.is_empty() {
        return printed(&all);
    }
    let names = SHAPE.iter().enumerate().map(|(k, name)| format!("{name} {}", if k < 3 { "mm" } else { "cm³" }));
    let heads: Vec<String> = [0, 2, 3, 4].map(|column| COLUMNS[column].0.into()).into_iter().chain(names).collect();
    let caption = "Inflated pouches and body: reduced model / finite elements (difference in %)";
    format!("{}\n{caption}\n{}", printed(&all), Table::finished(&heads, 1, shapes).text())
}
