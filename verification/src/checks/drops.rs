//! Things dropped on each other: no body passes through another, no energy is created, momentum stays.

use super::apart::{clearance_m, heights, masses, momentum, nodes, triangles};
use super::setup::*;
use models::fabrics::NeoHookean;

pub(super) const BALL_ON_FLOOR: Check = Check::quick(
    "ball-on-floor",
    "An inflated ball dropped on a rigid floor stays above it and bounces without gaining energy.",
    "conservation of energy",
    ball_on_floor,
);

pub(super) const BALL_ON_SHEET: Check = Check::quick(
    "ball-on-sheet",
    "An inflated ball dropped on a free sheet never passes through it and hands over exactly the momentum it loses.",
    "conservation of momentum and energy",
    ball_on_sheet,
);

pub(super) const CROSSED: Check = Check::quick(
    "crossed-sheets",
    "Two strips dropped crosswise on each other never swap sides and keep their momentum.",
    "conservation of momentum and energy",
    crossed,
);

const OUTPUTS: usize = 30;
const BALL_M: f64 = 0.05;
/// Speed at which things are dropped \[m/s\].
const SPEED: f64 = 2.0;

fn fabric() -> Section {
    section(Arc::new(NeoHookean::new(50.3e6, 2e-4)), 0.1)
}

/// Gas that rises to 5 kPa within 4 ms.
fn air() -> Chamber {
    chamber("air", rise(4e-3, 5e3))
}

fn ball(height_m: f64) -> Result<Mesh, FemError> {
    let mut ball = generate::sphere(BALL_M, 8)?;
    ball.points.iter_mut().for_each(|p| p[2] += height_m);
    Ok(ball)
}

/// Nodes of the part called `falling` move down, the others rest.
fn drop(run: &mut Simulation, mesh: &Mesh, falling: &str) {
    let mut v = vec![[0.0; 3]; mesh.points.len()];
    for part in mesh.parts.iter().filter(|part| part.name == falling) {
        nodes(part).into_iter().for_each(|n| v[n] = [0.0, 0.0, -SPEED]);
    }
    run.set_velocities(&v);
}

/// Runs to `end_s` and gives the extremes of what `look` sees at every output, and of the energy residual.
fn watch(run: &mut Simulation, end_s: f64, look: &dyn Fn(&Simulation) -> f64) -> Result<[f64; 2], FemError> {
    let (mut least, mut residual) = (f64::INFINITY, 0.0_f64);
    for i in 1..=OUTPUTS {
        advance(run, end_s * i as f64 / OUTPUTS as f64)?;
        least = least.min(look(run));
        residual = residual.max(run.ledger().residual_share());
    }
    Ok([least, residual])
}

fn ball_on_floor() -> CheckResult {
    let mesh = ball(BALL_M + 0.01)?;
    let mass = masses(&mesh, &[0.2]);
    let total: f64 = mass.iter().sum();
    let mut problem = Problem::new("ball", mesh.clone(), vec![fabric()], vec![air()]);
    let shape = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    problem.obstacles = vec![Obstacle { shape, friction: 0.2, motion: None }];
    let mut run = Simulation::new(&problem)?;
    drop(&mut run, &mesh, "sphere");
    let lowest = |run: &Simulation| run.positions().iter().fold(f64::INFINITY, |m, p| m.min(p[2]));
    let [lowest, residual] = watch(&mut run, 0.03, &lowest)?;
    let rebound = momentum(&mass, &run.velocities())[2] / total;
    Ok(vec![
        CheckedNumber::at_most("deepest node below the floor [mm]", -1e3 * lowest, 0.1),
        CheckedNumber::between("rebound speed over impact speed", rebound / SPEED, 0.3, 1.0),
        balance(residual),
    ]
    .into())
}

fn ball_on_sheet() -> CheckResult {
    let mut mesh = generate::plate(0.16, 0.16, 14, 14, None)?;
    mesh.points.iter_mut().for_each(|p| (0..2).for_each(|k| p[k] -= 0.08));
    mesh.append(ball(BALL_M + 0.01)?)?;
    mesh.parts[1].layer = 1;
    let mut problem = problem("ball and sheet", mesh.clone(), fabric(), vec![air()]);
    problem.contact = Some(Contact { friction: 0.2, ..Contact::default() });
    let mut run = Simulation::new(&problem)?;
    drop(&mut run, &mesh, "sphere");
    let clear = |run: &Simulation| outside_m(&mesh, &run.positions());
    let lines = collision(&mut run, &mesh, 0.025, "sphere", &clear)?;
    Ok(lines.into())
}

/// Smallest distance along z of the ball above the sheet, of a ball that may roll the sheet round itself: nodes of the
/// sheet count as inside where the ball is both above and below them.
fn outside_m(mesh: &Mesh, x: &[[f64; 3]]) -> f64 {
    let (sheet, ball) = (&mesh.parts[0], &mesh.parts[1]);
    let (below, around) = (triangles(sheet, x), triangles(ball, x));
    let over = nodes(ball).into_iter().flat_map(|n| heights(&below, x[n]));
    let inside = |n: usize| {
        let heights = heights(&around, x[n]);
        let above = heights.iter().copied().filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min);
        let under = heights.iter().map(|h| -h).filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min);
        if above.is_finite() && under.is_finite() { -above.min(under) } else { f64::INFINITY }
    };
    let wrapped = nodes(sheet).into_iter().map(inside);
    over.chain(wrapped).fold(f64::INFINITY, f64::min)
}

fn crossed() -> CheckResult {
    let mesh = generate::crossed_sheets(0.12, 0.04, 8, 4e-3)?;
    let mut problem = problem("crossed sheets", mesh.clone(), fabric(), vec![]);
    problem.contact = Some(Contact { friction: 0.3, ..Contact::default() });
    let mut run = Simulation::new(&problem)?;
    drop(&mut run, &mesh, "upper");
    let clear = |run: &Simulation| clearance_m(&mesh.parts[1], &mesh.parts[0], &run.positions());
    let lines = collision(&mut run, &mesh, 0.02, "upper", &clear)?;
    Ok(lines.into())
}

/// Two free bodies of the same areal mass, one thrown at the other.
fn collision(
    run: &mut Simulation,
    mesh: &Mesh,
    end_s: f64,
    thrown: &str,
    clear: &dyn Fn(&Simulation) -> f64,
) -> Result<Vec<CheckedNumber>, FemError> {
    let mass = masses(mesh, &[0.2, 0.2]);
    let start = momentum(&mass, &run.velocities());
    let [clear, residual] = watch(run, end_s, clear)?;
    let end = momentum(&mass, &run.velocities());
    let changed = (0..3).map(|k| (end[k] - start[k]).abs()).fold(0.0, f64::max);
    let hit = mesh.parts.iter().filter(|p| p.name != thrown).flat_map(nodes);
    let v = run.velocities();
    let given: f64 = hit.map(|n| mass[n] * v[n][2]).sum();
    Ok(vec![
        CheckedNumber::at_least("smallest distance between the two [mm], negative on the wrong side", 1e3 * clear, 0.0),
        CheckedNumber::at_least("momentum handed over, share", given / start[2], 0.1),
        CheckedNumber::at_most("change of momentum, share", changed / start[2].abs(), 1e-10),
        balance(residual),
    ])
}
