//! `ibr bench fem`: speed of the finite element engine on this machine, beside what it must reach.

use super::tables::table;
use super::{Context, Outcome};
use crate::cost::{cpu_seconds, resident_bytes};
use crate::failure::Failure;
use crate::output::machine;
use fem::robot::RobotSettings;
use fem::{Simulation, speed};
use serde_json::json;
use std::fmt::Write;
use std::time::Instant;

/// Whole runs of the folded cPAM; its cost changes along the run.
const WHOLE_RUNS: usize = 4;
/// Stretches of such a run that are timed.
const STRETCHES: usize = 40;
/// Repetitions of shells after each of them, and of one thread, two threads, two runs: a shared machine is disturbed for
/// seconds on end, and both of its cores are rarely free, so many short ones.
const TURNS: usize = 60;
/// Steps of a repetition.
const TURN_STEPS: u64 = 150;

/// Robots, and the seconds that a run of each may take on two cores at 4 mm.
const ROBOTS: [(&str, f64); 4] = [("spam", 15.0), ("epam", 15.0), ("fpam", 15.0), ("cpam", 45.0)];

/// One measured line.
struct Figure {
    what: String,
    elements: usize,
    value: f64,
    unit: &'static str,
    wanted: f64,
    /// True if more is better.
    rate: bool,
    residual: f64,
}

impl Figure {
    fn met(&self) -> bool {
        if self.rate { self.value >= self.wanted } else { self.value <= self.wanted }
    }
}

pub fn run(all: bool, context: &mut Context) -> Result<Outcome, Failure> {
    let mut figures = Vec::new();
    // First: later it would get the room that others gave back, and not grow.
    let memory = memory()?;
    figures.extend(rates(context)?);
    (context.progress)("two threads", None);
    let (two, limit) = two_threads()?;
    figures.push(two);
    figures.push(memory);
    let whole: &[(usize, &str, f64)] = &[(36, "4.9k", 0.6), (72, "20k", 5.0), (142, "80k", 40.0)];
    for (n, name, wanted) in &whole[..if all { 3 } else { 2 }] {
        (context.progress)(&format!("whole run, {name}"), None);
        figures.push(whole_run(*n, name, *wanted)?);
    }
    for (name, wanted) in ROBOTS.iter().filter(|_| all) {
        (context.progress)(&format!("robot {name}"), None);
        figures.push(robot(name, *wanted)?);
    }
    Ok(report(&figures, limit))
}

fn report(figures: &[Figure], limit: f64) -> Outcome {
    let rows = figures.iter().map(|f| {
        vec![
            f.what.clone(),
            f.elements.to_string(),
            format!("{:.2} {}", f.value, f.unit),
            format!("{} {}", if f.rate { "at least" } else { "at most" }, f.wanted),
            if f.met() { "yes" } else { "no" }.into(),
            format!("{:.1e}", f.residual),
        ]
    });
    let mut text = format!("Finite elements on {}\n", machine());
    text.push_str(&table(&["what", "quads", "measured", "wanted", "met", "energy residual"], 1, rows.collect()));
    let _ = writeln!(
        text,
        "Two runs of one thread each, beside each other: {limit:.2} times one, what two threads could reach."
    );
    text.push_str(&roofline(figures));
    let list: Vec<_> = figures
        .iter()
        .map(|f| {
            json!({"what": f.what, "elements": f.elements, "value": f.value, "unit": f.unit, "wanted": f.wanted,
                "met": f.met(), "energy_residual": f.residual})
        })
        .collect();
    Outcome::new(
        text,
        json!({"schema": "ibr.bench.fem", "version": 1, "machine": machine(), "figures": list, "two_runs_times": limit}),
    )
}

/// Million element-steps per CPU-second: of shells, the best repetition; of a whole run with contact (folded, blown up, at
/// rest), each stretch as it was in the best of several runs, which do the same.
fn rates(context: &mut Context) -> Result<Vec<Figure>, Failure> {
    let pillow = |bending: bool| -> Result<Simulation, Failure> {
        let mut run = Simulation::new(&speed::pillow(100, bending)?)?;
        speed::advance_by(&mut run, TURN_STEPS)?;
        Ok(run)
    };
    let mut shells = [(pillow(false)?, f64::INFINITY), (pillow(true)?, f64::INFINITY)];
    let problem = speed::folded_cpam(2e-3, true)?;
    let mut contact = Simulation::new(&problem)?;
    let mut stretch_s = [f64::INFINITY; STRETCHES];
    for whole in 0..WHOLE_RUNS {
        contact = Simulation::new(&problem)?;
        for (i, best_s) in stretch_s.iter_mut().enumerate() {
            let done = (whole * STRETCHES + i) as f64 / (WHOLE_RUNS * STRETCHES) as f64;
            (context.progress)("element-steps per second", Some(done));
            let start = cpu_seconds();
            contact.advance_until(problem.settings.end_s * (i + 1) as f64 / STRETCHES as f64, &mut |_| true)?;
            *best_s = best_s.min(cpu_seconds() - start);
        }
        for turn in 0..2 * TURNS {
            let (run, best_s) = &mut shells[turn % 2];
            let start = cpu_seconds();
            let steps = speed::advance_by(run, TURN_STEPS)?;
            *best_s = best_s.min((cpu_seconds() - start) / steps as f64);
        }
    }
    let [(membrane, membrane_s), (bending, bending_s)] = shells;
    let contact_s = stretch_s.iter().sum::<f64>() / contact.step() as f64;
    let rate = |what: &str, run: &Simulation, step_s: f64, wanted| Figure {
        what: what.to_owned(),
        elements: run.elements(),
        value: run.elements() as f64 / step_s / 1e6,
        unit: "M element-steps/CPU-s",
        wanted,
        rate: true,
        residual: run.ledger().residual_share(),
    };
    Ok(vec![
        rate("membrane only", &membrane, membrane_s, 60.0),
        rate("membrane + bending", &bending, bending_s, 40.0),
        rate("membrane + bending + contact, folded cPAM", &contact, contact_s, 25.0),
    ])
}

/// Real time of one thread over that of two, and over half that of two runs of one thread each: what the two cores give
/// just then. They alternate, so that all see the same machine.
fn two_threads() -> Result<(Figure, f64), Failure> {
    let with = |threads: usize| -> Result<Simulation, Failure> {
        let mut problem = speed::pillow(100, true)?;
        problem.settings.threads = threads;
        let mut run = Simulation::new(&problem)?;
        speed::advance_by(&mut run, TURN_STEPS)?;
        Ok(run)
    };
    let (mut one, mut other, mut two) = (with(1)?, with(1)?, with(2)?);
    let mut best = [f64::INFINITY; 3];
    for _ in 0..TURNS {
        let mut keep = |k: usize, start: Instant| best[k] = best[k].min(start.elapsed().as_secs_f64());
        let start = Instant::now();
        speed::advance_by(&mut one, TURN_STEPS)?;
        keep(0, start);
        let start = Instant::now();
        speed::advance_by(&mut two, TURN_STEPS)?;
        keep(1, start);
        let start = Instant::now();
        std::thread::scope(|scope| {
            let beside = scope.spawn(|| speed::advance_by(&mut other, TURN_STEPS));
            speed::advance_by(&mut one, TURN_STEPS)?;
            beside.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })?;
        keep(2, start);
    }
    let figure = Figure {
        what: "two threads against one".into(),
        elements: two.elements(),
        value: best[0] / best[1],
        unit: "times",
        wanted: 1.75,
        rate: true,
        residual: two.ledger().residual_share(),
    };
    Ok((figure, 2.0 * best[0] / best[2]))
}

/// Growth of the resident memory by a run, per element.
fn memory() -> Result<Figure, Failure> {
    let problem = speed::pillow(150, true)?;
    let before = resident_bytes();
    let mut run = Simulation::new(&problem)?;
    speed::advance_by(&mut run, 300)?;
    let grown = resident_bytes() - before;
    Ok(Figure {
        what: "memory of a run".into(),
        elements: run.elements(),
        value: grown / run.elements() as f64,
        unit: "bytes per element",
        wanted: 1000.0,
        rate: false,
        residual: run.ledger().residual_share(),
    })
}

/// CPU-seconds of the whole pillow run to 0.15 s, preparation and ledger included.
fn whole_run(n: usize, name: &str, wanted: f64) -> Result<Figure, Failure> {
    let start = cpu_seconds();
    let problem = speed::pillow(n, true)?;
    let mut run = Simulation::new(&problem)?;
    run.advance_until(problem.settings.end_s, &mut |_| true)?;
    Ok(Figure {
        what: format!("pillow to 0.15 s, nodes of {name} triangles"),
        elements: run.elements(),
        value: cpu_seconds() - start,
        unit: "CPU-s",
        wanted,
        rate: false,
        residual: run.ledger().residual_share(),
    })
}

/// Seconds on two threads of one ramp to 30 kPa with elements of 4 mm everywhere.
fn robot(name: &str, wanted: f64) -> Result<Figure, Failure> {
    let settings = RobotSettings { body_size_m: 4e-3, actuator_size_m: 4e-3, ..RobotSettings::compressed() };
    let mut problem = fem::robot::shipped(name, &settings)?.1;
    problem.settings.threads = 2;
    let start = Instant::now();
    let mut run = Simulation::new(&problem)?;
    run.advance_until(problem.settings.end_s, &mut |_| true)?;
    Ok(Figure {
        what: format!("robot {name} to 30 kPa, 4 mm, two threads"),
        elements: run.elements(),
        value: start.elapsed().as_secs_f64(),
        unit: "s",
        wanted,
        rate: false,
        residual: run.ledger().residual_share(),
    })
}

/// What an element-step takes, beside what was reached.
fn roofline(figures: &[Figure]) -> String {
    let (flops, bytes) = (speed::FLOPS_MEMBRANE + speed::FLOPS_NODE, speed::BYTES_MEMBRANE);
    let (more, more_bytes) = (flops + speed::FLOPS_BENDING, bytes + speed::BYTES_BENDING);
    let rate = |i: usize| figures.get(i).map_or(0.0, |f| f.value * 1e6);
    format!(
        "One element-step: {flops:.0} flops and {bytes:.0} bytes (with bending {more:.0} and {more_bytes:.0}).\n\
         Reached: {:.0} Gflop/s and {:.0} GB/s (with bending {:.0} and {:.0}). One core of this machine does {:.0} Gflop/s in \
         registers, not fused, and moves {:.0} GB/s through arrays of 4 MB.\n",
        rate(0) * flops / 1e9,
        rate(0) * bytes / 1e9,
        rate(1) * more / 1e9,
        rate(1) * more_bytes / 1e9,
        speed::peak_flops() / 1e9,
        speed::stream_bytes_per_s() / 1e9,
    )
}
