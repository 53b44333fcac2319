//! The same bits for any number of threads, and after a stop and a new start.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use std::sync::Arc;

use fem::mesh::generate;
use fem::problem::{Amplitude, Chamber, Contact, Ply, Pressure, Section};
use fem::{Problem, Simulation};
use models::fabrics::NeoHookean;

const END_S: f64 = 4e-3;

/// A pillow large enough for several patches, whose layers touch each other and a floor.
fn pillow(threads: usize, selective_mass: bool) -> Problem {
    let mesh = generate::pillow(0.2, 50, 1e-4).unwrap();
    let fabric = Arc::new(NeoHookean::new(50.3e6, 2e-4));
    let section = Section {
        plies: vec![Ply { fabric, angle_rad: 0.0 }],
        bonded: true,
        density_kg_m3: 1000.0,
        bending_factor: 0.1,
        rest_curvature: false,
    };
    // Sucked flat first, so that the layers meet, then blown up.
    let pressure = Pressure::Set(Amplitude::Smooth(vec![(0.0, 0.0), (1e-3, -500.0), (3e-3, 3e3)]));
    let air = Chamber { name: "air".into(), pressure, open_axis: None };
    let mut problem = Problem::new("pillow", mesh, vec![section.clone(), section], vec![air]);
    problem.contact = Some(Contact { friction: 0.2, ..Contact::default() });
    problem.settings.imperfection = 1e-3;
    problem.settings.threads = threads;
    problem.settings.selective_mass = selective_mass;
    if selective_mass {
        // Volumes are taken every eight steps, which then are a tenth of the first ramp.
        problem.settings.guards.residual = 0.1;
    }
    problem
}

/// Bits of positions, velocities and ledger.
fn bits(run: &Simulation) -> Vec<u64> {
    let ledger = run.ledger();
    let numbers = [ledger.kinetic_j, ledger.residual_j, ledger.external_work_j];
    let rows = ledger.rows.iter().map(|row| row.energy_j);
    let nodes = run.positions().into_iter().chain(run.velocities()).flatten();
    nodes.chain(rows).chain(numbers).map(f64::to_bits).collect()
}

#[test]
fn one_two_and_three_threads_give_the_same_bits() {
    for selective_mass in [false, true] {
        let run = |threads: usize| {
            let mut run = Simulation::new(&pillow(threads, selective_mass)).unwrap();
            run.advance_until(END_S, &mut |_| true).unwrap();
            run
        };
        let one = run(1);
        let touched = one.ledger().rows.iter().any(|row| row.name == "contact damping" && row.energy_j > 0.0);
        assert!(touched, "the layers never met");
        for threads in [2, 3] {
            assert!(bits(&one) == bits(&run(threads)), "{threads} threads differ");
        }
    }
}

#[test]
fn a_run_saved_at_any_step_and_resumed_ends_with_the_same_bits() {
    [false, true].into_iter().for_each(saved_and_resumed);
}

fn saved_and_resumed(selective_mass: bool) {
    let problem = pillow(1, selective_mass);
    let mut whole = Simulation::new(&problem).unwrap();
    let dt_s = whole.dt_s();
    // Steps without meaning for searches, looks or rechecks.
    let mut state = 0x9E37_79B9_u64;
    let mut stops: Vec<u64> = (0..3)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            17 + (state >> 33) % (END_S / dt_s) as u64 * 9 / 10
        })
        .collect();
    stops.sort_unstable();
    let mut pieces = Simulation::new(&problem).unwrap();
    for stop in stops {
        let time_s = stop as f64 * dt_s;
        whole.advance_until(time_s, &mut |_| true).unwrap();
        pieces.advance_until(time_s, &mut |_| true).unwrap();
        pieces = Simulation::resume(&problem, &pieces.save()).unwrap();
        assert!(bits(&whole) == bits(&pieces), "the state at step {} changed", whole.step());
    }
    whole.advance_until(END_S, &mut |_| true).unwrap();
    pieces.advance_until(END_S, &mut |_| true).unwrap();
    assert_eq!(whole.step(), pieces.step());
    assert!(bits(&whole) == bits(&pieces), "the end differs");
}

#[test]
fn a_state_of_another_problem_or_a_damaged_one_is_refused() {
    let problem = pillow(1, true);
    let mut run = Simulation::new(&problem).unwrap();
    run.advance_until(5e-4, &mut |_| true).unwrap();
    let saved = run.save();
    let mut other = problem.clone();
    other.mesh = generate::pillow(0.2, 20, 1e-4).unwrap();
    assert!(Simulation::resume(&other, &saved).is_err());
    assert!(Simulation::resume(&problem, &saved[..saved.len() - 3]).is_err());
}
