//! Endlessly wide pouch: contraction and volume.

use super::setup::*;
use crate::exact::elastic_pouch::{self, PouchFilm, free_contraction};
use crate::exact::pouch::Pouch;
use models::fabrics::NeoHookean;
use std::f64::consts::FRAC_PI_2;

pub(super) const CHECK: Check = Check::quick(
    "long-pouch",
    "Two strips welded at their ends are blown to a circle; their ends come closer by 1 − 2/π, less the stretch. \
               Held at arcs of half angle θ, they pull with p λ L₀ W cos θ/θ.",
    "verification::exact::elastic_pouch, exact at finite strain",
    run,
);

const POUCH: Pouch = Pouch { length_m: 0.06, width_m: 0.003 };
const C10_PA: f64 = 50.3e6;
const THICKNESS_M: f64 = 2e-4;
const PRESSURE_PA: f64 = 30e3;
/// Half angle of the arcs of the pouch that is held.
const HELD_RAD: f64 = 1.0;

fn run() -> CheckResult {
    let film = PouchFilm::NeoHookean(C10_PA * THICKNESS_M);
    let free = free_contraction(&POUCH, film, PRESSURE_PA);
    let (mesh, run) = blown(hold("right", [false, false, true]))?;
    let x = run.positions();
    let contraction = 1.0 - (mean(&mesh, "right", &x, 0) - mean(&mesh, "left", &x, 0)) / POUCH.length_m;
    let volume = volume_m3(&run);
    let round = elastic_pouch::volume_m3(&POUCH, film, FRAC_PI_2, PRESSURE_PA);
    let held = elastic_pouch::contraction(&POUCH, film, HELD_RAD, PRESSURE_PA);
    let (_, blocked) = blown(drive("right", [true; 3], 0, rise(0.02, -held * POUCH.length_m)))?;
    let force = elastic_pouch::force_n(&POUCH, film, HELD_RAD, PRESSURE_PA);
    Ok(vec![
        CheckedNumber::value("contraction", contraction, free, 0.01),
        CheckedNumber::value("volume [mm³]", 1e9 * volume, 1e9 * round, 0.01),
        CheckedNumber::value("force of the held pouch, driven end [N]", pull_n(&blocked, "right"), force, 0.01),
        CheckedNumber::value("the same, other end [N]", -pull_n(&blocked, "left"), force, 0.01),
        CheckedNumber::at_most("kinetic share at the end", run.ledger().kinetic_share(), 1e-5),
    ]
    .into())
}

/// The pouch under pressure, its right end supported in one way or another.
fn blown(right: Support) -> Result<(Mesh, Simulation), FemError> {
    let mesh = generate::long_pouch(POUCH.length_m, POUCH.width_m, 40, 2, 1e-4)?;
    let film = Arc::new(NeoHookean::new(C10_PA, THICKNESS_M));
    let air = Chamber { open_axis: Some([false, true, false]), ..chamber("air", rise(0.02, PRESSURE_PA)) };
    let mut problem = problem("long pouch", mesh, section(film, 0.0), vec![air]);
    problem.open = vec!["open_0".into(), "open_1".into()];
    let across = [false, true, false];
    problem.supports = vec![hold("left", [true, false, true]), right, hold("open_0", across), hold("open_1", across)];
    problem.settings.mass_damping_1_s = 200.0;
    let mut run = Simulation::new(&problem)?;
    advance(&mut run, 0.1)?;
    Ok((problem.mesh, run))
}
