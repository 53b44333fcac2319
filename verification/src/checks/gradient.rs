//! Force = −∂E/∂x of every term.

use super::setup::*;
use fem::contact::LayerContact;
use fem::mesh::generate::{Around, Cap, Tube, crossed_sheets, tube};
use fem::problem;
use fem::terms::{DeadLoads, Obstacles, RestCurvature};
use fem::{Tick, Transient};
use models::fabrics::{NeoHookean, Orthotropic};
use models::{Pose, Term};

pub(super) const CHECK: Check = Check::quick(
    "force-is-slope",
    "The force of every term is minus the slope of its energy, at random positions.",
    "virtual work; central differences of fourth order",
    run,
);

/// Largest error over the largest force.
const LIMIT: f64 = 1e-6;
const PROBES: usize = 30;

fn run() -> CheckResult {
    let mesh = tube(&Tube {
        radius_m: 0.04,
        length_m: 0.1,
        around: Around::Even(16),
        along: 10,
        caps: [Cap::Triangles, Cap::Quads],
        warp_rad: 0.3,
    })?;
    let wall = Section { rest_curvature: true, ..section(Arc::new(NeoHookean::new(50.3e6, 2e-4)), 1.0) };
    let woven = Arc::new(Orthotropic::new(96.5e6, 120e6, 0.3, 1.03e6, 5e-5));
    let cap = Section { plies: vec![Ply { fabric: woven, angle_rad: 0.4 }], ..wall.clone() };
    let sections = vec![wall.clone(), cap, wall];
    let problem = Problem::new("zoo", mesh, sections, vec![chamber("body", Amplitude::Constant(2e3))]);
    let (sheet, mesh, _) = shells(&problem)?;
    let q = shaken(&mesh, 1e-3);
    let rest = RestCurvature::new(&mesh, &problem.sections);
    let mut lines = Vec::new();
    let mut judge = |name: &str, term: &dyn Term, q: &[f64], step_m: f64| {
        lines.push(CheckedNumber::at_most(
            format!("{name}: error over largest force"),
            slope_error(term, q, PROBES, step_m),
            LIMIT,
        ));
    };
    judge("shells", &sheet, &q, 2e-7);
    judge("rest curvature", &rest, &q, 1e-4);
    for term in loads(&mesh, &sheet.masses(mesh.points.len()))? {
        judge(term.line().name, &*term, &q, 1e-6);
    }
    let (contact, x) = pressed()?;
    judge("contact", &contact, &x, 5e-10);
    Ok(lines.into())
}

fn loads(mesh: &Mesh, mass_kg: &[f64]) -> Result<Vec<Box<dyn Term>>, FemError> {
    let force = NodalForce { set: "tip".into(), total_n: [3.0, -2.0, 1.0], amplitude: Amplitude::Constant(0.7) };
    let gravity = problem::Gravity { g_m_s2: [1.0, 2.0, -9.81], amplitude: Amplitude::Constant(1.0) };
    let solids = [
        ObstacleShape::Plane { point: [0.0, 0.0, -0.02], normal: [0.1, 0.0, 1.0] },
        ObstacleShape::Cylinder { point: [0.05, 0.0, 0.07], axis: [0.0, 1.0, 0.1], radius_m: 0.05 },
    ];
    let solids = solids.map(|shape| Obstacle { shape, friction: 0.0, motion: None });
    let stiffness = vec![1e4; mesh.points.len()];
    Ok(vec![
        Box::new(DeadLoads::forces(mesh, &[force])?),
        Box::new(DeadLoads::gravity(&gravity, mass_kg)?),
        Box::new(Obstacles::new(mesh, &solids, &stiffness)?),
    ])
}

/// Two crossed sheets pressed into each other by half of the gap between them.
fn pressed() -> Result<(LayerContact, Vec<f64>), FemError> {
    let mesh = crossed_sheets(0.06, 0.04, 6, 1e-4)?;
    let contact = problem::Contact { friction: 0.0, ..problem::Contact::default() };
    let mut contact = LayerContact::new(&mesh, &contact, &vec![1e-5; mesh.points.len()], 4e-6)?;
    let mut q: Vec<f64> = Vec::new();
    for (i, p) in mesh.points.iter().enumerate() {
        let down = if p[2] > 5e-5 { -1.5e-4 } else { 0.0 };
        q.extend([p[0] + 2e-5 * noise(i, 0), p[1] + 2e-5 * noise(i, 1), p[2] + down + 2e-5 * noise(i, 2), 0.0]);
    }
    let tick = Tick { step: 0, time_s: 0.0, dt_s: 4e-6 };
    contact.advance(&Pose::nodes(&q), &tick, &mut vec![0.0; q.len()]);
    Ok((contact, q))
}

fn shaken(mesh: &Mesh, size_m: f64) -> Vec<f64> {
    let node = |(i, p): (usize, &[f64; 3])| {
        [p[0] * 1.01 + size_m * noise(i, 0), p[1] * 1.02 + size_m * noise(i, 1), p[2] + size_m * noise(i, 2), 0.0]
    };
    mesh.points.iter().enumerate().flat_map(node).collect()
}
