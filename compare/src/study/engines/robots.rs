//! Robots with both engines: their published numbers, their finite element runs, and where the models differ.

use super::{EnginePair, EngineRun, Ensemble, as_it_is, ensemble, pairs};
use crate::error::CompareError;
use crate::study::published::{Rung, model_ladder, shipped_scenario};
use crate::study::uncertain::{self, Uncertain};
use data::{PublishedActuator, published};
use models::Scenario;

/// One robot with the predictions of both engines.
#[derive(Debug, Clone)]
pub struct EngineRobot {
    /// The robot as the reduced model has it.
    pub scenario: Scenario,
    /// Published numbers; `None` for a robot that is not one of the paper's.
    pub published: Option<PublishedActuator>,
    /// The reduced model with effects of which none is fitted.
    pub with_effects: Option<Rung>,
    /// Its finite element runs with the recommended settings.
    pub ensemble: Ensemble,
    /// Hypercubes over unmeasured numbers that come with the program, one for every way that the robot may be made.
    pub uncertain: Vec<Uncertain>,
    /// Both engines at this run's pressures.
    pub pairs: Vec<EnginePair>,
}

/// Where the models part, for one robot and one quantity.
#[derive(Debug, Clone)]
pub struct PartingMap {
    /// Actuator kind of the robot, such as `epam`.
    pub actuator: String,
    /// Head of the rows, with unit.
    pub row_label: String,
    /// Value of every row and its pairs.
    pub rows: Vec<(String, Vec<EnginePair>)>,
    /// Element size of the runs \[mm\].
    pub mesh_mm: f64,
}

/// Everything that the page of both engines shows.
#[derive(Debug, Clone)]
pub struct Engines {
    /// Robots with their runs and published numbers.
    pub robots: Vec<EngineRobot>,
    /// Maps of those that have runs for them.
    pub maps: Vec<PartingMap>,
}

/// Puts robots and runs together.
///
/// # Errors
/// A damaged embedded set or a model without equilibrium.
pub fn engines(scenarios: &[Scenario], runs: &[EngineRun]) -> Result<Engines, CompareError> {
    let (mut robots, mut maps) = (Vec::new(), Vec::new());
    for scenario in scenarios {
        robots.push(robot(scenario, runs)?);
        maps.extend(parting_maps(scenario, runs)?);
    }
    Ok(Engines { robots, maps })
}

fn robot(scenario: &Scenario, runs: &[EngineRun]) -> Result<EngineRobot, CompareError> {
    let kind = scenario.actuator.kind.name;
    let shipped = shipped_scenario(kind).ok().is_some_and(|s| s == *scenario);
    let (mut printed, mut with_effects) = (None, None);
    if shipped {
        printed = published()?.actuator(kind).cloned();
        with_effects = model_ladder(kind)?.pop();
    }
    let ensemble = ensemble(runs, scenario);
    let uncertain = if shipped { uncertain::stored()? } else { Vec::new() };
    Ok(EngineRobot {
        published: printed,
        with_effects,
        uncertain: uncertain.into_iter().filter(|u| u.scenario == scenario.name).collect(),
        pairs: ensemble.runs.first().map_or(Ok(Vec::new()), |run| pairs(scenario, run, runs))?,
        scenario: scenario.clone(),
        ensemble,
    })
}

/// Maps over body pressure and over pouch length, each from runs on the finest mesh that has two rows of it.
fn parting_maps(scenario: &Scenario, runs: &[EngineRun]) -> Result<Vec<PartingMap>, CompareError> {
    let (kind, all) = (scenario.actuator.kind.name, runs);
    let of_it = |r: &&EngineRun| r.scenario == scenario.name && r.actuator == kind && r.cut.is_empty();
    let mine: Vec<&EngineRun> = runs.iter().filter(of_it).collect();
    let own_pouch = |r: &&EngineRun| (r.pouch_mm * 1e-3 - scenario.actuator.shape.length_m).abs() < 1e-6;
    let own_body = |r: &&EngineRun| (r.body_kpa * 1e3 - scenario.p_body_pa).abs() < 1e-3;
    let body: Vec<&EngineRun> = mine.iter().copied().filter(own_pouch).collect();
    let pouch: Vec<&EngineRun> = mine.iter().copied().filter(own_body).collect();
    let mut maps = Vec::new();
    for (row_label, runs, value) in [
        ("rows: body pressure [kPa]", body, (|r: &EngineRun| r.body_kpa) as fn(&EngineRun) -> f64),
        ("rows: length of a pouch [mm]", pouch, |r: &EngineRun| r.pouch_mm),
    ] {
        let rows = one_per_value(runs, value);
        let Some(mesh_mm) = rows.first().map(|r| r.mesh_mm[1]) else { continue };
        let rows = rows.iter().map(|r| Ok((format!("{}", value(r)), pairs(&varied(scenario, r), r, all)?)));
        let rows = rows.collect::<Result<Vec<_>, CompareError>>()?;
        maps.push(PartingMap { actuator: kind.to_string(), row_label: row_label.into(), rows, mesh_mm });
    }
    Ok(maps)
}

/// One run per value, largest first, on the finest mesh that has two; of several runs that with the most states, then the
/// smallest seed.
fn one_per_value(mut runs: Vec<&EngineRun>, value: fn(&EngineRun) -> f64) -> Vec<&EngineRun> {
    runs.sort_by(|a, b| {
        let rank = |r: &EngineRun| (std::cmp::Reverse(r.states.len()), r.seed);
        a.mesh_mm[1].total_cmp(&b.mesh_mm[1]).then(value(b).total_cmp(&value(a))).then(rank(a).cmp(&rank(b)))
    });
    runs.dedup_by(|a, b| a.mesh_mm[1] == b.mesh_mm[1] && value(a) == value(b));
    let of_mesh = runs.chunk_by(|a, b| a.mesh_mm[1] == b.mesh_mm[1]).find(|rows| rows.len() > 1);
    of_mesh.map(<[&EngineRun]>::to_vec).unwrap_or_default()
}

/// The scenario at a run's body pressure and pouch length.
pub fn varied(scenario: &Scenario, run: &EngineRun) -> Scenario {
    let mut changed = scenario.clone();
    if !as_it_is(run, scenario) {
        changed.p_body_pa = run.body_kpa * 1e3;
        changed.actuator.shape.length_m = run.pouch_mm * 1e-3;
        changed.actuator.count = run.count;
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_takes_one_run_per_row_from_the_finest_mesh_with_two() {
        let run = |mesh: f64, body_kpa: f64, seed: u64| EngineRun {
            mesh_mm: [8.0, mesh],
            body_kpa,
            seed,
            ..EngineRun::default()
        };
        let runs = [run(6.0, 1.0, 1), run(6.0, 2.0, 1), run(3.0, 2.0, 2), run(3.0, 2.0, 1)];
        let rows = |more: &[EngineRun]| -> Vec<(f64, f64, u64)> {
            let picked = one_per_value(runs.iter().chain(more).collect(), |r| r.body_kpa);
            picked.iter().map(|r| (r.mesh_mm[1], r.body_kpa, r.seed)).collect()
        };
        assert_eq!(rows(&[]), [(6.0, 2.0, 1), (6.0, 1.0, 1)]);
        assert_eq!(rows(&[run(3.0, 4.0, 1)]), [(3.0, 4.0, 1), (3.0, 2.0, 1)]);
        assert!(one_per_value(runs[..1].iter().collect(), |r| r.body_kpa).is_empty());
    }
}
