//! A finite element run as a comparison wants it, and the runs of a folder or of the program.

use super::{EngineRun, EngineState, ReducedTerm, ensemble, stored};
use fem::FemError;
use fem::robot::{Preset, Reading};
use fem::session::{
    FeRun, Many, Progress, RunJob, RunSettings, RunSource, Summary, finished_below, heights_mm, rounded, simulate_all,
};
use models::Scenario;
use std::path::Path;

/// A run as the comparison wants it; `None` if it is not one of a robot.
pub fn as_run(run: &FeRun) -> Option<EngineRun> {
    let summary = &run.summary;
    let about = summary.robot.as_ref().filter(|robot| !robot.readings.is_empty())?;
    let highest = about.readings.iter().map(|r| r.actuator_pa).fold(0.0, f64::max);
    let top = about.readings.iter().position(|r| r.actuator_pa >= highest)?;
    let (up, down) = about.readings.split_at(top + 1);
    Some(EngineRun {
        actuator: about.actuator.clone(),
        scenario: summary.name.clone(),
        mesh_mm: [about.setting("body_mesh_mm"), about.setting("actuator_mesh_mm")],
        elements: summary.elements as u64,
        steps: summary.steps,
        cpu_s: rounded(run.cost.cpu_s_of_all_sessions),
        engine: summary.engine.into(),
        body_kpa: rounded(about.body_pa * 1e-3),
        radius_mm: rounded(about.radius_m * 1e3),
        width_mm: rounded(about.width_m * 1e3),
        pouch_mm: rounded(about.pouch_m * 1e3),
        count: about.count,
        seed: about.setting("seed") as u64,
        stations_mm: about.readings[0].stations_m.iter().rev().skip(1).rev().map(|s| rounded(s * 1e3)).collect(),
        known: "assumed".into(),
        cut: ReducedTerm::of(about).map_or(String::new(), |cut| cut.term.into()),
        states: up.iter().map(state).collect(),
        down: down.iter().map(state).collect(),
    })
}

fn state(r: &Reading) -> EngineState {
    let [marker_mm, tip_mm] = heights_mm(r);
    let stored = |name: &str| r.ledger.iter().filter(|l| l.0 == name).map(|l| l.2 * 1e3).sum::<f64>();
    let lost = r.ledger.iter().filter(|l| l.1 == "dissipated").map(|l| l.2 * 1e3).sum::<f64>();
    let short = |v: f64| format!("{v:.6e}").parse().unwrap_or(v);
    let plane = |d: &[f64; 3]| [short(d[0] * 1e3), short(d[1] * 1e3)];
    let bending = stored("bending") + stored("folds");
    let [membrane, compressed] = ["membrane", "compressed sheets"].map(stored);
    let energies_mj = [membrane, compressed, bending, stored("contact"), stored("hourglass"), lost].map(short);
    EngineState {
        actuator_kpa: short(r.actuator_pa * 1e-3),
        marker_mm: short(marker_mm),
        tip_mm: short(tip_mm),
        turn_rad: short(r.tip_angle_rad),
        body_cm3: short(r.body_m3 * 1e6),
        actuator_cm3: short(r.actuator_m3 * 1e6),
        energies_mj,
        kinetic_share: short(r.kinetic_share),
        is_at_rest: Some(r.is_at_rest),
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

/// Whether a run is one of the paper's model, whatever else was set.
pub(in crate::study) fn is_paper(summary: &Summary) -> bool {
    summary.robot.as_ref().is_some_and(|robot| robot.model == Preset::Paper.name())
}

pub(in crate::study) fn and_back(up: &[f64]) -> Vec<f64> {
    up.iter().chain(up.iter().rev().skip(1)).copied().collect()
}

/// Every robot with every seed, up through its own pressures or these \[kPa\] and down again.
///
/// # Errors
/// [`FemError::Setting`] for a scenario whose `[fem]` cannot be changed.
pub fn seed_jobs(
    robots: &[(RunSource, Scenario)],
    seeds: u64,
    pressures_kpa: Option<&[f64]>,
) -> Result<Vec<RunJob>, FemError> {
    let mut jobs = Vec::new();
    for (source, scenario) in robots {
        let own: Vec<f64> = source.robot_run()?.1.pressures_pa.iter().map(|p| rounded(p[0] * 1e-3)).collect();
        let is_planar = !scenario.is_spatial();
        for seed in 1..=seeds {
            let mut changes = vec![("seed".to_string(), seed.to_string())];
            let kpa = pressures_kpa.map(<[f64]>::to_vec).or(is_planar.then(|| own.clone()));
            changes.extend(kpa.map(|kpa| ("pressures_kpa".to_string(), format!("{:?}", and_back(&kpa)))));
            let what = format!("{}, seed {seed}", scenario.name);
            jobs.push(RunJob { source: source.with(&changes)?, what, folder: None });
        }
    }
    Ok(jobs)
}

/// Runs of robots, each problem once: read if they are there, else made or resumed. A run that a guard stopped is its
/// error. Errors as for [`simulate_all`].
pub fn runs_of(
    jobs: &[RunJob],
    settings: &RunSettings,
    progress: Progress,
) -> Result<Vec<Result<EngineRun, FemError>>, FemError> {
    let Many { runs, .. } = simulate_all(jobs, settings, progress)?;
    Ok(runs.into_iter().filter_map(|run| run.map(|run| as_run(&run)).transpose()).collect())
}

/// All complete runs of robots in a folder, by name; runs of the paper's own model are compared elsewhere.
///
/// # Errors
/// [`FemError::Record`] for one that is damaged.
pub fn all_runs(folder: &Path) -> Result<Vec<EngineRun>, FemError> {
    let found = finished_below(folder, 1)?;
    Ok(found.iter().filter(|run| !is_paper(&run.summary)).filter_map(as_run).collect())
}

/// Runs that come with the program, or the runs of a folder if one is named.
///
/// # Errors
/// [`FemError::Setting`] for a folder without any; else as [`all_runs`].
pub fn known_runs(folder: Option<&Path>) -> Result<Vec<EngineRun>, FemError> {
    let Some(folder) = folder else { return stored() };
    let found = all_runs(folder)?;
    if found.is_empty() {
        let shown = folder.display();
        let message = format!("{shown}: no finished finite element run of a robot");
        let help = format!("make them with: ibr compare --engines SCENARIO --runs {shown}");
        return Err(FemError::Setting { message, help });
    }
    Ok(found)
}

/// Runs of a robot as it is that come with the program, one for every seed.
///
/// # Errors
/// [`FemError::Setting`] if there are fewer than `count`.
pub fn of_the_program(scenario: &Scenario, count: usize) -> Result<Vec<EngineRun>, FemError> {
    let mut found = ensemble(&stored()?, scenario).runs;
    found.truncate(count);
    if found.len() == count {
        return Ok(found);
    }
    let (there, kind, body_kpa) = (found.len(), scenario.actuator.kind.name, scenario.p_body_pa * 1e-3);
    let message = format!(
        "{there} finite element runs of {kind} at {body_kpa} kPa body pressure come with the program, not {count}"
    );
    Err(FemError::Setting { message, help: "lower --seeds, or leave --stored out to make them: minutes each".into() })
}
