use models::{Pose, Term};

use super::rig::{Noise, Rig, flat, masses};
use crate::contact::LayerContact;
use crate::mesh::Mesh;
use crate::problem;
use crate::vec3::{add, cross, node};
use crate::{Tick, Transient};

pub(crate) fn settings(friction: f64) -> problem::Contact {
    problem::Contact { friction, ..problem::Contact::default() }
}

/// Two sheets of different mesh and direction, 0.1 mm apart; pressing them brings all nodes into contact.
fn pressed(friction: f64) -> (LayerContact, Vec<[f64; 4]>) {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 10, 0.04, [0.0; 3], 0.0);
    flat(&mut mesh, 1, 9, 0.036, [0.001, 0.0005, 1e-4], 0.3);
    let mass = masses(&mesh);
    let mut contact = LayerContact::new(&mesh, &settings(friction), &mass, 4e-6).unwrap();
    let mut noise = Noise(7);
    let mut x: Vec<[f64; 4]> = Vec::new();
    for (i, p) in mesh.points.iter().enumerate() {
        let moved = if i < 121 { [0.0; 3] } else { [0.0, 0.0, -1.5e-4] };
        let p = add(add(*p, moved), noise.point(2e-5));
        x.push([p[0], p[1], p[2], 0.0]);
    }
    let mut force = vec![0.0; 4 * x.len()];
    let tick = Tick { step: 0, time_s: 0.0, dt_s: 4e-6 };
    contact.advance(&Pose::nodes(x.as_flattened()), &tick, &mut force);
    (contact, x)
}

#[test]
fn forces_of_touching_layers_have_no_resultant_and_no_moment() {
    let (contact, x) = pressed(0.0);
    let mut force = vec![[0.0; 4]; x.len()];
    contact.add(&Pose::nodes(x.as_flattened()), force.as_flattened_mut());
    let (mut sum, mut moment, mut scale): ([f64; 3], [f64; 3], f64) = ([0.0; 3], [0.0; 3], 0.0);
    for i in 0..x.len() {
        let f = node(&force, i);
        sum = add(sum, f);
        moment = add(moment, cross(node(&x, i), f));
        scale += f[2].abs();
    }
    assert!(scale > 100.0, "the sheets touch: {scale} N");
    for k in 0..3 {
        assert!(sum[k].abs() < 1e-14 * scale, "{sum:?}");
        assert!(moment[k].abs() < 1e-14 * scale * 0.04, "{moment:?}");
    }
}

#[test]
fn force_is_the_slope_of_the_energy_over_positions_of_both_sides() {
    for friction in [0.0, 0.3] {
        let (contact, x) = pressed(friction);
        let mut force = vec![[0.0; 4]; x.len()];
        let energy = contact.add(&Pose::nodes(x.as_flattened()), force.as_flattened_mut());
        let largest = force.as_flattened().iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        assert!(energy > 0.0);
        for i in (0..x.len()).step_by(3) {
            for k in 0..3 {
                let eps = 2e-10;
                let mut slope = 0.0;
                for sign in [1.0, -1.0] {
                    let mut moved = x.clone();
                    moved[i][k] += sign * eps;
                    let mut unused = vec![0.0; 4 * x.len()];
                    slope += sign * contact.add(&Pose::nodes(moved.as_flattened()), &mut unused) / (2.0 * eps);
                }
                assert!((force[i][k] + slope).abs() < 1e-5 * largest, "{i} {k}: {} {slope}", force[i][k]);
            }
        }
    }
}

#[test]
fn advancing_adds_the_same_force_as_looking() {
    let (mut contact, x) = pressed(0.0);
    let (mut one, mut two) = (vec![0.0; 4 * x.len()], vec![0.0; 4 * x.len()]);
    let e1 = contact.add(&Pose::nodes(x.as_flattened()), &mut one);
    let tick = Tick { step: 1, time_s: 0.0, dt_s: 4e-6 };
    let e2 = contact.advance(&Pose::nodes(x.as_flattened()), &tick, &mut two);
    let largest = one.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    assert!((e1 - e2).abs() < 1e-12 * e1);
    assert!(one.iter().zip(&two).all(|(a, b)| (a - b).abs() < 1e-12 * largest));
}

#[test]
fn two_sheets_thrown_at_each_other_bounce_and_keep_the_books() {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 10, 0.04, [0.0; 3], 0.0);
    flat(&mut mesh, 1, 9, 0.036, [0.0, 0.0, 2e-3], 0.4);
    let mut rig = Rig::new(mesh, &settings(0.2)).unwrap();
    rig.throw(121..221, [0.3, 0.0, -1.0]);
    let start = rig.kinetic_of([0.3, 0.0, -1.0], 121..221);
    let mut lowest = f64::INFINITY;
    rig.run_with(2000, |rig| {
        lowest = lowest.min((121..221).map(|i| rig.x[i][2]).fold(f64::INFINITY, f64::min));
    });
    let rise = (121..221).map(|i| rig.v[i][2]).sum::<f64>() / 100.0;
    let push = (0..121).map(|i| rig.v[i][2]).sum::<f64>() / 121.0;
    assert!(lowest < 2e-4 && push < -0.2 && rise > push, "they met: {lowest} {rise} {push}");
    let [_, friction, damping] = rig.rows();
    assert!(friction > 0.0 && damping > 0.0, "{:?} of {start}, misses {}", rig.rows(), rig.residual(start));
    let miss = rig.residual(start);
    assert!(miss.abs() < 0.01 * start, "{miss} of {start}; {:?}", rig.rows());
}
