//! Fixed rigid solids in the way of the nodes: frictionless penalty plus Coulomb friction.
//!
//! ```text
//! d = (x − P)·n            plane;  d = |r| − R, n = r/|r|, r = (x − P) − a (a·(x − P))    cylinder
//! E = ½ k (−d)₊² + ½ k |e|²       N = k (−d)₊       |T| = k |e| ≤ μ N
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | penalty stiffness of the node, see [`penalty_stiffness_n_m`](super::penalty_stiffness_n_m) | N/m |
//! | e | elastic slide remembered per node and obstacle | m |
//! | μ | friction coefficient | - |
//!
//! **Validity**: depths well below the radius; nodes do not touch the solid between them, so elements must be smaller
//! than its curvature. Friction: see the return map in `coulomb`.

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};
use rayon::prelude::*;

use super::coulomb::slide;
use crate::bytes::{pack, unpack};
use crate::problem::Obstacle;
use crate::problem::solid::Solid;
use crate::vec3::{V3, dot};
use crate::{FemError, Mesh};
use crate::{Tick, Transient};

/// Nodes per parallel chunk.
const CHUNK: usize = 1024;

/// All obstacles of a run.
#[derive(Debug, Clone)]
pub struct Obstacles {
    solids: Vec<Solid>,
    stiffness_n_m: Vec<f64>,
    /// Elastic slide of every node, one block of nodes per obstacle.
    springs_m: Vec<Vec<[f64; 3]>>,
    /// Positions of the step before; empty before the first step.
    before_m: Vec<[f64; 4]>,
    /// Energy and loss of each chunk.
    sums: Vec<[f64; 2]>,
    stored_j: f64,
    friction_j: f64,
}

impl Obstacles {
    /// Obstacles for the nodes of `mesh` (solver's node order), with a penalty stiffness per node.
    ///
    /// # Errors
    /// [`FemError::Problem`] naming an obstacle (from 1) with a zero direction, a radius or a friction out of range.
    pub fn new(mesh: &Mesh, obstacles: &[Obstacle], stiffness_n_m: &[f64]) -> Result<Obstacles, FemError> {
        let nodes = mesh.points.len();
        if stiffness_n_m.len() != nodes {
            return Err(FemError::Problem(format!("{} stiffnesses for {nodes} nodes", stiffness_n_m.len())));
        }
        let solids = obstacles.iter().enumerate().map(|(i, o)| Solid::new(i, o)).collect::<Result<Vec<_>, _>>()?;
        Ok(Obstacles {
            springs_m: vec![vec![[0.0; 3]; nodes]; solids.len()],
            solids,
            stiffness_n_m: stiffness_n_m.to_vec(),
            before_m: Vec::new(),
            sums: vec![[0.0; 2]; nodes.div_ceil(CHUNK)],
            stored_j: 0.0,
            friction_j: 0.0,
        })
    }
    fn rub(&mut self, solid: usize, x: &[[f64; 4]], force: &mut [[f64; 4]]) -> [f64; 2] {
        let (body, before, stiffness) = (&self.solids[solid], &self.before_m, &self.stiffness_n_m);
        let springs = &mut self.springs_m[solid];
        force.par_chunks_mut(CHUNK).zip(springs.par_chunks_mut(CHUNK)).zip(&mut self.sums).enumerate().for_each(
            |(chunk, ((force, springs), sums))| {
                *sums = [0.0; 2];
                for (local, (f, spring)) in force.iter_mut().zip(springs).enumerate() {
                    let i = chunk * CHUNK + local;
                    let [energy, lost] = body.step(&x[i], &before[i], stiffness[i], spring, f);
                    sums[0] += energy;
                    sums[1] += lost;
                }
            },
        );
        self.sums.iter().fold([0.0; 2], |sum, s| [sum[0] + s[0], sum[1] + s[1]])
    }
}

impl Term for Obstacles {
    fn line(&self) -> LedgerLine {
        LedgerLine { name: "obstacles", account: Account::Load }
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy_j = 0.0;
        for (solid, springs) in self.solids.iter().zip(&self.springs_m) {
            for (i, (f, spring)) in force.iter_mut().zip(springs).enumerate() {
                let before = self.before_m.get(i).unwrap_or(&x[i]);
                energy_j += solid.hold(&x[i], before, self.stiffness_n_m[i], spring, f);
            }
        }
        energy_j
    }
}

impl Transient for Obstacles {
    fn advance(&mut self, at: &Pose, _tick: &Tick, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        if self.before_m.is_empty() {
            self.before_m = x.to_vec();
        }
        let mut energy_j = 0.0;
        for solid in 0..self.solids.len() {
            let [energy, lost] = self.rub(solid, x, force);
            energy_j += energy;
            self.friction_j += lost;
        }
        self.before_m.copy_from_slice(x);
        self.stored_j = energy_j;
        energy_j
    }
    /// Lines at the positions of the last step (at `at` before the first).
    fn ledger(&self, at: &Pose) -> Vec<Row> {
        let first = self.before_m.is_empty();
        let stored = if first { self.add(at, &mut vec![0.0; at.q.len()]) } else { self.stored_j };
        vec![
            self.line().row(RowKind::Stored, stored),
            LedgerLine { name: "obstacle friction", account: Account::Load }.row(RowKind::Dissipated, self.friction_j),
        ]
    }
    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        let x = at.q.as_chunks::<4>().0;
        for solid in &self.solids {
            for (i, (bound, k)) in bound.iter_mut().zip(&self.stiffness_n_m).enumerate() {
                if solid.touch(&x[i]).depth_m > 0.0 {
                    *bound += k;
                }
            }
        }
    }
    fn save(&self) -> Vec<u8> {
        pack(&(self.stored_j, self.friction_j, &self.before_m, &self.springs_m))
    }
    fn restore(&mut self, saved: &[u8]) -> bool {
        let Some((stored_j, friction_j, before_m, springs_m)) = unpack::<Saved>(saved) else { return false };
        let lengths = |springs: &[Vec<V3>]| springs.iter().map(Vec::len).collect::<Vec<_>>();
        let fits = before_m.is_empty() || before_m.len() == self.stiffness_n_m.len();
        if !fits || lengths(&springs_m) != lengths(&self.springs_m) {
            return false;
        }
        (self.stored_j, self.friction_j, self.before_m, self.springs_m) = (stored_j, friction_j, before_m, springs_m);
        true
    }
}

/// Stored and lost energy, positions before, springs.
type Saved = (f64, f64, Vec<[f64; 4]>, Vec<Vec<V3>>);

impl Solid {
    /// One step: force, energy and loss; the spring is updated.
    #[inline]
    fn step(&self, x: &[f64; 4], before: &[f64; 4], k: f64, spring: &mut V3, force: &mut [f64; 4]) -> [f64; 2] {
        let touch = self.touch(x);
        if touch.depth_m <= 0.0 && *spring == [0.0; 3] {
            return [0.0; 2];
        }
        let normal_n = k * touch.depth_m.max(0.0);
        let mut lost = 0.0;
        if self.friction > 0.0 {
            (*spring, lost) = slide(*spring, moved(x, before), touch.normal, k, self.friction * normal_n);
        }
        push(force, normal_n, touch.normal, k, spring);
        [0.5 * k * (touch.depth_m.max(0.0).powi(2) + dot(*spring, *spring)), lost]
    }
    /// Force and energy at a pose, with the spring moved there from where it was remembered; nothing is remembered.
    fn hold(&self, x: &[f64; 4], before: &[f64; 4], k: f64, spring: &V3, force: &mut [f64; 4]) -> f64 {
        let mut spring = *spring;
        self.step(x, before, k, &mut spring, force)[0]
    }
}

fn moved(x: &[f64; 4], before: &[f64; 4]) -> V3 {
    [x[0] - before[0], x[1] - before[1], x[2] - before[2]]
}

fn push(force: &mut [f64; 4], normal_n: f64, normal: V3, k: f64, spring: &V3) {
    for axis in 0..3 {
        force[axis] += normal_n * normal[axis] - k * spring[axis];
    }
}

#[cfg(test)]
#[path = "obstacles_tests.rs"]
mod tests;
