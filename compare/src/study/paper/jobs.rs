//! Runs of the paper's own model: those to be made, and those found below a folder.

use super::{Kinetic, PaperRun, Peak, mesh_name};
use crate::study::engines::{as_it_is, as_run, is_paper};
use crate::study::published::shipped_scenario;
use fem::FemError;
use fem::session::{FeRun, RunJob, RunSource, Summary, finished_below, mesh_keys, rounded};
use models::Scenario;
use std::path::Path;

/// Pressures between 10 and 20 kPa at which the paper looks at the cPAM \[kPa\].
const BUCKLING_KPA: [f64; 3] = [11.0, 12.0, 13.0];
/// Keys of `[fem]` that leave the paper's modelling choices as they are: loads, sizes, supports, seeds.
const FREE: [&str; 7] = ["pressures_kpa", "separate", "mesh_mm", "body_mesh_mm", "actuator_mesh_mm", "base", "seed"];
/// Folders in folders: `ibr simulate` puts several runs into one.
const DEPTH: usize = 3;

/// Every robot on every mesh \[mm\] at every pressure \[kPa\] (`None`: its own), and with an encastre base at its highest on
/// meshes of one size.
///
/// # Errors
/// [`FemError::Refused`] for a robot that is not a sound problem.
pub fn jobs(
    robots: &[(RunSource, Scenario)],
    meshes: &[[f64; 2]],
    pressures_kpa: Option<&[f64]>,
) -> Result<Vec<RunJob>, FemError> {
    let mut jobs = Vec::new();
    for robot in robots {
        let kpa = pressures_kpa.map_or_else(|| own_pressures(robot), |kpa| Ok(kpa.to_vec()))?;
        let top = kpa.iter().copied().fold(0.0, f64::max);
        for mesh in meshes {
            let pinned = kpa.iter().map(|p| (*p, "pinned"));
            for (p, base) in pinned.chain((mesh[0] == mesh[1]).then_some((top, "encastre"))) {
                jobs.push(job(robot, *mesh, p, base)?);
            }
        }
    }
    Ok(jobs)
}

/// The scenario's, and those at which the cPAM buckles.
fn own_pressures((source, scenario): &(RunSource, Scenario)) -> Result<Vec<f64>, FemError> {
    let mut kpa: Vec<f64> = source.robot_run()?.1.pressures_pa.iter().map(|pa| rounded(pa[0] * 1e-3)).collect();
    if scenario.actuator.kind.name == "cpam" {
        kpa.extend(BUCKLING_KPA);
    }
    Ok(kpa)
}

fn job(
    (source, scenario): &(RunSource, Scenario),
    mesh_mm: [f64; 2],
    kpa: f64,
    base: &str,
) -> Result<RunJob, FemError> {
    let mut changes =
        vec![("model".to_string(), "\"paper\"".to_string()), ("pressures_kpa".into(), format!("[{kpa}]"))];
    changes.extend(mesh_keys(&mesh_mm));
    changes.extend((base != "pinned").then(|| ("base".into(), format!("\"{base}\""))));
    let what = format!("{}, {}, {kpa} kPa, {base}", scenario.actuator.kind.name, mesh_name(mesh_mm));
    Ok(RunJob { source: source.with(&changes)?, what, folder: None })
}

/// All finished ones of the present engine, made by `ibr compare --paper` or by `ibr simulate`.
///
/// # Errors
/// [`FemError::Record`] for one that is damaged.
pub fn runs_below(folder: &Path) -> Result<Vec<PaperRun>, FemError> {
    Ok(finished_below(folder, DEPTH)?.iter().filter_map(paper_run).collect())
}

/// A run of a robot of the paper at one pressure with nothing of the preset changed; `None` if it is another.
fn paper_run(made: &FeRun) -> Option<PaperRun> {
    let Summary { robot, kinetic_share: shares, added_mass_share, .. } = &made.summary;
    let robot = robot.as_ref()?;
    let unchanged = robot.set.iter().all(|key| FREE.contains(&key.as_str()));
    (is_paper(&made.summary) && unchanged).then_some(())?;
    let run = as_run(made)?;
    as_it_is(&run, &shipped_scenario(&run.actuator).ok()?).then_some(())?;
    // The filled body and one pressure: a ramp through several is another loading.
    let [_, last] = &robot.readings[..] else { return None };
    Some(PaperRun {
        run,
        encastre: robot.base == "encastre",
        added_mass_share: rounded(*added_mass_share),
        kinetic: Kinetic {
            outputs: shares.outputs as u64,
            below_10_pct_of_internal: shares.below_10_pct_of_internal.kept_at as u64,
            below_1_pct_of_total: shares.below_1_pct_of_total.kept_at as u64,
            at_end: rounded(shares.end?),
        },
        peak: Peak {
            part: last.von_mises_part.clone(),
            at_mm: rounded(last.von_mises_at_m * 1e3),
            on_seam: last.von_mises_on_seam,
        },
    })
}
