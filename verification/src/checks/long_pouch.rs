//! Endlessly wide pouch: contraction and volume.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use crate::exact::elastic_pouch::{self, Film, free_contraction, volume_m3};
use crate::exact::pouch::Pouch;
use models::fabrics::NeoHookean;

use super::inflated::{advance, chamber, hold, mean, section};
use super::pulled::drive_x;
use super::{Check, Line, Outcome};
use fem::mesh::generate;
use fem::problem::{Chamber, Support};
use fem::{FemError, Mesh, Problem, Simulation};

/// Entry of the list.
pub const CHECK: Check = Check {
    name: "long-pouch",
    sentence: "Two strips welded at their ends are blown to a circle; their ends come closer by 1 − 2/π, less the stretch. \
               Held at arcs of half angle θ, they pull with p λ L₀ W cos θ/θ.",
    source: "verification::exact::elastic_pouch, exact at finite strain",
    slow: false,
    run,
};

const POUCH: Pouch = Pouch { length_m: 0.06, width_m: 0.003 };
const C10_PA: f64 = 50.3e6;
const THICKNESS_M: f64 = 2e-4;
const PRESSURE_PA: f64 = 30e3;
/// Half angle of the arcs of the pouch that is held.
const HELD_RAD: f64 = 1.0;

fn run() -> Result<Outcome, FemError> {
    let film = Film::NeoHookean(C10_PA * THICKNESS_M);
    let free = free_contraction(&POUCH, film, PRESSURE_PA);
    let (mesh, run) = blown(hold("right", [false, false, true]))?;
    let x = run.positions();
    let contraction = 1.0 - (mean(&mesh, "right", &x, 0) - mean(&mesh, "left", &x, 0)) / POUCH.length_m;
    let volume = run.chambers().first().map_or(f64::NAN, |air| air.volume_m3);
    let round = volume_m3(&POUCH, film, FRAC_PI_2, PRESSURE_PA);
    let held = elastic_pouch::contraction(&POUCH, film, HELD_RAD, PRESSURE_PA);
    let (_, blocked) = blown(drive_x("right", vec![(0.0, 0.0), (0.02, -held * POUCH.length_m)]))?;
    let force = elastic_pouch::force_n(&POUCH, film, HELD_RAD, PRESSURE_PA);
    let reaction = |set: &str| blocked.reaction_n(set).map_or(f64::NAN, |n| n[0]);
    let lines = vec![
        Line::value("contraction", contraction, free, 0.01),
        Line::value("volume [mm³]", 1e9 * volume, 1e9 * round, 0.01),
        Line::value("force of the held pouch, driven end [N]", reaction("right"), force, 0.01),
        Line::value("the same, other end [N]", -reaction("left"), force, 0.01),
        Line::at_most("kinetic share at the end", run.ledger().kinetic_share(), 1e-5),
    ];
    Ok(Outcome { lines, figure: None })
}

/// The pouch under pressure, its right end supported in one way or another.
fn blown(right: Support) -> Result<(Mesh, Simulation), FemError> {
    let mesh = generate::long_pouch(POUCH.length_m, POUCH.width_m, 40, 2, 1e-4)?;
    let sheet = section(Arc::new(NeoHookean { c10_pa: C10_PA, thickness_m: THICKNESS_M }), 0.0);
    let air = Chamber { open_axis: Some(1), ..chamber("air", vec![(0.0, 0.0), (0.02, PRESSURE_PA)]) };
    let mut problem = Problem::new("long pouch", mesh, vec![sheet.clone(), sheet], vec![air]);
    problem.open = vec!["open_0".into(), "open_1".into()];
    let across = [false, true, false];
    problem.supports = vec![hold("left", [true, false, true]), right, hold("open_0", across), hold("open_1", across)];
    problem.settings.mass_damping_1_s = 200.0;
    let mut run = Simulation::new(&problem)?;
    advance(&mut run, 0.1)?;
    Ok((problem.mesh, run))
}
