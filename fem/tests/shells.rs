//! Laws of the shell term: the fast kernels equal the plain ones, force is minus the slope of energy, rigid motion
//! costs nothing.

#![allow(clippy::unwrap_used)]

mod plain;

use std::sync::Arc;

use fem::mesh::generate;
use fem::problem::{Amplitude, Chamber, Ply, Pressure, Problem, Section};
use fem::sheet::Sheet;
use fem::sheet::order::{Order, renumber};
use fem::{Mesh, NODE, Transient};
use models::fabrics::{FABRICS, Laminate, NeoHookean, Orthotropic, WrinklingFilm};
use models::{Fabric, Pose, Term};
use plain::PlainSheet;

fn section(fabric: Arc<dyn Fabric>, angle_rad: f64) -> Section {
    let plies = vec![Ply { fabric, angle_rad }];
    Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor: 1.0, rest_curvature: false }
}

fn chamber(name: &str, pa: f64) -> Chamber {
    Chamber { name: name.into(), pressure: Pressure::Set(Amplitude::Constant(pa)), open_axis: None }
}

fn neo_film() -> NeoHookean {
    NeoHookean::new(50.3e6, 2e-4)
}

/// A tube with quad and triangle caps, a balloon and a glued tube: regular rows, irregular quads, triangles, two chambers,
/// single and bonded plies.
fn zoo() -> Vec<(Problem, &'static str)> {
    let neo: Arc<dyn Fabric> = Arc::new(neo_film());
    let woven: Arc<dyn Fabric> = Arc::new(Orthotropic::new(96.5e6, 120e6, 0.3, 1.03e6, 5e-5));
    let mut all = Vec::new();
    let tube = generate::tube(&generate::Tube {
        radius_m: 0.04,
        length_m: 0.3,
        around: generate::Around::Even(40),
        along: 60,
        caps: [generate::Cap::Triangles, generate::Cap::Quads],
        warp_rad: 0.0,
    })
    .unwrap();
    let by_part = |wall: &Arc<dyn Fabric>, cap: &Arc<dyn Fabric>| {
        let sections = (0..tube.parts.len()).map(|p| section(if p == 1 { cap.clone() } else { wall.clone() }, 0.4));
        Problem::new("tube", tube.clone(), sections.collect(), vec![chamber("body", 2e3)])
    };
    all.push((by_part(&woven, &neo), "tube"));
    let film: Arc<dyn Fabric> = Arc::new(WrinklingFilm { film: neo_film(), load_n_per_m: 5.0 });
    all.push((by_part(&film, &film), "tube that wrinkles"));
    all.push((by_part(&film, &neo), "tube that wrinkles, with stiff caps"));
    let mut wavy = by_part(&film, &neo);
    let wave = |p: &[f64; 3]| [p[0] + 1e-3 * (90.0 * p[1]).sin(), p[1], p[2] + 1e-3 * (80.0 * p[0]).sin()];
    wavy.mesh.membrane = wavy.mesh.points.iter().map(wave).collect();
    all.push((wavy, "wavy tube"));
    all.push((striped(&tube, &[film, bonded(&[&neo, &neo]), woven.clone()]), "tube with seams along it"));
    all.push((by_part(&bonded(&[&woven, &neo, &woven]), &bonded(&[&woven, &woven])), "glued tube"));
    let disc = generate::disc_balloon(0.1, 12).unwrap();
    let sections = disc.parts.iter().map(|_| section(neo.clone(), 0.0)).collect();
    all.push((Problem::new("disc", disc, sections, vec![chamber("air", 1e3)]), "disc"));
    // Sheets that share a rim, in several patches: rows of one want the places of the other.
    let pillow = generate::pillow(0.2, 50, 1e-4).unwrap();
    let sections = pillow.parts.iter().map(|_| section(neo.clone(), 0.0)).collect();
    all.push((Problem::new("pillow", pillow, sections, vec![chamber("air", 1e3)]), "pillow"));
    all
}

/// The tube with its wall in strips of the fabrics, so that rows of elements change fabric.
fn striped(tube: &Mesh, fabrics: &[Arc<dyn Fabric>]) -> Problem {
    let mut mesh = tube.clone();
    let wall = std::mem::take(&mut mesh.parts[0].quads);
    for k in (0..fabrics.len()).rev() {
        let mut part = mesh.parts[0].clone();
        part.name = format!("strip_{k}");
        part.quads =
            wall.iter().enumerate().filter(|(e, _)| [0, 0, 1, 0, 2][e % 40 % 5] == k).map(|(_, q)| *q).collect();
        mesh.parts.insert(1, part);
    }
    mesh.parts.remove(0);
    let of = |p: usize| section(fabrics.get(p).unwrap_or(&fabrics[0]).clone(), 0.4);
    let sections = (0..mesh.parts.len()).map(of).collect();
    Problem::new("striped", mesh, sections, vec![chamber("body", 2e3)])
}

/// Plies at 0, 0.7, 1.4 rad.
fn bonded(plies: &[&Arc<dyn Fabric>]) -> Arc<dyn Fabric> {
    let ply = |(i, fabric): (usize, &&Arc<dyn Fabric>)| Ply { fabric: Arc::clone(fabric), angle_rad: 0.7 * i as f64 };
    Arc::new(Laminate::new(plies.iter().enumerate().map(ply).collect()).unwrap())
}

fn prepared(problem: &Problem) -> (Sheet, Mesh) {
    let order = Order::of(&problem.mesh);
    let mesh = renumber(&problem.mesh, &order);
    let sheet = Sheet::new(&mesh, &order, &problem.sections, &problem.chambers, &problem.settings).unwrap();
    (sheet, mesh)
}

/// Reference positions blown up and shaken by a fixed pseudo-random field of `size` times the element size.
fn shaken(mesh: &Mesh, size_m: f64) -> Vec<f64> {
    let noise = |i: usize, k: usize| ((i * 7919 + k * 104_729) as f64 * 0.618_033_988_749_9).fract() - 0.5;
    let node = |(i, p): (usize, &[f64; 3])| {
        [p[0] * 1.01 + size_m * noise(i, 0), p[1] * 1.02 + size_m * noise(i, 1), p[2] + size_m * noise(i, 2), 0.0]
    };
    mesh.points.iter().enumerate().flat_map(node).collect()
}

fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |m, x| m.max(x.abs()))
}

#[test]
fn the_fast_shells_equal_the_plain_ones() {
    for (problem, name) in zoo() {
        let (sheet, mesh) = prepared(&problem);
        let q = shaken(&mesh, 1e-3);
        let (mut fast, mut plain) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        let energy = sheet.add(&Pose::nodes(&q), &mut fast);
        let expected = PlainSheet::new(&sheet, &mesh, &problem).add(&Pose::nodes(&q), &mut plain);
        let scale = largest(&plain);
        let worst = fast.iter().zip(&plain).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(scale > 0.1, "{name}: forces of {scale} N test nothing");
        assert!(worst < 1e-11 * scale, "{name}: forces differ by {worst:e} of {scale:e} N");
        assert!((energy - expected).abs() < 1e-11 * expected.abs(), "{name}: {energy} and {expected} J");
    }
}

#[test]
fn the_force_is_minus_the_slope_of_the_energy() {
    for (problem, name) in zoo() {
        let (sheet, mesh) = prepared(&problem);
        let plain = PlainSheet::new(&sheet, &mesh, &problem);
        let q = shaken(&mesh, 1e-3);
        let mut force = vec![0.0; q.len()];
        plain.add(&Pose::nodes(&q), &mut force);
        let scale = largest(&force);
        for probe in 0..24 {
            let dof = probe * 7919 % mesh.points.len() * NODE + probe % 3;
            let energy = |step: f64| {
                let mut moved = q.clone();
                moved[dof] += step;
                plain.add(&Pose::nodes(&moved), &mut vec![0.0; q.len()])
            };
            let step = 2e-7;
            let slope =
                (energy(-2.0 * step) - 8.0 * energy(-step) + 8.0 * energy(step) - energy(2.0 * step)) / (12.0 * step);
            assert!((force[dof] + slope).abs() < 1e-6 * scale, "{name} dof {dof}: {} against {}", force[dof], -slope);
        }
    }
}

#[test]
fn a_rigid_turn_by_one_radian_leaves_stress_and_force_at_rounding() {
    for law in FABRICS {
        let fabric = (law.make)(&(law.example)()).unwrap();
        let thickness = fabric.thickness_m();
        let mesh = generate::plate(0.2, 0.1, 20, 10, None).unwrap();
        let problem = Problem::new("plate", mesh, vec![section(fabric.clone(), 0.3)], vec![]);
        let (sheet, mesh) = prepared(&problem);
        let (s, c) = 1.0_f64.sin_cos();
        let turn = |p: &[f64; 3]| [c * p[0] - s * p[2] + 0.3, p[1] - 0.2, s * p[0] + c * p[2], 0.0];
        let q: Vec<f64> = mesh.points.iter().flat_map(turn).collect();
        let mut force = vec![0.0; q.len()];
        let energy = sheet.add(&Pose::nodes(&q), &mut force);
        let stiff = fabric.tangent([0.0; 3], &[0.0; 2])[0][0];
        assert!(largest(&force) < 1e-13 * stiff, "{}: {:e} N", law.name, largest(&force));
        assert!(energy.abs() < 1e-15 * stiff * 0.02, "{}: {energy:e} J", law.name);
        let stress = largest(&sheet.fields(&q).von_mises_pa);
        assert!(stress * thickness < 1e-12 * stiff, "{}: {stress:e} Pa", law.name);
    }
}

#[test]
fn a_slack_film_is_stepped_as_if_it_were_taut_and_no_deeper() {
    let (wrinkling, _) = zoo().into_iter().find(|(_, name)| *name == "tube that wrinkles").unwrap();
    let whole = wrinkling.sections.iter().map(|_| section(Arc::new(neo_film()), 0.4)).collect();
    let bound = |problem: &Problem, size: f64| {
        let (sheet, mesh) = prepared(problem);
        let scaled: Vec<f64> = mesh.points.iter().flat_map(|p| [size * p[0], size * p[1], size * p[2], 0.0]).collect();
        let mut bound = vec![0.0; mesh.points.len()];
        sheet.stiffness_bound(&Pose::nodes(&scaled), &mut bound);
        bound
    };
    let taut = bound(&Problem { sections: whole, ..wrinkling.clone() }, 1.0);
    for size in [1.0, 0.98, 0.8] {
        let slack = bound(&wrinkling, size);
        let apart = slack.iter().zip(&taut).map(|(slack, taut)| (slack / taut - 1.0).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-9, "{size}: {apart:e}");
    }
}
