//! A block on a slope: Coulomb friction against the closed form.

use super::setup::*;
use models::fabrics::Orthotropic;

pub(super) const CHECK: Check = Check::quick(
    "slope",
    "A plate on a slope sticks below the friction angle and slides with g (sin a - mu cos a) above it, rigid or flexible.",
    "Coulomb friction of a rigid block",
    run,
);

const SLOPE: f64 = std::f64::consts::FRAC_PI_6;
const GRAVITY: f64 = 9.81;
/// Time in which gravity comes up, so that the plate does not bounce on its penalty springs \[s\].
const RISE_S: f64 = 0.02;
const END_S: f64 = 0.12;

fn run() -> CheckResult {
    let mut lines = Vec::new();
    for (kind, rigid) in [("rigid", true), ("flexible", false)] {
        // tan 30° = 0.577: the plate sticks at 0.6 and slides at 0.3.
        let (mut stuck, start) = (plate(0.6, rigid)?, along_m(&plate(0.6, rigid)?));
        advance(&mut stuck, END_S)?;
        let free_m = 0.5 * GRAVITY * SLOPE.sin() * END_S * END_S;
        let crept = (along_m(&stuck) - start) / free_m;
        lines.push(CheckedNumber::at_most(format!("{kind}, sticking: way over free way"), crept, 1e-4));
        let mut run = plate(0.3, rigid)?;
        let speed = |run: &Simulation| along(&run.velocities());
        advance(&mut run, RISE_S)?;
        let (before, from, lost) = (speed(&run), along_m(&run), lost_j(&run));
        let rise_s = run.time_s();
        advance(&mut run, END_S)?;
        let found = (speed(&run) - before) / (run.time_s() - rise_s);
        let exact = GRAVITY * (SLOPE.sin() - 0.3 * SLOPE.cos());
        lines.push(CheckedNumber::value(format!("{kind}, sliding: acceleration [m/s²]"), found, exact, 0.01));
        let way_m = along_m(&run) - from;
        // Plate of 40 mm by 40 mm by 1 mm.
        let work_mj = 1e3 * 1.6e-3 * GRAVITY * 0.3 * SLOPE.cos() * way_m;
        lines.push(CheckedNumber::value(
            format!("{kind}, lost to friction [mJ]"),
            1e3 * (lost_j(&run) - lost),
            work_mj,
            0.01,
        ));
        lines.push(balance(run.ledger().residual_share()));
    }
    Ok(lines.into())
}

/// Plate of 1.6 g lying on the slope, which falls towards +x.
fn plate(friction: f64, rigid: bool) -> Result<Simulation, FemError> {
    let (sin, cos) = SLOPE.sin_cos();
    let mut mesh = generate::plate(0.04, 0.04, 4, 4, None)?;
    mesh.points.iter_mut().for_each(|p| *p = [cos * p[0], p[1], -sin * p[0]]);
    name_all(&mut mesh);
    let sheet = section(Arc::new(Orthotropic::isotropic(1e7, 0.3, 1e-3)), 1.0);
    let mut problem = problem("slope", mesh, sheet, vec![]);
    problem.gravity = Some(Gravity { g_m_s2: [0.0, 0.0, -GRAVITY], amplitude: rise(RISE_S, 1.0) });
    let shape = ObstacleShape::Plane { point: [0.0; 3], normal: [sin, 0.0, cos] };
    problem.obstacles = vec![Obstacle { shape, friction, motion: None }];
    if rigid {
        problem.rigid = vec![Rigid { set: "all".into() }];
    }
    Simulation::new(&problem)
}

/// Mean component down the slope of vectors at the nodes.
fn along(values: &[[f64; 3]]) -> f64 {
    let (sin, cos) = SLOPE.sin_cos();
    values.iter().map(|v| cos * v[0] - sin * v[2]).sum::<f64>() / values.len() as f64
}

fn along_m(run: &Simulation) -> f64 {
    along(&run.positions())
}

fn lost_j(run: &Simulation) -> f64 {
    energy_j(run, "obstacle friction")
}
