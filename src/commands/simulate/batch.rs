//! Several runs of one robot in one folder: a finished one is kept and skipped, an interrupted one goes on.

use super::folder;
use super::input::Named;
use super::plan::{About, Variation};
use super::robot::{heights_mm, rounded};
use super::single::{self, Done, Finished, Manner};
use super::summary::Summary;
use super::uncertain;
use crate::commands::tables::table;
use crate::commands::together::{shared, together};
use crate::commands::{Context, Outcome};
use crate::failure::{Failure, INTERRUPTED};
use fem::robot::Reading;
use report::{LineSeries, LineStyle, Lines, lines};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// Heights of one run.
struct Row {
    variation: Variation,
    /// Pressure \[kPa\], outermost marker \[mm\], tip \[mm\].
    heights: Vec<[f64; 3]>,
    /// Folder; empty if the run is that of another row.
    folder: String,
    cpu_s: f64,
}

/// Runs all that are not there yet.
pub fn run(
    base: &Named,
    cases: &[Variation],
    about: &About,
    manner: &Manner,
    context: &mut Context,
) -> Result<Outcome, Failure> {
    if manner.folder.join("case.toml").exists() {
        let path = manner.folder.display().to_string();
        let help = "choose another folder with --out; several runs get a folder each inside it".into();
        return Err(Failure::Write { path, cause: "it holds a single run".into(), help });
    }
    if let About::Uncertain(numbers, cube, variant) = about {
        return uncertain::run(base, cases, (numbers, cube, variant), manner, context);
    }
    let rows = match rows(base, cases, manner, context)? {
        Ok(rows) => rows,
        Err(done) => return Ok(interrupted(done, cases.len(), &manner.folder)),
    };
    let mut outcome = listed(&rows);
    if let Some(png) = meshes(&base.spec, &rows) {
        let path = manner.folder.join("mesh.png");
        data::write_atomically(&path, &png)?;
        outcome.notes.push(format!("plot: {}", path.display()));
    }
    data::write_atomically(&manner.folder.join("table.csv"), csv(&rows).as_bytes())?;
    outcome.notes.push(format!("table: {}", manner.folder.join("table.csv").display()));
    Ok(outcome)
}

/// What the cases gave, several beside each other; if the user interrupted them, the number of runs that are complete.
fn rows(
    base: &Named,
    cases: &[Variation],
    manner: &Manner,
    context: &mut Context,
) -> Result<Result<Vec<Row>, usize>, Failure> {
    // All cases are looked at before the first one costs time.
    let mut loaded = Vec::new();
    for case in cases {
        let named = base.with(&case.changes)?;
        let fingerprint = named.load()?.case.problem.fingerprint();
        loaded.push((named, fingerprint));
    }
    let first = |index: usize| loaded.iter().position(|(_, print)| *print == loaded[index].1).unwrap_or(index);
    let jobs: Vec<usize> = (0..cases.len()).filter(|index| first(*index) == *index).collect();
    for &index in &jobs {
        holds_another(&loaded[index].0, &manner.folder.join(&cases[index].label), manner.force)?;
    }
    let (workers, threads) = shared(manner.threads, jobs.len());
    let each = Manner { threads, ..manner.clone() };
    let found = together(jobs.len(), workers, context, &|job, inner: &mut Context| {
        let (index, label) = (jobs[job], &cases[jobs[job]].label);
        one(&loaded[index].0, label, &each, &format!("{} of {}, {label}", index + 1, cases.len()), inner)
    })?;
    let found: BTreeMap<usize, Finished> = match found {
        Ok(found) => jobs.into_iter().zip(found).collect(),
        Err(done) => return Ok(Err(done)),
    };
    let row = |(index, case): (usize, &Variation)| {
        let (own, run) = (first(index) == index, &found[&first(index)]);
        let cpu_s = if own { run.cost.cpu_s_of_all_sessions } else { 0.0 };
        let folder = if own { case.label.clone() } else { String::new() };
        Row { variation: case.clone(), heights: heights(&run.summary), folder, cpu_s }
    };
    Ok(Ok(cases.iter().enumerate().map(row).collect()))
}

/// One run of the batch; `None` if the user interrupted it.
pub fn one(
    named: &Named,
    label: &str,
    manner: &Manner,
    what: &str,
    context: &mut Context,
) -> Result<Option<Finished>, Failure> {
    let folder = manner.folder.join(label);
    let other = holds_another(named, &folder, manner.force)?;
    let manner = Manner { folder, resume: !other, force: other, ..manner.clone() };
    let Context { json, progress, written, interrupt } = context;
    let mut tell = |text: &str, share: Option<f64>| progress(&format!("{what}: {text}"), share);
    let mut inner = Context { json: *json, progress: &mut tell, written, interrupt };
    match single::run(named.load()?, &manner, &mut inner)? {
        Done::Now(run, _) | Done::Before(run) => Ok(Some(run)),
        Done::Interrupted { .. } => Ok(None),
    }
}

/// Whether the folder holds a run of another case, which is an error unless it may be overwritten.
fn holds_another(named: &Named, folder: &Path, force: bool) -> Result<bool, Failure> {
    let other = folder::is_of(folder, &named.text)? == Some(false);
    if other && !force {
        let cause = "it holds a run of another case, or the case has changed".into();
        let help = "choose another folder with --out, or add --force to run it again".into();
        return Err(Failure::Write { path: folder.display().to_string(), cause, help });
    }
    Ok(other)
}

fn heights(summary: &Summary) -> Vec<[f64; 3]> {
    let read = summary.robot.iter().flat_map(|robot| &robot.readings);
    let row = |r: &Reading| {
        let [marker, tip] = heights_mm(r);
        [rounded(r.actuator_pa * 1e-3), marker, tip]
    };
    read.filter(|r| r.actuator_pa > 0.0).map(row).collect()
}

pub fn interrupted(done: usize, all: usize, folder: &Path) -> Outcome {
    let note = format!(
        "interrupted; {done} of {all} runs are complete in {}; the same command goes on there",
        folder.display()
    );
    Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() }
}

/// Every run, then mean and spread of those that differ in the seed only.
fn listed(rows: &[Row]) -> Outcome {
    let mut lines = Vec::new();
    for row in rows {
        for [kpa, marker, tip] in &row.heights {
            let label = if row.variation.label.is_empty() { "as it is" } else { &row.variation.label };
            let cpu = format!("{:.1}", row.cpu_s);
            lines.push(vec![label.to_string(), kpa.to_string(), format!("{marker:.1}"), format!("{tip:.1}"), cpu]);
        }
    }
    let head = ["run", "actuator kPa", "outermost marker mm", "tip mm", "run CPU s"];
    let mut text = table(&head, 1, lines);
    let groups = groups(rows);
    let words = |name: &str| if name.is_empty() { "all".to_string() } else { name.to_string() };
    let several: Vec<&Group> = groups.iter().filter(|g| g.tips.len() > 1).collect();
    if !several.is_empty() {
        let row = |g: &&Group| {
            let (mean, spread) = (g.mean(), g.spread());
            let count = g.tips.len().to_string();
            vec![words(&g.name), g.kpa.to_string(), count, format!("{mean:.1}"), format!("{spread:.1}")]
        };
        text.push_str("\nTip, mean and standard deviation over the seeds\n");
        let head = ["group", "actuator kPa", "runs", "mean mm", "sd mm"];
        text.push_str(&table(&head, 1, several.iter().map(row).collect()));
    }
    let groups = groups.iter().map(
        |g| json!({"group": g.name, "actuator_kpa": g.kpa, "runs": g.tips.len(), "tip_mean_mm": g.mean(), "tip_sd_mm": g.spread()}),
    );
    Outcome::new(
        text,
        json!({"schema": "ibr.simulations", "version": 1, "runs": as_json(rows), "groups": groups.collect::<Vec<_>>()}),
    )
}

struct Group {
    name: String,
    kpa: f64,
    tips: Vec<f64>,
}

impl Group {
    fn mean(&self) -> f64 {
        self.tips.iter().sum::<f64>() / self.tips.len() as f64
    }

    /// Standard deviation of the sample; 0 for one.
    fn spread(&self) -> f64 {
        let (mean, n) = (self.mean(), self.tips.len() as f64);
        let sum: f64 = self.tips.iter().map(|t| (t - mean).powi(2)).sum();
        if n > 1.0 { (sum / (n - 1.0)).sqrt() } else { 0.0 }
    }
}

fn groups(rows: &[Row]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for row in rows {
        for [kpa, _, tip] in &row.heights {
            match groups.iter_mut().find(|g| g.name == row.variation.group && g.kpa == *kpa) {
                Some(group) => group.tips.push(*tip),
                None => groups.push(Group { name: row.variation.group.clone(), kpa: *kpa, tips: vec![*tip] }),
            }
        }
    }
    groups
}

/// Outermost marker over the actuator's element size, a line for every pressure; `None` unless there are several sizes.
fn meshes(name: &str, rows: &[Row]) -> Option<Vec<u8>> {
    let mut lines_of: BTreeMap<u64, BTreeMap<u64, Vec<f64>>> = BTreeMap::new();
    for row in rows {
        let size = row.variation.changes.iter().find(|(key, _)| key == "actuator_mesh_mm")?;
        let size: f64 = size.1.parse().ok()?;
        for [kpa, marker, _] in &row.heights {
            // Positive numbers are in the order of their bits.
            lines_of.entry(kpa.to_bits()).or_default().entry(size.to_bits()).or_default().push(*marker);
        }
    }
    let series = |(kpa, sizes): (&u64, &BTreeMap<u64, Vec<f64>>)| {
        let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
        let spread = |all: &[f64]| {
            let squares: f64 = all.iter().map(|m| (m - mean(all)).powi(2)).sum();
            (squares / (all.len() - 1).max(1) as f64).sqrt()
        };
        LineSeries {
            name: format!("{} kPa", f64::from_bits(*kpa)),
            points: sizes.iter().map(|(size, all)| [f64::from_bits(*size), mean(all)]).collect(),
            half_width: sizes.values().map(|all| spread(all)).collect(),
            style: LineStyle::LinePoints,
            colour: None,
        }
    };
    let several = lines_of.values().any(|sizes| sizes.len() > 1);
    let seeds = lines_of.values().flat_map(|sizes| sizes.values()).any(|markers| markers.len() > 1);
    let spread = if seeds { ", standard deviation over the seeds" } else { "" };
    let data = Lines {
        title: format!("{name}: outermost marker and the mesh{spread}"),
        x_label: "element size at the actuator [mm]".into(),
        y_label: "displacement of the outermost marker [mm]".into(),
        series: lines_of.iter().map(series).collect(),
    };
    several.then(|| lines(&data).ok().map(|drawn| drawn.png)).flatten()
}

fn csv(rows: &[Row]) -> String {
    let mut out = String::from("run,changes,p_act_kpa,marker_mm,tip_mm,cpu_s\n");
    for row in rows {
        let changes: Vec<String> =
            row.variation.changes.iter().map(|(k, v)| format!("{k}={v}").replace(',', ";")).collect();
        for [kpa, marker, tip] in &row.heights {
            let label = &row.variation.label;
            out.push_str(&format!("{label},{},{kpa},{marker},{tip},{}\n", changes.join(" "), row.cpu_s));
        }
    }
    out
}

fn as_json(rows: &[Row]) -> Vec<Value> {
    let row = |r: &Row| {
        let changes: serde_json::Map<String, Value> =
            r.variation.changes.iter().map(|(k, v)| (k.clone(), json!(v))).collect();
        let heights: Vec<Value> =
            r.heights.iter().map(|h| json!({"actuator_kpa": h[0], "marker_mm": h[1], "tip_mm": h[2]})).collect();
        json!({"run": r.variation.label, "changes": changes, "folder": r.folder, "heights": heights, "cpu_s": r.cpu_s})
    };
    rows.iter().map(row).collect()
}
