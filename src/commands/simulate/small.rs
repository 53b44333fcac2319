//! A small run of a robot in memory, for the demonstration.

use super::input::named;
use super::robot_files::side_view;
use crate::commands::Context;
use crate::cost::cpu_seconds;
use crate::failure::Failure;
use fem::Simulation;
use fem::output::picture::png_bytes;
use fem::robot::Reading;

/// What it came to.
pub struct Small {
    /// The robot at each pressure.
    pub readings: Vec<Reading>,
    /// Buckling events.
    pub snaps: usize,
    /// Elements.
    pub elements: usize,
    /// Processor time \[s\].
    pub cpu_s: f64,
    /// Missing energy over external work.
    pub residual_share: f64,
    /// Side view, PNG.
    pub picture: Vec<u8>,
}

/// Runs a shipped robot with keys of `[fem]` set to other values.
pub fn run(robot: &str, changes: &[(&str, &str)], context: &mut Context) -> Result<Small, Failure> {
    let changes: Vec<(String, String)> = changes.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect();
    let loaded = named(robot)?.with(&changes)?.load()?;
    let Some(robot) = &loaded.robot else {
        return Err(Failure::usage(format!("{robot} is no robot"), "name a shipped robot"));
    };
    let mut problem = loaded.case.problem.clone();
    problem.settings.threads = 0;
    let began = cpu_seconds();
    let mut run = Simulation::new(&problem)?;
    let mut watched = robot.watch(&problem);
    while let Some(time_s) = watched.next_s() {
        run.advance_until(time_s, &mut |run| {
            watched.watch.sample(run);
            (context.progress)("a small finite element run", Some(run.time_s() / problem.settings.end_s));
            true
        })?;
        watched.read(&run)?;
    }
    let picture = png_bytes(&side_view(robot, &problem.mesh, &run)?);
    let (readings, snaps) = (watched.readings.clone(), watched.snaps().len());
    let residual_share = run.ledger().residual_share();
    Ok(Small { readings, snaps, elements: run.elements(), cpu_s: cpu_seconds() - began, residual_share, picture })
}
