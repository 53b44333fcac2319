//! Finished runs of robots, kept in a folder under the hash of problem and engine, so that asking twice costs nothing.

use super::folder;
use super::input::{Loaded, Named};
use super::paper_runs::is_paper;
use super::robot::{heights_mm, rounded};
use super::single::{self, Done, Finished, Manner};
use crate::commands::Context;
use crate::commands::together::{shared, together};
use crate::failure::Failure;
use compare::study::engines::{FeRun, FeState};
use fem::robot::Reading;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How missing runs are made.
#[derive(Debug, Clone)]
pub struct Keeper {
    /// Folder of all runs.
    pub folder: PathBuf,
    /// Threads of all runs together; 0: one per core.
    pub threads: usize,
}

impl Keeper {
    /// The runs of robots, each problem once: read if they are there, made or gone on with if not, several beside each other
    /// and those first that will take longest. A run that a guard stopped is its error. If the user interrupted them, the
    /// number of runs that are complete.
    pub fn run_all(
        &self,
        cases: &[(Named, String)],
        context: &mut Context,
    ) -> Result<Result<Vec<Made>, usize>, Failure> {
        let mut jobs: Vec<Job> = Vec::new();
        for (at, (named, _)) in cases.iter().enumerate() {
            let job = Job::of(at, &named.load()?);
            if jobs.iter().all(|other| other.fingerprint != job.fingerprint) {
                jobs.push(job);
            }
        }
        jobs.sort_by(|a, b| b.effort.total_cmp(&a.effort));
        let (workers, threads) = shared(self.threads, jobs.len());
        let found = together(jobs.len(), workers, context, &|k, inner: &mut Context| {
            let (named, what) = &cases[jobs[k].at];
            match self.run(named, &format!("{} of {}, {what}", jobs[k].at + 1, cases.len()), threads, inner) {
                Err(stopped @ Failure::Stopped { .. }) => Ok(Some(Err(stopped))),
                other => other.map(|run| run.map(Ok)),
            }
        })?;
        Ok(found.map(|runs| {
            let in_order: BTreeMap<usize, Made> = jobs.iter().map(|job| job.at).zip(runs).collect();
            in_order.into_values().collect()
        }))
    }

    fn run(&self, named: &Named, what: &str, threads: usize, context: &mut Context) -> Result<Option<FeRun>, Failure> {
        let loaded = named.load()?;
        let kind = loaded.robot.as_ref().map_or("case", |r| r.scenario.actuator.kind.name);
        let key = format!("{kind}-{:016x}-{}", loaded.case.problem.fingerprint(), fem::ENGINE);
        let folder = self.folder.join(key);
        if let Some(run) = finished(&folder)? {
            return Ok(Some(run));
        }
        let begun = folder::is_of(&folder, &named.text)?;
        let (resume, force) = (begun == Some(true), begun == Some(false));
        let every = Duration::from_secs(30);
        let manner = Manner { folder: folder.clone(), resume, force, frames: false, end_s: None, threads, every };
        let Context { json, progress, written, interrupt } = context;
        let mut tell = |text: &str, share: Option<f64>| progress(&format!("{what}: {text}"), share);
        let mut inner = Context { json: *json, progress: &mut tell, written, interrupt };
        match single::run(loaded, &manner, &mut inner)? {
            Done::Interrupted { .. } => Ok(None),
            Done::Now(run, _) | Done::Before(run) => match as_run(&run) {
                None => Err(Failure::usage(format!("{} is no robot", named.spec), "name the scenario of a robot")),
                run => Ok(run),
            },
        }
    }
}

/// A run, or why it was stopped.
pub type Made = Result<FeRun, Failure>;

/// A run to be made.
struct Job {
    /// Position in the list of cases.
    at: usize,
    fingerprint: u64,
    /// Grows with the time it will take.
    effort: f64,
}

/// What a step with contact costs, in steps without.
const CONTACT: f64 = 2.5;

impl Job {
    fn of(at: usize, loaded: &Loaded) -> Job {
        let problem = &loaded.case.problem;
        let contact = if problem.contact.is_some() { CONTACT } else { 1.0 };
        // Smaller elements need more steps as well.
        let effort = contact * problem.settings.end_s * (problem.mesh.elements() as f64).powf(1.5);
        Job { at, fingerprint: problem.fingerprint(), effort }
    }
}

/// The complete run in a folder, if it is one of the present engine.
pub fn complete(folder: &Path) -> Result<Option<Finished>, Failure> {
    #[derive(Deserialize)]
    struct Made {
        engine: u32,
    }
    let text = std::fs::read(folder.join("summary.json")).unwrap_or_default();
    // Runs of other engines may be records of another shape, and are nobody's fault.
    let of_another = serde_json::from_slice(&text).is_ok_and(|Made { engine }| engine != fem::ENGINE);
    if of_another || !folder::is_finished(folder) {
        return Ok(None);
    }
    Finished::read(folder).map(Some)
}

/// The complete run of a robot in a folder.
fn finished(folder: &Path) -> Result<Option<FeRun>, Failure> {
    Ok(complete(folder)?.as_ref().and_then(as_run))
}

/// All complete runs of robots in a folder, by name; those of the paper's own model are compared elsewhere.
pub fn all(folder: &Path) -> Result<Vec<FeRun>, Failure> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(Vec::new()) };
    let mut folders: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    folders.sort();
    let found: Vec<Finished> =
        folders.iter().filter_map(|folder| complete(folder).transpose()).collect::<Result<_, _>>()?;
    Ok(found.iter().filter(|run| !is_paper(&run.summary)).filter_map(as_run).collect())
}

/// A run as the comparison wants it; `None` if it is not one of a robot.
pub fn as_run(Finished { summary, cost }: &Finished) -> Option<FeRun> {
    let about = summary.robot.as_ref().filter(|robot| !robot.readings.is_empty())?;
    Some(FeRun {
        actuator: about.actuator.clone(),
        scenario: summary.name.clone(),
        mesh_mm: [about.setting("body_mesh_mm"), about.setting("actuator_mesh_mm")],
        elements: summary.elements as u64,
        steps: summary.steps,
        cpu_s: rounded(cost.cpu_s_of_all_sessions),
        engine: summary.engine.into(),
        body_kpa: rounded(about.body_pa * 1e-3),
        radius_mm: rounded(about.radius_m * 1e3),
        width_mm: rounded(about.width_m * 1e3),
        pouch_mm: rounded(about.pouch_m * 1e3),
        count: about.count,
        seed: about.setting("seed") as u64,
        stations_mm: about.readings[0].stations_m.iter().rev().skip(1).rev().map(|s| rounded(s * 1e3)).collect(),
        known: "assumed".into(),
        states: about.readings.iter().map(state).collect(),
    })
}

fn state(r: &Reading) -> FeState {
    let [marker_mm, tip_mm] = heights_mm(r);
    let stored = |name: &str| r.ledger.iter().filter(|l| l.0 == name).map(|l| l.2 * 1e3).sum::<f64>();
    let lost = r.ledger.iter().filter(|l| l.1 == "dissipated").map(|l| l.2 * 1e3).sum::<f64>();
    let short = |v: f64| format!("{v:.6e}").parse().unwrap_or(v);
    let plane = |d: &[f64; 3]| [short(d[0] * 1e3), short(d[1] * 1e3)];
    let bending = stored("bending") + stored("folds");
    let energies_mj = [stored("membrane"), bending, stored("contact"), stored("hourglass"), lost].map(short);
    FeState {
        actuator_kpa: short(r.actuator_pa * 1e-3),
        marker_mm: short(marker_mm),
        tip_mm: short(tip_mm),
        turn_rad: short(r.tip_angle_rad),
        body_cm3: short(r.body_m3 * 1e6),
        actuator_cm3: short(r.actuator_m3 * 1e6),
        energies_mj,
        kinetic_share: short(r.kinetic_share),
        von_mises_mpa: short(r.von_mises_pa * 1e-6),
        weld_n_per_m: short(r.seam_n_per_m),
        base_n: r.base_n.map(short),
        base_nm: r.base_nm.map(short),
        inflated_mm: r.inflated.map(|i| [i.arm_m, i.width_m, i.height_m].map(|m| short(m * 1e3))),
        // The last station is the tip.
        moved_mm: r.moved_m.iter().rev().skip(1).rev().map(plane).collect(),
        seen_mm: r.seen_moved_m.iter().map(plane).collect(),
    }
}
