//! The finite elements of du Pasquier et al. 2023 against this engine with their modelling choices, `[fem] model = "paper"`:
//! displacements next to those that the paper's accuracies imply, and the sentences of the paper that runs or patterns can check.

mod checks;
mod facts;
mod implied;
mod runs;

use crate::policy;
use crate::study::engines::{EngineRun, EngineState, Listed};
pub use checks::facts;
pub use facts::{FactRow, FactVerdict};
use fem::FemError;
use fem::record::RecordShape;
pub use implied::{HeightRow, Implied, against, heights};
pub use runs::runs_below;
use serde::{Deserialize, Serialize};

/// Meshes of the paper: the coarsest of its study on body and actuator, and the final one \[mm\].
pub const MESHES_MM: [[f64; 2]; 2] = [[4.0, 4.0], [4.0, 1.0]];
const ROBOTS: [&str; 4] = ["spam", "cpam", "epam", "fpam"];

/// A finished run of the preset: one robot, one mesh, one pressure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaperRun {
    /// The run as other comparisons have it.
    pub run: EngineRun,
    /// Whether the base ring cannot turn.
    pub encastre: bool,
    /// Mass added by scaling, over the true mass.
    pub added_mass_share: f64,
    /// Kinetic energy compared with the other energies at the outputs.
    pub kinetic: Kinetic,
    /// Where the largest von Mises stress is.
    pub peak: Peak,
}

/// Kinetic energy at the outputs of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Kinetic {
    /// Number of outputs after the start.
    pub outputs: u64,
    /// Those below 10 % of the internal energy.
    pub below_10_pct_of_internal: u64,
    /// Those below 1 % of the total energy.
    pub below_1_pct_of_total: u64,
    /// Over kinetic and stored energy at the end.
    pub at_end: f64,
}

/// The element with the largest von Mises stress at the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// Part of the robot that the element belongs to.
    pub part: String,
    /// Place along the straight robot \[mm\].
    pub at_mm: f64,
    /// Whether it is next to a weld.
    pub on_seam: bool,
}

const RUNS: RecordShape = RecordShape { schema: "ibr.paper_runs", version: 2 };

/// Runs of the preset that come with the program, as `ibr compare --paper --runs FOLDER` writes them.
///
/// # Errors
/// The errors of [`read_runs`], for a program whose runs were not made again with its records.
pub fn stored() -> Result<Vec<PaperRun>, FemError> {
    read_runs("the paper's runs that come with the program", include_str!("../../../assets/paper-runs.json"))
}

/// Reads runs as [`runs_json`] writes them.
///
/// # Errors
/// [`FemError::Record`] with the line and the field.
pub fn read_runs(file: &str, text: &str) -> Result<Vec<PaperRun>, FemError> {
    let help = "make the file again: `ibr compare --paper --runs FOLDER --out PAGE` writes PAGE/paper-runs.json";
    Ok(RUNS.read::<Listed<PaperRun>>(file, text, help)?.runs)
}

/// Runs as they are stored: one a line.
pub fn runs_json(runs: &[PaperRun]) -> String {
    RUNS.listed("runs", runs)
}

/// Runs in the order in which they are stored, each case once: the one with the lowest seed.
pub fn ordered(mut runs: Vec<PaperRun>) -> Vec<PaperRun> {
    let case = |r: &PaperRun| {
        let kpa = r.end().map_or(0.0, |s| s.actuator_kpa);
        let numbers = [r.run.mesh_mm[0], -r.run.mesh_mm[1], kpa].map(|v| (v / policy::SAME_READING).round() as i64);
        (r.run.actuator.clone(), numbers[0], numbers[1], r.encastre, numbers[2])
    };
    runs.sort_by_key(|r| (case(r), r.run.seed));
    runs.dedup_by_key(|r| case(r));
    runs
}

impl PaperRun {
    /// Last state of the run, at its one pressure.
    pub fn end(&self) -> Option<&EngineState> {
        self.run.states.last()
    }

    fn is(&self, kind: &str, mesh_mm: [f64; 2], kpa: f64) -> bool {
        let same = policy::is_same_reading;
        self.run.actuator == kind
            && same(self.run.mesh_mm[0], mesh_mm[0])
            && same(self.run.mesh_mm[1], mesh_mm[1])
            && self.end().is_some_and(|s| same(s.actuator_kpa, kpa))
    }
}

/// The pinned run of a robot on a mesh at a pressure.
pub fn find<'a>(runs: &'a [PaperRun], kind: &str, mesh_mm: [f64; 2], kpa: f64) -> Option<&'a PaperRun> {
    runs.iter().find(|r| !r.encastre && r.is(kind, mesh_mm, kpa))
}

/// Element sizes as text: `20/10 mm`, or `10 mm` if both are equal.
pub fn mesh_name([body, actuator]: [f64; 2]) -> String {
    if body == actuator { format!("{actuator} mm") } else { format!("{body}/{actuator} mm") }
}

#[cfg(test)]
mod tests;
