//! Cost per element and step. `cargo test -p fem --release contact::tests::speed -- --ignored --nocapture`

use std::time::Instant;

use models::{Pose, Term, Tick};

use super::laws::settings;
use super::rig::{flat, masses};
use crate::contact::Contact;
use crate::mesh::Mesh;

/// Steps a stack whose layers are pressed together and drift, and prints ns per element-step.
fn cost(title: &str, layers: usize, n: usize, friction: f64, speed_m_s: f64) {
    let mut mesh = Mesh::default();
    for layer in 0..layers {
        flat(&mut mesh, layer as u32, n, 0.004 * n as f64, [0.0, 0.0, 1e-5 * layer as f64], 0.0);
    }
    let mass = masses(&mesh);
    let dt_s = 4e-6;
    let mut contact = Contact::new(&mesh, &settings(friction), &mass, dt_s).unwrap();
    let per = mesh.points.len() / layers;
    let mut x: Vec<[f64; 4]> = mesh.points.iter().map(|p| [p[0], p[1], p[2], 0.0]).collect();
    let start = x.clone();
    let v = vec![0.0; 4 * x.len()];
    let mut force = vec![0.0; 4 * x.len()];
    let steps = 1000;
    let mut spent = 0.0;
    for step in 0..steps {
        for (i, (x, s)) in x.iter_mut().zip(&start).enumerate() {
            let layer = (i / per) as f64;
            x[0] = s[0] + layer * speed_m_s * dt_s * step as f64;
            x[2] = 6e-6 * layer + 1e-6 * (0.1 * step as f64 + i as f64).sin();
        }
        let tick = Tick { step, time_s: step as f64 * dt_s, dt_s, v: &v };
        let clock = Instant::now();
        contact.advance(&Pose::nodes(x.as_flattened()), &tick, &mut force);
        spent += clock.elapsed().as_secs_f64();
    }
    let ns = spent * 1e9 / (steps as f64 * mesh.elements() as f64);
    println!("{title}: {ns:.1} ns per element-step, {} pairs, {} searches", contact.near_pairs(), contact.searches());
}

#[test]
#[ignore = "timing"]
fn cost_of_layers_that_touch_everywhere() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        cost("2 layers 100 x 100", 2, 100, 0.0, 0.0);
        cost("2 layers 100 x 100, sliding at 1 m/s", 2, 100, 0.0, 1.0);
        cost("2 layers 100 x 100, sliding at 1 m/s, friction", 2, 100, 0.3, 1.0);
        cost("4 layers 50 x 50", 4, 50, 0.0, 0.0);
        cost("4 layers 50 x 50, sliding at 1 m/s", 4, 50, 0.0, 1.0);
    });
}
