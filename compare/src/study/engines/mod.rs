//! Both engines on one robot: what the reduced model and a finite element run say at the same pressures, where their energy
//! is, and which term carries a difference.
//!
//! At the bend θ that the finite elements reach, energies of the same kind stand side by side:
//!
//! ```text
//! excess of a term = E_fe(θ) − E_reduced(θ)        gas: −P ΔV, counted from the filled body
//! ```
//!
//! Energies at one bend do not decide the equilibrium, their slopes do. Which term carries a difference of the tips is
//! therefore tried: [`carrier`] cuts the term in both engines and looks whether the difference goes.

pub mod breakdown;
mod carrier;
mod lines;
mod of_run;
mod robots;

use crate::characterize::Scatter;
use crate::error::CompareError;
use crate::policy;
pub use carrier::{CUTS, Carrier, ReducedTerm, carrier};
use fem::FemError;
use fem::record::RecordShape;
pub use lines::*;
use models::{Account, Loads, Model, Scenario, Target};
pub use of_run::{all_runs, as_run, known_runs, of_the_program, runs_of, seed_jobs};
pub(in crate::study) use of_run::{and_back, is_paper};
pub use robots::{EngineRobot, Engines, PartingMap, engines, varied};
use serde::{Deserialize, Serialize};

/// Terms of the ledger that both engines have, in this order.
pub const TERMS: [&str; 7] =
    ["pouch gas", "body folds", "wall bending", "stretch", "compressed sheets", "contact", "hourglass"];
/// Energies of all terms in the order of [`TERMS`] \[mJ\].
pub type Energies = [f64; TERMS.len()];
/// Highest pressure at which a model is asked for a bend \[Pa\].
const HIGHEST_PA: f64 = 500e3;

/// A finished finite element run of a robot.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct EngineRun {
    /// Actuator kind of the robot, such as `epam`.
    pub actuator: String,
    /// Name of the scenario that was run.
    pub scenario: String,
    /// Element sizes of body and actuator \[mm\].
    pub mesh_mm: [f64; 2],
    /// Number of elements of the mesh.
    pub elements: u64,
    /// Number of time steps of the run.
    pub steps: u64,
    /// Processor time of the whole run \[s\].
    pub cpu_s: f64,
    /// Number of the engine that made it.
    pub engine: u64,
    /// Body gauge pressure \[kPa\].
    pub body_kpa: f64,
    /// Radius of the body \[mm\].
    pub radius_mm: f64,
    /// Width of one unit of the actuator \[mm\].
    pub width_mm: f64,
    /// Length of one unit of the actuator \[mm\].
    pub pouch_mm: f64,
    /// Number of actuator units in series.
    pub count: usize,
    /// Seed of the imperfections in the mesh.
    pub seed: u64,
    /// Marker stations along the robot \[mm\].
    pub stations_mm: Vec<f64>,
    /// `calibrated` if a number of the run was fitted to the tip it is compared with, else `assumed`.
    pub known: String,
    /// Term of [`CUTS`] of which the robot has a tenth; empty for a robot as it is.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub cut: String,
    /// States, the filled body without actuator pressure first.
    pub states: Vec<EngineState>,
    /// States on the way back from the highest pressure, if the run came down again.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub down: Vec<EngineState>,
}

/// One state of a finite element run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct EngineState {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Height of the outermost marker \[mm\].
    pub marker_mm: f64,
    /// Height of the tip in the plane of bending \[mm\].
    pub tip_mm: f64,
    /// Turn of the tip from the straight robot \[rad\].
    pub turn_rad: f64,
    /// Volume of gas in the body \[cm³\].
    pub body_cm3: f64,
    /// Volume of gas in all pouches or muscles \[cm³\].
    pub actuator_cm3: f64,
    /// Stored in membrane, compressed sheets, bending, contact and hourglass control, and lost so far \[mJ\].
    pub energies_mj: [f64; 6],
    /// Kinetic over kinetic and stored energy.
    pub kinetic_share: f64,
    /// Whether the tip was at rest; `None` in runs that did not keep it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub is_at_rest: Option<bool>,
    /// Largest von Mises stress of all elements \[MPa\].
    pub von_mises_mpa: f64,
    /// Largest pull on a weld \[N/m\].
    pub weld_n_per_m: f64,
    /// Force of the support at the base on the robot \[N\]; 0 in runs that did not keep it.
    #[serde(default)]
    pub base_n: [f64; 3],
    /// Its moment about the middle of the nodes that are held \[N·m\].
    #[serde(default)]
    pub base_nm: [f64; 3],
    /// Arm, width and height of the pouches between others \[mm\]; `None` for one unit, and in runs that did not keep it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inflated_mm: Option<[f64; 3]>,
    /// Displacements of the sections at the markers in the plane of bending, x along the straight robot, y to the actuator \[mm\].
    pub moved_mm: Vec<[f64; 2]>,
    /// Displacements of the wall where the markers stick, at the height of the axis, on the side that faces a camera \[mm\].
    pub seen_mm: Vec<[f64; 2]>,
}

/// Reduced model and finite elements at one actuator pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnginePair {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Outermost marker and tip of the reduced model \[mm\].
    pub reduced_mm: [f64; 2],
    /// Outermost marker and tip of the finite elements \[mm\].
    pub fe_mm: [f64; 2],
    /// Ledger of the reduced model in [`TERMS`] \[mJ\], at its own bend.
    pub reduced_mj: Energies,
    /// Ledger of the finite elements \[mJ\].
    pub fe_mj: Energies,
    /// The same minus the reduced model's at this bend \[mJ\]; `None` if it cannot bend so.
    pub excess_mj: Option<Energies>,
    /// What the finite elements have lost since the body was full \[mJ\].
    pub lost_mj: f64,
    /// Reduced model and finite elements in [`SHAPE`]; `None` without pouches, and for runs that did not keep it.
    pub shape: Option<[[f64; 5]; 2]>,
    /// What carries the difference; `None` where the models meet, and where no term was cut or none carries it.
    pub carrier: Option<Carrier>,
}

/// Quantities of [`EnginePair::shape`]; lengths in mm, volumes in cm³.
pub const SHAPE: [&str; 5] = ["arm", "width", "height", "actuator", "body"];

impl EnginePair {
    /// Reduced minus finite element tip over the latter; `None` where the tip hardly moves.
    pub fn difference(&self) -> Option<f64> {
        let fe = self.fe_mm[1];
        policy::has_moved(1e-3 * fe, 0.0).then(|| (self.reduced_mm[1] - fe) / fe)
    }

    /// Whether the models part: by more than a tenth.
    pub fn parts(&self) -> bool {
        self.difference().is_some_and(|off| !policy::meets(off))
    }
}

/// Both engines at every pressure of a run; runs of the same robot with a term cut say what carries a difference.
pub fn pairs(scenario: &Scenario, run: &EngineRun, all: &[EngineRun]) -> Result<Vec<EnginePair>, CompareError> {
    let Some((filled, states)) = run.states.split_first() else { return Ok(Vec::new()) };
    let mut pairs = states.iter().map(|state| pair(scenario, run, filled, state)).collect::<Result<Vec<_>, _>>()?;
    for pair in &mut pairs {
        pair.carrier = carrier(scenario, run, pair, all)?;
    }
    Ok(pairs)
}

fn pair(
    scenario: &Scenario,
    run: &EngineRun,
    filled: &EngineState,
    state: &EngineState,
) -> Result<EnginePair, CompareError> {
    let model = Model::new(scenario);
    let mut at = model.prediction();
    let loads = Loads::uniform(run.body_kpa * 1e3, state.actuator_kpa * 1e3);
    model.predict(&loads, &mut at)?;
    let marker = at.markers.last().map_or(at.tip.y_m, |xy| xy[1]);
    let reduced_mm = [marker * 1e3, at.tip.y_m * 1e3];
    let reduced_mj = reduced_ledger(&model, &loads, &at, 1.0);
    let shape = model.pouch_shape(&loads, &at).zip(state.inflated_mm).map(|(own, [arm, width, height])| {
        let reduced =
            [own.arm_m * 1e3, own.width_m * 1e3, own.height_m * 1e3, own.actuator_m3 * 1e6, own.body_m3 * 1e6];
        [reduced, [arm, width, height, state.actuator_cm3 - filled.actuator_cm3, state.body_cm3]]
    });
    let fe_mj = fe_ledger(run, filled, state);
    let at_this_bend = reduced_at(&model, run, state, state.actuator_kpa, &mut at);
    let excess_mj = at_this_bend.map(|reduced| std::array::from_fn(|k| fe_mj[k] - reduced[k]));
    let lost_mj = state.energies_mj[5] - filled.energies_mj[5];
    let fe_mm = [state.marker_mm, state.tip_mm];
    let (actuator_kpa, carrier) = (state.actuator_kpa, None);
    Ok(EnginePair { actuator_kpa, reduced_mm, fe_mm, reduced_mj, fe_mj, excess_mj, lost_mj, shape, carrier })
}

/// Ledger of the reduced model at the bend of a state, its gas at a pressure in the volume that this bend takes \[mJ\];
/// `None` if it cannot bend so.
fn reduced_at(
    model: &Model,
    run: &EngineRun,
    state: &EngineState,
    gas_kpa: f64,
    at: &mut models::Prediction,
) -> Option<Energies> {
    let body_pa = run.body_kpa * 1e3;
    let pa = model.pressure_for(Target::Angle(state.turn_rad), body_pa, at).ok().filter(|pa| *pa > 0.0)?;
    Some(reduced_ledger(model, &Loads::uniform(body_pa, pa), at, gas_kpa * 1e3 / pa))
}

/// Ledgers of finite elements and of the reduced model at the same bends, from the first pressure that bends the robot by a tenth
/// of the turn at the given one to that one \[mJ\]: what filling a slack actuator takes is in neither. `None` if
/// the run lacks the two states or the model cannot bend so.
pub fn between(scenario: &Scenario, run: &EngineRun, actuator_kpa: f64) -> Option<[Energies; 2]> {
    let model = Model::new(&Scenario { p_max_pa: HIGHEST_PA, ..scenario.clone() });
    let mut at = model.prediction();
    let high = state_at(&run.states, actuator_kpa)?;
    let bent = |s: &&EngineState| s.actuator_kpa > 0.0 && policy::is_bent(s.turn_rad, high.turn_rad);
    let low = run.states.iter().find(bent).filter(|s| s.actuator_kpa < high.actuator_kpa)?;
    let from = reduced_at(&model, run, low, actuator_kpa, &mut at)?;
    let to = reduced_at(&model, run, high, actuator_kpa, &mut at)?;
    Some([fe_ledger(run, low, high), std::array::from_fn(|k| to[k] - from[k])])
}

fn reduced_ledger(model: &Model, loads: &Loads, at: &models::Prediction, gas: f64) -> Energies {
    let mut out = [0.0; TERMS.len()];
    for line in model.ledger(loads, at) {
        let term = match line.account {
            Account::ActuatorGas => 0,
            Account::BodyGas => 1,
            // The runs have no loads other than their gas.
            Account::Wall | Account::Load => 2,
            Account::Stretch => 3,
            Account::Compression => 4,
            Account::Contact => 5,
            Account::Numerical => 6,
        };
        let factor = if term == 0 { gas } else { 1.0 };
        out[term] += factor * line.energy_j * 1e3;
    }
    out
}

/// Gas −P ΔV in mJ (kPa·cm³ is mJ), the rest as stored since the body was full.
fn fe_ledger(run: &EngineRun, filled: &EngineState, state: &EngineState) -> Energies {
    let since = |k: usize| state.energies_mj[k] - filled.energies_mj[k];
    [
        -state.actuator_kpa * (state.actuator_cm3 - filled.actuator_cm3),
        -run.body_kpa * (state.body_cm3 - filled.body_cm3),
        since(2),
        since(0),
        since(1),
        since(3),
        since(4),
    ]
}

const RUNS: RecordShape = RecordShape { schema: "ibr.fem_runs", version: 2 };

#[derive(Deserialize)]
pub(in crate::study) struct Listed<R> {
    pub runs: Vec<R>,
}

/// Finite element runs that come with the program, made by its own commands (`ibr breakdown`, `ibr simulate`).
///
/// # Errors
/// The errors of [`read_runs`], for a program whose runs were not made again with its records.
pub fn stored() -> Result<Vec<EngineRun>, FemError> {
    read_runs("the runs that come with the program", include_str!("../../../assets/fem-runs.json"))
}

/// Reads runs as [`runs_json`] writes them.
///
/// # Errors
/// [`FemError::Record`] with the line and the field.
pub fn read_runs(file: &str, text: &str) -> Result<Vec<EngineRun>, FemError> {
    let help = "make the file again: `ibr compare --engines --runs FOLDER` writes runs.json next to its report";
    Ok(RUNS.read::<Listed<EngineRun>>(file, text, help)?.runs)
}

/// Runs as they are stored: one a line.
pub fn runs_json(runs: &[EngineRun]) -> String {
    RUNS.listed("runs", runs)
}

/// Runs of one robot as it is that differ in their seed only.
#[derive(Debug, Clone, Default)]
pub struct Ensemble {
    /// Runs in the order of their seeds.
    pub runs: Vec<EngineRun>,
}

impl Ensemble {
    /// Mean and standard deviation of the outermost marker and of the tip at a pressure \[mm\]; the deviation is `None` for
    /// a single run, everything where no run was read there.
    pub fn at(&self, actuator_kpa: f64) -> Option<[MeanOverSeeds; 2]> {
        let of = |number: fn(&EngineState) -> f64| self.over(|run| Some(number(state_at(&run.states, actuator_kpa)?)));
        Some([of(|s| s.marker_mm)?, of(|s| s.tip_mm)?])
    }

    /// Mean and standard deviation of the tip on the way back at a pressure \[mm\]; `None` where no run came back to it.
    pub fn back_at(&self, actuator_kpa: f64) -> Option<MeanOverSeeds> {
        self.over(|run| Some(state_at(&run.down, actuator_kpa)?.tip_mm))
    }

    /// Mean and standard deviation of the height of the marker, on the wall, at a station \[mm\]; `None` where no run has it at that pressure.
    pub fn marker_at(&self, station_m: f64, actuator_kpa: f64) -> Option<MeanOverSeeds> {
        self.over(|run| {
            let k = run.stations_mm.iter().position(|s| policy::is_same_station(*s, station_m * 1e3))?;
            Some(state_at(&run.states, actuator_kpa)?.seen_mm.get(k)?[1])
        })
    }

    /// Over the runs that have a number; `None` if none has.
    fn over(&self, number: impl Fn(&EngineRun) -> Option<f64>) -> Option<MeanOverSeeds> {
        over_seeds(self.runs.iter().filter_map(number))
    }

    /// Whether the tips of all runs were at rest at a pressure, on both ways.
    pub fn is_at_rest(&self, actuator_kpa: f64) -> bool {
        let here = |state: &&EngineState| policy::is_same_reading(state.actuator_kpa, actuator_kpa);
        let mut all = self.runs.iter().flat_map(|run| run.states.iter().chain(&run.down)).filter(here);
        all.all(|state| state.is_at_rest != Some(false))
    }

    /// Mean processor time of a run \[s\].
    pub fn cpu_s(&self) -> f64 {
        self.runs.iter().map(|run| run.cpu_s).sum::<f64>() / self.runs.len() as f64
    }
}

/// Mean and standard deviation over seeds, which a single one has not.
pub type MeanOverSeeds = (f64, Option<f64>);

/// Of a value from every seed; `None` without any.
pub(crate) fn over_seeds(values: impl IntoIterator<Item = f64>) -> Option<MeanOverSeeds> {
    Scatter::of(values).map(|scatter| (scatter.mean, scatter.sd))
}

fn state_at(states: &[EngineState], actuator_kpa: f64) -> Option<&EngineState> {
    states.iter().find(|s| policy::is_same_reading(s.actuator_kpa, actuator_kpa))
}

/// The runs of a shipped robot as it is to 30 kPa, on the finest mesh there is.
pub fn ensemble(runs: &[EngineRun], scenario: &Scenario) -> Ensemble {
    let mine = runs.iter().filter(|r| as_it_is(r, scenario) && r.states.last().is_some_and(|s| s.actuator_kpa > 29.9));
    finest(mine.collect())
}

/// Of the runs on the finest mesh those read at the most pressures, one for every seed: that with the most steps.
fn finest(runs: Vec<&EngineRun>) -> Ensemble {
    let mesh = runs.iter().map(|r| r.mesh_mm[1]).fold(f64::INFINITY, f64::min);
    let mut kept: Vec<EngineRun> = runs.into_iter().filter(|r| r.mesh_mm[1] == mesh).cloned().collect();
    let read = kept.iter().map(|r| r.states.len()).max().unwrap_or(0);
    kept.retain(|r| r.states.len() == read);
    kept.sort_by_key(|r| (r.seed, std::cmp::Reverse(r.steps)));
    kept.dedup_by_key(|r| r.seed);
    Ensemble { runs: kept }
}

/// Whether a run is of this robot at its own body pressure.
pub fn as_it_is(run: &EngineRun, scenario: &Scenario) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * b.abs();
    run.actuator == scenario.actuator.kind.name
        && run.cut.is_empty()
        && run.scenario == scenario.name
        && run.count == scenario.actuator.count
        && near(run.body_kpa, scenario.p_body_pa * 1e-3)
        && near(run.pouch_mm, scenario.actuator.shape.length_m * 1e3)
        && near(run.radius_mm, scenario.radius_m * 1e3)
        && near(run.width_mm, scenario.actuator.shape.width_m * 1e3)
}

#[cfg(test)]
mod tests;
