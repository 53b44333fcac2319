#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use models::fabrics::{NeoHookean, Orthotropic};

use super::LEAST;
use crate::mesh::{Part, generate};
use crate::problem::{Amplitude, Contact, MassScaling, NodalForce, Problem, Rigid, Section, Settings, Support};
use crate::random::gaussian;
use crate::{Mesh, Simulation};

const FILM: NeoHookean = NeoHookean::new(50.3e6, 2e-4);

fn problem(mut mesh: Mesh) -> Problem {
    mesh.parts.iter_mut().for_each(|part| (part.front, part.back) = (None, None));
    let section = Section::of(Arc::new(FILM), 1.0);
    let mut problem = Problem::new("piece", mesh, vec![section], vec![]);
    problem.settings = Settings { viscosity: 0.0, selective_mass: true, ..Settings::default() };
    problem
}

/// −T₃, T₅ and −T₇ over their degree and their argument, of y² = z.
fn chebyshev(passes: usize, z: f64) -> f64 {
    match passes {
        2 => 1.0 - 4.0 / 3.0 * z,
        4 => 1.0 - 4.0 * z + 3.2 * z * z,
        _ => 1.0 - 8.0 * z + 16.0 * z * z - 64.0 / 7.0 * z * z * z,
    }
}

/// A wave along a grid: (q² + ε)/(1 + ε) with the polynomials of the module, λ = 0.9 sin²(θ/2), θ = 2π over the elements of the wave;
/// with two passes q = 1 − λ. What moves as one stays.
#[test]
fn waves_of_a_grid_are_smoothed_as_derived() {
    for (passes, largest) in [(2, 4.0 / 3.0), (4, 1.8), (6, 1.8)] {
        let mut problem = problem(generate::plate(0.24, 0.16, 24, 16, None).unwrap());
        problem.settings.mass_passes = passes;
        let run = Simulation::new(&problem).unwrap();
        let selective = run.selective.as_ref().unwrap();
        for elements in [f64::INFINITY, 24.0, 12.0, 6.0, 3.0, 2.0] {
            let theta = TAU / elements;
            let wave: Vec<[f64; 4]> = run.x.iter().map(|x| [(theta * x[0] / 0.01).cos(), 0.0, 1.0, 0.0]).collect();
            let q = chebyshev(passes, 0.9 * (0.5 * theta).sin().powi(2) / largest);
            let factor = (q * q + LEAST) / (1.0 + LEAST);
            let smooth = selective.smoothed(&wave);
            let inner = |i: &usize| (0.06..0.18).contains(&run.x[*i][0]) && (0.06..0.1).contains(&run.x[*i][1]);
            let off = |i: usize| (smooth[i][0] - factor * wave[i][0]).abs();
            let far = (0..wave.len()).filter(inner).map(off).fold(0.0, f64::max);
            assert!(far < 1e-13, "{passes}, {elements}: {far}");
            assert!(smooth.iter().all(|v| (v[2] - 1.0).abs() < 1e-13));
        }
    }
}

/// M⁻¹ with nodes held and random vectors: a·M⁻¹b = b·M⁻¹a, and a·M⁻¹a > 0; no wave is lighter than lumped.
#[test]
fn selective_masses_are_symmetric_and_heavier_than_lumped_ones() {
    for passes in [2, 4, 6] {
        let mut problem = problem(generate::plate(0.1, 0.05, 12, 7, None).unwrap());
        problem.settings.mass_passes = passes;
        problem.supports = vec![Support { set: "left".into(), axes: [true, false, true], motion: None }];
        let run = Simulation::new(&problem).unwrap();
        let selective = run.selective.as_ref().unwrap();
        let any = |seed: u64| -> Vec<[f64; 4]> {
            (0..run.x.len())
                .map(|i| [0, 1, 2].map(|k| gaussian(seed, (4 * i + k) as u64)))
                .map(|[x, y, z]| [x, y, z, 0.0])
                .collect()
        };
        // u = D⁻¹ p, so Σ m uᵃ·(D M⁻¹ uᵇ) is a·M⁻¹b.
        let through = |a: &[[f64; 4]], b: &[[f64; 4]]| -> f64 {
            let v = selective.smoothed(b);
            run.mass.iter().zip(a).zip(&v).map(|((m, a), v)| m * (a[0] * v[0] + a[1] * v[1] + a[2] * v[2])).sum()
        };
        let (a, b) = (any(1), any(2));
        let (ab, ba, aa) = (through(&a, &b), through(&b, &a), through(&a, &a));
        assert!((ab - ba).abs() < 1e-12 * aa && aa > 0.0, "{passes}: {ab} {ba} {aa}");
        let checkers = |i: usize| {
            if ((run.x[i][0] / (0.1 / 12.0)).round() + (run.x[i][1] / (0.05 / 7.0)).round()) % 2.0 == 0.0 {
                1.0
            } else {
                -1.0
            }
        };
        let waves: Vec<[f64; 4]> = (0..run.x.len()).map(|i| [0.0, checkers(i), 0.0, 0.0]).collect();
        let lumped: f64 = run.mass.iter().sum();
        assert!(through(&waves, &waves) < lumped, "{passes}: {}", through(&waves, &waves) / lumped);
    }
}

/// The largest of s (q(s)² + ε)/(1 + ε), s = sin²(θ/2), is 0.1667, 0.087 and 0.047: 2.45, 3.4 and 4.6 times the step.
#[test]
fn a_grid_of_squares_allows_the_step_that_its_waves_allow() {
    let mut problem = problem(generate::plate(0.2, 0.12, 50, 30, None).unwrap());
    problem.settings.hourglass = 0.0;
    let step = |problem: &Problem| Simulation::new(problem).unwrap().dt_s();
    let mut with = |passes: usize| {
        (problem.settings.selective_mass, problem.settings.mass_passes) = (true, passes);
        step(&problem)
    };
    let with = [2, 4, 6].map(&mut with);
    problem.settings.selective_mass = false;
    let without = step(&problem);
    for ((passes, largest), with) in [(2, 4.0 / 3.0), (4, 1.8), (6, 1.8)].into_iter().zip(with) {
        let of = |s: f64| s * (chebyshev(passes, 0.9 * s / largest).powi(2) + LEAST) / (1.0 + LEAST);
        let peak = (0..=10_000).map(|i| of(1e-4 * f64::from(i))).fold(0.0, f64::max);
        let (ratio, derived) = (with / without, peak.sqrt().recip());
        assert!((0.88..1.03).contains(&(ratio / derived)), "{passes}: {ratio}, derived {derived}");
    }
}

/// Kicked at random, free in space: momentum and angular momentum keep to rounding, energy to what steps cost.
#[test]
fn a_free_sheet_keeps_momentum_angular_momentum_and_energy() {
    [2, 6].into_iter().for_each(keeps);
}

fn keeps(passes: usize) {
    let mut problem = problem(generate::plate(0.12, 0.08, 15, 9, None).unwrap());
    (problem.settings.cfl, problem.settings.mass_passes) = (0.3, passes);
    // Bending forces of absolute places cancel to their rounding only, with lumped masses too.
    problem.sections[0].bending_factor = 0.0;
    let mut run = Simulation::new(&problem).unwrap();
    let kick = |i: usize, k: usize| 0.1 * gaussian(3, (4 * i + k) as u64);
    run.set_velocities(&(0..problem.mesh.points.len()).map(|i| [0, 1, 2].map(|k| kick(i, k))).collect::<Vec<_>>());
    let sums = |run: &Simulation| {
        let u = &run.selective.as_ref().unwrap().u;
        let mut sum = [0.0; 6];
        for ((m, u), x) in run.mass.iter().zip(u).zip(&run.x) {
            for k in 0..3 {
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                sum[k] += m * u[k];
                sum[3 + k] += m * (x[a] * u[b] - x[b] * u[a]);
            }
        }
        sum
    };
    let (before, end_s) = (sums(&run), 4000.0 * run.dt_s());
    run.advance_until(end_s, &mut |_| true).unwrap();
    let ledger = run.ledger();
    assert!(ledger.residual_share() < 2e-3, "{}", ledger.residual_share());
    let scale: f64 = run.mass.iter().sum::<f64>() * 0.1;
    for (k, (a, b)) in before.iter().zip(sums(&run)).enumerate() {
        assert!((a - b).abs() < 1e-12 * scale, "{k}: {a} {b}");
    }
}

/// The slowest stretching wave of a free strip without lateral contraction, ω = (π/l) √(E/ρ); waves of n elements are slower by
/// 0.9 sin²(π/n), beside (π/n)²/6 of lumping.
#[test]
fn the_slowest_wave_keeps_its_frequency_at_second_order() {
    let (length, young) = (0.2, 300e6);
    let exact_s = 2.0 * length / (young / 1000.0_f64).sqrt();
    let period_s = |along: usize| {
        let mut problem = problem(generate::plate(length, length / along as f64, along, 1, None).unwrap());
        problem.sections[0].plies[0].fabric = Arc::new(Orthotropic::new(young, young, 0.0, 1e8, 2e-4));
        problem.settings.cfl = 0.2;
        let mut run = Simulation::new(&problem).unwrap();
        let start: Vec<[f64; 3]> = problem.mesh.points.iter().map(|p| [(PI * p[0] / length).cos(), 0.0, 0.0]).collect();
        run.set_velocities(&start.iter().map(|v| v.map(|v| 1e-3 * v)).collect::<Vec<_>>());
        // Projection on the wave: two changes of sign are half a period apart.
        let mut crossings: Vec<f64> = Vec::new();
        let mut last = (0.0, 1.0);
        while crossings.len() < 3 {
            run.advance_until(run.time_s() + 1.5 * run.dt_s(), &mut |_| true).unwrap();
            let now: f64 = run.velocities().iter().zip(&start).map(|(v, s)| v[0] * s[0]).sum();
            if now * last.1 < 0.0 {
                crossings.push(last.0 + (run.time_s() - last.0) * last.1 / (last.1 - now));
            }
            last = (run.time_s(), now);
        }
        crossings[2] - crossings[0]
    };
    let error = [16, 32].map(|n| period_s(n) / exact_s - 1.0);
    let derived = [16.0, 32.0].map(|n: f64| (0.9 + 1.0 / 6.0) * (0.5 * PI / n).powi(2));
    for (found, derived) in error.iter().zip(derived) {
        assert!((found / derived - 1.0).abs() < 0.05, "{error:?}, derived {derived:?}");
    }
}

/// Pulled by a moving support, or with a rigid edge pulled by a force: the work of the support is on the ledger, and at rest it
/// holds what it holds with lumped masses.
#[test]
fn supports_and_rigid_bodies_do_what_they_do_with_lumped_masses() {
    let force_n = |selective_mass: bool, mass_passes: usize, rigid: bool| {
        let mut problem = problem(generate::plate(0.1, 0.05, 12, 6, None).unwrap());
        let still = Amplitude::Constant(0.0);
        let pull = Amplitude::Smooth(vec![(0.0, 0.0), (0.02, 5e-3)]);
        let hold = |set: &str, motion| Support { set: set.into(), axes: [true; 3], motion };
        problem.supports = vec![hold("left", None), hold("right", Some([pull, still.clone(), still]))];
        if rigid {
            problem.supports.pop();
            problem.rigid = vec![Rigid { set: "right".into() }];
            let amplitude = Amplitude::Smooth(vec![(0.0, 0.0), (0.02, 1.0)]);
            problem.forces = vec![NodalForce { set: "right".into(), total_n: [40.0, 0.0, 0.0], amplitude }];
        }
        (problem.settings.selective_mass, problem.settings.mass_passes) = (selective_mass, mass_passes);
        problem.settings.mass_damping_1_s = 500.0;
        let mut run = Simulation::new(&problem).unwrap();
        run.advance_until(0.04, &mut |_| true).unwrap();
        assert!(run.ledger().residual_share() < 1e-3, "{selective_mass}: {:?}", run.ledger());
        match rigid {
            true => run.positions().iter().map(|x| x[0]).fold(0.0, f64::max),
            false => run.reaction_n("right").unwrap()[0],
        }
    };
    for rigid in [false, true] {
        let lumped = force_n(false, 2, rigid);
        for passes in [2, 6] {
            let selective = force_n(true, passes, rigid);
            assert!((selective / lumped - 1.0).abs() < 1e-4, "{rigid}, {passes}: {selective} {lumped}");
        }
    }
}

/// A thin sheet with a stiff strip of bonded plies, asked for the step that the thin sheet allows: the strip pays for its bending, the
/// rest gets far less than if all were raised alike (the step goes by the root of the mass), and the step holds.
#[test]
fn stuck_plies_pay_for_their_own_bending() {
    let mut mesh = generate::plate(0.03, 0.02, 30, 20, None).unwrap();
    let strip = |quad: &[u32; 4]| quad.iter().all(|n| (0.0129..0.0171).contains(&mesh.points[*n as usize][0]));
    let (strip, sheet): (Vec<_>, Vec<_>) = mesh.parts[0].quads.iter().partition(|quad| strip(quad));
    let whole = problem(mesh.clone());
    mesh.parts.push(Part { name: "strip".into(), quads: strip, ..mesh.parts[0].clone() });
    mesh.parts[0].quads = sheet;
    let mut problem = problem(mesh);
    problem.sections.push(whole.sections[0].clone());
    problem.sections[1].plies = vec![problem.sections[0].plies[0].clone(); 4];
    let thin = |i: usize| !(0.0119..0.0181).contains(&problem.mesh.points[i][0]);
    let masses = |problem: &Problem| {
        let run = Simulation::new(problem).unwrap();
        // The solver has an order of its own.
        let mut masses = vec![0.0; run.mass.len()];
        let points = |p: &[f64; 4]| problem.mesh.points.iter().position(|x| (x[0] - p[0]).hypot(x[1] - p[1]) < 1e-6);
        run.x.iter().zip(&run.mass).for_each(|(x, m)| masses[points(x).unwrap()] = *m);
        (masses, run.dt_s())
    };
    let six = Settings { mass_passes: 6, ..problem.settings.clone() };
    let step_s = masses(&Problem { settings: six.clone(), ..whole }).1;
    let mut scaled = Problem { settings: six, ..problem.clone() };
    let (lumped, light_s) = masses(&scaled);
    let alike = (step_s / light_s).powi(2);
    scaled.settings.mass_scaling = MassScaling::TargetStep(step_s);
    let (mass, dt_s) = masses(&scaled);
    let raised = |thinly: bool| {
        let own = (0..mass.len()).filter(|i| thin(*i) == thinly);
        let sums = own.fold([0.0, 0.0], |[a, b], i| [a + mass[i], b + lumped[i]]);
        sums[0] / sums[1]
    };
    assert!(raised(true) < 0.3 * alike && raised(false) > 0.5 * alike, "{} {} {alike}", raised(true), raised(false));
    assert!((0.95..1.2).contains(&(dt_s / step_s)), "{dt_s} {step_s}");
    let mut run = Simulation::new(&scaled).unwrap();
    let kick = |i: usize, k: usize| 1e-3 * gaussian(3, (4 * i + k) as u64);
    run.set_velocities(&(0..mass.len()).map(|i| [0, 1, 2].map(|k| kick(i, k))).collect::<Vec<_>>());
    run.advance_until(4000.0 * dt_s, &mut |_| true).unwrap();
    assert!(run.ledger().residual_share() < 0.02, "{}", run.ledger().residual_share());
}

#[test]
fn contact_of_edges_is_refused() {
    let mut problem = problem(generate::plate(0.1, 0.1, 4, 4, None).unwrap());
    problem.contact = Some(Contact { edges: true, ..Contact::default() });
    let said = Simulation::new(&problem).err().unwrap().to_string();
    assert!(said.contains("edges") && said.contains("selective_mass"), "{said}");
}
