#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use models::Fabric;
use models::fabrics::{NeoHookean, Orthotropic, WrinklingFilm};

use super::*;
use crate::mesh::generate;
use crate::problem::{Ply, Problem, Section, Settings};
use crate::{Mesh, Simulation};

const FILM: NeoHookean = NeoHookean::new(50.3e6, 2e-4);

fn problem(mut mesh: Mesh, fabric: Arc<dyn Fabric>) -> Problem {
    mesh.parts.iter_mut().for_each(|part| (part.front, part.back) = (None, None));
    let section = |_| {
        let plies = vec![Ply { fabric: fabric.clone(), angle_rad: 0.4 }];
        Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor: 0.0, rest_curvature: false }
    };
    let sections = mesh.parts.iter().map(section).collect();
    Problem::new("piece", mesh, sections, vec![])
}

/// In a grid of like rectangles a × b every second row moves against its neighbours, ω² = 4 max(D₁₁/a², D₂₂/b²)/ρt: strains
/// along both sides cannot alternate together, so D₁₂, which counts for one element, does not count.
#[test]
fn a_grid_of_rectangles_has_its_closed_form() {
    let (a, b) = (4e-3, 2e-3);
    let fabric = Orthotropic::new(300e6, 100e6, 0.3, 1e6, 2e-4);
    let mesh = generate::plate(40.0 * a, 30.0 * b, 40, 30, None).unwrap();
    let mut problem = problem(mesh, Arc::new(fabric));
    problem.sections[0].plies[0].angle_rad = 0.0;
    problem.settings = Settings { viscosity: 0.0, hourglass: 0.0, cfl: 1.0, ..Settings::default() };
    let d = fabric.tangent([0.0; 3], &[0.0; 2]);
    let exact_s = (1000.0 * 2e-4 / (d[0][0] / (a * a)).max(d[1][1] / (b * b))).sqrt();
    let run = Simulation::new(&problem).unwrap();
    let found = SURE * run.dt_s() / exact_s;
    assert!((found - 1.0).abs() < 2e-3, "{found}");
    // The nodes' bounds alone would have given a shorter step.
    assert!(run.clock.gain > 1.02, "{}", run.clock.gain);
}

/// What moves after some hundred steps over what moved at first; infinite for a run that stopped itself.
fn grown(problem: &Problem, cfl: f64) -> f64 {
    let mut problem = problem.clone();
    problem.settings.cfl = 1.0;
    let mut run = Simulation::new(&problem).unwrap();
    let speed = |i: usize, k: usize| 1e-4 * gaussian(7, (4 * i + k) as u64);
    run.set_velocities(&(0..problem.mesh.points.len()).map(|i| [0, 1, 2].map(|k| speed(i, k))).collect::<Vec<_>>());
    run.clock.dt_s *= cfl;
    let start = run.clock.dt_s;
    match run.advance_until(400.0 * start, &mut |_| true) {
        Ok(_) => run.books.kinetic / run.mass.iter().map(|m| 1.5e-8 * m).sum::<f64>(),
        Err(_) => f64::INFINITY,
    }
}

#[test]
fn the_step_is_stable_and_a_little_more_is_not() {
    let tube = generate::tube(&generate::Tube {
        radius_m: 0.04,
        length_m: 0.1,
        around: generate::Around::Even(40),
        along: 20,
        caps: [generate::Cap::Triangles, generate::Cap::Quads],
        warp_rad: 0.0,
    });
    let wrinkling = WrinklingFilm { film: FILM, load_n_per_m: 5.0 };
    let tied = crate::shared_tests::tied().unwrap();
    for (name, problem, gain) in [
        ("tube", problem(tube.unwrap(), Arc::new(FILM)), 1.03),
        ("sphere", problem(generate::sphere(0.05, 8).unwrap(), Arc::new(FILM)), 1.03),
        ("tied", problem(tied, Arc::new(Orthotropic::new(300e6, 100e6, 0.3, 1e6, 2e-4))), 1.03),
        ("taut film", problem(generate::plate(0.1, 0.1, 20, 30, None).unwrap(), Arc::new(wrinkling)), 1.0),
    ] {
        for (selective_mass, gain) in [(false, gain), (true, 1.5)] {
            let mut problem = problem.clone();
            problem.settings.selective_mass = selective_mass;
            let has = Simulation::new(&problem).unwrap().clock.gain;
            let (stable, beyond) = (grown(&problem, 1.0), grown(&problem, 1.05));
            println!("{name}: γ {has:.3}, {stable:.2e} at the step, {beyond:.2e} at 1.05 of it");
            assert!(has >= gain && stable < 3.0, "{name}, {selective_mass}: {has}, {stable}");
            // A film that wrinkles carries nothing for half of every swing.
            assert!(beyond > 1e3 || name == "taut film", "{name}, {selective_mass}: {beyond}");
        }
    }
}

#[test]
fn what_is_not_a_number_leaves_the_bounds() {
    let problem = problem(generate::plate(0.1, 0.1, 4, 4, None).unwrap(), Arc::new(FILM));
    let run = Simulation::new(&problem).unwrap();
    let gain = |x: &[[f64; 4]], others: f64| gain(&run.sheet, &[], x, vec![others; x.len()], &run.mass, 1e-6, None);
    assert_eq!(gain(&run.x, f64::NAN), 1.0);
    assert_eq!(gain(&vec![[f64::NAN; 4]; run.x.len()], 0.0), 1.0);
    assert_eq!(gain(&run.x, 1e30), 1.0);
}
