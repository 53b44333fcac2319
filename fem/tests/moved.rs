//! A run does not know where its origin is, nor where x points.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use std::sync::Arc;

use fem::mesh::generate;
use fem::problem::{Amplitude, Chamber, Gravity, NodalForce, Obstacle, ObstacleShape, Ply, Pressure, Section, Support};
use fem::vec3::{V3, cross, dot, unit};
use fem::{Problem, Simulation};
use models::fabrics::Orthotropic;

/// A turn about an axis by an angle, then a shift.
struct Place {
    axis: V3,
    angle_rad: f64,
    shift_m: V3,
}

impl Place {
    fn turn(&self, v: V3) -> V3 {
        let (axis, (sin, cos)) = (unit(self.axis).unwrap(), self.angle_rad.sin_cos());
        let (across, along) = (cross(axis, v), dot(axis, v) * (1.0 - cos));
        [0, 1, 2].map(|k| cos * v[k] + sin * across[k] + along * axis[k])
    }

    fn at(&self, x: V3) -> V3 {
        let turned = self.turn(x);
        [0, 1, 2].map(|k| turned[k] + self.shift_m[k])
    }

    fn problem(&self, mut problem: Problem) -> Problem {
        problem.mesh.points.iter_mut().chain(&mut problem.mesh.start).for_each(|x| *x = self.at(*x));
        problem.mesh.parts.iter_mut().for_each(|part| part.warp = vec![self.turn([1.0, 0.0, 0.0])]);
        problem.gravity.iter_mut().for_each(|g| g.g_m_s2 = self.turn(g.g_m_s2));
        problem.forces.iter_mut().for_each(|f| f.total_n = self.turn(f.total_n));
        for obstacle in &mut problem.obstacles {
            if let ObstacleShape::Plane { point, normal } = &mut obstacle.shape {
                (*point, *normal) = (self.at(*point), self.turn(*normal));
            }
        }
        problem
    }
}

fn section() -> Section {
    let fabric = Arc::new(Orthotropic::new(60e6, 40e6, 0.3, 10e6, 2e-4));
    let plies = vec![Ply { fabric, angle_rad: 0.3 }];
    Section { plies, bonded: true, density_kg_m3: 1000.0, bending_factor: 0.5, rest_curvature: false }
}

/// A flag that is held at one edge, pulled at the other and falls on a floor.
fn flag() -> Problem {
    let mesh = generate::plate(0.1, 0.06, 10, 6, None).unwrap();
    let mut problem = Problem::new("flag", mesh, vec![section()], vec![]);
    problem.supports = vec![Support { set: "left".into(), axes: [true; 3], motion: None }];
    let always = || Amplitude::Constant(1.0);
    problem.gravity = Some(Gravity { g_m_s2: [0.0, 1.0, -9.81], amplitude: always() });
    problem.forces = vec![NodalForce { set: "right".into(), total_n: [0.1, 0.02, 0.0], amplitude: always() }];
    let shape = ObstacleShape::Plane { point: [0.0, 0.0, -2e-3], normal: [0.0, 0.0, 1.0] };
    problem.obstacles = vec![Obstacle { shape, friction: 0.3, motion: None }];
    problem.settings.selective_mass = true;
    problem
}

/// A pillow that is blown up.
fn pillow() -> Problem {
    let mesh = generate::pillow(0.1, 8, 1e-3).unwrap();
    let pressure = Pressure::Set(Amplitude::Smooth(vec![(0.0, 0.0), (0.02, 2e3)]));
    let air = Chamber { name: "air".into(), pressure, open_axis: None };
    Problem::new("pillow", mesh, vec![section(), section()], vec![air])
}

#[test]
fn a_case_that_is_moved_by_a_metre_and_turned_by_any_angle_gives_the_same_run() {
    for (make, end_s) in [(flag as fn() -> Problem, 0.03), (pillow, 0.01)] {
        let run = |place: &Place| {
            let mut run = Simulation::new(&place.problem(make())).unwrap();
            run.advance_until(end_s, &mut |_| true).unwrap();
            run
        };
        let still = run(&Place { axis: [1.0, 0.0, 0.0], angle_rad: 0.0, shift_m: [0.0; 3] });
        for (axis, angle_rad, shift_m) in [
            ([0.0, 0.0, 1.0], 0.0, [1.0, 0.0, 0.0]),
            ([0.0, 0.0, 1.0], 0.5, [0.0; 3]),
            ([1.0, 2.0, -3.0], 2.1, [0.5, -0.7, 0.6]),
        ] {
            let place = Place { axis, angle_rad, shift_m };
            let moved = run(&place);
            assert_eq!(moved.step(), still.step());
            for (a, b) in still.positions().iter().zip(moved.positions()) {
                let a = place.at(*a);
                let apart = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-7, "{axis:?} by {angle_rad}: {a:?} and {b:?}");
            }
            let [a, b] = [still.ledger(), moved.ledger()];
            for (a, b) in a.rows.iter().zip(&b.rows) {
                assert!((a.energy_j - b.energy_j).abs() < 1e-5 * still.ledger().scale_j, "{a:?} and {b:?}");
            }
        }
    }
}

/// Pressure in a closed chamber has no resultant force or moment, so a pillow that nothing holds neither moves nor turns.
#[test]
fn a_pillow_that_nothing_holds_stays_where_it_is() {
    let problem = pillow();
    let mut run = Simulation::new(&problem).unwrap();
    let before = run.positions();
    run.advance_until(0.2, &mut |_| true).unwrap();
    let centre = |points: &[V3]| [0, 1, 2].map(|k| points.iter().map(|x| x[k]).sum::<f64>() / points.len() as f64);
    let (from, to) = (centre(&before), centre(&run.positions()));
    // Nodes have different masses: the centre of the places moves with the shape, symmetric in x and y.
    let moved_m = (0..2).map(|k| (to[k] - from[k]).abs()).fold(0.0, f64::max);
    let (mut turned, mut size) = ([0.0; 3], 0.0);
    for (a, b) in before.iter().zip(run.positions()) {
        let [a, b] = [[0, 1, 2].map(|k| a[k] - from[k]), [0, 1, 2].map(|k| b[k] - to[k])];
        let arm = cross(a, b);
        (0..3).for_each(|k| turned[k] += arm[k]);
        size += dot(a, a);
    }
    let turned_rad = turned.iter().map(|t| (t / size).abs()).fold(0.0, f64::max);
    let risen_m = run.positions().iter().map(|x| x[2]).fold(0.0, f64::max);
    assert!(risen_m > 0.01, "the pillow fills: {risen_m}");
    assert!(moved_m < 5e-5 && turned_rad < 1e-3, "moved by {moved_m} m, turned by {turned_rad}");
}
