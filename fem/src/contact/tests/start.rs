use models::Pose;

use super::laws::settings;
use super::rig::{Noise, Rig, flat, sheet};
use crate::mesh::Mesh;
use crate::{Tick, Transient};

/// Two coincident square sheets welded along the rim, air between them, fronts outward.
pub(crate) fn pillow(n: usize, side: f64, chamber: bool, layers: [u32; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    flat(&mut mesh, layers[0], n, side, [0.0; 3], 0.0);
    let row = n as u32 + 1;
    let rim = |i: u32| i.is_multiple_of(row) || i % row == row - 1 || i / row == 0 || i / row == row - 1;
    let mut lower = mesh.parts[0].clone();
    let mut copy = std::collections::HashMap::new();
    for quad in &mut lower.quads {
        for n in quad.iter_mut().filter(|n| !rim(**n)) {
            let points = &mut mesh.points;
            *n = *copy.entry(*n).or_insert_with(|| {
                points.push(points[*n as usize]);
                points.len() as u32 - 1
            });
        }
        quad.swap(1, 3);
    }
    lower.name = "lower".into();
    lower.layer = layers[1];
    mesh.parts.push(lower);
    if chamber {
        mesh.parts.iter_mut().for_each(|part| part.back = Some("air".into()));
    }
    mesh
}

#[test]
fn a_coincident_pillow_starts_without_any_force_and_stays_at_rest() {
    for layers in [[0, 1], [1, 0], [0, 0]] {
        let mesh = pillow(12, 0.05, true, layers);
        let mut rig = Rig::new(mesh, &settings(0.3)).unwrap();
        assert!(rig.contact.near().count() > 100);
        rig.run(50);
        assert!(rig.v.as_flattened().iter().all(|v| *v == 0.0), "layers {layers:?}");
        assert_eq!(rig.rows(), [0.0; 3]);
    }
}

#[test]
fn the_layers_of_a_coincident_pillow_do_not_swap_when_they_are_pressed_together() {
    for (layers, noise_m) in [([0, 1], 0.0), ([1, 0], 4e-6), ([0, 0], 4e-6)] {
        let mut mesh = pillow(12, 0.05, true, layers);
        let mut noise = Noise(3);
        mesh.start = mesh.points.iter().map(|p| [p[0], p[1], p[2] + noise_m * noise.next()]).collect();
        let mut rig = Rig::new(mesh, &settings(0.0)).unwrap();
        rig.pressure = vec![1e3, 1e3];
        rig.alpha = 200.0;
        rig.run(2000);
        let upper: Vec<u32> = rig.mesh.parts[0].quads.iter().map(|q| q[0]).collect();
        let lower: Vec<u32> = rig.mesh.parts[1].quads.iter().map(|q| q[0]).collect();
        let touching = upper.iter().zip(&lower).filter(|(a, b)| a != b);
        let lowest = touching.map(|(a, b)| rig.x[*a as usize][2] - rig.x[*b as usize][2]).fold(f64::INFINITY, f64::min);
        // Twice the static depth of two springs per node, as under any sudden load, and the noise of the start.
        let depth = 1e3 * rig.dt * rig.dt / (2.0 * 0.05 * 0.2) + 4.0 * noise_m;
        assert!(lowest > -2.1 * depth, "{lowest} m, expected no deeper than {depth} m");
    }
}

#[test]
fn contact_pressure_is_the_pressure_that_presses() {
    let mut rig = Rig::new(pillow(12, 0.05, true, [0, 1]), &settings(0.0)).unwrap();
    rig.pressure = vec![1e3, 1e3];
    rig.alpha = 5000.0;
    rig.run(4000);
    let pressure = rig.contact.pressure_pa(rig.x.as_flattened());
    let middle = 6 * 13 + 6;
    assert!((pressure[middle] - 1e3).abs() < 20.0, "{} Pa", pressure[middle]);
}

#[test]
fn layers_that_pass_through_each_other_are_refused_by_node_element_and_depth() {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 10, 0.04, [0.0; 3], 0.0);
    sheet(&mut mesh, 1, 10, 10, |u, v| [0.04 * u - 0.02, 0.04 * v - 0.02, 6e-4 * (u - 0.5)]);
    let message = Rig::new(mesh, &settings(0.0)).err().unwrap().to_string();
    assert!(message.contains("node") && message.contains("element") && message.contains("mm"), "{message}");
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 10, 0.04, [0.0; 3], 0.0);
    flat(&mut mesh, 1, 10, 0.04, [0.0, 0.0, 1e-5], 0.0);
    mesh.points[121 + 60][2] = -3e-4;
    let message = Rig::new(mesh, &settings(0.0)).err().unwrap().to_string();
    assert!(message.contains("node 182 ") && message.contains("0.3000 mm"), "{message}");
}

#[test]
fn wrong_settings_are_said() {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 2, 0.01, [0.0; 3], 0.0);
    let mass = vec![1.0; 9];
    let refuse = |change: &dyn Fn(&mut crate::problem::Contact), dt: f64, word: &str| {
        let mut settings = settings(0.0);
        change(&mut settings);
        let message = crate::contact::LayerContact::new(&mesh, &settings, &mass, dt).unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    };
    refuse(&|s| s.friction = -1.0, 1e-6, "friction");
    refuse(&|s| s.thickness_m = f64::NAN, 1e-6, "thickness_m");
    refuse(&|s| s.parts = vec!["arm".into()], 1e-6, "\"arm\"");
    refuse(&|_| (), 0.0, "time step");
    let mut turned = mesh.clone();
    turned.parts[0].quads[0].swap(1, 3);
    let message = crate::contact::LayerContact::new(&turned, &settings(0.0), &mass, 1e-6).unwrap_err().to_string();
    assert!(message.contains("opposite ways") && message.contains("element 1"), "{message}");
}

/// A pillow that is pressed and thrown, so that everything contact remembers is in use.
fn busy() -> Rig {
    let mut rig = Rig::new(pillow(20, 0.06, true, [0, 1]), &settings(0.3)).unwrap();
    rig.pressure = vec![2e3, 1e3];
    let mut noise = Noise(11);
    rig.v.iter_mut().for_each(|v| *v = [0.5 * noise.next(), 0.5 * noise.next(), 0.5 * noise.next(), 0.0]);
    rig
}

#[test]
fn a_restored_contact_goes_on_to_the_bit_and_refuses_what_does_not_fit() {
    let mut one = busy();
    one.run(700);
    let saved = one.contact.save();
    let mut two = busy();
    assert!(two.contact.restore(&saved).is_some());
    assert_eq!(two.contact.save(), saved);
    let mut force = [vec![0.0; 4 * one.x.len()], vec![0.0; 4 * one.x.len()]];
    let mut x = one.x.clone();
    let mut noise = Noise(5);
    for step in 0..300 {
        x.iter_mut().for_each(|x| (0..3).for_each(|k| x[k] += 2e-6 * noise.next()));
        let tick = Tick { step, time_s: 0.0, dt_s: one.dt };
        one.contact.advance(&Pose::nodes(x.as_flattened()), &tick, &mut force[0]);
        two.contact.advance(&Pose::nodes(x.as_flattened()), &tick, &mut force[1]);
    }
    assert!(force[0].iter().any(|f| *f != 0.0));
    assert_eq!(force[0], force[1]);
    assert_eq!(one.contact.save(), two.contact.save());
    for cut in [0, 8, saved.len() / 2, saved.len() - 1] {
        assert!(two.contact.restore(&saved[..cut]).is_none());
    }
    assert!(two.contact.restore(&[&saved[..], &[0]].concat()).is_none());
}

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut rig = busy();
            rig.run(800);
            (rig.x, rig.contact.save())
        })
    };
    let one = run(1);
    assert!(run(2) == one && run(4) == one);
}
