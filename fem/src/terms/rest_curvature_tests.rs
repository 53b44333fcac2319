use std::sync::Arc;

use models::fabrics::Orthotropic;
use models::{Pose, Term};

use super::RestCurvature;
use crate::Mesh;
use crate::mesh::generate;
use crate::problem::{Ply, Section};
use crate::sheet::bending::{BendingMatrix, curvature_rows};
use crate::sheet::reference::bending_stiffness;
use crate::{Tick, Transient};

fn section() -> Section {
    let plies = vec![Ply { fabric: Arc::new(Orthotropic::isotropic(208e6, 0.3, 2e-4)), angle_rad: 0.0 }];
    Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor: 1.0, rest_curvature: true }
}

fn tube(around: usize, along: usize) -> Mesh {
    let around = generate::Around::Even(around);
    let caps = [generate::Cap::Open; 2];
    generate::tube(&generate::Tube { radius_m: 0.04, length_m: 0.1, around, along, caps, warp_rad: 0.0 }).unwrap()
}

fn flat(x: &[[f64; 3]]) -> Vec<f64> {
    x.iter().flat_map(|x| [x[0], x[1], x[2], 0.0]).collect()
}

/// Energy and force of bending with rest curvature, and energy of bending alone.
fn all(mesh: &Mesh, q: &[f64]) -> (f64, Vec<f64>, f64) {
    let mut force = vec![0.0; q.len()];
    let rows = curvature_rows(mesh, &[bending_stiffness(&section())]);
    let matrix = BendingMatrix::new(mesh.points.len(), &rows);
    let bending = matrix.add(q.as_chunks().0, force.as_chunks_mut().0);
    let rest = RestCurvature::new(mesh, &[section()]);
    (bending + rest.add(&Pose::nodes(q), &mut force), force, bending)
}

fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |m, x| m.max(x.abs()))
}

#[test]
fn the_force_is_minus_the_slope_of_the_energy() {
    let mesh = tube(12, 8);
    let rest = RestCurvature::new(&mesh, &[section()]);
    let noise = |i: usize| ((i * 7919) as f64 * 0.618_033_988_749_9).fract() - 0.5;
    let mut q = flat(&mesh.points);
    q.iter_mut().enumerate().for_each(|(i, x)| *x += 5e-3 * noise(i));
    let mut force = vec![0.0; q.len()];
    rest.add(&Pose::nodes(&q), &mut force);
    for dof in (0..q.len()).step_by(13).filter(|dof| dof % 4 < 3) {
        let energy = |step: f64| {
            let mut moved = q.clone();
            moved[dof] += step;
            rest.add(&Pose::nodes(&moved), &mut vec![0.0; q.len()])
        };
        let h = 1e-4;
        let slope = (energy(-2.0 * h) - 8.0 * energy(-h) + 8.0 * energy(h) - energy(2.0 * h)) / (12.0 * h);
        // A quartic has no error at this order.
        assert!((force[dof] + slope).abs() < 1e-9 * largest(&force), "{dof}: {} against {}", force[dof], -slope);
    }
}

#[test]
fn a_tube_at_rest_is_free_of_force_wherever_it_is_turned() {
    let mesh = tube(24, 10);
    let (s, c) = 1.0_f64.sin_cos();
    let turned: Vec<[f64; 3]> =
        mesh.points.iter().map(|p| [c * p[0] - s * p[2] + 0.3, p[1], s * p[0] + c * p[2]]).collect();
    for points in [&mesh.points, &turned] {
        let (energy, force, bending) = all(&mesh, &flat(points));
        let stiffness = bending_stiffness(&section());
        assert!(energy.abs() < 1e-12 * bending, "{energy:e} of {bending:e} J");
        // D/R is a tension of the size that bending without rest curvature would hold, times one element.
        assert!(largest(&force) < 1e-11 * stiffness / 0.04, "{:e} N", largest(&force));
    }
}

#[test]
fn a_sphere_of_irregular_elements_comes_to_rest_with_the_square_of_their_size() {
    let left = |n: usize| {
        let mesh = generate::sphere(0.04, n).unwrap();
        let (energy, _, bending) = all(&mesh, &flat(&mesh.points));
        energy / bending
    };
    let (coarse, fine) = (left(8), left(16));
    assert!(fine < 1e-3 && (coarse / fine).log2() > 1.8, "{coarse:e} {fine:e}");
}

#[test]
fn the_stiffness_bound_holds_for_the_curvature_of_the_energy() {
    let mesh = tube(12, 6);
    let rest = RestCurvature::new(&mesh, &[section()]);
    let q = flat(&mesh.points);
    let mut bound = vec![0.0; mesh.points.len()];
    rest.stiffness_bound(&Pose::nodes(&q), &mut bound);
    for probe in 0..20 {
        let u: Vec<f64> = (0..q.len()).map(|i| ((i * 31 + probe * 7919) as f64 * 0.7548).sin()).collect();
        let energy = |step: f64| {
            let moved: Vec<f64> = q.iter().zip(&u).map(|(q, u)| q + step * u).collect();
            rest.add(&Pose::nodes(&moved), &mut vec![0.0; q.len()])
        };
        let h = 1e-5;
        let curvature = (energy(h) - 2.0 * energy(0.0) + energy(-h)) / (h * h);
        let limit: f64 =
            bound.iter().zip(u.as_chunks::<4>().0).map(|(k, u)| k * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2])).sum();
        assert!(curvature.abs() <= limit, "{curvature} over {limit}");
    }
}

#[test]
fn a_flat_sheet_and_a_section_that_does_not_ask_have_no_rest_curvature() {
    let plate = generate::plate(0.1, 0.1, 4, 4, None).unwrap();
    assert!(RestCurvature::new(&plate, &[section()]).is_empty());
    let other = Section { rest_curvature: false, ..section() };
    assert!(RestCurvature::new(&tube(12, 4), &[other]).is_empty());
}

#[test]
fn a_restored_term_reports_the_energy_of_its_last_step() {
    let mesh = tube(12, 4);
    let mut term = RestCurvature::new(&mesh, &[section()]);
    let (q, v) = (flat(&mesh.points), vec![0.0; 4 * mesh.points.len()]);
    let tick = Tick { step: 0, time_s: 0.0, dt_s: 1e-6 };
    let energy = term.advance(&Pose::nodes(&q), &tick, &mut vec![0.0; q.len()]);
    let mut other = RestCurvature::new(&mesh, &[section()]);
    assert!(other.restore(&term.save()).is_some() && other.clone().restore(&[1, 2]).is_none());
    assert!(energy < 0.0 && other.ledger(&Pose::nodes(&v))[0].energy_j.to_bits() == energy.to_bits());
}
