//! How far a clamped ring is felt in a pressurised cylinder.

use super::setup::*;
use crate::exact::shell::{self, ClampedCylinder};
use fem::mesh::generate::{Around, Cap, Tube, tube};
use models::fabrics::Orthotropic;

pub(super) const CHECK: Check = Check::quick(
    "clamped-ring",
    "A cylinder clamped at rigid rings under pressure and axial tension: its radius near a ring.",
    "verification::exact::shell (Timoshenko and Woinowsky-Krieger, ch. 15, with tension)",
    run,
);

const RADIUS_M: f64 = 0.04;
const LENGTH_M: f64 = 0.032;
const AROUND: usize = 32;
/// Elements along the tube: coarse, fine.
const ALONG: [usize; 2] = [40, 80];
const PRESSURE_PA: f64 = 500.0;

fn exact() -> (ClampedCylinder, f64) {
    let (young, nu, t): (f64, f64, f64) = (208e6, 0.3, 2e-4);
    // A polygon of n sides is held apart by p cos(π/n).
    let pressure_pa = PRESSURE_PA * (std::f64::consts::PI / AROUND as f64).cos();
    let shell = ClampedCylinder {
        radius_m: RADIUS_M,
        membrane_stiffness_n_per_m: young * t,
        poisson: nu,
        bending_stiffness_nm: young * t.powi(3) / (12.0 * (1.0 - nu * nu)),
        axial_tension_n_per_m: 0.5 * pressure_pa * RADIUS_M,
    };
    (shell, pressure_pa)
}

fn run() -> CheckResult {
    let (shell, pressure_pa) = exact();
    let far = shell::far_displacement_m(&shell, pressure_pa);
    let edge = shell::edge_length_m(&shell);
    let meshes = [widened(ALONG[0])?, widened(ALONG[1])?];
    // Read between the rows of nodes by the parabola through three of them.
    let at = |mesh: usize, x: f64| parabola(&meshes[mesh], x) / far;
    let known = |x: f64| shell::displacement_m(&shell, pressure_pa, x) / far;
    let mut lines =
        vec![CheckedNumber::value("widening half way, over closed form", at(1, 0.499 * LENGTH_M), 1.0, 0.01)];
    for share in [1.0, 1.5, 2.0] {
        let x = share * edge;
        let name = format!("{share} edge lengths from the ring, over half way");
        lines.push(CheckedNumber::value(name, at(1, x), known(x), 0.01));
    }
    let near = 0.75 * edge;
    let fall = rate(at(0, near) - known(near), at(1, near) - known(near), 2.0);
    lines.push(CheckedNumber::at_least("rate at 0.75 edge lengths", fall, 1.7));
    let line = (0..=100).map(|i| f64::from(i) * 0.05 * edge);
    let line = line.map(|x| [1e3 * x, 1e6 * shell::displacement_m(&shell, pressure_pa, x)]);
    let marks = meshes[1].iter().filter(|p| p[0] < 5.0 * edge).map(|p| [1e3 * p[0], 1e6 * p[1]]);
    let axes = ["distance from the ring [mm]", "widening [µm]"];
    let curves = vec![FigureCurve::exact("closed form", line), FigureCurve::engine("shells", marks)];
    Ok(CheckOutcome::drawn(lines, Figure::new("Cylinder clamped at a ring under pressure", axes, curves)))
}

/// Distance from the ring and widening of each row of nodes; the clamp acts half way between the two rows that it holds.
fn widened(along: usize) -> Result<Vec<[f64; 2]>, FemError> {
    let around = Around::Even(AROUND);
    let caps = [Cap::Quads; 2];
    let mut mesh = tube(&Tube { radius_m: RADIUS_M, length_m: LENGTH_M, around, along, caps, warp_rad: 0.0 })?;
    // A rigid cap with two rows of the wall is an end that cannot turn.
    for end in ["base", "tip"] {
        let clamped =
            [format!("{end}_cap"), format!("{end}_2")].iter().flat_map(|set| mesh.sets[set].clone()).collect();
        mesh.sets.insert(format!("{end}_clamp"), clamped);
    }
    let made = Section { rest_curvature: true, ..section(Arc::new(Orthotropic::isotropic(208e6, 0.3, 2e-4)), 1.0) };
    let ramp = rise(1e-3, PRESSURE_PA);
    let mut problem = problem("ring", mesh, made, vec![chamber("body", ramp)]);
    problem.supports = vec![hold("base_clamp", [true; 3])];
    problem.rigid = vec![Rigid { set: "tip_clamp".into() }];
    // Hourglass control grows with the square of the elements' aspect, here up to 20, and would act as a tension.
    problem.settings.hourglass = 1e-4;
    problem.settings.mass_damping_1_s = 1.2e4;
    problem.settings.end_s = 2.5e-3;
    let x = settle(&problem)?.positions();
    let h = LENGTH_M / along as f64;
    let first = problem.mesh.points.iter().zip(&x).filter(|(p, _)| p[2].abs() < 1e-9 && p[1] > 0.9 * RADIUS_M);
    Ok(first.map(|(p, x)| [p[0] - 0.5 * h, x[1] - RADIUS_M]).collect())
}

fn parabola(w: &[[f64; 2]], x: f64) -> f64 {
    let next = w.iter().position(|p| p[0] > x).unwrap_or(1).clamp(1, w.len() - 2);
    let [a, b, c] = [w[next - 1], w[next], w[next + 1]];
    let share =
        |p: [f64; 2], q: [f64; 2], r: [f64; 2]| p[1] * (x - q[0]) * (x - r[0]) / ((p[0] - q[0]) * (p[0] - r[0]));
    share(a, b, c) + share(b, a, c) + share(c, a, b)
}
