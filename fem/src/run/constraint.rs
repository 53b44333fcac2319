//! Prescribed motion, ties and rigid bodies.

use crate::problem::{Amplitude, Problem};
use crate::vec3::{Nodes, V3};
use crate::{FemError, Mesh, Result};
use serde::{Deserialize, Serialize};

/// Nodes whose motion is prescribed along some axes.
#[derive(Debug, Clone)]
pub(super) struct Driven {
    pub nodes: Vec<u32>,
    pub axes: [bool; 3],
    pub motion: [Amplitude; 3],
    pub start: Vec<[f64; 3]>,
}

/// A rigid body: nodes that keep their distances.
#[derive(Debug, Clone)]
pub(super) struct RigidBody {
    pub nodes: Vec<u32>,
    mass: Vec<f64>,
    /// Positions relative to the centre of mass at the start \[m\].
    arm: Vec<[f64; 3]>,
    pub now: BodyNow,
}

/// Where a body is, and how it moves.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct BodyNow {
    /// Position of the centre of mass \[m\].
    centre: [f64; 3],
    /// Its velocity half a step back \[m/s\].
    velocity: [f64; 3],
    /// Angular momentum half a step back \[kg m²/s\].
    spin: [f64; 3],
    /// Orientation as a unit quaternion (w, x, y, z).
    turn: [f64; 4],
}

/// Prescribed nodes of a problem; axes that hold still are only masked.
pub(super) fn driven(problem: &Problem, mesh: &Mesh, fixed: &mut [[bool; 3]]) -> Result<Vec<Driven>> {
    let mut all = Vec::new();
    for support in &problem.supports {
        let nodes = mesh.set(&support.set, "support")?;
        for node in nodes {
            for (fixed, axis) in fixed[*node as usize].iter_mut().zip(support.axes) {
                *fixed |= axis;
            }
        }
        if let Some(motion) = &support.motion {
            let start = nodes.iter().map(|n| mesh.start_of(*n as usize)).collect();
            all.push(Driven { nodes: nodes.to_vec(), axes: support.axes, motion: motion.clone(), start });
        }
    }
    Ok(all)
}

impl Driven {
    /// Gives the nodes the velocity that brings them to where they must be at `t`, and returns the work done on the
    /// structure over the step: (m Δv/Δt − f)·v̄ Δt.
    pub(super) fn step(&self, t: f64, dt: f64, mass: &[f64], force: &Nodes, x: &Nodes, v: &mut Nodes) -> f64 {
        let mut work = 0.0;
        let shift = [0, 1, 2].map(|k| self.motion[k].at(t));
        for (node, start) in self.nodes.iter().zip(&self.start) {
            let i = *node as usize;
            for k in (0..3).filter(|k| self.axes[*k]) {
                let target = start[k] + shift[k];
                let velocity = (target - x[i][k]) / dt;
                let mean = 0.5 * (velocity + v[i][k]);
                work += (mass[i] * (velocity - v[i][k]) - force[i][k] * dt) * mean;
                v[i][k] = velocity;
            }
        }
        work
    }
}

pub(super) fn bodies(problem: &Problem, mesh: &Mesh, mass: &[f64]) -> Result<Vec<RigidBody>> {
    let make = |rigid: &crate::problem::Rigid| {
        let nodes = mesh.set(&rigid.set, "rigid")?;
        if nodes.len() < 3 {
            return Err(FemError::Problem(format!("rigid: node set `{}` has fewer than 3 nodes", rigid.set)));
        }
        Ok(RigidBody::new(nodes, mass, |i| mesh.start_of(i)))
    };
    problem.rigid.iter().map(make).collect()
}

impl RigidBody {
    fn new(nodes: &[u32], mass: &[f64], at: impl Fn(usize) -> V3) -> RigidBody {
        let own: Vec<f64> = nodes.iter().map(|n| mass[*n as usize]).collect();
        let total: f64 = own.iter().sum();
        let mut centre = [0.0; 3];
        for (node, m) in nodes.iter().zip(&own) {
            let x = at(*node as usize);
            (0..3).for_each(|k| centre[k] += m / total * x[k]);
        }
        let arm = nodes.iter().map(|n| at(*n as usize)).map(|x| [0, 1, 2].map(|k| x[k] - centre[k])).collect();
        let now = BodyNow { centre, velocity: [0.0; 3], spin: [0.0; 3], turn: [1.0, 0.0, 0.0, 0.0] };
        RigidBody { nodes: nodes.to_vec(), mass: own, arm, now }
    }

    /// One step of the body under the forces on its nodes; sets the velocities that bring them to their places.
    /// Leapfrog in momentum and angular momentum; the orientation turns by the mid-step angular velocity.
    pub(super) fn step(&mut self, dv: f64, dt: f64, damping: f64, force: &Nodes, x: &Nodes, v: &mut Nodes) {
        let mut push = [0.0; 3];
        let mut moment = [0.0; 3];
        for node in &self.nodes {
            let i = *node as usize;
            let f = [force[i][0], force[i][1], force[i][2]];
            let arm = [0, 1, 2].map(|k| x[i][k] - self.now.centre[k]);
            let m = crate::vec3::cross(arm, f);
            (0..3).for_each(|k| push[k] += f[k]);
            (0..3).for_each(|k| moment[k] += m[k]);
        }
        let total: f64 = self.mass.iter().sum();
        let keep = (1.0 - 0.5 * damping * dv) / (1.0 + 0.5 * damping * dv);
        let gain = 1.0 / (1.0 + 0.5 * damping * dv);
        for k in 0..3 {
            self.now.velocity[k] = self.now.velocity[k] * keep + gain * dv * push[k] / total;
            self.now.spin[k] = self.now.spin[k] * keep + gain * dv * moment[k];
        }
        let half = rotate_by(self.now.turn, self.omega(self.now.turn), 0.5 * dt);
        let omega = self.omega(half);
        self.now.turn = rotate_by(self.now.turn, omega, dt);
        let after = matrix(self.now.turn);
        for k in 0..3 {
            self.now.centre[k] += dt * self.now.velocity[k];
        }
        for (node, arm) in self.nodes.iter().zip(&self.arm) {
            let i = *node as usize;
            for k in 0..3 {
                let target = self.now.centre[k] + after[k][0] * arm[0] + after[k][1] * arm[1] + after[k][2] * arm[2];
                v[i][k] = (target - x[i][k]) / dt;
            }
        }
    }

    /// Takes momentum and angular momentum from the velocities of the nodes.
    pub(crate) fn take_velocities(&mut self, x: &Nodes, v: &Nodes) {
        (self.now.velocity, self.now.spin) = ([0.0; 3], [0.0; 3]);
        let total: f64 = self.mass.iter().sum();
        for (node, m) in self.nodes.iter().zip(&self.mass) {
            let (x, v) = (x[*node as usize], v[*node as usize]);
            let arm = [0, 1, 2].map(|k| x[k] - self.now.centre[k]);
            let spin = crate::vec3::cross(arm, [v[0], v[1], v[2]]);
            (0..3).for_each(|k| self.now.velocity[k] += m / total * v[k]);
            (0..3).for_each(|k| self.now.spin[k] += m * spin[k]);
        }
    }

    /// Angular velocity at an orientation \[rad/s\].
    fn omega(&self, turn: [f64; 4]) -> V3 {
        let r = matrix(turn);
        let mut inertia = [[0.0; 3]; 3];
        for (m, arm) in self.mass.iter().zip(&self.arm) {
            let a = [0, 1, 2].map(|k| r[k][0] * arm[0] + r[k][1] * arm[1] + r[k][2] * arm[2]);
            let square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
            for i in 0..3 {
                for j in 0..3 {
                    inertia[i][j] += m * (if i == j { square } else { 0.0 } - a[i] * a[j]);
                }
            }
        }
        solve(inertia, self.now.spin)
    }
}

/// Rotation matrix of a unit quaternion.
fn matrix([w, x, y, z]: [f64; 4]) -> [V3; 3] {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// `turn` after rotating with angular velocity `omega` for `dt`.
fn rotate_by(turn: [f64; 4], omega: V3, dt: f64) -> [f64; 4] {
    let speed = (omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]).sqrt();
    let half = 0.5 * speed * dt;
    let scale = if speed > 0.0 { half.sin() / speed } else { 0.0 };
    let a = [half.cos(), omega[0] * scale, omega[1] * scale, omega[2] * scale];
    let b = turn;
    let mut q = [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ];
    let length = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    q.iter_mut().for_each(|c| *c /= length);
    q
}

/// Solves a symmetric 3×3 system by Cramer's rule; a body on one line spins about it without inertia, so 0 there.
fn solve(a: [V3; 3], b: V3) -> V3 {
    let cross = crate::vec3::cross;
    let dot = crate::vec3::dot;
    let determinant = dot(a[0], cross(a[1], a[2]));
    let scale = a[0][0] + a[1][1] + a[2][2];
    if determinant.abs() <= 1e-12 * scale * scale * scale {
        return [0.0; 3];
    }
    let columns = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])];
    [0, 1, 2].map(|k| (columns[0][k] * b[0] + columns[1][k] * b[1] + columns[2][k] * b[2]) / determinant)
}

/// Hands the forces on tied nodes to the nodes they follow.
pub(crate) fn hand_over(ties: &[crate::mesh::Tie], force: &mut Nodes) {
    for tie in ties {
        let own = std::mem::take(&mut force[tie.node as usize]);
        for (node, weight) in &tie.to {
            for k in 0..3 {
                force[*node as usize][k] += weight * own[k];
            }
        }
    }
}

/// Puts tied nodes where the nodes they follow have gone; `offset` is their distance from there at the start.
pub(super) fn follow(ties: &[crate::mesh::Tie], offset: &[V3], x: &mut Nodes, v: &mut Nodes) {
    for (tie, offset) in ties.iter().zip(offset) {
        let mut place = *offset;
        let mut speed = [0.0; 3];
        for (node, weight) in &tie.to {
            for k in 0..3 {
                place[k] += weight * x[*node as usize][k];
                speed[k] += weight * v[*node as usize][k];
            }
        }
        x[tie.node as usize][..3].copy_from_slice(&place);
        v[tie.node as usize][..3].copy_from_slice(&speed);
    }
}
