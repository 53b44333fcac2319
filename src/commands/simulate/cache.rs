//! Finished runs of robots, kept in a folder under the hash of problem and engine, so that asking twice costs nothing.

use super::input::{Loaded, Named};
use super::robot;
use super::single::{self, Done, Manner};
use crate::commands::Context;
use crate::commands::together::{shared, together};
use crate::failure::Failure;
use compare::study::engines::{FeRun, FeState};
use fem::robot::Reading;
use serde_json::Value;
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
        if let Some(run) = finished(&folder) {
            return Ok(Some(run));
        }
        let case = folder.join("case.toml");
        let begun = std::fs::read_to_string(&case).is_ok_and(|text| text == named.text);
        let force = case.exists() && !begun;
        let every = Duration::from_secs(30);
        let manner =
            Manner { folder: folder.clone(), resume: begun, force, frames: false, end_s: None, threads, every };
        let Context { json, progress, written, interrupt } = context;
        let mut tell = |text: &str, share: Option<f64>| progress(&format!("{what}: {text}"), share);
        let mut inner = Context { json: *json, progress: &mut tell, written, interrupt };
        match single::run(loaded, &manner, &mut inner)? {
            Done::Interrupted { .. } => Ok(None),
            Done::Now { summary, cost, .. } | Done::Before { summary, cost } => Ok(as_run(&summary, &cost)),
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

/// A finished run of the present engine in a folder.
pub fn finished(folder: &Path) -> Option<FeRun> {
    let read =
        |name: &str| -> Option<Value> { serde_json::from_str(&std::fs::read_to_string(folder.join(name)).ok()?).ok() };
    let (summary, manifest) = (read("summary.json")?, read("manifest.json")?);
    (summary["engine"] == fem::ENGINE).then_some(())?;
    as_run(&summary, &manifest["cost"])
}

/// All finished runs in a folder, by name.
pub fn all(folder: &Path) -> Vec<FeRun> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut folders: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    folders.sort();
    folders.iter().filter_map(|folder| finished(folder)).collect()
}

/// A run as the comparison wants it; `None` if it is not one of a robot.
pub fn as_run(summary: &Value, cost: &Value) -> Option<FeRun> {
    let readings = robot::readings(summary);
    let about = &summary["robot"];
    let setting = |key: &str| about["settings"][key].as_f64();
    // Runs of before kept no points of the wall.
    let seen = |r: &Reading| r.seen_moved_m.len() + 1 == r.stations_m.len();
    (!readings.is_empty() && readings.iter().all(seen)).then_some(())?;
    // The numbers that `RobotSettings::usual` leaves as one would assume them before seeing a robot bend.
    let fitted = |kind: &str, key: &str, usual: f64| about["actuator"] == kind && setting(key) != Some(usual);
    let sheet = fitted("spam", "tape_margin_mm", 0.0) || fitted("spam", "tape_mm", 0.05);
    let calibrated = sheet || fitted("fpam", "nu12", 0.0);
    Some(FeRun {
        actuator: about["actuator"].as_str()?.into(),
        scenario: summary["name"].as_str()?.into(),
        mesh_mm: [setting("body_mesh_mm")?, setting("actuator_mesh_mm")?],
        elements: summary["elements"].as_u64()?,
        steps: summary["steps"].as_u64()?,
        cpu_s: robot::rounded(cost["cpu_s_of_all_sessions"].as_f64().unwrap_or(0.0)),
        engine: summary["engine"].as_u64()?,
        body_kpa: robot::rounded(about["body_pa"].as_f64()? * 1e-3),
        radius_mm: robot::rounded(about["radius_m"].as_f64().unwrap_or(0.0) * 1e3),
        width_mm: robot::rounded(about["width_m"].as_f64().unwrap_or(0.0) * 1e3),
        pouch_mm: robot::rounded(about["pouch_m"].as_f64()? * 1e3),
        count: about["count"].as_u64()? as usize,
        seed: setting("seed")? as u64,
        stations_mm: readings[0].stations_m.iter().rev().skip(1).rev().map(|s| robot::rounded(s * 1e3)).collect(),
        known: if calibrated { "calibrated" } else { "assumed" }.into(),
        states: readings.iter().map(state).collect(),
    })
}

fn state(r: &Reading) -> FeState {
    let [marker_mm, tip_mm] = robot::heights_mm(r);
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
        // The last station is the tip.
        moved_mm: r.moved_m.iter().rev().skip(1).rev().map(plane).collect(),
        seen_mm: r.seen_moved_m.iter().map(plane).collect(),
    }
}
