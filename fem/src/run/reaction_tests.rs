#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use models::fabrics::NeoHookean;

use super::*;
use crate::mesh::generate;
use crate::mesh::generate::{Around, Cap, Tube};
use crate::problem::{Amplitude, Chamber, Gravity, NodalForce, Pressure, Rigid, Section, Support};
use crate::vec3::cross;
use crate::{Problem, Simulation};

fn problem(mesh: Mesh, chambers: Vec<Chamber>) -> Problem {
    let film = NeoHookean::new(20e6, 2e-4);
    let section = Section::of(Arc::new(film), 1.0);
    let sections = mesh.parts.iter().map(|_| section.clone()).collect();
    Problem::new("reactions", mesh, sections, chambers)
}

fn tube(base: Cap) -> Mesh {
    let (around, caps) = (Around::Even(12), [base, Cap::Quads]);
    generate::tube(&Tube { radius_m: 0.02, length_m: 0.08, around, along: 6, caps, warp_rad: 0.0 }).unwrap()
}

fn rising(value: f64) -> Amplitude {
    Amplitude::Smooth(vec![(0.0, 0.0), (0.02, value)])
}

fn held(set: &str, axes: [bool; 3]) -> Support {
    Support { set: set.into(), axes, motion: None }
}

/// Size of the difference over size of the second.
fn off(a: [f64; 3], b: [f64; 3]) -> f64 {
    let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    size([0, 1, 2].map(|k| a[k] - b[k])) / size(b)
}

/// An inflated tube in gravity with a dead force at its tip. Its pressure has no resultant if it is closed, and else p times the area
/// of the opening, a polygon of 12 corners. The base is held, or its rim along y and z and all of its cap along x.
#[test]
fn at_rest_supports_balance_force_and_weight_and_their_moments() {
    let pull = [2.0, -0.05, 0.03];
    for (selective_mass, split, base) in
        [(false, false, Cap::Quads), (false, true, Cap::Quads), (true, false, Cap::Quads), (false, false, Cap::Open)]
    {
        let mesh = tube(base);
        let pressure = Pressure::Set(rising(10e3));
        let mut problem = problem(mesh, vec![Chamber { name: "body".into(), pressure, open_axis: None }]);
        problem.supports = match split {
            false => vec![held("base", [true; 3])],
            true => vec![held("base", [false, true, true]), held("base_cap", [true; 3])],
        };
        problem.open = if base == Cap::Open { vec!["base".into()] } else { vec![] };
        problem.forces = vec![NodalForce { set: "tip".into(), total_n: pull, amplitude: rising(1.0) }];
        problem.gravity = Some(Gravity { g_m_s2: [0.0, -9.81, 0.0], amplitude: Amplitude::Constant(1.0) });
        problem.settings.selective_mass = selective_mass;
        problem.settings.mass_damping_1_s = 400.0;
        let mut run = Simulation::new(&problem).unwrap();
        assert!(run.reactions().iter().all(|r| r.force_n == [0.0; 3]), "no step yet");
        run.advance_until(0.12, &mut |_| true).unwrap();
        let (x, mass) = (run.positions(), &run.mass);
        let mut load = pull;
        load[0] += if base == Cap::Open { 10e3 * 3.0 * 0.02 * 0.02 } else { 0.0 };
        load[1] -= 9.81 * mass.iter().sum::<f64>();
        let sum = |of: fn(&Reaction) -> [f64; 3]| {
            let rows = run.reactions().iter().map(of);
            rows.fold([0.0; 3], |sum, r| [0, 1, 2].map(|k| sum[k] + r[k]))
        };
        assert!(off(sum(|r| r.force_n), load.map(|f| -f)) < 1e-4, "{:?}, load {load:?}", run.reactions());
        if split {
            // The rim's nodes are in the cap, too; they hold along y and z for the rim and along x for the cap.
            assert_eq!((run.reactions().len(), run.reaction_n("base").unwrap()[0]), (2, 0.0));
            assert!((run.reaction_n("base_cap").unwrap()[0] / -load[0] - 1.0).abs() < 1e-4);
            continue;
        }
        let mean = |set: &str| {
            let nodes = &problem.mesh.sets[set];
            [0, 1, 2].map(|k| nodes.iter().map(|n| x[*n as usize][k]).sum::<f64>() / nodes.len() as f64)
        };
        let (base, tip) = (mean("base"), mean("tip"));
        let mut moment = cross([0, 1, 2].map(|k| tip[k] - base[k]), pull);
        for (m, place) in mass.iter().zip(&run.x) {
            let arm = [0, 1, 2].map(|k| place[k] - base[k]);
            (0..3).for_each(|k| moment[k] += cross(arm, [0.0, -9.81 * m, 0.0])[k]);
        }
        assert!(off(run.reactions()[0].moment_nm, moment.map(|m| -m)) < 1e-3, "{:?}, {moment:?}", run.reactions());
    }
}

/// While a driven edge is on its way the reactions are the rate of the momentum, step by step, inertia of the edge included.
#[test]
fn in_motion_reactions_are_the_rate_of_momentum() {
    for (tied, selective_mass) in [(false, false), (true, false), (false, true), (true, true)] {
        let mesh = match tied {
            true => crate::shared_tests::tied().unwrap(),
            false => generate::plate(0.1, 0.02, 20, 4, None).unwrap(),
        };
        let mut problem = problem(mesh, vec![]);
        let set = if tied { "right_b" } else { "right" };
        let motion = Some([rising(1e-3), rising(2e-3), rising(-5e-3)]);
        problem.supports = vec![Support { set: set.into(), axes: [true; 3], motion }];
        problem.settings.selective_mass = selective_mass;
        let mut run = Simulation::new(&problem).unwrap();
        run.advance_until(0.004, &mut |_| true).unwrap();
        for _ in 0..5 {
            let momentum = |run: &Simulation| {
                let pairs = run.mass.iter().zip(&run.v);
                pairs.fold([0.0; 3], |sum, (m, v)| [0, 1, 2].map(|k| sum[k] + m * v[k]))
            };
            let before = momentum(&run);
            run.sheet.measure = true;
            run.one_step();
            let rate = [0, 1, 2].map(|k| (momentum(&run)[k] - before[k]) / run.clock.dt_s);
            let found = run.reaction_n(set).unwrap();
            assert!(off(found, rate) < 1e-9, "tied {tied}, selective {selective_mass}: {found:?}, {rate:?}");
        }
    }
}

#[test]
fn what_a_rigid_body_carries_is_not_held_by_a_support() {
    let mut problem = problem(generate::plate(0.1, 0.02, 8, 4, None).unwrap(), vec![]);
    problem.rigid = vec![Rigid { set: "right".into() }];
    problem.supports = vec![held("right", [true; 3]), held("left", [true, false, true])];
    let reactions = Reactions::new(&problem, &problem.mesh).unwrap();
    assert!(reactions.nodes[0].iter().all(|(_, own)| *own == [false; 3]));
    assert_eq!(reactions.all[1].axes, [true, false, true]);
}

#[test]
fn reactions_go_through_a_checkpoint() {
    let mut problem = problem(generate::plate(0.1, 0.02, 8, 4, None).unwrap(), vec![]);
    let motion = Some([rising(1e-3), rising(0.0), rising(0.0)]);
    problem.supports = vec![held("left", [true; 3]), Support { motion, ..held("right", [true; 3]) }];
    let mut run = Simulation::new(&problem).unwrap();
    run.advance_until(0.002, &mut |_| true).unwrap();
    let resumed = Simulation::resume(&problem, &run.save()).unwrap();
    assert!(run.reaction_n("right").unwrap()[0] > 0.0);
    assert_eq!(run.reactions(), resumed.reactions());
}
