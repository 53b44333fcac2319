//! Runs that the paper made, to be made here.

use super::mesh_name;
use fem::FemError;
use fem::session::{Job, Source, mesh_keys, rounded};
use models::Scenario;

/// Pressures between 10 and 20 kPa at which the paper looks at the cPAM \[kPa\].
const BUCKLING_KPA: [f64; 3] = [11.0, 12.0, 13.0];

/// Every robot on every mesh \[mm\] at every pressure \[kPa\] (`None`: its own), and with an encastre base at its highest on
/// meshes of one size.
///
/// # Errors
/// [`FemError::Refused`] for a robot that is no sound problem.
pub fn jobs(
    robots: &[(Source, Scenario)],
    meshes: &[[f64; 2]],
    pressures_kpa: Option<&[f64]>,
) -> Result<Vec<Job>, FemError> {
    let mut jobs = Vec::new();
    for robot in robots {
        let kpa = pressures_kpa.map_or_else(|| own_pressures(robot), |kpa| Ok(kpa.to_vec()))?;
        let top = kpa.iter().copied().fold(0.0, f64::max);
        for mesh in meshes {
            for p in &kpa {
                jobs.push(job(robot, *mesh, *p, "pinned")?);
            }
            if mesh[0] == mesh[1] {
                jobs.push(job(robot, *mesh, top, "encastre")?);
            }
        }
    }
    Ok(jobs)
}

/// The scenario's, and those at which the cPAM buckles.
fn own_pressures((source, scenario): &(Source, Scenario)) -> Result<Vec<f64>, FemError> {
    let mut kpa: Vec<f64> = source.robot_run()?.1.pressures_pa.iter().map(|pa| rounded(pa[0] * 1e-3)).collect();
    if scenario.actuator.kind.name == "cpam" {
        kpa.extend(BUCKLING_KPA);
    }
    Ok(kpa)
}

fn job((source, scenario): &(Source, Scenario), mesh_mm: [f64; 2], kpa: f64, base: &str) -> Result<Job, FemError> {
    let mut changes =
        vec![("model".to_string(), "\"paper\"".to_string()), ("pressures_kpa".into(), format!("[{kpa}]"))];
    changes.extend(mesh_keys(&mesh_mm));
    if base != "pinned" {
        changes.push(("base".into(), format!("\"{base}\"")));
    }
    let what = format!("{}, {}, {kpa} kPa, {base}", scenario.actuator.kind.name, mesh_name(mesh_mm));
    Ok(Job { source: source.with(&changes)?, what, folder: None })
}
