use super::*;
use crate::problem::{Amplitude, ObstacleShape};
use models::RowKind;

const G: f64 = 9.81;

fn term(shape: ObstacleShape, friction: f64, stiffness: &[f64]) -> Obstacles {
    let mesh = Mesh { points: vec![[0.0; 3]; stiffness.len()], ..Mesh::default() };
    Obstacles::new(&mesh, &[Obstacle { shape, friction, motion: None }], stiffness).unwrap()
}

/// A node of 1 kg under a constant force, by central differences; returns way, speed and work of the force.
struct Block {
    term: Obstacles,
    x: Vec<f64>,
    v: Vec<f64>,
    pull: V3,
    step: u64,
}

const DT: f64 = 1e-4;
const K: f64 = 0.1 / (DT * DT);

impl Block {
    fn step(&mut self) {
        let mut force = vec![0.0; 4];
        let tick = Tick { step: self.step, time_s: self.step as f64 * DT, dt_s: DT };
        self.term.advance(&Pose::nodes(&self.x), &tick, &mut force);
        for (axis, (f, pull)) in force.iter().zip(self.pull).enumerate() {
            self.v[axis] += DT * (f + pull);
            self.x[axis] += DT * self.v[axis];
        }
        self.step += 1;
    }
    /// Stored, lost by friction, by damping.
    fn rows(&self) -> [f64; 3] {
        let rows = self.term.ledger(&Pose::nodes(&self.x));
        [0, 1, 2].map(|row: usize| rows[row].energy_j)
    }
}

/// A block at rest on an incline, already pressed in by its own weight.
fn incline(angle_rad: f64, friction: f64) -> Block {
    let plane = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let pull = [G * angle_rad.sin(), 0.0, -G * angle_rad.cos()];
    let x = vec![0.0, 0.0, pull[2] / K, 0.0];
    Block { term: term(plane, friction, &[K]), x, v: vec![0.0; 4], pull, step: 0 }
}

#[test]
fn a_block_on_an_incline_sticks_below_the_friction_angle() {
    let mut block = incline(0.29, 0.3);
    let whole = block.pull[0];
    for i in 0..20_000 {
        block.pull[0] = whole * (i as f64 / 5000.0).min(1.0);
        block.step();
    }
    let give = whole / K;
    assert!((block.x[0] - give).abs() < 0.01 * give, "{} m instead of an elastic {give} m", block.x[0]);
    assert_eq!(block.rows()[1], 0.0);
}

#[test]
fn a_block_on_an_incline_slides_with_the_acceleration_of_coulomb() {
    let (angle, friction): (f64, f64) = (0.5, 0.3);
    let mut block = incline(angle, friction);
    for _ in 0..10_000 {
        block.step();
    }
    let exact = G * (angle.sin() - friction * angle.cos());
    assert!((block.v[0] / 1.0 - exact).abs() < 0.01 * exact, "{} against {exact} m/s", block.v[0]);
    let [stored, lost, damping] = block.rows();
    let work = block.pull[0] * block.x[0];
    let kinetic = 0.5 * block.v[0] * block.v[0];
    assert!((work - kinetic - lost - stored - damping).abs() < 2e-3 * work, "{work} {kinetic} {lost} {stored}");
    assert!((lost - friction * G * angle.cos() * block.x[0]).abs() < 2e-3 * lost);
}

#[test]
fn a_node_that_fell_on_a_plane_comes_to_rest_on_it_and_damping_has_its_energy() {
    let plane = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 2.0] };
    let mut ball = Block {
        term: term(plane, 0.0, &[K]),
        x: vec![0.0, 0.0, 0.1, 0.0],
        v: vec![0.0; 4],
        pull: [0.0, 0.0, -G],
        step: 0,
    };
    let (mut lowest, mut highest): (f64, f64) = (1.0, 0.0);
    for _ in 0..5000 {
        ball.step();
        lowest = lowest.min(ball.x[2]);
        highest = if lowest < 0.0 { highest.max(ball.x[2]) } else { 0.0 };
    }
    let speed = (2.0 * G * 0.1_f64).sqrt();
    assert!(-lowest < speed / K.sqrt(), "depth {lowest}");
    // A dashpot of 0.4 of critical that does not pull returns a third of the speed.
    assert!((0.005..0.02).contains(&highest), "{highest}");
    assert!((ball.x[2] + G / K).abs() < 1e-3 * G / K && ball.v[2].abs() < 1e-9, "{} {}", ball.x[2], ball.v[2]);
    let fallen = G * (0.1 - ball.x[2]);
    let [stored, _, damping] = ball.rows();
    assert!((stored + damping - fallen).abs() < 2e-3 * fallen, "{stored} + {damping} of {fallen}");
}

#[test]
fn force_is_the_slope_of_the_energy_inside_and_exactly_zero_outside() {
    let cylinder = ObstacleShape::Cylinder { point: [0.1, 0.0, 0.2], axis: [0.0, 3.0, 1.0], radius_m: 0.05 };
    for friction in [0.0, 0.4] {
        let mut term = term(cylinder.clone(), friction, &[1e4, 1e4]);
        let at = [0.12, 0.3, 0.31, 0.0, 0.4, 0.0, 0.2, 0.0];
        let tick = Tick { step: 0, time_s: 0.0, dt_s: DT };
        term.advance(&Pose::nodes(&at), &tick, &mut [0.0; 8]);
        let mut force = [0.0; 8];
        assert!(term.add(&Pose::nodes(&at), &mut force) > 0.0);
        assert_eq!(force[4..], [0.0; 4]);
        for axis in 0..3 {
            let mut slope = 0.0;
            for sign in [1.0, -1.0] {
                let mut moved = at;
                moved[axis] += sign * 1e-7;
                slope += sign * term.add(&Pose::nodes(&moved), &mut [0.0; 8]) / 2e-7;
            }
            assert!((force[axis] + slope).abs() < 1e-6 * 1e4 * 0.05, "{axis}: {} {slope}", force[axis]);
        }
    }
}

#[test]
fn a_restored_obstacle_goes_on_to_the_bit_and_refuses_what_does_not_fit() {
    let mut one = incline(0.5, 0.3);
    for _ in 0..100 {
        one.step();
    }
    let saved = one.term.save();
    let mut two = incline(0.5, 0.3);
    assert!(two.term.restore(&saved).is_some());
    assert!(two.term.restore(&saved[..8]).is_none() && two.term.restore(&[]).is_none());
    (two.x, two.v, two.step) = (one.x.clone(), one.v.clone(), one.step);
    for _ in 0..100 {
        one.step();
        two.step();
    }
    assert_eq!(one.x, two.x);
    assert_eq!(one.rows(), two.rows());
}

#[test]
fn the_stiffness_bound_is_the_spring_of_the_nodes_that_touch() {
    let plane = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let mut bound = [1.0; 2];
    let q = [0.0, 0.0, -1e-4, 0.0, 0.0, 0.0, 0.1, 0.0];
    term(plane, 0.0, &[5.0, 5.0]).stiffness_bound(&Pose::nodes(&q), &mut bound);
    assert_eq!(bound, [6.0, 1.0]);
}

#[test]
fn an_impossible_obstacle_is_named() {
    let mesh = Mesh { points: vec![[0.0; 3]], ..Mesh::default() };
    let good = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let flat = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0; 3] };
    let thin = ObstacleShape::Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius_m: -1.0 };
    for (shape, friction, what) in [(flat, 0.0, "normal"), (thin, 0.0, "radius"), (good.clone(), f64::NAN, "friction")]
    {
        let list =
            [Obstacle { shape: good.clone(), friction: 0.0, motion: None }, Obstacle { shape, friction, motion: None }];
        let message = Obstacles::new(&mesh, &list, &[1.0]).unwrap_err().to_string();
        assert!(message.contains("obstacle 2") && message.contains(what), "{message}");
    }
}

/// A plate rises under a block and draws it along: its work is what the block gains, and what friction takes.
#[test]
fn the_work_of_an_obstacle_that_moves_is_kinetic_potential_stored_and_lost_energy() {
    let plane = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let to = |m: f64| Amplitude::Smooth(vec![(0.1, 0.0), (0.6, m)]);
    let motion = Some([to(0.4), Amplitude::Constant(0.0), to(0.05)]);
    let mesh = Mesh { points: vec![[0.0; 3]], ..Mesh::default() };
    let term = Obstacles::new(&mesh, &[Obstacle { shape: plane, friction: 0.1, motion }], &[K]).unwrap();
    let mut block = Block { term, x: vec![0.0, 0.0, -G / K, 0.0], v: vec![0.0; 4], pull: [0.0, 0.0, -G], step: 0 };
    let start = block.x[2];
    let mut fastest: f64 = 0.0;
    for step in 0..9000 {
        block.step();
        fastest = fastest.max(block.v[0]);
        if step % 1000 == 999 {
            // The ledger is of the last force, half a step of motion before.
            let rows = block.term.ledger(&Pose::nodes(&block.x));
            let sum = |kind: RowKind| rows.iter().filter(|r| r.kind == kind).map(|r| r.energy_j).sum::<f64>();
            let [stored, lost, work] = [RowKind::Stored, RowKind::Dissipated, RowKind::Supplied].map(sum);
            let kinetic: f64 = 0.5 * block.v.iter().map(|v| v * v).sum::<f64>();
            let gained = kinetic + G * (block.x[2] - start) + (stored - 0.5 * G * G / K) + lost;
            assert!((work - gained).abs() < 2e-3 * (lost + 0.05 * G), "{step}: {work} {gained} {lost}");
        }
    }
    // The plate outruns the block, which Coulomb's force accelerates and stops again.
    assert!(fastest > 0.2 && fastest < 1.0 && block.x[0] > 0.1 && block.x[0] < 0.35, "{fastest} {:?}", block.x);
    assert!((block.x[2] - start - 0.05).abs() < 1e-3, "{}", block.x[2]);
}
