//! Heights that the paper's accuracies imply.
//!
//! The paper prints a = 1 − mean over six markers of ((y_FEA − y_EXP)/y_FEA)², so the root mean square of the relative error is
//! e = √(1 − a). If the error is alike along the robot, then at every marker
//!
//! ```text
//! y_FEA = y_EXP/(1 + e)   or   y_FEA = y_EXP/(1 − e)          low and high branch
//! ```
//!
//! The sign of the error is not printed. y_EXP is printed at 30 kPa only, as the largest of all measured displacements d_max,
//! so that at the other pressures y_FEA ≤ d_max/(1 − e) is all that follows. **Validity**: evidence, no data. An error that
//! sits on one of six markers alone is √6 e there.

use super::{PaperRun, find};
use crate::policy;
use data::{Published, PublishedActuator};
use serde::Serialize;

const MM: f64 = 1e3;

/// What an accuracy of the paper implies about its finite elements' height of the outermost marker.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Implied {
    /// Root mean square of (y_FEA − y_EXP)/y_FEA.
    pub error: f64,
    /// Low and high branch \[mm\]; `None` where y_EXP is not printed.
    pub branches_mm: Option<[f64; 2]>,
    /// y_FEA cannot be above this \[mm\].
    pub at_most_mm: f64,
}

impl Implied {
    /// Of a robot at a pressure; `None` if the paper prints no accuracy there.
    pub fn of(actuator: &PublishedActuator, pressure_pa: f64) -> Option<Implied> {
        let accuracy = actuator.accuracy.iter().find(|(pa, _)| (pa - pressure_pa).abs() < 1.0)?.1;
        let (error, measured_mm) = ((1.0 - accuracy).max(0.0).sqrt(), actuator.d_max_m * MM);
        let branches = [measured_mm / (1.0 + error), measured_mm / (1.0 - error)];
        let printed = (actuator.d_max_pressure_pa - pressure_pa).abs() < 1.0;
        Some(Implied { error, branches_mm: printed.then_some(branches), at_most_mm: branches[1] })
    }

    /// Signed distance of a height from the nearer branch over that branch, and whether it is the high one.
    pub fn off(&self, height_mm: f64) -> Option<(f64, bool)> {
        let [low, high] = self.branches_mm?.map(|branch| height_mm / branch - 1.0);
        Some(if low.abs() <= high.abs() { (low, false) } else { (high, true) })
    }

    /// Measured heights that a height of the finite elements would stand for \[mm\].
    pub fn would_mean_mm(&self, height_mm: f64) -> [f64; 2] {
        [height_mm * (1.0 - self.error), height_mm * (1.0 + self.error)]
    }
}

/// A run next to the height that the paper implies.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeightRow {
    /// Robot of the paper: `spam`, `cpam`, `epam` or `fpam`.
    pub robot: String,
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Element sizes of body and actuator \[mm\].
    pub mesh_mm: [f64; 2],
    /// Heights that the printed accuracy implies.
    pub implied: Implied,
    /// Heights of the markers, base first \[mm\].
    pub markers_mm: Vec<f64>,
    /// Height of the tip in the run \[mm\].
    pub tip_mm: f64,
    /// Whether the run meets the implied heights, in words.
    pub verdict: String,
}

impl HeightRow {
    /// Height of the outermost marker \[mm\].
    pub fn outermost_mm(&self) -> f64 {
        self.markers_mm.last().copied().unwrap_or(self.tip_mm)
    }
}

/// Every robot of the paper at every pressure on every mesh of the list for which there is a run.
pub fn heights(paper: &Published, runs: &[PaperRun], meshes_mm: &[[f64; 2]]) -> Vec<HeightRow> {
    let mut out = Vec::new();
    for actuator in &paper.actuators {
        for (pa, _) in &actuator.accuracy {
            let found = meshes_mm.iter().filter_map(|mesh| find(runs, &actuator.kind, *mesh, pa * 1e-3));
            out.extend(found.filter_map(|run| against(actuator, run)));
        }
    }
    out
}

/// One run next to what the paper implies.
pub fn against(actuator: &PublishedActuator, run: &PaperRun) -> Option<HeightRow> {
    let state = run.end()?;
    let implied = Implied::of(actuator, state.actuator_kpa * 1e3)?;
    Some(HeightRow {
        robot: actuator.kind.clone(),
        actuator_kpa: state.actuator_kpa,
        mesh_mm: run.run.mesh_mm,
        markers_mm: state.moved_mm.iter().map(|xy| xy[1]).collect(),
        tip_mm: state.tip_mm,
        verdict: verdict(&implied, state.marker_mm),
        implied,
    })
}

fn verdict(implied: &Implied, height_mm: f64) -> String {
    let Some((off, high)) = implied.off(height_mm) else {
        let [low, high] = implied.would_mean_mm(height_mm);
        return match height_mm <= implied.at_most_mm {
            true => format!("no y_EXP printed; would mean {low:.0} or {high:.0} measured"),
            false => format!("misses: above the most that is possible by {:.1} mm", height_mm - implied.at_most_mm),
        };
    };
    let (branch, percent) = (if high { "high" } else { "low" }, 100.0 * off);
    match policy::meets(off) {
        true => format!("holds: {percent:+.1} % from the {branch} branch"),
        false => format!("misses: {percent:+.1} % from the {branch} branch"),
    }
}
