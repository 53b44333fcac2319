//! Coulomb's law on obstacles, for every kind of mass: a sheet on an incline slides or sticks, a strip is pulled round a cylinder.

use super::setup::*;
use models::fabrics::Orthotropic;

pub(super) const INCLINE: Check = Check::quick(
    "incline",
    "A sheet on an incline of 20 degrees slides by Coulomb's law, and below the friction angle it stays where it is.",
    "a = g (sin φ − μ cos φ) m/m_scaled; rest for μ > tan φ",
    incline,
);

pub(super) const CAPSTAN: Check = Check::quick(
    "capstan",
    "A strip is pulled over a quarter of a cylinder against a constant force.",
    "Euler and Eytelwein: exp(μ π/2)",
    capstan,
);

const TURN: f64 = 20.0 * std::f64::consts::PI / 180.0;
const G: f64 = 9.81;

fn incline() -> CheckResult {
    let mut lines = Vec::new();
    for (friction, thickness_m) in [(0.3, 1e-3), (0.4, 1e-3), (0.4, 1e-4)] {
        let mesh = generate::plate(0.1, 0.1, 10, 10, None)?;
        let film = Orthotropic::isotropic(50e6, 0.3, thickness_m);
        let mut problem = problem("incline", mesh, section(Arc::new(film), 1.0), vec![]);
        let shape = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
        problem.obstacles = vec![Obstacle { shape, friction, motion: None }];
        let g_m_s2 = [G * TURN.sin(), 0.0, -G * TURN.cos()];
        problem.gravity = Some(Gravity { g_m_s2, amplitude: Amplitude::Constant(1.0) });
        for (name, problem) in each_mass(&problem)? {
            let run = settle(&problem)?;
            let way = mean(&problem.mesh, "centre", &run.positions(), 0) - 0.05;
            let t = run.time_s();
            if friction < TURN.tan() {
                let carried = G * TURN.sin() - 2.0 * way / (t * t) * (1.0 + run.added_mass());
                let found = carried / (G * TURN.cos());
                lines.push(CheckedNumber::value(
                    format!("{name}: friction of the sliding sheet"),
                    found,
                    friction,
                    0.03,
                ));
            } else {
                let creep = format!("{name}: creep of a sheet of {} mm in 1 s [mm]", 1e3 * thickness_m);
                lines.push(CheckedNumber::at_most(creep, 1e3 * way.abs(), 0.05));
            }
            lines.push(balance(run.ledger().residual_share()));
        }
    }
    Ok(lines.into())
}

/// Radius of the cylinder, and length of the strip before and behind it \[m\].
const RADIUS_M: f64 = 0.05;
const FREE_M: f64 = 0.025;
/// Pull on the hanging end \[N\].
const PULL_N: f64 = 1.0;

fn capstan() -> CheckResult {
    let mut lines = Vec::new();
    for friction in [0.3, 0.6] {
        for (name, problem) in each_mass(&strip(friction)?)? {
            let mut run = Simulation::new(&problem)?;
            let (outputs, mut pull) = (20, 0.0);
            for i in 0..outputs {
                advance(&mut run, 0.3 + 0.2 * f64::from(i + 1) / f64::from(outputs))?;
                pull += pull_n(&run, "right") / f64::from(outputs);
            }
            let exact = (friction * std::f64::consts::FRAC_PI_2).exp();
            let what = format!("{name}, μ = {friction}: pull over counterforce");
            lines.push(CheckedNumber::value(what, pull / PULL_N, exact, 0.03));
            lines.push(balance(run.ledger().residual_share()));
        }
    }
    Ok(lines.into())
}

/// A strip without bending stiffness on a quarter of a cylinder; one end hangs, the other is drawn along x.
fn strip(friction: f64) -> Result<Problem, FemError> {
    let arc = RADIUS_M * std::f64::consts::FRAC_PI_2;
    let length = 2.0 * FREE_M + arc;
    let mut mesh = generate::plate(length, 5e-3, 52, 2, None)?;
    let place = |[s, y, _]: [f64; 3]| {
        let turn = ((s - FREE_M) / RADIUS_M).clamp(0.0, std::f64::consts::FRAC_PI_2);
        let (before, behind) = ((FREE_M - s).max(0.0), (s - FREE_M - arc).max(0.0));
        [behind - RADIUS_M * turn.cos(), y, RADIUS_M * turn.sin() - before]
    };
    mesh.start = mesh.points.iter().map(|p| place(*p)).collect();
    let film = Orthotropic::isotropic(50e6, 0.0, 1e-3);
    let mut problem = problem("capstan", mesh, section(Arc::new(film), 0.0), vec![]);
    let shape = ObstacleShape::Cylinder { point: [0.0; 3], axis: [0.0, 1.0, 0.0], radius_m: RADIUS_M };
    problem.obstacles = vec![Obstacle { shape, friction, motion: None }];
    let amplitude = Amplitude::Constant(1.0);
    problem.forces = vec![NodalForce { set: "left".into(), total_n: [0.0, 0.0, -PULL_N], amplitude }];
    let way = Amplitude::Linear(vec![(0.0, 0.0), (0.5, 8e-3)]);
    problem.supports = vec![drive("right", [true; 3], 0, way)];
    (problem.settings.end_s, problem.settings.mass_damping_1_s) = (0.5, 100.0);
    Ok(problem)
}
