//! Speed of the finite element engine on this machine, compared with its targets.

use super::plain_loop::Membrane;
use super::workloads as speed;
use crate::checks::Against;
use crate::cost::resident_bytes;
use crate::{Error, Findings, Printed};
use compare::Progress;
use fem::Simulation;
use fem::cost::process_seconds;
use fem::robot::RobotSettings;
use serde_json::json;
use std::time::Instant;

/// Repeats of every ratio: the table gives its median and range.
const REPEATS: usize = 7;
/// Turns of a repeat, in which both sides of a ratio alternate and the best of each counts: a shared machine is disturbed for
/// seconds on end, and both of its cores are rarely free, so many short ones.
const TURNS: usize = 6;
/// Steps of a turn: a few looks of the guards.
const TURN_STEPS: u64 = 192;
/// Whole runs of the folded cPAM, whose cost changes along the run, and stretches of each.
const WHOLE_RUNS: usize = 5;
const STRETCHES: usize = 40;

struct EngineFigure {
    what: String,
    elements: usize,
    unit: &'static str,
    /// Measured values, one per repeat, ascending.
    values: Vec<f64>,
    /// What it must reach: a ratio of two things measured at the same time, or a number that does not depend on the machine.
    wanted: Option<Against>,
    residual: f64,
}

impl EngineFigure {
    fn new(
        what: &str,
        run: &Simulation,
        unit: &'static str,
        mut values: Vec<f64>,
        wanted: Option<Against>,
    ) -> EngineFigure {
        values.sort_by(f64::total_cmp);
        let (elements, residual) = (run.elements(), run.ledger().residual_share());
        EngineFigure { what: what.to_owned(), elements, unit, values, wanted, residual }
    }

    fn median(&self) -> f64 {
        self.values.get(self.values.len() / 2).copied().unwrap_or(f64::NAN)
    }

    fn met(&self) -> Option<bool> {
        self.wanted.map(|wanted| wanted.holds(self.median()))
    }

    fn row(&self) -> Vec<String> {
        let measured = match self.values[..] {
            [low, .., high] => format!("{:.2} ({low:.2} to {high:.2}) {}", self.median(), self.unit),
            _ => format!("{:.2} {}", self.median(), self.unit),
        };
        let wanted = match self.wanted {
            Some(Against::AtLeast(least)) => format!("at least {least}"),
            Some(Against::AtMost(most)) => format!("at most {most}"),
            _ => String::new(),
        };
        let met = self.met().map_or("", |met| if met { "yes" } else { "no" });
        vec![
            self.what.clone(),
            self.elements.to_string(),
            measured,
            wanted,
            met.into(),
            format!("{:.1e}", self.residual),
        ]
    }

    fn json(&self) -> serde_json::Value {
        let (least, most) = match self.wanted {
            Some(Against::AtLeast(least)) => (Some(least), None),
            Some(Against::AtMost(most)) => (None, Some(most)),
            _ => (None, None),
        };
        json!({"what": self.what, "elements": self.elements, "median": self.median(), "low": self.values.first(),
            "high": self.values.last(), "unit": self.unit, "at_least": least, "at_most": most, "met": self.met(),
            "energy_residual": self.residual})
    }
}

/// Ratios of speeds and memory, and with `all` whole runs too; `machine` names the computer.
///
/// # Errors
/// A run that stops.
pub fn measure(all: bool, machine: &str, progress: &mut Progress) -> Result<Findings, Error> {
    // First: later it would get the room that others gave back, and not grow.
    let memory = memory()?;
    progress("against a plain loop", None);
    let mut figures: Vec<EngineFigure> = against_plain()?.into();
    progress("two threads", None);
    figures.push(two_threads()?);
    figures.extend(rates(progress)?);
    figures.push(memory);
    for (n, name) in [(36, "4.9k"), (72, "20k"), (142, "80k")].into_iter().filter(|_| all) {
        progress(&format!("whole run, {name}"), None);
        figures.push(whole_run(n, name)?);
    }
    for name in models::actuators::ACTUATORS.iter().map(|a| a.name).filter(|_| all) {
        progress(&format!("robot {name}"), None);
        figures.push(robot(name)?);
    }
    Ok(report(&figures, machine))
}

fn report(figures: &[EngineFigure], machine: &str) -> Findings {
    let head = &["what", "quads", "median (range)", "target", "met", "energy residual"];
    let list: Vec<_> = figures.iter().map(EngineFigure::json).collect();
    Findings {
        parts: vec![
            Printed::Text(format!("Finite elements on {machine}\n")),
            Printed::table(head, 1, figures.iter().map(EngineFigure::row)),
        ],
        json: json!({"schema": "ibr.bench.fem", "version": 2, "machine": machine, "figures": list}),
        missed: figures.iter().any(|f| f.met() == Some(false)),
    }
}

/// A pillow with `n` elements along a side, past its first steps.
fn pillow(n: usize, bending: bool, threads: usize) -> Result<Simulation, Error> {
    let mut problem = speed::pillow(n, bending)?;
    problem.settings.threads = threads;
    let mut run = Simulation::new(&problem)?;
    speed::advance_by(&mut run, TURN_STEPS)?;
    Ok(run)
}

/// Processor time per step, and per simulated second, of a pillow with bending and ledger relative to a plain loop over
/// membrane triangles on the same nodes.
fn against_plain() -> Result<[EngineFigure; 2], Error> {
    let mut plain = Membrane::new(&speed::pillow(72, true)?);
    let mut run = pillow(72, true, 1)?;
    let (mut per_step, mut per_time) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let mut best = [f64::INFINITY; 2];
        for _ in 0..TURNS {
            let start = process_seconds();
            plain.advance_by(TURN_STEPS);
            best[0] = best[0].min((process_seconds() - start) / TURN_STEPS as f64);
            let start = process_seconds();
            let steps = speed::advance_by(&mut run, TURN_STEPS)?;
            best[1] = best[1].min((process_seconds() - start) / steps as f64);
        }
        per_step.push(best[1] / best[0]);
        per_time.push(best[1] / best[0] * plain.dt_s() / run.dt_s());
    }
    let of = format!("pillow with bending against {} plain membrane triangles", plain.triangles());
    let wanted = Some(Against::AtMost(0.6));
    Ok([
        EngineFigure::new(&format!("{of}, CPU per step"), &run, "times", per_step, wanted),
        EngineFigure::new("the same, CPU per simulated second", &run, "times", per_time, Some(Against::AtMost(0.45))),
    ])
}

/// Speed of one run on two threads relative to two simultaneous runs of one thread each, which get all that the two
/// cores give at that moment.
fn two_threads() -> Result<EngineFigure, Error> {
    let (mut one, mut other, mut two) = (pillow(100, true, 1)?, pillow(100, true, 1)?, pillow(100, true, 2)?);
    let mut ratios = Vec::new();
    for _ in 0..REPEATS {
        let mut best = [f64::INFINITY; 2];
        for _ in 0..TURNS {
            let start = Instant::now();
            let steps = speed::advance_by(&mut two, TURN_STEPS)?;
            best[0] = best[0].min(start.elapsed().as_secs_f64() / steps as f64);
            let start = Instant::now();
            let steps = std::thread::scope(|scope| {
                let beside = scope.spawn(|| speed::advance_by(&mut other, TURN_STEPS));
                let steps = speed::advance_by(&mut one, TURN_STEPS)?;
                beside.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)).map(|more| steps + more)
            })?;
            best[1] = best[1].min(start.elapsed().as_secs_f64() / steps as f64);
        }
        ratios.push(best[1] / best[0]);
    }
    let what = "two threads against two simultaneous runs of one thread";
    Ok(EngineFigure::new(what, &two, "times", ratios, Some(Against::AtLeast(0.93))))
}

/// Element-steps per CPU-second with contact (folded, blown up, at rest) relative to a pillow with bending; these
/// rates, and the rate of membranes alone. They alternate stretch by stretch, one ratio per whole run.
fn rates(progress: &mut Progress) -> Result<Vec<EngineFigure>, Error> {
    let problem = speed::folded_cpam(2e-3, true)?;
    let mut touching = Simulation::new(&problem)?;
    let (mut membrane, mut bending) = (pillow(100, false, 1)?, pillow(100, true, 1)?);
    let (mut ratios, mut rates) = (Vec::new(), [const { Vec::new() }; 3]);
    for whole in 0..WHOLE_RUNS {
        touching = Simulation::new(&problem)?;
        let mut spent_s = [0.0; 3];
        let mut done = [0.0; 3];
        for i in 0..STRETCHES {
            let share = (whole * STRETCHES + i) as f64 / (WHOLE_RUNS * STRETCHES) as f64;
            progress("element-steps per second", Some(share));
            let until_s = problem.settings.end_s * (i + 1) as f64 / STRETCHES as f64;
            for (k, run) in [&mut membrane, &mut bending, &mut touching].into_iter().enumerate() {
                let (from, start) = (run.step(), process_seconds());
                if k == 2 {
                    run.advance_until(until_s, &mut |_| true)?;
                } else {
                    speed::advance_by(run, TURN_STEPS)?;
                }
                spent_s[k] += process_seconds() - start;
                done[k] += (run.step() - from) as f64 * run.elements() as f64;
            }
        }
        (0..3).for_each(|k| rates[k].push(done[k] / spent_s[k] / 1e6));
        ratios.push(rates[2][whole] / rates[1][whole]);
    }
    let [shells, bent, touched] = rates;
    let unit = "M element-steps/CPU-s";
    Ok(vec![
        EngineFigure::new(
            "folded cPAM with contact against bending",
            &touching,
            "times",
            ratios,
            Some(Against::AtLeast(0.6)),
        ),
        EngineFigure::new("membrane only", &membrane, unit, shells, None),
        EngineFigure::new("membrane + bending", &bending, unit, bent, None),
        EngineFigure::new("membrane + bending + contact, folded cPAM", &touching, unit, touched, None),
    ])
}

/// Growth of the resident memory by a run, per element.
fn memory() -> Result<EngineFigure, Error> {
    let problem = speed::pillow(150, true)?;
    let before = resident_bytes();
    let mut run = Simulation::new(&problem)?;
    speed::advance_by(&mut run, 300)?;
    let grown = vec![(resident_bytes() - before) / run.elements() as f64];
    Ok(EngineFigure::new("memory of a run", &run, "bytes per element", grown, Some(Against::AtMost(1000.0))))
}

/// CPU-seconds of the whole pillow run to 0.15 s, preparation and ledger included.
fn whole_run(n: usize, name: &str) -> Result<EngineFigure, Error> {
    let start = process_seconds();
    let problem = speed::pillow(n, true)?;
    let mut run = Simulation::new(&problem)?;
    run.advance_until(problem.settings.end_s, &mut |_| true)?;
    let what = format!("pillow to 0.15 s, nodes of {name} triangles");
    Ok(EngineFigure::new(&what, &run, "CPU-s", vec![process_seconds() - start], None))
}

/// Seconds on two threads of one ramp to 30 kPa with elements of 4 mm everywhere.
fn robot(name: &str) -> Result<EngineFigure, Error> {
    let settings = RobotSettings { body_size_m: 4e-3, actuator_size_m: 4e-3, ..RobotSettings::compressed() };
    let mut problem = fem::robot::shipped(name, &settings)?.1;
    problem.settings.threads = 2;
    let start = Instant::now();
    let mut run = Simulation::new(&problem)?;
    run.advance_until(problem.settings.end_s, &mut |_| true)?;
    let what = format!("robot {name} to 30 kPa, 4 mm, two threads");
    Ok(EngineFigure::new(&what, &run, "s", vec![start.elapsed().as_secs_f64()], None))
}
