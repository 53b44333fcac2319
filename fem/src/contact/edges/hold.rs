//! Nothing passes through anything: the motion of a step is changed where two would meet in it.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::body::Edges;
use super::chunk::{EdgeChunk, Hit, MotionBounds};
use crate::contact::push;
use crate::vec3::{Nodes, V3, along, dot, node, sub};

/// Rounds in which pairs are pushed one by one; then what still meets moves as one.
const ROUNDS: usize = 20;
const MOST_ROUNDS: usize = 200;
/// Two closer than this share of the gap are one.
const ONE: f64 = 1e-4;

pub(crate) struct EdgeStep<'a> {
    pub x: &'a [[f64; 4]],
    pub v: &'a [[f64; 4]],
    /// Time between the middles of the last step and this one \[s\].
    pub(crate) dv_s: f64,
    pub dt_s: f64,
    pub damping_1_s: f64,
}

impl Edges {
    /// Adds the forces that keep pairs from meeting in the step; all other forces are in `force`.
    pub(crate) fn hold(&mut self, step: &EdgeStep, force: &mut Nodes) {
        let (one_m, least_m) = (ONE * self.gap_m.min(self.thickness_m), self.least_m());
        let mut motion: Vec<V3> = (0..step.x.len()).map(|i| self.motion(step, force, i)).collect();
        let start_m = self.searched.path_m;
        self.searched.path_m += furthest_m(&motion);
        // Chunks with nodes that the last round moved.
        let mut due = vec![true; self.chunks.len()];
        let (mut changed, mut zones) = (BTreeSet::new(), Zones::default());
        for round in 0..MOST_ROUNDS {
            let look = MotionBounds { x: step.x, by: &motion, path_m: self.searched.path_m, one_m, least_m };
            let hits = meetings(&mut self.chunks, &look, &due);
            if hits.is_empty() {
                break;
            }
            let mut touched: Vec<u32> = hits.iter().flat_map(|hit| hit.nodes).collect();
            if round < ROUNDS {
                hits.iter().for_each(|hit| self.part(hit, &mut motion));
            } else {
                hits.iter().for_each(|hit| zones.join(&hit.nodes));
                for zone in zones.all() {
                    self.stick(&zone, &mut motion);
                    touched.extend(zone);
                }
            }
            due.fill(false);
            for chunk in touched.iter().flat_map(|n| self.around.of(*n as usize)) {
                due[*chunk as usize] = true;
                self.chunks[*chunk as usize].cross_due_m = f64::NEG_INFINITY;
            }
            let moved: Vec<V3> = touched.iter().map(|n| motion[*n as usize]).collect();
            self.searched.path_m = self.searched.path_m.max(start_m + furthest_m(&moved));
            changed.extend(touched);
        }
        self.book(step, &changed, &motion, force);
    }

    /// Motion of a node in the step under these forces.
    fn motion(&self, step: &EdgeStep, force: &Nodes, i: usize) -> V3 {
        let half = 0.5 * step.damping_1_s * step.dv_s;
        let (keep, gain) = ((1.0 - half) / (1.0 + half), step.dv_s / (1.0 + half));
        let (v, f, w) = (step.v[i], force[i], self.mobility_1_kg[i]);
        [0, 1, 2].map(|k| step.dt_s * if w[k] > 0.0 { keep * v[k] + gain * w[k] * f[k] } else { v[k] })
    }

    /// Slows the approach of a pair so that some of its distance is left.
    fn part(&self, Hit { nodes, most_m, touch }: &Hit, motion: &mut [V3]) {
        let n = touch.normal;
        let (mut closing, mut give) = (0.0, 0.0);
        for (node, w) in nodes.iter().zip(touch.weights) {
            let i = *node as usize;
            closing -= w * dot(n, motion[i]);
            give += w * w * (0..3).map(|k| n[k] * n[k] * self.mobility_1_kg[i][k]).sum::<f64>();
        }
        let excess = closing - most_m;
        if excess <= 0.0 || give <= 0.0 {
            return;
        }
        for (node, w) in nodes.iter().zip(touch.weights) {
            let i = *node as usize;
            let push = [0, 1, 2].map(|k| n[k] * self.mobility_1_kg[i][k]);
            motion[i] = along(motion[i], w * excess / give, push);
        }
    }

    /// One motion for all nodes: their mean, or the mean of the driven nodes if there are any.
    fn stick(&self, zone: &[u32], motion: &mut [V3]) {
        (0..3).for_each(|axis| {
            let mobility = |n: &u32| self.mobility_1_kg[*n as usize][axis];
            let driven = zone.iter().any(|n| mobility(n) == 0.0);
            let (mut mass, mut sum) = (0.0, 0.0);
            for n in zone {
                let m = match (mobility(n), driven) {
                    (0.0, _) => 1.0,
                    (_, true) => 0.0,
                    (w, false) => 1.0 / w,
                };
                mass += m;
                sum += m * motion[*n as usize][axis];
            }
            for n in zone.iter().filter(|n| mobility(n) > 0.0) {
                motion[*n as usize][axis] = sum / mass;
            }
        });
    }

    /// Turns changed motions into forces, and adds up their work.
    fn book(&mut self, step: &EdgeStep, changed: &BTreeSet<u32>, motion: &[V3], force: &mut Nodes) {
        if self.held.before_m.is_empty() {
            self.held.before_m = step.x.to_vec();
        }
        let rate = (1.0 + 0.5 * step.damping_1_s * step.dv_s) / (step.dv_s * step.dt_s);
        let mut forces = Vec::new();
        for n in changed {
            let i = *n as usize;
            let (free, mobility) = (self.motion(step, force, i), self.mobility_1_kg[i]);
            let f = |k: usize| if mobility[k] > 0.0 { rate / mobility[k] * (motion[i][k] - free[k]) } else { 0.0 };
            let f = [f(0), f(1), f(2)];
            push(&mut force[i], 1.0, f);
            forces.push((*n, f));
        }
        let came = |n: u32| sub(node(step.x, n as usize), node(&self.held.before_m, n as usize));
        let work: f64 = self.held.forces.iter().chain(&forces).map(|(n, f)| dot(*f, came(*n))).sum();
        self.held.lost_j -= 0.5 * work;
        self.held.forces = forces;
        self.held.before_m.copy_from_slice(step.x);
    }
}

/// Pairs of the chunks that are due that would meet.
fn meetings(chunks: &mut [EdgeChunk], look: &MotionBounds, due: &[bool]) -> Vec<Hit> {
    chunks.par_iter_mut().zip(due).filter(|(_, due)| **due).for_each(|(chunk, _)| chunk.meet(look));
    chunks.iter_mut().flat_map(|chunk| chunk.hits.drain(..)).collect()
}

fn furthest_m(motion: &[V3]) -> f64 {
    motion.iter().map(|m| dot(*m, *m)).fold(0.0, f64::max).sqrt()
}

#[derive(Debug, Default)]
struct Zones {
    of: BTreeMap<u32, u32>,
}

impl Zones {
    fn root(&self, mut n: u32) -> u32 {
        while let Some(up) = self.of.get(&n).filter(|up| **up != n) {
            n = *up;
        }
        n
    }

    fn join(&mut self, nodes: &[u32]) {
        let root = nodes.iter().map(|n| self.root(*n)).min().unwrap_or(0);
        for n in nodes {
            let own = self.root(*n);
            self.of.insert(own, root);
            self.of.entry(*n).or_insert(root);
        }
    }

    fn all(&self) -> Vec<Vec<u32>> {
        let mut zones: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for n in self.of.keys() {
            zones.entry(self.root(*n)).or_default().push(*n);
        }
        zones.into_values().collect()
    }
}
