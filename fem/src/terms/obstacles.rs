//! Rigid solids in the way of the nodes, fixed or moved: penalty and damping along the normal, Coulomb friction across it.
//!
//! ```text
//! d = (x − P)·n            plane;  d = |r| − R, n = r/|r|, r = (x − P) − a (a·(x − P))    cylinder
//! E = ½ k (−d)₊² + ½ k |e|²       N = k (−d)₊ − c ḋ ≥ 0       |T| = k |e| ≤ μ N
//! P ← P + s(t)      work of the motion: W ← W + ½ (F_new + F_old)·(s_new − s_old)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | penalty stiffness of the node, see [`penalty_stiffness_n_m`](super::penalty_stiffness_n_m) | N/m |
//! | c | 2 ζ √(k m), ζ = 0.4: a node comes to rest on the solid instead of bouncing, which would end each time it sticks | N·s/m |
//! | e | elastic slide remembered per node and obstacle | m |
//! | μ | friction coefficient | - |
//! | s | displacement of a solid that moves | m |
//! | F | force of the solid on all nodes | N |
//!
//! **Validity**: depths well below the radius; nodes do not touch the solid between them, so elements must be smaller
//! than its curvature. Friction: see the return map in `coulomb`.

use models::{Account, LedgerLine, Pose, Row, Term};
use rayon::prelude::*;

use super::coulomb::slide;
use crate::bytes::{pack, unpack};
use crate::problem::Obstacle;
use crate::problem::solid::Solid;
use crate::transient::{self, dissipated, supplied};
use crate::vec3::{Nodes, V3, add, dot, sub};
use crate::{FemError, Mesh, Result};
use crate::{Tick, Transient};

const CHUNK: usize = 1024;
/// c/(k Δt) = 2 ζ/√(k Δt²/m) with ζ = 0.4 and k Δt²/m = [`SHARE`](super::SHARE). Central differences bear 2 c Δt/m = 0.5 in addition to k
/// and a mesh at 0.9 of the mesh's limit.
const DAMPING: f64 = 2.53;

/// Obstacles of a run, with stiffness, friction and energies of their contact.
#[derive(Debug, Clone, Default)]
pub struct Obstacles {
    solids: Vec<Solid>,
    paths: Vec<SolidPath>,
    stiffness_n_m: Vec<f64>,
    /// Of every node, one block of nodes per obstacle.
    grips: Vec<Vec<Grip>>,
    /// Positions of the step before; empty before the first step.
    before_m: Vec<[f64; 4]>,
    /// Energies of each chunk, and force on its nodes.
    sums: Vec<[f64; 6]>,
    stored_j: f64,
    /// Lost by friction and by damping.
    lost_j: [f64; 2],
    /// Work that moving solids have done on the fabric so far \[J\].
    work_j: f64,
}

/// The way of a solid: where it is, and was a step before \[m\], and its force on the nodes then \[N\].
#[derive(Debug, Clone)]
struct SolidPath {
    obstacle: Obstacle,
    now_m: V3,
    before_m: V3,
    force_n: V3,
}

impl SolidPath {
    fn of(obstacle: &Obstacle) -> SolidPath {
        let start = obstacle.moved_m(0.0);
        SolidPath { obstacle: obstacle.clone(), now_m: start, before_m: start, force_n: [0.0; 3] }
    }
}

/// What a node remembers of an obstacle: elastic slide \[m\] and force of damping \[N\].
type Grip = (V3, f64);

impl Obstacles {
    /// Obstacles for the nodes of `mesh` (solver's node order), with a penalty stiffness per node.
    ///
    /// # Errors
    /// [`FemError::Problem`] naming an obstacle (from 1) with a zero direction, a radius or a friction out of range.
    pub fn new(mesh: &Mesh, obstacles: &[Obstacle], stiffness_n_m: &[f64]) -> Result<Obstacles> {
        let nodes = mesh.points.len();
        if stiffness_n_m.len() != nodes {
            return Err(FemError::Problem(format!("{} stiffnesses for {nodes} nodes", stiffness_n_m.len())));
        }
        let solids = obstacles.iter().enumerate().map(|(i, o)| Solid::new(i, o)).collect::<Result<Vec<_>, _>>()?;
        Ok(Obstacles {
            grips: vec![vec![Grip::default(); nodes]; solids.len()],
            paths: obstacles.iter().map(SolidPath::of).collect(),
            solids,
            stiffness_n_m: stiffness_n_m.to_vec(),
            sums: vec![[0.0; 6]; nodes.div_ceil(CHUNK)],
            ..Obstacles::default()
        })
    }
    fn solids_as_text(&self) -> String {
        format!("{:?}", self.solids)
    }
    /// Energy stored and lost by friction and by damping, in this step, and force on all nodes.
    fn rub(&mut self, solid: usize, x: &Nodes, force: &mut Nodes) -> [f64; 6] {
        let SolidPath { now_m, before_m, .. } = self.paths[solid];
        let (body, before, stiffness) = (&self.solids[solid], &self.before_m, &self.stiffness_n_m);
        let grips = &mut self.grips[solid];
        force.par_chunks_mut(CHUNK).zip(grips.par_chunks_mut(CHUNK)).zip(&mut self.sums).enumerate().for_each(
            |(chunk, ((force, grips), sums))| {
                *sums = [0.0; 6];
                for (local, (f, grip)) in force.iter_mut().zip(grips).enumerate() {
                    let i = chunk * CHUNK + local;
                    let [at, was] = [from(&x[i], now_m), from(&before[i], before_m)];
                    let others = *f;
                    let energies = body.step(&at, &was, stiffness[i], grip, f);
                    (0..3).for_each(|k| sums[k] += energies[k]);
                    (0..3).for_each(|k| sums[3 + k] += f[k] - others[k]);
                }
            },
        );
        self.sums.iter().fold([0.0; 6], |sum, s| std::array::from_fn(|k| sum[k] + s[k]))
    }
}

/// A place as a solid that has moved by `by` sees it.
fn from(x: &[f64; 4], by: V3) -> [f64; 4] {
    [x[0] - by[0], x[1] - by[1], x[2] - by[2], x[3]]
}

impl Term for Obstacles {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("obstacles", Account::Load)
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy_j = 0.0;
        for ((solid, grips), path) in self.solids.iter().zip(&self.grips).zip(&self.paths) {
            for (i, (f, (spring, _))) in force.iter_mut().zip(grips).enumerate() {
                let at = from(&x[i], path.now_m);
                // After a step `before_m` holds the places of this moment.
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
            let [energy, friction, damping, fx, fy, fz] = self.rub(solid, x, force);
            energy_j += energy;
            self.lost_j[0] += friction;
            self.lost_j[1] += damping;
            let SolidPath { now_m, before_m, force_n, .. } = &mut self.paths[solid];
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
            transient::stored("obstacles", Account::Load, stored),
            dissipated("obstacle friction", Account::Load, self.lost_j[0]),
            dissipated("obstacle damping", Account::Load, self.lost_j[1]),
        ];
        let moves = self.paths.iter().any(|path| path.obstacle.motion.is_some());
        rows.extend(moves.then(|| supplied("obstacle motion", Account::Load, self.work_j)));
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
        pack(&(self.solids_as_text(), [self.stored_j, self.work_j], self.lost_j, &self.before_m, &self.grips, paths))
    }
    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let (solids, [stored_j, work_j], lost_j, before_m, grips, paths): SavedObstacles = unpack(saved)?;
        let lengths = |grips: &[Vec<Grip>]| grips.iter().map(Vec::len).collect::<Vec<_>>();
        let fits = before_m.is_empty() || before_m.len() == self.stiffness_n_m.len();
        let known = solids == self.solids_as_text() && lengths(&grips) == lengths(&self.grips);
        (fits && known).then_some(())?;
        (self.stored_j, self.work_j, self.lost_j) = (stored_j, work_j, lost_j);
        (self.before_m, self.grips) = (before_m, grips);
        for (path, saved) in self.paths.iter_mut().zip(paths) {
            [path.now_m, path.before_m, path.force_n] = saved;
        }
        Some(())
    }
}

/// Solids, energy stored and work, energies lost, positions before, memory of the nodes, ways.
type SavedObstacles = (String, [f64; 2], [f64; 2], Vec<[f64; 4]>, Vec<Vec<Grip>>, Vec<[V3; 3]>);

impl Solid {
    /// One step: force, energy stored and lost by friction and by damping; the memory is updated. Damping has what the normal
    /// force did in the step less what the penalty stores: with it what a step takes or gives that begins or ends outside.
    #[inline]
    fn step(&self, x: &[f64; 4], before: &[f64; 4], k: f64, grip: &mut Grip, force: &mut [f64; 4]) -> V3 {
        let touch = self.touch(x);
        if touch.depth_m <= 0.0 && *grip == Grip::default() {
            return [0.0; 3];
        }
        let (spring, damped_n) = grip;
        let last_m = self.touch(before).depth_m;
        let deep = touch.depth_m.max(0.0);
        let was = last_m.max(0.0);
        let closed = touch.depth_m - last_m;
        let damped_before_n = *damped_n;
        // The solid does not pull: damping takes no more than the penalty gives.
        *damped_n = if deep > 0.0 { k * (DAMPING * closed).max(-deep) } else { 0.0 };
        let work = 0.5 * (*damped_n + damped_before_n + k * (deep + was)) * closed;
        let damping = work - 0.5 * k * (deep * deep - was * was);
        let (normal_n, mut friction) = (k * deep + *damped_n, 0.0);
        if self.friction > 0.0 {
            (*spring, friction) = slide(*spring, moved(x, before), touch.normal, k, self.friction * normal_n);
        }
        push(force, normal_n, touch.normal, k, spring);
        [0.5 * k * (deep * deep + dot(*spring, *spring)), friction, damping]
    }
    /// Force and energy at a pose without damping, with the spring moved there from where it was remembered; nothing is
    /// remembered.
    fn hold(&self, x: &[f64; 4], before: &[f64; 4], k: f64, spring: &V3, force: &mut [f64; 4]) -> f64 {
        let touch = self.touch(x);
        let (deep, mut spring) = (touch.depth_m.max(0.0), *spring);
        if self.friction > 0.0 {
            spring = slide(spring, moved(x, before), touch.normal, k, self.friction * k * deep).0;
        }
        push(force, k * deep, touch.normal, k, &spring);
        0.5 * k * (deep * deep + dot(spring, spring))
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
