//! The energy balance over a long run without any damping.

use super::setup::*;
use fem::mesh::generate::pillow;
use models::fabrics::NeoHookean;

pub(super) const CHECK: Check = Check::quick(
    "energy",
    "An inflated pillow whose pressure jumps vibrates for 100000 steps without damping: no energy comes or goes.",
    "conservation of energy",
    run,
);

const STEPS: u64 = 100_000;
const PRESSURE_PA: f64 = 2e3;

fn run() -> CheckResult {
    let fabric = NeoHookean::new(50.3e6, 2e-4);
    let flat = |pressure: Amplitude| -> Result<Problem, FemError> {
        let mesh = pillow(0.1, 10, 2e-3)?;
        Ok(problem("pillow", mesh, section(Arc::new(fabric), 1.0), vec![chamber("air", pressure)]))
    };
    let mut problem = flat(rise(0.02, PRESSURE_PA))?;
    problem.settings.mass_damping_1_s = 300.0;
    problem.settings.end_s = 0.05;
    let inflated = settle(&problem)?.positions();
    // A third more pressure at once, and nothing that damps.
    let mut problem = flat(Amplitude::Constant(PRESSURE_PA * 4.0 / 3.0))?;
    problem.mesh.start = inflated;
    problem.settings.viscosity = 0.0;
    problem.settings.cfl = 0.5;
    let mut run = Simulation::new(&problem)?;
    let (mut worst, mut moving): (f64, f64) = (0.0, 0.0);
    let mut work: f64 = 0.0;
    run.advance_until(f64::MAX, &mut |run| {
        let ledger = run.ledger();
        work = work.max(ledger.external_work_j.abs());
        worst = worst.max(ledger.residual_j.abs() / ledger.scale_j);
        moving = if run.step() > STEPS / 2 { moving.max(ledger.kinetic_j / work) } else { 0.0 };
        run.step() < STEPS
    })?;
    Ok(vec![
        CheckedNumber::at_least("kinetic energy over work, last half", moving, 0.01),
        CheckedNumber::at_most("largest residual over work, 1e5 steps", worst, 1e-4),
    ]
    .into())
}
