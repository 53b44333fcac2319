//! Folds next to stiff strips, and the pouch that folds along all of its edges.

use super::setup::*;
use crate::exact::fold::stiffened_moments_n;
use crate::exact::pouch::{Pouch, contraction, sealed_theta, sealed_volume_m3};
use fem::mesh::generate::{flat_tube, plate};
use fem::mesh::{Part, Tie};
use fem::sheet;
use models::fabrics::{NeoHookean, Orthotropic, WrinklingFilm};

pub(super) const STRIP: Check = Check::quick(
    "fold",
    "A strip D | 60 D | D is pulled at both ends at 60° to its stiff middle: its moments there are the elastica's on any mesh.",
    "verification::exact::fold, the elastica behind a stiff strip",
    strip,
);

pub(super) const SEALED: Check = Check::slow(
    "sealed-pouch",
    "A pouch sealed along all four edges, two of them straight, is blown up without load: what it holds and how far it contracts.",
    "verification::exact::pouch::sealed_volume_m3, calibrated on finer meshes of such pouches",
    sealed,
);

/// √(D/T) \[m\], pull per width \[N/m\], angle of the pull, half length of the stiff part \[m\].
const FOLD_M: f64 = 1e-3;
const PULL_N_M: f64 = 100.0;
const ANGLE: f64 = std::f64::consts::FRAC_PI_3;
const HALF_M: f64 = 7.5e-3;
const STIFFER: f64 = 60.0;
/// Length of each soft part \[m\]: the pull's direction is reached to e⁻²⁴.
const SOFT_M: f64 = 24e-3;
const STRAIN: f64 = 1e-3;
const END_S: f64 = 0.02;

fn strip() -> CheckResult {
    let soft = PULL_N_M * FOLD_M * FOLD_M;
    let [at_middle, at_edge] = stiffened_moments_n(soft, STIFFER * soft, HALF_M, PULL_N_M, ANGLE);
    let mut errors = Vec::new();
    let mut lines = Vec::new();
    for elements in [2, 6, 12, 24, 48] {
        let [middle, edge] = strip_moments_n(elements)?;
        let size = SOFT_M / elements as f64 / FOLD_M;
        lines.push(CheckedNumber::value(
            format!("moment per width at the edge, elements of {size} √(D/T) [N]"),
            edge,
            at_edge,
            0.03,
        ));
        lines.push(CheckedNumber::value("at the middle [N]", middle, at_middle, 0.03));
        errors.push(middle - at_middle);
    }
    lines.push(CheckedNumber::at_least(
        "rate at the middle from 1 to 0.5 √(D/T)",
        rate(errors[3], errors[4], 2.0),
        1.9,
    ));
    Ok(lines.into())
}

/// Moments of the force at one end about the middle and about the edge of the stiff part, per width \[N\].
fn strip_moments_n(elements: usize) -> Result<[f64; 2], FemError> {
    let size = SOFT_M / elements as f64;
    // The stiff part bends over √(60 D/T), which its own elements have to follow; the soft one need not.
    let stiff = ((HALF_M / size).round() as usize).max(3);
    let half: Vec<f64> = (0..=stiff)
        .map(|i| HALF_M * i as f64 / stiff as f64)
        .chain((1..=elements).map(|i| HALF_M + size * i as f64))
        .collect();
    let places: Vec<f64> = half.iter().skip(1).rev().map(|x| -x).chain(half.iter().copied()).collect();
    let n = places.len() - 1;
    let width = 2.0 * size;
    let mut mesh = plate(1.0, width, n, 2, None)?;
    mesh.points.iter_mut().enumerate().for_each(|(k, p)| p[0] = places[k % places.len()]);
    let row = places.len() as u32;
    for i in 0..row {
        mesh.ties.extend([i, 2 * row + i].map(|node| Tie { node, to: vec![(row + i, 1.0)] }));
    }
    mesh.sets.insert("line".into(), (row..2 * row).collect());
    mesh.sets.insert("middle".into(), vec![row + (n / 2) as u32]);
    mesh.parts = split(&mesh, HALF_M);
    let mut problem = Problem::new("fold", mesh, vec![sheet_of(1.0), sheet_of(STIFFER)], vec![]);
    let pull = |set: &str, sign: f64| NodalForce {
        set: set.into(),
        total_n: [sign * ANGLE.cos(), 0.0, -ANGLE.sin()].map(|f| f * PULL_N_M * width),
        amplitude: rise(0.25 * END_S, 1.0),
    };
    problem.forces = vec![pull("right", 1.0), pull("left", -1.0)];
    problem.supports = vec![hold("middle", [true; 3]), hold("line", [false, true, false])];
    problem.settings.end_s = END_S;
    problem.settings.mass_damping_1_s = 2000.0;
    let x = settle(&problem)?.positions();
    let end = x[(2 * row - 1) as usize];
    let moment = |about: usize| {
        let lever = [0, 2].map(|k| end[k] - x[row as usize + about][k]);
        PULL_N_M * (lever[0] * ANGLE.sin() + lever[1] * ANGLE.cos()).abs()
    };
    Ok([moment(n / 2), moment(n / 2 + stiff)])
}

/// The plate's elements within `half_m` of the middle, and the others before them.
fn split(mesh: &Mesh, half_m: f64) -> Vec<Part> {
    let middle = |quad: &[u32; 4]| quad.iter().map(|n| mesh.points[*n as usize][0]).sum::<f64>() / 4.0;
    let (soft, stiff) = mesh.parts[0].quads.iter().partition(|quad| middle(quad).abs() > half_m);
    let part = |name: &str, quads: Vec<[u32; 4]>| Part { name: name.into(), quads, ..Part::default() };
    vec![part("soft", soft), part("stiff", stiff)]
}

/// A sheet that hardly stretches, with `factor` times the target D.
fn sheet_of(factor: f64) -> Section {
    const THICKNESS_M: f64 = 5e-5;
    let plain = section(Arc::new(Orthotropic::isotropic(PULL_N_M / STRAIN / THICKNESS_M, 0.0, THICKNESS_M)), 1.0);
    let own = sheet::reference::bending_stiffness(&plain);
    Section { bending_factor: factor * PULL_N_M * FOLD_M * FOLD_M / own, ..plain }
}

fn sealed() -> CheckResult {
    let mut lines = Vec::new();
    for ratio in [2.0 / 3.0, 1.0, 1.5, 2.0, 4.0] {
        let pouch = Pouch { length_m: 0.06, width_m: ratio * 0.06 };
        let theta = sealed_theta(&pouch);
        let [ends, holds] = blown(&pouch)?;
        lines.push(CheckedNumber::value(
            format!("W/L = {ratio:.3}: volume [cm³]"),
            1e6 * holds,
            1e6 * sealed_volume_m3(&pouch, theta),
            0.03,
        ));
        lines.push(CheckedNumber::value(format!("W/L = {ratio:.3}: contraction"), ends, contraction(theta), 0.03));
    }
    Ok(lines.into())
}

/// Contraction and volume \[m³\] of a pouch of fabric that hardly stretches, wrinkles freely and does not resist bending.
fn blown(pouch: &Pouch) -> Result<[f64; 2], FemError> {
    const ALONG: usize = 24;
    let across = 2 * (0.5 * ALONG as f64 * pouch.width_m / pouch.length_m).round() as usize;
    let mesh = flat_tube(pouch.width_m, pouch.length_m, across, ALONG, 0.0, 2e-5)?;
    let film = WrinklingFilm { film: NeoHookean::new(1e8, 1e-4), load_n_per_m: 1.0 };
    let air = chamber("air", rise(0.05, 1e3));
    let mut problem = problem("sealed pouch", mesh, section(Arc::new(film), 0.0), vec![air]);
    problem.supports = vec![hold("end_0", [true; 3])];
    problem.rigid = vec![Rigid { set: "end_1".into() }];
    problem.settings.mass_damping_1_s = 100.0;
    problem.settings.hourglass = 5e-4;
    problem.settings.imperfection = 1e-3;
    problem.settings.end_s = 0.15;
    let run = settle(&problem)?;
    let ends = 1.0 - mean(&problem.mesh, "end_1", &run.positions(), 0) / pouch.length_m;
    Ok([ends, volume_m3(&run)])
}
