//! Strips in bending: cantilevers with small and large rotations, and a strip that rolls up to its rest curvature.
//!
//! The strip is two elements wide; its edges copy the line between them, as in a wide strip that bends to a cylinder. The
//! clamp holds two rows of nodes and acts half way between them.

use super::setup::*;
use crate::exact::elastica;
use fem::mesh::{Tie, generate::plate};
use models::fabrics::Orthotropic;

pub(super) const SMALL: Check = Check::quick(
    "strip",
    "A clamped strip droops under its weight, or turns under an end moment, as a plate of stiffness D does.",
    "Timoshenko and Woinowsky-Krieger, ch. 1",
    small,
);

pub(super) const LARGE: Check = Check::quick(
    "elastica",
    "A clamped strip under a tip force bends far: deflection and shortening of the elastica.",
    "verification::exact::elastica (Bisshopp and Drucker 1945)",
    large,
);

pub(super) const ROLL: Check = Check::quick(
    "rest-curvature",
    "A strip that was made round but starts flat rolls up to its own radius and ends without energy.",
    "the reference shape itself",
    roll,
);

/// Distance from the clamp to the tip \[m\].
const LENGTH_M: f64 = 0.1;
const YOUNG_PA: f64 = 100e6;
const POISSON: f64 = 0.3;
const THICKNESS_M: f64 = 1e-3;
const DENSITY: f64 = 1000.0;

fn stiffness_nm() -> f64 {
    elastica::plate_bending_stiffness_nm(YOUNG_PA, POISSON, THICKNESS_M)
}

fn strip_section() -> Section {
    section(Arc::new(Orthotropic::isotropic(YOUNG_PA, POISSON, THICKNESS_M)), 1.0)
}

/// Strip of n elements, clamped half an element from its end, with sets `clamp`, `line` (by x), `last`, `before`.
fn strip(length_m: f64, n: usize) -> Result<Mesh, FemError> {
    let h = length_m / (n as f64 - 0.5);
    let mut mesh = plate(n as f64 * h, 2.0 * h, n, 2, None)?;
    let row = n as u32 + 1;
    let line: Vec<u32> = (row..2 * row).collect();
    for i in 0..row {
        mesh.ties.extend([i, 2 * row + i].map(|node| Tie { node, to: vec![(row + i, 1.0)] }));
    }
    mesh.sets.insert("clamp".into(), line[..2].to_vec());
    mesh.sets.insert("last".into(), vec![line[n]]);
    mesh.sets.insert("before".into(), vec![line[n - 1]]);
    mesh.sets.insert("line".into(), line);
    Ok(mesh)
}

/// A strip at rest after its load has grown over half of the time; places of its line.
fn rest(mut problem: Problem, end_s: f64, damping_1_s: f64) -> Result<Vec<[f64; 3]>, FemError> {
    problem.supports = vec![hold("clamp", [true; 3])];
    problem.settings.end_s = end_s;
    problem.settings.mass_damping_1_s = damping_1_s;
    let x = settle(&problem)?.positions();
    Ok(problem.mesh.sets["line"].iter().map(|n| x[*n as usize]).collect())
}

fn ramp(end_s: f64) -> Amplitude {
    rise(0.5 * end_s, 1.0)
}

/// A few times the strip's slowest period, and damping that leaves nothing of it.
const SETTLE: (f64, f64) = (0.8, 60.0);

fn cantilever(n: usize, load: impl Fn(&mut Problem, f64)) -> Result<Vec<[f64; 3]>, FemError> {
    let mut problem = Problem::new("strip", strip(LENGTH_M, n)?, vec![strip_section()], vec![]);
    load(&mut problem, LENGTH_M / (n as f64 - 0.5));
    rest(problem, SETTLE.0, SETTLE.1)
}

fn force(set: &str, total_n: [f64; 3]) -> NodalForce {
    NodalForce { set: set.to_owned(), total_n, amplitude: ramp(SETTLE.0) }
}

fn small() -> CheckResult {
    let d = stiffness_nm();
    // A droop of 1/500 of the length: rotations stay below 0.003.
    let g = 0.002 * LENGTH_M * 8.0 * d / LENGTH_M.powi(4) / (DENSITY * THICKNESS_M);
    let exact = elastica::weight_deflection_m(d, LENGTH_M, DENSITY * THICKNESS_M * g);
    let mut droop = Vec::new();
    for n in [5, 10, 20] {
        let weight = Gravity { g_m_s2: [0.0, 0.0, g], amplitude: ramp(SETTLE.0) };
        droop.push(cantilever(n, |p, _| p.gravity = Some(weight.clone()))?[n][2]);
    }
    let n = 20;
    let turn = 0.01;
    let x = cantilever(n, |p, h| {
        // The moment per width on the strip of two elements; a couple on its last two rows.
        let couple = turn * d / ((n - 1) as f64 * h) * 2.0 * h / h;
        p.forces = vec![force("last", [0.0, 0.0, couple]), force("before", [0.0, 0.0, -couple])];
    })?;
    let slope = (x[n][2] - x[n - 1][2]).atan2(x[n][0] - x[n - 1][0]);
    Ok(vec![
        CheckedNumber::value("tip of the drooping strip, 20 elements [m]", droop[2], exact, 0.01),
        CheckedNumber::at_least("rate", rate(droop[1] - exact, droop[2] - exact, 2.0), 1.9),
        CheckedNumber::value("tip's turn under an end moment [rad]", slope, turn, 1e-3),
    ]
    .into())
}

fn large() -> CheckResult {
    let load = 3.0;
    let exact = elastica::cantilever(load);
    let mut errors = Vec::new();
    let mut curve = Vec::new();
    let mut tip = [0.0; 2];
    for n in [10, 20, 40] {
        let bent = cantilever(n, |p, h| {
            let total = load * stiffness_nm() * 2.0 * h / LENGTH_M.powi(2);
            p.forces = vec![force("last", [0.0, 0.0, total])];
        })?;
        let clamp = 0.5 * LENGTH_M / (n as f64 - 0.5);
        tip = [bent[n][2] / LENGTH_M, 1.0 - (bent[n][0] - clamp) / LENGTH_M];
        errors.push([tip[0] - exact.deflection, tip[1] - exact.shortening]);
        curve = bent.iter().map(|x| [1e3 * (x[0] - clamp), 1e3 * x[2]]).collect();
    }
    let lines = vec![
        CheckedNumber::value("deflection over length", tip[0], exact.deflection, 0.01),
        CheckedNumber::value("shortening over length", tip[1], exact.shortening, 0.01),
        CheckedNumber::at_least("rate of the deflection", rate(errors[1][0], errors[2][0], 2.0), 1.8),
        CheckedNumber::at_least("rate of the shortening", rate(errors[1][1], errors[2][1], 2.0), 1.8),
    ];
    let line = elastica::cantilever_line(load, 60).into_iter().map(|x| x.map(|x| 1e3 * LENGTH_M * x));
    let curves = vec![FigureCurve::engine("strip of 40 elements", curve), FigureCurve::exact("elastica", line)];
    let axes = ["along the clamp [mm]", "across [mm]"];
    Ok(CheckOutcome::drawn(lines, Figure::new("Cantilever under a tip force, F L²/B = 3", axes, curves)))
}

fn roll() -> CheckResult {
    let (n, radius) = (20, 0.05);
    let mut mesh = strip(LENGTH_M, n)?;
    // Chords keep their length, so the flat start is unstretched.
    let chord = mesh.points[1][0];
    let angle = 2.0 * (0.5 * chord / radius).asin();
    mesh.start = mesh.points.clone();
    for p in &mut mesh.points {
        let a = p[0] / chord * angle;
        *p = [radius * a.sin(), p[1], radius * (1.0 - a.cos())];
    }
    let made = Section { rest_curvature: true, ..strip_section() };
    let mut problem = Problem::new("roll", mesh, vec![made], vec![]);
    problem.supports = vec![hold("clamp", [true; 3])];
    problem.settings.end_s = 0.6;
    problem.settings.mass_damping_1_s = SETTLE.1;
    let run = settle(&problem)?;
    let x = run.positions();
    let line: Vec<[f64; 3]> = problem.mesh.sets["line"].iter().map(|i| x[*i as usize]).collect();
    let heading = |i: usize| (line[i + 1][2] - line[i][2]).atan2(line[i + 1][0] - line[i][0]);
    let (turn, made) = (heading(n - 1) - heading(0), (n - 1) as f64 * angle);
    let flat = 0.5 * stiffness_nm() / (radius * radius) * 2.0 * chord * (n - 1) as f64 * chord;
    let held: f64 = run.ledger().rows.iter().filter(|r| r.kind == models::RowKind::Stored).map(|r| r.energy_j).sum();
    Ok(vec![
        CheckedNumber::value("turn from clamp to tip [rad]", turn, made, 1e-4),
        CheckedNumber::at_most("energy left over the flat strip's", held.abs() / flat, 1e-6),
    ]
    .into())
}
