use super::laws::settings;
use super::rig::{Noise, Rig, flat, sheet};
use crate::Transient;
use crate::contact::LayerContact;
use crate::contact::closest;
use crate::contact::closest::nearest;
use crate::mesh::Mesh;
use crate::vec3::add;

/// Lowest height of `nodes` over the front of a layer, by asking every element; nodes beyond its rim do not count.
fn lowest(rig: &Rig, nodes: std::ops::Range<usize>, layer: u32) -> f64 {
    let surface = &rig.contact.surface;
    let faces: Vec<u32> = (0..surface.elements.len() as u32).filter(|e| surface.layer[*e as usize] == layer).collect();
    let mut low = f64::INFINITY;
    for i in nodes {
        let near = faces.iter().map(|e| (nearest(surface, &rig.x, rig.p(i), *e), *e));
        let Some((at, best)) = near.min_by(|a, b| a.0.square_m2.total_cmp(&b.0.square_m2)) else { continue };
        let found = closest::describe(surface, &rig.x, rig.p(i), best, &at, 0.0);
        if !found.rim {
            low = low.min(found.height_m);
        }
    }
    low
}

/// Depth that a penalty of share .05 allows at a speed: v dt/√.05.
fn depth(rig: &Rig, speed: f64) -> f64 {
    speed * rig.dt / 0.05_f64.sqrt()
}

#[test]
fn two_crossed_strips_thrown_at_each_other_never_pass_through() {
    let mut mesh = Mesh::default();
    sheet(&mut mesh, 0, 24, 5, |u, v| [0.096 * (u - 0.5), 0.02 * (v - 0.5), 0.0]);
    sheet(&mut mesh, 1, 5, 24, |u, v| [0.0205 * (u - 0.5), 0.096 * (v - 0.5), 1.5e-3]);
    let (lower, all) = (25 * 6, 2 * 25 * 6);
    let mut rig = Rig::new(mesh, &settings(0.2)).unwrap();
    rig.throw(lower..all, [0.0, 0.0, -3.0]);
    let start = rig.kinetic_of([0.0, 0.0, -3.0], lower..all);
    let deepest = -depth(&rig, 3.0);
    let mut step = 0;
    rig.run_with(2400, |rig| {
        step += 1;
        if step % 100 == 0 {
            let low = lowest(rig, lower..all, 0);
            assert!(low > deepest, "step {step}: {low} m against {deepest} m");
        }
    });
    assert!((0..lower).map(|i| rig.v[i][2] * rig.mass[i]).sum::<f64>() < 0.0, "the lower strip was hit");
    let miss = rig.residual(start);
    assert!(miss.abs() < 0.01 * start, "{miss} of {start}; {:?}", rig.rows());
    assert_eq!(rig.contact.passed(), (0, all, None));
}

#[test]
fn nodes_that_come_through_a_layer_are_counted_with_the_place_of_the_first_and_resumed() {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 20, 0.08, [0.0; 3], 0.0);
    flat(&mut mesh, 1, 8, 0.03, [0.001, 0.0005, 1e-3], 0.1);
    let (below, all) = (441, 441 + 81);
    let mut rig = Rig::new(mesh, &settings(0.0)).unwrap();
    rig.throw(below..all, [0.0, 0.0, -250.0]);
    while rig.p(all - 1)[2] > -4e-3 && rig.step < 100 {
        rig.run(1);
    }
    let (nodes, could, first) = rig.contact.passed();
    let (first, part) = first.unwrap();
    assert!(lowest(&rig, below..all, 0) < -1.5e-3, "springs hold no such throw");
    // Nodes of the thrown sheet came through the other, and nodes of the other near its middle through it.
    assert!(nodes >= 81 && could == all, "{nodes} of {could}");
    assert_eq!(part == 0, first.node >= 441);
    assert!(first.place_m[2].abs() < 1.5e-3 && first.time_s < 3e-5, "{first:?}");
    let mut other = LayerContact::new(&rig.mesh, &settings(0.0), &rig.mass, rig.dt).unwrap();
    assert!(other.restore(&rig.contact.save()).is_some());
    assert_eq!(other.passed(), rig.contact.passed());
}

#[test]
fn a_dome_thrown_on_a_held_sheet_comes_back_and_the_books_close() {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 20, 0.08, [0.0; 3], 0.0);
    sheet(&mut mesh, 1, 14, 14, |u, v| {
        let (x, y) = (0.045 * (u - 0.5), 0.045 * (v - 0.5));
        [x, y, 0.04 + 1e-3 - (0.04_f64.powi(2) - x * x - y * y).sqrt()]
    });
    let (sheet, all) = (21 * 21, 21 * 21 + 15 * 15);
    let mut rig = Rig::new(mesh, &settings(0.3)).unwrap();
    for i in 0..sheet {
        rig.fixed[i] = i % 21 == 0 || i % 21 == 20 || !(21..20 * 21).contains(&i);
    }
    rig.throw(sheet..all, [0.2, 0.0, -2.0]);
    let start = rig.kinetic_of([0.2, 0.0, -2.0], sheet..all);
    let deepest = -depth(&rig, 2.0);
    let mut step = 0;
    rig.run_with(4500, |rig| {
        step += 1;
        if step % 300 == 0 {
            assert!(lowest(rig, sheet..all, 0) > deepest, "step {step}: {}", lowest(rig, sheet..all, 0));
        }
    });
    let rise = (sheet..all).map(|i| rig.v[i][2]).sum::<f64>() / 225.0;
    assert!(rise > 0.5, "{rise} m/s");
    let miss = rig.residual(start);
    assert!(miss.abs() < 0.01 * start, "{miss} of {start}; {:?}", rig.rows());
}

/// A small sheet on a held large one, pulled by a gravity that leans by `angle_rad`; its mean speed and way.
fn incline(angle_rad: f64, friction: f64, seconds: f64) -> (Rig, f64, f64) {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 20, 0.08, [0.0; 3], 0.0);
    flat(&mut mesh, 1, 4, 0.015, [-0.02, 0.001, 4e-6], 0.2);
    let mut rig = Rig::new(mesh, &settings(friction)).unwrap();
    rig.fixed[..441].fill(true);
    rig.gravity = [9.81 * angle_rad.sin(), 0.0, -9.81 * angle_rad.cos()];
    let steps = (seconds / rig.dt) as usize;
    rig.run(steps);
    let mean = |k: usize, of: &[[f64; 4]]| of[441..].iter().map(|x| x[k]).sum::<f64>() / 25.0;
    let (speed, way) = (mean(0, &rig.v), mean(0, &rig.x) + 0.02);
    (rig, speed, way)
}

#[test]
fn a_patch_on_an_incline_sticks_below_the_friction_angle() {
    let (_, speed, way) = incline(0.2, 0.3, 0.02);
    // Free fall along the slope would be 0.4 mm and 0.04 m/s.
    assert!(way.abs() < 5e-6 && speed.abs() < 1e-3, "{way} m, {speed} m/s");
}

#[test]
fn a_patch_on_an_incline_slides_with_the_acceleration_of_coulomb() {
    let (angle, friction) = (0.5_f64, 0.3);
    let (rig, speed, _) = incline(angle, friction, 0.02);
    let exact = 9.81 * (angle.sin() - friction * angle.cos()) * rig.dt * rig.step as f64;
    assert!((speed - exact).abs() < 0.01 * exact, "{speed} against {exact} m/s");
    let miss = rig.residual(0.0);
    assert!(miss.abs() < 0.01 * rig.work, "{miss} of {}; {:?}", rig.work, rig.rows());
}

#[test]
fn a_pressed_and_shaken_stack_of_layers_keeps_its_order() {
    let mut mesh = Mesh::default();
    for layer in 0..5 {
        flat(&mut mesh, layer, 10, 0.04, [0.0, 0.0, 1e-5 * f64::from(layer)], 0.02 * f64::from(layer));
    }
    let mut rig = Rig::new(mesh, &settings(0.2)).unwrap();
    for i in 0..605 {
        let (row, column) = (i % 121 / 11, i % 11);
        rig.fixed[i] = row == 0 || row == 10 || column == 0 || column == 10;
    }
    rig.pressure[0] = -2e4;
    rig.pressure[4] = 2e4;
    let mut noise = Noise(9);
    rig.v.iter_mut().for_each(|v| *v = [0.0, 0.0, 2.0 * noise.next(), 0.0]);
    let static_m = 2e4 * rig.dt * rig.dt / (2.0 * 0.05 * 0.2);
    let deepest = -(depth(&rig, 4.0) + 2.0 * static_m);
    for step in 0..10 {
        rig.run(300);
        for layer in 0..4 {
            let low = lowest(&rig, 121 * (layer + 1)..121 * (layer + 2), layer as u32);
            assert!(low > deepest, "burst {step}, layer {layer}: {low} m against {deepest} m");
        }
    }
}

/// A tube of one layer around x, fronts outward.
fn tube(n: usize, radius: f64) -> Mesh {
    let mut mesh = Mesh::default();
    sheet(&mut mesh, 0, 10, n, |u, v| {
        let a = std::f64::consts::TAU * v;
        [0.04 * u, radius * a.cos(), radius * a.sin()]
    });
    let (row, last) = (11, (11 * n) as u32);
    for n in mesh.parts[0].quads.iter_mut().flatten().filter(|n| **n >= last) {
        *n -= last;
    }
    mesh.points.truncate(row * n);
    mesh
}

#[test]
fn a_tube_of_one_layer_slammed_flat_does_not_pass_through_itself() {
    let mut rig = Rig::new(tube(24, 0.015), &settings(0.0)).unwrap();
    for i in 0..rig.x.len() {
        rig.v[i][2] = -4.0 * rig.x[i][2] / 0.015;
    }
    let start: f64 = rig.v.iter().zip(&rig.mass).map(|(v, m)| 0.5 * m * v[2] * v[2]).sum();
    let deepest = -depth(&rig, 8.0);
    let mut met = false;
    for _ in 0..250 {
        rig.run(10);
        for i in 0..11 {
            // Node 6 rows up is the top of the ring, 18 the bottom.
            let apart = rig.x[11 * 6 + i][2] - rig.x[11 * 18 + i][2];
            assert!(apart > deepest, "{apart} m against {deepest} m");
            met |= apart < 3e-4;
        }
    }
    assert!(met, "the walls met");
    let miss = rig.residual(start);
    assert!(miss.abs() < 0.01 * start, "{miss} of {start}");
}

#[test]
fn nothing_that_touches_is_missing_from_the_near_pairs() {
    let mut mesh = Mesh::default();
    flat(&mut mesh, 0, 8, 0.032, [0.0; 3], 0.0);
    flat(&mut mesh, 1, 9, 0.032, [0.0, 0.0, 2e-3], 0.5);
    let mut rig = Rig::new(mesh, &settings(0.0)).unwrap();
    let mut noise = Noise(21);
    rig.throw(81..181, [3.0, 1.0, -4.0]);
    rig.v.iter_mut().for_each(|v| (0..3).for_each(|k| v[k] += 2.0 * noise.next()));
    let mut touched = 0;
    rig.run_with(900, |rig| {
        if rig.step % 4 != 0 {
            return;
        }
        let at: Vec<_> = rig.x.iter().zip(&rig.v).map(|(x, v)| [0, 1, 2, 3].map(|k| x[k] - rig.dt * v[k])).collect();
        let surface = &rig.contact.surface;
        let near: std::collections::HashSet<u32> = rig.contact.near().map(|r| r.node).collect();
        for i in 0..at.len() {
            let layer = u32::from(i < 81);
            let p = crate::vec3::node(&at, i);
            for e in (0..surface.elements.len() as u32).filter(|e| surface.layer[*e as usize] == layer) {
                let inside = nearest(surface, &at, p, e);
                if inside.square_m2 < (1.5e-4_f64).powi(2) && inside.weights.iter().all(|w| *w > 0.05) {
                    touched += 1;
                    assert!(near.contains(&(i as u32)), "step {}: node {i} at element {e}", rig.step);
                }
            }
        }
    });
    assert!(touched > 20, "{touched}");
}

#[test]
fn a_run_starts_without_force_for_a_stack_in_any_direction() {
    let mut mesh = Mesh::default();
    for layer in 0..4 {
        let axis = [0.6, 0.0, 0.8];
        sheet(&mut mesh, layer, 10, 10, |u, v| {
            let p = [0.8 * 0.04 * u, 0.04 * v, -0.6 * 0.04 * u];
            add(p, axis.map(|a| a * 1e-6 * f64::from(layer)))
        });
    }
    let mut rig = Rig::new(mesh, &settings(0.1)).unwrap();
    rig.run(20);
    assert!(rig.v.as_flattened().iter().all(|v| *v == 0.0));
}
