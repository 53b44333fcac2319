//! Rigid solids in the way of the nodes, fixed or moved: frictionless penalty plus Coulomb friction.
//!
//! ```text
//! d = (x − P)·n            plane;  d = |r| − R, n = r/|r|, r = (x − P) − a (a·(x − P))    cylinder
//! E = ½ k (−d)₊² + ½ k |e|²       N = k (−d)₊       |T| = k |e| ≤ μ N
//! P ← P + s(t)      work of the motion: W ← W + ½ (F_new + F_old)·(s_new − s_old)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | penalty stiffness of the node, see [`penalty_stiffness_n_m`](super::penalty_stiffness_n_m) | N/m |
//! | e | elastic slide remembered per node and obstacle | m |
//! | μ | friction coefficient | - |
//! | s | displacement of a solid that moves | m |
//! | F | force of the solid on all nodes | N |
//!
//! **Validity**: depths well below the radius; nodes do not touch the solid between them, so elements must be smaller
//! than its curvature. Friction: see the return map in `coulomb`.

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};
use rayon::prelude::*;

use super::coulomb::slide;
use crate::bytes::{pack, unpack};
use crate::problem::Obstacle;
use crate::problem::solid::Solid;
use crate::vec3::{V3, add, dot, sub};
use crate::{FemError, Mesh};
use crate::{Tick, Transient};

/// Nodes per parallel chunk.
const CHUNK: usize = 1024;

/// All obstacles of a run.
#[derive(Debug, Clone)]
pub struct Obstacles {
    solids: Vec<Solid>,
    paths: Vec<Path>,
    stiffness_n_m: Vec<f64>,
    /// Elastic slide of every node, one block of nodes per obstacle.
    springs_m: Vec<Vec<[f64; 3]>>,
    /// Positions of the step before; empty before the first step.
    before_m: Vec<[f64; 4]>,
    /// Energy, loss and force of each chunk.
    sums: Vec<[f64; 5]>,
    stored_j: f64,
    friction_j: f64,
    /// Work of solids that move.
    work_j: f64,
}

/// The way of a solid: where it is, and was a step before \[m\], and its force on the nodes then \[N\].
#[derive(Debug, Clone)]
struct Path {
    obstacle: Obstacle,
    now_m: V3,
    before_m: V3,
    force_n: V3,
}

impl Path {
    fn of(obstacle: &Obstacle) -> Path {
        let start = obstacle.moved_m(0.0);
        Path { obstacle: obstacle.clone(), now_m: start, before_m: start, force_n: [0.0; 3] }
    }
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
            paths: obstacles.iter().map(Path::of).collect(),
            solids,
            stiffness_n_m: stiffness_n_m.to_vec(),
            before_m: Vec::new(),
            sums: vec![[0.0; 5]; nodes.div_ceil(CHUNK)],
            stored_j: 0.0,
            friction_j: 0.0,
            work_j: 0.0,
        })
    }
    fn solids_as_text(&self) -> String {
        format!("{:?}", self.solids)
    }
    /// One step of a solid: energy, loss and force on all nodes.
    fn rub(&mut self, solid: usize, x: &[[f64; 4]], force: &mut [[f64; 4]]) -> [f64; 5] {
        let Path { now_m, before_m, .. } = self.paths[solid];
        let (body, before, stiffness) = (&self.solids[solid], &self.before_m, &self.stiffness_n_m);
        let springs = &mut self.springs_m[solid];
        force.par_chunks_mut(CHUNK).zip(springs.par_chunks_mut(CHUNK)).zip(&mut self.sums).enumerate().for_each(
            |(chunk, ((force, springs), sums))| {
                *sums = [0.0; 5];
                for (local, (f, spring)) in force.iter_mut().zip(springs).enumerate() {
                    let i = chunk * CHUNK + local;
                    let [at, was] = [from(&x[i], now_m), from(&before[i], before_m)];
                    let others = *f;
                    let [energy, lost] = body.step(&at, &was, stiffness[i], spring, f);
                    let own = [energy, lost, f[0] - others[0], f[1] - others[1], f[2] - others[2]];
                    (0..5).for_each(|k| sums[k] += own[k]);
                }
            },
        );
        self.sums.iter().fold([0.0; 5], |sum, s| std::array::from_fn(|k| sum[k] + s[k]))
    }
}

/// A place as a solid that has moved by `by` sees it.
fn from(x: &[f64; 4], by: V3) -> [f64; 4] {
    [x[0] - by[0], x[1] - by[1], x[2] - by[2], x[3]]
}

impl Term for Obstacles {
    fn line(&self) -> LedgerLine {
        LedgerLine { name: "obstacles", account: Account::Load }
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy_j = 0.0;
        for ((solid, springs), path) in self.solids.iter().zip(&self.springs_m).zip(&self.paths) {
            for (i, (f, spring)) in force.iter_mut().zip(springs).enumerate() {
                let at = from(&x[i], path.now_m);
                // After a step the places before are those of this moment.
                let before = self.before_m.get(i).map_or(at, |before| from(before, path.now_m));
                energy_j += solid.hold(&at, &before, self.stiffness_n_m[i], spring, f);
            }
        }
        energy_j
    }
}

impl Transient for Obstacles {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let first = self.before_m.is_empty();
        if first {
            self.before_m = x.to_vec();
        }
        let mut energy_j = 0.0;
        for solid in 0..self.solids.len() {
            self.paths[solid].now_m = self.paths[solid].obstacle.moved_m(tick.time_s);
            let [energy, lost, fx, fy, fz] = self.rub(solid, x, force);
            energy_j += energy;
            self.friction_j += lost;
            let Path { now_m, before_m, force_n, .. } = &mut self.paths[solid];
            if !first {
                self.work_j += 0.5 * dot(add([fx, fy, fz], *force_n), sub(*now_m, *before_m));
            }
            (*before_m, *force_n) = (*now_m, [fx, fy, fz]);
        }
        self.before_m.copy_from_slice(x);
        self.stored_j = energy_j;
        energy_j
    }
    /// Lines at the positions of the last step (at `at` before the first).
    fn ledger(&self, at: &Pose) -> Vec<Row> {
        let first = self.before_m.is_empty();
        let stored = if first { self.add(at, &mut vec![0.0; at.q.len()]) } else { self.stored_j };
        let mut rows = vec![
            self.line().row(RowKind::Stored, stored),
            LedgerLine { name: "obstacle friction", account: Account::Load }.row(RowKind::Dissipated, self.friction_j),
        ];
        if self.paths.iter().any(|path| path.obstacle.motion.is_some()) {
            rows.push(
                LedgerLine { name: "obstacle motion", account: Account::Load }.row(RowKind::Supplied, self.work_j),
            );
        }
        rows
    }
    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        let x = at.q.as_chunks::<4>().0;
        for (solid, path) in self.solids.iter().zip(&self.paths) {
            for (i, (bound, k)) in bound.iter_mut().zip(&self.stiffness_n_m).enumerate() {
                if solid.touch(&from(&x[i], path.now_m)).depth_m > 0.0 {
                    *bound += k;
                }
            }
        }
    }
    fn save(&self) -> Vec<u8> {
        let paths: Vec<_> = self.paths.iter().map(|p| [p.now_m, p.before_m, p.force_n]).collect();
        pack(&(
            self.solids_as_text(),
            self.stored_j,
            self.friction_j,
            self.work_j,
            &self.before_m,
            &self.springs_m,
            paths,
        ))
    }
    fn restore(&mut self, saved: &[u8]) -> bool {
        let Some((solids, stored_j, friction_j, work_j, before_m, springs_m, paths)) = unpack::<Saved>(saved) else {
            return false;
        };
        let lengths = |springs: &[Vec<V3>]| springs.iter().map(Vec::len).collect::<Vec<_>>();
        let fits = before_m.is_empty() || before_m.len() == self.stiffness_n_m.len();
        if !fits
            || solids != self.solids_as_text()
            || lengths(&springs_m) != lengths(&self.springs_m)
            || paths.len() != self.paths.len()
        {
            return false;
        }
        (self.stored_j, self.friction_j, self.work_j) = (stored_j, friction_j, work_j);
        (self.before_m, self.springs_m) = (before_m, springs_m);
        for (path, saved) in self.paths.iter_mut().zip(paths) {
            [path.now_m, path.before_m, path.force_n] = saved;
        }
        true
    }
}

/// Solids, stored and lost energy, work of the motion, positions before, springs, ways.
type Saved = (String, f64, f64, f64, Vec<[f64; 4]>, Vec<Vec<V3>>, Vec<[V3; 3]>);

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
