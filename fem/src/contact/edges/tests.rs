use std::sync::Arc;

use models::fabrics::NeoHookean;
use models::{Pose, Term};

use super::Edges;
use super::hold::EdgeStep;
use crate::contact::tests::rig::{Noise, masses, sheet};
use crate::problem::{self, Ply, Section};
use crate::shared_tests::{piercings, pouch};
use crate::vec3::{add, cross, node};
use crate::{Mesh, Problem, Simulation};
use crate::{Tick, Transient};

const DT_S: f64 = 4e-6;

/// Two strips one element wide that cross at right angles between their nodes, the second `height_m` above the first.
fn strips(height_m: f64) -> Mesh {
    let mut mesh = Mesh::default();
    sheet(&mut mesh, 0, 7, 1, |u, v| [0.028 * (u - 0.5), 0.004 * (v - 0.5), 0.0]);
    sheet(&mut mesh, 1, 1, 5, |u, v| [0.003 * (u - 0.5), 0.028 * (v - 0.5), height_m]);
    mesh
}

fn edges(mesh: &Mesh) -> Edges {
    let settings = problem::Contact { edges: true, ..problem::Contact::default() };
    Edges::new(mesh, &settings, &masses(mesh), DT_S, &vec![[false; 3]; mesh.points.len()]).unwrap()
}

/// Evaluates one step at `x`, with velocities `v`; positions after it without springs.
fn step(edges: &mut Edges, x: &[[f64; 4]], v: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let mut force = vec![[0.0; 4]; x.len()];
    let tick = Tick { step: 0, time_s: 0.0, dt_s: DT_S };
    edges.advance(&Pose::nodes(x.as_flattened()), &tick, force.as_flattened_mut());
    force.fill([0.0; 4]);
    edges.hold(&EdgeStep { x, v, dv_s: DT_S, dt_s: DT_S, damping_1_s: 0.0 }, &mut force);
    let mass = edges.mass_kg.clone();
    (0..x.len()).map(|i| std::array::from_fn(|k| v[i][k] + DT_S / mass[i] * force[i][k])).collect()
}

/// Strips pressed into each other by some hundredths of a millimetre.
fn pressed() -> (Edges, Vec<[f64; 4]>) {
    let mesh = strips(1e-4);
    let mut edges = edges(&mesh);
    let mut noise = Noise(3);
    let sinks = [0.0, 5e-5, 8e-5, 8e-5];
    let mut x = Vec::new();
    for pair in sinks.windows(2) {
        let sink = |i: usize, sink_m: f64| if i < 16 { 0.0 } else { sink_m };
        let size = if pair[0] == 8e-5 { 5e-6 } else { 0.0 };
        let place = |(i, p): (usize, &[f64; 3])| [p[0], p[1], p[2] - sink(i, pair[0])];
        let moved = mesh.points.iter().enumerate().map(place);
        x = moved.map(|p| add(p, noise.point(size))).map(|[x, y, z]| [x, y, z, 0.0]).collect();
        let v: Vec<[f64; 4]> =
            (0..x.len()).map(|i| [0.0, 0.0, (sink(i, pair[0]) - sink(i, pair[1]) - 5e-6) / DT_S, 0.0]).collect();
        step(&mut edges, &x, &v);
    }
    (edges, x)
}

#[test]
fn nothing_passes_through_anything_and_the_books_are_kept_whatever_the_velocities() {
    let mut mesh = strips(5e-4);
    sheet(&mut mesh, 2, 5, 5, |u, v| [0.02 * (u - 0.5), 0.02 * (v - 0.5), 1e-3]);
    let (mut edges, mut noise) = (edges(&mesh), Noise(11));
    let mass = edges.mass_kg.clone();
    let mut x: Vec<[f64; 4]> = mesh.points.iter().map(|p| [p[0], p[1], p[2], 0.0]).collect();
    // Thrown at each other, every node with 60 m/s of its own: without forces between nodes of a sheet they crumple.
    let throw = |i: usize, own: [f64; 3]| [own[0], own[1], own[2] - if i < 16 { -40.0 } else { 40.0 }, 0.0];
    let mut v: Vec<[f64; 4]> = (0..x.len()).map(|i| throw(i, noise.point(60.0))).collect();
    let momentum = |v: &[[f64; 4]]| [0, 1, 2].map(|k| v.iter().zip(&mass).map(|(v, m)| m * v[k]).sum::<f64>());
    let start = momentum(&v);
    let kinetic = |v: &[[f64; 4]], w: &[[f64; 4]]| -> f64 {
        v.iter().zip(w).zip(&mass).map(|((v, w), m)| 0.5 * m * (v[0] * w[0] + v[1] * w[1] + v[2] * w[2])).sum()
    };
    let mut free = x.clone();
    let mut first = kinetic(&v, &v);
    for step_number in 0..100 {
        let next = step(&mut edges, &x, &v);
        let kept = kinetic(&v, &next) + edges.held.lost_j;
        first = if step_number == 0 { kept } else { first };
        assert!((kept - first).abs() < 1e-9 * first, "{kept} {first}");
        for i in 0..x.len() {
            (0..3).for_each(|k| x[i][k] += DT_S * next[i][k]);
            (0..3).for_each(|k| free[i][k] += DT_S * throw(i, [0.0; 3])[k]);
        }
        v = next;
        let at: Vec<[f64; 3]> = x.iter().map(|p| [p[0], p[1], p[2]]).collect();
        assert_eq!(piercings(&mesh, &at), 0);
    }
    let end = momentum(&v);
    assert!((0..3).all(|k| (end[k] - start[k]).abs() < 1e-12), "{start:?} {end:?}");
    assert!(edges.held.lost_j > 0.01 * first, "they met");
    let free: Vec<[f64; 3]> = free.iter().map(|p| [p[0], p[1], p[2]]).collect();
    assert!(free[16][2] < free[0][2], "alone they would have passed");
}

#[test]
fn force_is_the_slope_of_the_energy_without_resultant_and_moment() {
    let (edges, x) = pressed();
    let mut force = vec![[0.0; 4]; x.len()];
    let energy = edges.add(&Pose::nodes(x.as_flattened()), force.as_flattened_mut());
    let largest = force.as_flattened().iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    assert!(energy > 0.0 && largest > 0.0);
    let (mut sum, mut moment) = ([0.0; 3], [0.0; 3]);
    for i in 0..x.len() {
        sum = add(sum, node(&force, i));
        moment = add(moment, cross(node(&x, i), node(&force, i)));
        for k in 0..3 {
            let eps = 2e-10;
            let mut slope = 0.0;
            for sign in [1.0, -1.0] {
                let mut moved = x.clone();
                moved[i][k] += sign * eps;
                let mut unused = vec![0.0; 4 * x.len()];
                slope += sign * edges.add(&Pose::nodes(moved.as_flattened()), &mut unused) / (2.0 * eps);
            }
            assert!((force[i][k] + slope).abs() < 1e-5 * largest, "{i} {k}: {} {slope}", force[i][k]);
        }
    }
    assert!(sum.iter().all(|f| f.abs() < 1e-13 * largest), "{sum:?}");
    assert!(moment.iter().all(|m| m.abs() < 1e-13 * 0.03 * largest), "{moment:?}");
}

/// The strips in coated nylon, the upper one on its way down.
fn dropped() -> (Problem, Vec<[f64; 3]>) {
    let fabric = Arc::new(NeoHookean::new(50.3e6, 2e-4));
    let section = || Section {
        plies: vec![Ply { fabric: fabric.clone(), angle_rad: 0.0 }],
        bonded: false,
        density_kg_m3: 1000.0,
        bending_factor: 1.0,
        rest_curvature: false,
    };
    let mut problem = Problem::new("strips", strips(1e-3), vec![section(), section()], vec![]);
    problem.contact = Some(problem::Contact { edges: true, ..problem::Contact::default() });
    let v = (0..28).map(|i| [0.0, 0.0, if i < 16 { 0.0 } else { -2.0 }]).collect();
    (problem, v)
}

#[test]
fn strips_that_cross_between_their_nodes_bounce_and_keep_the_books() {
    let (problem, v) = dropped();
    let mut run = Simulation::new(&problem).unwrap();
    run.set_velocities(&v);
    run.advance_until(2.5e-3, &mut |_| true).unwrap();
    // Nodes around the middle: 3, 4, 11, 12 of the lower strip; 20 to 23 of the upper one.
    let x = run.positions();
    let lower = [3, 4, 11, 12].iter().map(|i| x[*i][2]).fold(f64::NEG_INFINITY, f64::max);
    let upper = [20, 21, 22, 23].iter().map(|i: &usize| x[*i][2]).fold(f64::INFINITY, f64::min);
    assert!(upper > lower, "{upper} m over {lower} m");
    let v = run.velocities();
    assert!((0..16).map(|i| v[i][2]).sum::<f64>() < -1.0, "the lower strip was hit");
    assert!(run.ledger().residual_share() < 0.01, "{:?}", run.ledger());
}

#[test]
fn a_folded_pouch_starts_without_force() {
    let problem = pouch(3e-3, 30e3, true).unwrap();
    let mut edges = edges(&problem.mesh);
    let x: Vec<[f64; 4]> = problem.mesh.start.iter().map(|p| [p[0], p[1], p[2], 0.0]).collect();
    let mut force = vec![0.0; 4 * x.len()];
    let tick = Tick { step: 0, time_s: 0.0, dt_s: 4e-6 };
    assert_eq!(edges.advance(&Pose::nodes(x.as_flattened()), &tick, &mut force), 0.0);
    assert!(
        edges.chunks.iter().map(|chunk| chunk.pairs.len()).sum::<usize>() > 1000 && force.iter().all(|f| *f == 0.0)
    );
}

#[test]
fn a_resumed_run_and_any_number_of_threads_end_on_the_same_bits() {
    let mut problem = pouch(6e-3, 30e3, true).unwrap();
    let mut ends = Vec::new();
    for threads in [1, 2] {
        problem.settings.threads = threads;
        let mut run = Simulation::new(&problem).unwrap();
        run.advance_until(6e-3, &mut |_| true).unwrap();
        let mut resumed = Simulation::resume(&problem, &run.save()).unwrap();
        run.advance_until(9e-3, &mut |_| true).unwrap();
        resumed.advance_until(9e-3, &mut |_| true).unwrap();
        assert!(run.save() == resumed.save(), "resumed");
        let lost = run.ledger().rows.iter().find(|r| r.name == "edge damping").map_or(0.0, |r| r.energy_j);
        assert!(lost != 0.0, "edges touched");
        assert_eq!(piercings(&problem.mesh, &run.positions()), 0);
        ends.push(run.save());
    }
    assert!(ends[0] == ends[1], "threads");
}
