use std::sync::Arc;

use models::fabrics::Orthotropic;
use models::{Pose, Term};

use super::Folds;
use crate::mesh::generate::plate;
use crate::mesh::{Mesh, Part};
use crate::problem::{Problem, Section};
use crate::sheet::Sheet;
use crate::sheet::order::{Order, renumber};
use crate::sheet::reference::bending_stiffness;
use crate::{Tick, Transient};

const SOFT: f64 = 1.0;
const HARD: f64 = 60.0;
const SIDE_M: f64 = 0.01;

fn section(factor: f64) -> Section {
    Section::of(Arc::new(Orthotropic::isotropic(2e8, 0.3, 2e-4)), factor)
}

/// A plate 4 by 3 elements of 10 mm, its right half 60 times as stiff, and its folds.
fn folds(triangles: bool) -> (Mesh, Folds) {
    let mut mesh = plate(4.0 * SIDE_M, 3.0 * SIDE_M, 4, 3, None).unwrap();
    let middle = |mesh: &Mesh, quad: &[u32; 4]| quad.iter().map(|n| mesh.points[*n as usize][0]).sum::<f64>() / 4.0;
    let (left, right) = mesh.parts[0].quads.iter().partition(|quad| middle(&mesh, quad) < 2.0 * SIDE_M);
    let split = |quads: Vec<[u32; 4]>| quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let part = |name: &str, quads: Vec<[u32; 4]>| match triangles {
        true => Part { name: name.into(), triangles: split(quads), ..Part::default() },
        false => Part { name: name.into(), quads, ..Part::default() },
    };
    mesh.parts = vec![part("soft", left), part("hard", right)];
    let sections = vec![section(SOFT), section(HARD)];
    let problem = Problem::new("folds", mesh, sections, vec![]);
    let order = Order::of(&problem.mesh);
    let mesh = renumber(&problem.mesh, &order);
    let sheet = Sheet::new(&mesh, &order, &problem.sections, &[], &problem.settings).unwrap();
    let stiffness: Vec<f64> = problem.sections.iter().map(bending_stiffness).collect();
    let folds = Folds::new(&mesh, &sheet, &stiffness);
    (mesh, folds)
}

fn placed(mesh: &Mesh, place: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
    mesh.points.iter().map(|p| place(*p)).flat_map(|p| [p[0], p[1], p[2], 0.0]).collect()
}

/// Left half flat and stretched by `strain` across the edge, right half turned up by an angle, nothing stretched there.
fn turned(mesh: &Mesh, angle: f64, strain: f64) -> Vec<f64> {
    placed(mesh, |[x, y, _]| {
        let beyond = x - 2.0 * SIDE_M;
        if beyond < 0.0 {
            return [beyond * (1.0 + strain), y, 0.0];
        }
        [beyond * angle.cos(), y, beyond * angle.sin()]
    })
}

fn advance(folds: &mut Folds, q: &[f64], step: u64) -> f64 {
    let tick = Tick { step, time_s: 0.0, dt_s: 1e-5 };
    folds.advance(&Pose::nodes(q), &tick, &mut vec![0.0; q.len()])
}

#[test]
fn without_tension_a_fold_is_two_compliances_in_series() {
    let d = bending_stiffness(&section(SOFT));
    let (length, series) = (3.0 * SIDE_M, 2.0 / (SIDE_M / d + SIDE_M / (HARD * d)));
    for triangles in [false, true] {
        let (mesh, folds) = folds(triangles);
        for angle in [0.1_f64, 1.0, 2.4] {
            let q = turned(&mesh, angle, 0.0);
            let energy = folds.add(&Pose::nodes(&q), &mut vec![0.0; q.len()]);
            let exact = 4.0 * series * length * (1.0 - (0.5 * angle).cos());
            assert!((energy / exact - 1.0).abs() < 1e-12, "{angle}: {energy} against {exact}");
        }
    }
}

#[test]
fn under_tension_a_fold_and_the_links_beside_it_are_as_stiff_as_the_elastica() {
    let (mesh, mut folds) = folds(false);
    let d = bending_stiffness(&section(SOFT));
    let strain = 0.05;
    let tension = 2e8 * 2e-4 / (1.0 - 0.09) * strain * (1.0 + 0.5 * strain);
    let q = turned(&mesh, 1.0, strain);
    for look in 0..200 {
        advance(&mut folds, &q, look * 32 + 31);
    }
    let energy = folds.add(&Pose::nodes(&q), &mut vec![0.0; q.len()]);
    // The hard side turns too: without tension in it, it is a chain of links.
    let hard = 2.0 * HARD * d / SIDE_M;
    // In series with an endless chain of links under tension, Z² = T h Z + T D, the fold is the elastica's √(D T).
    let pull = 0.5 * tension * SIDE_M;
    let (whole, chain) = ((d * tension).sqrt(), pull + (pull * pull + tension * d).sqrt());
    let soft = 1.0 / (1.0 / whole - 1.0 / chain);
    let turn = (1.0 + strain - 1.0_f64.cos()).hypot(1.0_f64.sin());
    let exact = 4.0 / (1.0 / soft + 1.0 / hard) * 3.0 * SIDE_M * (1.0 - (1.0 - 0.25 * turn * turn).sqrt());
    assert!((energy / exact - 1.0).abs() < 1e-9, "{energy} against {exact}");
    let ledger = folds.ledger(&Pose::nodes(&q));
    assert!((ledger[1].energy_j / energy - 1.0).abs() < 0.2, "what tension did is the energy that came: {ledger:?}");
}

#[test]
fn the_force_is_minus_the_slope_of_the_energy_and_turns_with_the_sheet() {
    for triangles in [false, true] {
        let (mesh, mut folds) = folds(triangles);
        let noise = |i: usize| ((i * 7919) as f64 * 0.618_033_988_749_9).fract() - 0.5;
        let mut q = turned(&mesh, 1.3, 2e-3);
        q.iter_mut().enumerate().filter(|(i, _)| i % 4 < 3).for_each(|(i, x)| *x += 2e-3 * noise(i));
        advance(&mut folds, &q, 31);
        let mut force = vec![0.0; q.len()];
        folds.add(&Pose::nodes(&q), &mut force);
        let largest = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        for dof in (0..q.len()).filter(|dof| dof % 4 < 3) {
            let energy = |step: f64| {
                let mut moved = q.clone();
                moved[dof] += step;
                folds.add(&Pose::nodes(&moved), &mut vec![0.0; q.len()])
            };
            let h = 1e-5;
            let slope = (energy(-2.0 * h) - 8.0 * energy(-h) + 8.0 * energy(h) - energy(2.0 * h)) / (12.0 * h);
            assert!((force[dof] + slope).abs() < 1e-7 * largest, "{dof}: {} against {}", force[dof], -slope);
        }
        let nodes = force.as_chunks::<4>().0.iter().zip(q.as_chunks::<4>().0);
        let mut sums = [0.0; 6];
        for (f, x) in nodes {
            (0..3).for_each(|k| sums[k] += f[k]);
            (0..3).for_each(|k| {
                sums[3 + k] += (x[(k + 1) % 3] * f[(k + 2) % 3] - x[(k + 2) % 3] * f[(k + 1) % 3]) / SIDE_M
            });
        }
        assert!(sums.iter().all(|s| s.abs() < 1e-12 * largest), "no net force and moment: {sums:?}");
    }
}

#[test]
fn a_restored_fold_goes_on_with_the_same_bits() {
    let (mesh, mut folds) = folds(false);
    let fresh = folds.clone();
    let q = turned(&mesh, 0.7, 1e-3);
    for look in 0..5 {
        advance(&mut folds, &q, look * 32 + 31);
    }
    let mut again = fresh.clone();
    assert!(again.restore(&folds.save()).is_some());
    assert_eq!(again.ledger(&Pose::nodes(&q)), folds.ledger(&Pose::nodes(&q)));
    assert_eq!(advance(&mut again, &q, 191).to_bits(), advance(&mut folds, &q, 191).to_bits());
    assert!(fresh.clone().restore(&folds.save()[1..]).is_none());
}

#[test]
fn a_sheet_of_one_stiffness_has_no_folds() {
    let mesh = plate(0.1, 0.1, 4, 4, None).unwrap();
    let problem = Problem::new("plain", mesh, vec![section(SOFT)], vec![]);
    let order = Order::of(&problem.mesh);
    let mesh = renumber(&problem.mesh, &order);
    let sheet = Sheet::new(&mesh, &order, &problem.sections, &[], &problem.settings).unwrap();
    assert!(Folds::new(&mesh, &sheet, &[bending_stiffness(&section(SOFT))]).is_empty());
}
