//! Over which pressures and pouches the reduced model parts from the finite elements.

use super::lines::exact;
use super::{CUTS, Carrier, Energies, EngineRun, SHAPE, and_back, pairs, varied};
use crate::error::CompareError;
use crate::study::columns::TextColumn;
use fem::FemError;
use fem::session::{RunJob, RunSource, mesh_keys, rounded};
use models::Scenario;
use serde::Serialize;

/// Runs to make for every robot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ranges {
    /// Body pressures in addition to its own \[kPa\].
    pub body_kpa: Vec<f64>,
    /// Lengths of a pouch in addition to its own, at its own body pressure \[mm\].
    pub pouch_mm: Vec<f64>,
    /// Actuator pressures, of which those from the body's up are run \[kPa\].
    pub actuator_kpa: Vec<f64>,
    /// Element sizes of body and actuator, if not its own \[mm\].
    pub mesh_mm: Option<[f64; 2]>,
    /// Whether every robot is run with a tenth of each term of [`CUTS`] too.
    pub carriers: bool,
}

/// Every robot at every body pressure, and with every pouch length at its own, up through the pressures and down again; with a term
/// cut, up only.
///
/// # Errors
/// [`FemError::Setting`] for pouches longer than the actuator.
pub fn jobs(robots: &[(RunSource, Scenario)], ranges: &Ranges) -> Result<Vec<RunJob>, FemError> {
    let mut jobs = Vec::new();
    for (source, scenario) in robots {
        for (body_kpa, pouch_mm) in places(scenario, ranges) {
            let above: Vec<f64> = ranges.actuator_kpa.iter().copied().filter(|p| *p >= body_kpa).collect();
            let source = source.varied(body_kpa, pouch_mm)?;
            let mut add = |what: String, kpa: &[f64], more: Option<(&str, f64)>| {
                let mut changes = vec![("pressures_kpa".to_string(), format!("{kpa:?}"))];
                changes.extend(ranges.mesh_mm.iter().flat_map(mesh_keys));
                changes.extend(more.map(|(key, value)| (key.to_string(), value.to_string())));
                source.with(&changes).map(|source| jobs.push(RunJob { source, what, folder: None }))
            };
            add(scenario.name.clone(), &and_back(&above), None)?;
            for cut in CUTS.iter().filter(|_| ranges.carriers) {
                add(format!("{}, a tenth of {}", scenario.name, cut.term), &above, Some(cut.key))?;
            }
        }
    }
    Ok(jobs)
}

fn places(scenario: &Scenario, ranges: &Ranges) -> Vec<(f64, Option<f64>)> {
    let own = rounded(scenario.p_body_pa * 1e-3);
    let bodies = ranges.body_kpa.iter().copied().filter(|p| *p != own);
    let mut wanted: Vec<(f64, Option<f64>)> = std::iter::once(own).chain(bodies).map(|p| (p, None)).collect();
    // An actuator of one piece has no pouches to divide.
    if scenario.actuator.kind.has_pouches() {
        let other = |mm: &&f64| (**mm * 1e-3 - scenario.actuator.shape.length_m).abs() > 1e-9;
        wanted.extend(ranges.pouch_mm.iter().filter(other).map(|mm| (own, Some(*mm))));
    }
    wanted
}

/// Both engines in one run at one pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parting {
    /// Actuator kind of the robot, such as `epam`.
    pub robot: String,
    /// Element size at the actuator \[mm\].
    pub mesh_mm: f64,
    /// Body gauge pressure \[kPa\].
    pub body_kpa: f64,
    /// Length of one unit of the actuator \[mm\].
    pub pouch_mm: f64,
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Tip of the scenario as it is \[mm\].
    pub reduced_tip_mm: f64,
    /// Tip of the finite elements \[mm\].
    pub fe_tip_mm: f64,
    /// Reduced minus finite elements over the latter.
    pub difference: Option<f64>,
    /// The term that carries it, and the difference without it.
    pub carried_by: Option<Carrier>,
    /// Energies of the finite elements minus the reduced model's at this bend \[mJ\].
    pub excess_mj: Option<Energies>,
    /// Tip of the scenario without its effects \[mm\].
    pub bare_tip_mm: f64,
    /// Relative difference of that tip from the finite elements'.
    pub bare_difference: Option<f64>,
    /// Sizes of the inflated robot in both engines, where the run has them.
    pub shape: Option<PartingShape>,
}

/// Inflated pouches and body in both engines, in [`SHAPE`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartingShape {
    names: [&'static str; 5],
    /// Sizes in the reduced model, in the order of [`SHAPE`].
    pub reduced: [f64; 5],
    /// Sizes in the finite elements, in the order of [`SHAPE`].
    pub fe: [f64; 5],
}

/// Every run of one of these robots at every pressure.
pub fn partings(scenarios: &[Scenario], runs: &[EngineRun]) -> Result<Vec<Parting>, CompareError> {
    let mut rows = Vec::new();
    for run in runs.iter().filter(|run| run.cut.is_empty()) {
        let Some(scenario) = scenarios.iter().find(|s| s.name == run.scenario) else { continue };
        let scenario = varied(scenario, run);
        let bare = pairs(&scenario.bare(), run, runs)?;
        rows.extend(pairs(&scenario, run, runs)?.into_iter().zip(bare).map(|(own, bare)| Parting {
            robot: run.actuator.clone(),
            mesh_mm: run.mesh_mm[1],
            body_kpa: run.body_kpa,
            pouch_mm: run.pouch_mm,
            actuator_kpa: own.actuator_kpa,
            reduced_tip_mm: own.reduced_mm[1],
            fe_tip_mm: own.fe_mm[1],
            difference: own.difference(),
            carried_by: own.carrier,
            excess_mj: own.excess_mj,
            bare_tip_mm: bare.reduced_mm[1],
            bare_difference: bare.difference(),
            shape: own.shape.map(|[reduced, fe]| PartingShape { names: SHAPE, reduced, fe }),
        }));
    }
    Ok(rows)
}

/// Columns of `breakdown.csv` with their values as text.
pub const PARTINGS_CSV: [TextColumn<Parting>; 10] = [
    ("robot", |row| row.robot.clone()),
    ("mesh_mm", |row| row.mesh_mm.to_string()),
    ("p_body_kpa", |row| row.body_kpa.to_string()),
    ("pouch_mm", |row| row.pouch_mm.to_string()),
    ("p_act_kpa", |row| row.actuator_kpa.to_string()),
    ("reduced_tip_mm", |row| row.reduced_tip_mm.to_string()),
    ("fe_tip_mm", |row| row.fe_tip_mm.to_string()),
    ("difference_pct", |row| exact(row.difference.map(|d| 100.0 * d))),
    ("carried_by", |row| row.carried_by.map_or(String::new(), |c| c.term.into())),
    ("bare_tip_mm", |row| row.bare_tip_mm.to_string()),
];
