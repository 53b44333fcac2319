//! Several runs of one robot: those that differ in seed, mesh or pressure, and hypercubes.

use crate::cli::{ShardArgs, SimulateArgs};
use crate::commands::shards::shared;
use crate::prelude::*;
use crate::shown::several_runs::{SimulationsAnswer, UncertainAnswer, table_text, uncertain_text};
use compare::study::uncertain::Uncertain;
use fem::session::{Cube, Job, RunTable, Settings, Source, Variation, simulate_all};
use ibr::pages::{Files, marker_intervals, mesh_plot, what_to_measure};
use report::lines;

fn jobs(base: &Source, variations: &[Variation]) -> Result<Vec<Job>, Failure> {
    let job = |v: &Variation| {
        let (what, folder) = (v.label.clone(), Some(v.label.clone()));
        Ok(Job { source: base.with(&v.changes)?, what, folder })
    };
    variations.iter().map(job).collect()
}

pub(super) fn table(
    base: &Source,
    variations: &[Variation],
    settings: &Settings,
    shards: &ShardArgs,
    context: &mut Context,
) -> Result<Outcome, Failure> {
    let jobs = jobs(base, variations)?;
    if let Some(told) = shared(shards, &jobs, settings, context)? {
        return Ok(told);
    }
    let many = context.fem(|progress| simulate_all(&jobs, settings, progress))?;
    let table = RunTable::of(variations, many)?;
    let mut outcome = Outcome::answer(table_text(&table), "ibr.simulations", &SimulationsAnswer::of(&table));
    let png = mesh_plot(&base.name, &table).and_then(|plot| lines(&plot).ok()).map(|drawn| drawn.png);
    let files = [("plot", "mesh.png", png), ("table", "table.csv", Some(table.csv().into_bytes()))];
    write(
        &mut outcome,
        settings,
        files.into_iter().filter_map(|(what, name, bytes)| Some((what, name, bytes?))),
        context,
    )?;
    Ok(outcome)
}

pub(super) fn uncertain(
    cube: &Cube,
    args: &SimulateArgs,
    settings: Settings,
    context: &mut Context,
) -> Result<Outcome, Failure> {
    let settings = Settings { frames: false, ..settings };
    let jobs = jobs(&cube.base, &cube.robots)?;
    if let Some(told) = shared(&args.shards, &jobs, &settings, context)? {
        return Ok(told);
    }
    let many = context.fem(|progress| simulate_all(&jobs, &settings, progress))?;
    let all = Uncertain::of(cube, &many, &args.set)?;
    let (measured, top) = (all.measured(), all.top_kpa());
    let weights = all.weights(top);
    let answer = UncertainAnswer {
        robots: all.members.len(),
        numbers: &all.numbers,
        pressures: all.intervals(),
        weights: weights.as_ref().map(|w| &w.0[..]),
        rest: weights.as_ref().map(|w| w.1),
    };
    let mut outcome = Outcome::answer(uncertain_text(&all, &measured), "ibr.uncertain", &answer);
    let markers = marker_intervals(&all, &measured).map(|drawn| ("written", "markers.png", drawn.png));
    let tornado = weights.as_ref().map(|_| what_to_measure(&all, top)).transpose()?;
    let tornado = tornado.map(|drawn| ("written", "tornado.png", drawn.png));
    if weights.is_none() {
        let (robots, needed) = (all.members.iter().filter(|m| m.stopped.is_none()).count(), all.needed());
        outcome.notes.push(format!(
            "note: {robots} finished robots do not tell which number to measure first, {needed} do: there is no tornado.png"
        ));
    }
    let record = ("written", "uncertain.json", all.record().into_bytes());
    write(&mut outcome, &settings, std::iter::once(record).chain(markers).chain(tornado), context)?;
    Ok(outcome)
}

/// Writes files and their manifest beside the runs.
fn write(
    outcome: &mut Outcome,
    settings: &Settings,
    files: impl Iterator<Item = (&'static str, &'static str, Vec<u8>)>,
    context: &mut Context,
) -> Result<(), Failure> {
    let folder = settings.folder.as_deref().unwrap_or(Path::new(""));
    let mut written = Files::default();
    for (what, name, bytes) in files {
        outcome.notes.push(format!("{what}: {}", folder.join(name).display()));
        written.files.push((name.into(), bytes));
    }
    write_files(folder, &written, &[], context)
}
