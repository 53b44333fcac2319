//! A hypercube of what finite element runs gave.

use super::{Member, MemberState, Uncertain, Varied};
use fem::FemError;
use fem::robot::Reading;
use fem::session::{Cube, FeRun, Felt, Many, rounded};
use serde::Serialize;

/// Quantiles of the displacements at a pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Intervals {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Of every marker along x and y \[mm\].
    pub markers_mm: Vec<[Option<[f64; 3]>; 2]>,
}

impl Varied {
    fn of((unknown, key): &Felt) -> Varied {
        Varied {
            name: key.name.into(),
            interval: unknown.interval.map(|si| rounded(si / key.si)),
            tenths: [0.1, 0.9].map(|share| format!("{:.2e}", unknown.at(share) / key.si).parse().unwrap_or(f64::NAN)),
            meaning: key.meaning.into(),
            reason: unknown.reason.into(),
        }
    }
}

impl Member {
    /// A robot that cannot be run keeps the error instead of states.
    fn of(run: &Result<FeRun, FemError>, shares: &[f64]) -> Member {
        // Five digits, as a camera will never see them.
        let short = |m: f64| format!("{:.4e}", m * 1e3).parse().unwrap_or(f64::NAN);
        let state = |r: &Reading| MemberState {
            actuator_kpa: rounded(r.actuator_pa * 1e-3),
            // The last station is the tip.
            moved_mm: r.moved_m.iter().rev().skip(1).rev().map(|d| [short(d[0]), short(d[1])]).collect(),
        };
        let readings = run.iter().flat_map(FeRun::readings);
        Member {
            shares: shares.iter().map(|s| format!("{s:.5}").parse().unwrap_or(*s)).collect(),
            states: readings.filter(|r| r.actuator_pa > 0.0).map(state).collect(),
            stopped: run.as_ref().err().map(FemError::to_string),
        }
    }
}

impl Uncertain {
    /// Of a hypercube and its runs; `variant`: what was set in addition, as typed.
    ///
    /// # Errors
    /// [`FemError::Refused`] for a scenario that is not a robot.
    pub fn of(cube: &Cube, many: &Many, variant: &[String]) -> Result<Uncertain, FemError> {
        let (scenario, run) = cube.base.robot_run()?;
        let runs = many.of.iter().map(|of| &many.runs[*of]);
        Ok(Uncertain {
            engine: fem::ENGINE,
            actuator: scenario.actuator.kind.name.into(),
            scenario: scenario.name.clone(),
            variant: variant.join(" "),
            mesh_mm: [run.settings.body_size_m, run.settings.actuator_size_m].map(|m| rounded(m * 1e3)),
            body_kpa: rounded(scenario.p_body_pa * 1e-3),
            stations_mm: scenario.markers_m.iter().map(|s| rounded(s * 1e3)).collect(),
            numbers: cube.numbers.iter().map(Varied::of).collect(),
            members: runs.zip(&cube.shares).map(|(run, shares)| Member::of(run, shares)).collect(),
        })
    }

    /// Highest actuator pressure that was read, 0 without states \[kPa\].
    pub fn top_kpa(&self) -> f64 {
        self.pressures_kpa().into_iter().fold(0.0, f64::max)
    }

    /// Quantiles of every marker at every pressure.
    pub fn intervals(&self) -> Vec<Intervals> {
        let markers =
            |kpa: f64| (0..self.stations_mm.len()).map(move |m| [0, 1].map(|axis| self.quantiles_mm(kpa, m, axis)));
        let all = self.pressures_kpa();
        all.into_iter()
            .map(|actuator_kpa| Intervals { actuator_kpa, markers_mm: markers(actuator_kpa).collect() })
            .collect()
    }

    /// Measured displacement of this kind of robot at the outermost marker: pressure \[kPa\], station and height \[mm\].
    pub fn measured(&self) -> Vec<(f64, [f64; 2])> {
        let Ok(paper) = data::published() else { return Vec::new() };
        let own = paper.actuators.iter().filter(|a| a.kind == self.actuator);
        let at = self.stations_mm.last().copied().unwrap_or(f64::NAN);
        own.map(|a| (a.d_max_pressure_pa * 1e-3, [at, a.d_max_m * 1e3])).collect()
    }
}
