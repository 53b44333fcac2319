//! The four robots of du Pasquier, Jeong, Okamura 2023 as recommended: their books close, and the ePAM's folds resist.
//!
//! Whether they bend as far as measured is no check of the engine: most of what decides it was assumed. `ibr compare --engines` holds them
//! against the published displacements, with the interval that the assumed numbers leave.

use super::{Check, Curve, Figure, Line, Outcome};
use crate::robot::{RobotSettings, sections, shipped};
use crate::{FemError, Simulation};

pub(super) const CHECK: Check = Check {
    name: "robots",
    sentence: "The four robots at 30 kPa are at rest, lose no energy and do not lean on hourglass control.",
    source: "energy balance",
    slow: true,
    run,
};

pub(super) const FOLDS: Check = Check {
    name: "robot-folds",
    sentence: "The ePAM at 10 kPa bends less with sheets of ten times the bending stiffness: its folds are not free.",
    source: "a fold by the elastica is √10 times as stiff then",
    slow: true,
    run: folds,
};

const ROBOTS: [&str; 4] = ["spam", "cpam", "epam", "fpam"];

/// A robot at the end of its ramp.
struct End {
    run: Simulation,
    /// Height of the outermost marker \[mm\].
    y_mm: f64,
}

impl End {
    fn row(&self, name: &str) -> f64 {
        self.run.ledger().rows.iter().filter(|r| r.name == name).map(|r| r.energy_j).sum()
    }
}

fn run() -> Result<Outcome, FemError> {
    let (mut lines, mut tips) = (Vec::new(), Vec::new());
    for (k, name) in ROBOTS.into_iter().enumerate() {
        let end = bend(name, &RobotSettings::default())?;
        let hourglass = end.row("hourglass");
        let stored = end.row("membrane") + end.row("bending") + end.row("folds") + hourglass;
        let ledger = end.run.ledger();
        let of = |what: &str| format!("{name}: {what}");
        lines.extend([
            Line::at_most(&of("kinetic share at the end"), ledger.kinetic_share(), 0.01),
            Line::at_most(&of("energy residual over external work"), ledger.residual_share(), 1e-3),
            Line::at_most(&of("hourglass share of stored energy"), hourglass / stored, 0.05),
        ]);
        tips.push([k as f64 + 1.0, end.y_mm]);
    }
    let figure = Figure {
        title: "Four robots at 30 kPa, as recommended".into(),
        x: "sPAM, cPAM, ePAM, fPAM".into(),
        y: "outermost marker [mm]".into(),
        curves: vec![Curve { label: "finite elements".into(), points: tips, exact: false }],
    };
    Ok(Outcome { lines, figure: Some(figure) })
}

fn folds() -> Result<Outcome, FemError> {
    let low = RobotSettings { actuator_pa: 10e3, ..RobotSettings::default() };
    let stiff = RobotSettings { bending_factor: 10.0 * low.bending_factor, ..low.clone() };
    let [soft, stiff] = [bend("epam", &low)?, bend("epam", &stiff)?];
    let lines = vec![Line::at_least("less height with ten times the stiffness", 1.0 - stiff.y_mm / soft.y_mm, 0.1)];
    Ok(Outcome { lines, figure: None })
}

/// A robot at the end of one ramp.
fn bend(name: &str, settings: &RobotSettings) -> Result<End, FemError> {
    let (scenario, mut problem) = shipped(name, settings)?;
    problem.settings.threads = 1;
    let last = scenario.markers_m.last().copied().unwrap_or(scenario.length_m);
    let line = sections(&problem.mesh, &[last, scenario.length_m])?;
    let mut run = Simulation::new(&problem)?;
    let start = line.at(&run.positions())?;
    run.advance_until(problem.settings.end_s, &mut |_| true)?;
    let end = line.at(&run.positions())?;
    Ok(End { run, y_mm: 1e3 * (end[0][1] - start[0][1]) })
}
