//! Several runs of one robot: those that differ in seed, mesh or pressure, and hypercubes.

use crate::cli::{ShardArgs, SimulateArgs};
use crate::commands::shards::shared;
use crate::prelude::*;
use compare::study::uncertain::{Intervals, Member, Uncertain, Varied, Weight};
use fem::session::{
    AS_IT_IS, Cube, Heights, RunJob, RunRow, RunSettings, RunSource, RunTable, SeedGroup, Variation, simulate_all,
};
use ibr::pages::{Files, marker_intervals, mesh_plot, what_to_measure};
use std::collections::BTreeMap;

fn jobs(base: &RunSource, variations: &[Variation]) -> Result<Vec<RunJob>> {
    let job = |v: &Variation| {
        let (what, folder) = (v.label.clone(), Some(v.label.clone()));
        Ok(RunJob { source: base.with(&v.changes)?, what, folder })
    };
    variations.iter().map(job).collect()
}

pub(super) fn table(
    base: &RunSource,
    variations: &[Variation],
    settings: &RunSettings,
    shards: &ShardArgs,
    context: &mut Context,
) -> Result<Outcome> {
    let jobs = jobs(base, variations)?;
    if let Some(told) = shared(shards, &jobs, settings, context)? {
        return Ok(told);
    }
    let many = context.fem(|progress| simulate_all(&jobs, settings, progress))?;
    let table = RunTable::of(variations, many)?;
    let mut outcome = Outcome::answer(table_text(&table), "ibr.simulations", &simulations_answer(&table));
    let png = mesh_plot(&base.name, &table).and_then(|plot| report::lines(&plot).ok()).map(|drawn| drawn.png);
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
    settings: RunSettings,
    context: &mut Context,
) -> Result<Outcome> {
    let settings = RunSettings { frames: false, ..settings };
    let jobs = jobs(&cube.base, &cube.robots)?;
    if let Some(told) = shared(&args.shards, &jobs, &settings, context)? {
        return Ok(told);
    }
    let many = context.fem(|progress| simulate_all(&jobs, &settings, progress))?;
    let all = Uncertain::of(cube, &many, &args.changes.set)?;
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
            "note: {robots} finished robots cannot show which number to measure first, {needed} can: tornado.png was not written"
        ));
    }
    let record = ("written", "uncertain.json", all.record().into_bytes());
    write(&mut outcome, &settings, std::iter::once(record).chain(markers).chain(tornado), context)?;
    Ok(outcome)
}

fn write(
    outcome: &mut Outcome,
    settings: &RunSettings,
    files: impl Iterator<Item = (&'static str, &'static str, Vec<u8>)>,
    context: &mut Context,
) -> Result<()> {
    let folder = settings.folder.as_deref().unwrap_or(Path::new(""));
    let mut written = Files::default();
    for (what, name, bytes) in files {
        outcome.notes.push(format!("{what}: {}", folder.join(name).display()));
        written.files.push((name.into(), bytes));
    }
    write_files(folder, &written, &[], context)
}

/// Every run, then mean and spread of those that differ in the seed only.
fn table_text(all: &RunTable) -> String {
    // A robot as it is comes first, then what was changed about it.
    let first = all.rows.first().filter(|run| run.variation.label == AS_IT_IS).map_or(&[][..], |run| &run.heights);
    let change = |k: usize, h: &Heights| {
        let own = first.get(k).filter(|own| own.actuator_kpa == h.actuator_kpa && own.tip_mm.abs() > 0.0);
        own.map(|own| 100.0 * (h.tip_mm / own.tip_mm - 1.0))
    };
    let rows = all.rows.iter().flat_map(|run| run.heights.iter().enumerate().map(move |(k, h)| (run, k, h)));
    let text = TextTable::of(rows)
        .words("run", |(run, ..)| &run.variation.label)
        .right("actuator kPa", |(.., h)| h.actuator_kpa.to_string())
        .number("outermost marker mm", 1, |(.., h)| h.marker_mm)
        .number("tip mm", 1, |(.., h)| h.tip_mm)
        .signed("change %", 1, |(_, k, h)| change(*k, h))
        .right("at rest", |(.., h)| if h.is_at_rest { "yes" } else { "no" })
        .number("run CPU s", 1, |(run, ..)| run.cpu_s)
        .text();
    let groups = all.groups();
    let several = TextTable::of(groups.iter().filter(|g| g.runs > 1))
        .words("group", |g| if g.group.is_empty() { "all" } else { &g.group })
        .right("actuator kPa", |g| g.actuator_kpa.to_string())
        .right("runs", |g| g.runs.to_string())
        .number("mean mm", 1, |g| g.tip_mean_mm)
        .number("sd mm", 1, |g| g.tip_sd_mm);
    text + &several.under("Tip, mean and standard deviation over the seeds")
}

fn uncertain_text(all: &Uncertain, measured: &[(f64, [f64; 2])]) -> String {
    let stopped: Vec<&Member> = all.members.iter().filter(|m| m.stopped.is_some()).collect();
    let mut out = format!(
        "{}: {} robots whose assumed numbers fill their intervals{}\n\nHeight of the markers [mm]: median (10 % to 90 %)\n",
        all.scenario,
        all.members.len(),
        if stopped.is_empty() { String::new() } else { format!(", {} of which stopped", stopped.len()) }
    );
    let mut heights = TextTable::of(all.pressures_kpa()).right("actuator kPa", |kpa| kpa.to_string());
    for (m, s) in all.stations_mm.iter().enumerate() {
        heights = heights.right(format!("s = {s}"), |kpa| {
            let quantiles = all.quantiles_mm(*kpa, m, 1);
            quantiles.map_or("–".into(), |[low, middle, high]| format!("{middle:.1} ({low:.1} to {high:.1})"))
        });
    }
    let seen = |kpa: &f64| {
        let (_, [_, y]) = measured.iter().find(|(at, _)| (at - kpa).abs() < 0.05)?;
        let inside = all.tip_mm(*kpa).is_some_and(|[low, _, high]| (low..=high).contains(y));
        Some(format!("{y:.1}, {}", if inside { "inside" } else { "outside" }))
    };
    out += &heights.right("measured", |kpa| seen(kpa).unwrap_or("–".into())).text();
    let top = all.top_kpa();
    if let Some((weights, rest)) = all.weights(top) {
        let number = |w: &Weight| &all.numbers[w.number];
        out += &format!("\nWhat to measure first: outermost marker at {top} kPa\n");
        out += &TextTable::of(&weights)
            .words("assumed", |w| &number(w).name)
            .words("interval", |w| number(w).interval.map(three_digits).join(" to "))
            .signed("10 % to 90 % of it: mm", 1, |w| w.swing_mm)
            .number("of the variance %", 0, |w| 100.0 * w.share)
            .right("why this interval", |w| &number(w).reason)
            .text();
        out += &calibrated(all, measured, &weights);
        out += &format!("{:.0} % of the variance is not of a straight law\n", 100.0 * rest);
    }
    out + &lines("stopped: ", stopped.iter().map(|member| member.stopped.as_deref().unwrap_or_default()))
}

fn three_digits(value: f64) -> String {
    format!("{value:.2e}").parse::<f64>().unwrap_or(value).to_string()
}

/// What one number would have to be for the measured displacement, all others in the middle of their intervals.
fn calibrated(all: &Uncertain, measured: &[(f64, [f64; 2])], weights: &[Weight]) -> String {
    let Some((kpa, [_, y])) = measured.last() else { return String::new() };
    let place = |w: &&Weight| {
        let share = all.share_for(*kpa, w.number, *y).filter(|share| (0.0..=1.0).contains(share));
        share.map_or("none in its interval".into(), |share| format!("{:.0} % of its interval", 100.0 * share))
    };
    let title = format!(
        "Calibration, no prediction: what one number would have to be for the measured {y:.1} mm at {kpa} kPa, by a straight law"
    );
    let table = TextTable::of(weights).words("assumed", |w| &all.numbers[w.number].name).words("target", place);
    format!("\n{title}\n{}", table.text())
}

/// `ibr.simulations`: `ibr simulate ROBOT`, several runs
#[derive(Serialize)]
struct SimulationsAnswer<'a> {
    /// Heights and processor time of every run
    runs: Vec<RunRecord<'a>>,
    /// Those that differ in the seed only
    groups: Vec<SeedGroup>,
}

#[derive(Serialize)]
struct RunRecord<'a> {
    /// Difference from the common scenario, in words
    run: &'a str,
    /// Keys of `[fem]` that differ, with their values
    changes: BTreeMap<&'a str, &'a str>,
    /// Folder in which the run was written
    folder: &'a str,
    /// Heights of marker and tip at every pressure
    heights: &'a [Heights],
    /// Processor time that the run took
    cpu_s: f64,
}

fn simulations_answer<'a>(table: &'a RunTable) -> SimulationsAnswer<'a> {
    let record = |row: &'a RunRow| RunRecord {
        run: &row.variation.label,
        changes: row.variation.changes.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect(),
        folder: &row.folder,
        heights: &row.heights,
        cpu_s: row.cpu_s,
    };
    SimulationsAnswer { runs: table.rows.iter().map(record).collect(), groups: table.groups() }
}

/// `ibr.uncertain`: `ibr simulate ROBOT --uncertain`
#[derive(Serialize)]
struct UncertainAnswer<'a> {
    /// Number of robots that were run
    robots: usize,
    /// Assumed numbers that were varied, with their intervals
    numbers: &'a [Varied],
    /// Heights of every marker at every pressure
    pressures: Vec<Intervals>,
    /// What each number does to the outermost marker; null with too few robots
    weights: Option<&'a [Weight]>,
    /// Share of the variance that is not of a straight law
    rest: Option<f64>,
}
