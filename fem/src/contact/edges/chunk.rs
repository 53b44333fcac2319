//! A few hundred pairs that are looked at and stepped together.

use super::pair::{Pair, Scene};
use crate::vec3::{V3, add, dot, node, scale, sub};

/// Pairs per chunk.
pub(super) const PAIRS: usize = 512;

/// Force of one pair, and how its four nodes share it.
pub(super) type Push = ([u32; 4], [f64; 4], V3);

/// Pairs in order of their sides.
#[derive(Debug, Clone, Default)]
pub(super) struct Chunk {
    pub pairs: Vec<Pair>,
    /// Nodes of the pairs, ascending.
    pub nodes: Vec<u32>,
    /// Pairs that may touch before the next look.
    pub near: Vec<u32>,
    /// Positions of the nodes at the last look.
    pub seen_m: Vec<[f64; 4]>,
    /// Each node may move this much against the others before the next look.
    pub allowed_m: f64,
    /// Path of the fastest node at which the motion must be measured again.
    pub due_m: f64,
    /// Forces of the last step.
    pub pushes: Vec<Push>,
    /// Energy stored, and lost in the last step \[J\].
    pub sums: [f64; 2],
}

impl Chunk {
    pub fn new(pairs: Vec<Pair>) -> Chunk {
        let mut nodes: Vec<u32> = pairs.iter().flat_map(|p| p.nodes).collect();
        nodes.sort_unstable();
        nodes.dedup();
        Chunk { pairs, nodes, due_m: f64::NEG_INFINITY, ..Chunk::default() }
    }

    /// One step: looks again if nodes moved too far, then evaluates the near pairs.
    pub fn step(&mut self, scene: &Scene, path_m: f64, slack_m: f64) {
        self.sums = [0.0; 2];
        self.pushes.clear();
        if path_m >= self.due_m && self.moved_too_far(scene, path_m) {
            self.look(scene, path_m, slack_m);
        }
        for at in &self.near {
            let pair = &mut self.pairs[*at as usize];
            let Some(touch) = pair.update(scene) else {
                if pair.deep_m > 0.0 {
                    self.sums[1] += pair.release();
                }
                continue;
            };
            if pair.deep_m > 0.0 || (pair.on && touch.depth_m > 0.0) {
                let force = pair.press(&touch, scene.dt_s, &mut self.sums);
                if force > 0.0 {
                    self.pushes.push((pair.nodes, touch.weights, scale(touch.normal, force)));
                }
            } else {
                (pair.last_m, pair.damped_n) = (touch.depth_m, 0.0);
            }
        }
    }

    /// Measures how far nodes moved against the mean motion, or puts the next measurement off.
    fn moved_too_far(&mut self, scene: &Scene, path_m: f64) -> bool {
        if self.seen_m.is_empty() {
            return true;
        }
        let moved = |(n, seen): (&u32, &[f64; 4])| sub(node(scene.x, *n as usize), [seen[0], seen[1], seen[2]]);
        let all = || self.nodes.iter().zip(&self.seen_m).map(moved);
        let mean = scale(all().fold([0.0; 3], add), 1.0 / self.nodes.len() as f64);
        let far = all().map(|m| sub(m, mean)).map(|m| dot(m, m)).fold(0.0, f64::max).sqrt();
        let left = self.allowed_m - far;
        // A node and the mean may part at twice the pace of the fastest node.
        self.due_m = path_m + 0.5 * left;
        left <= 0.05 * self.allowed_m || left.is_nan()
    }

    /// Decides ways and which pairs may touch soon.
    pub fn look(&mut self, scene: &Scene, path_m: f64, slack_m: f64) {
        let mut closest_m = f64::INFINITY;
        let mut gaps = Vec::with_capacity(self.pairs.len());
        for pair in &mut self.pairs {
            let gap_m = pair.settle(scene) - pair.rest_m.max(0.0);
            closest_m = closest_m.min(gap_m);
            gaps.push(gap_m);
        }
        // Half of the way left, so that a far pair is looked at again well before it touches.
        let between = (0.5 * closest_m).clamp(slack_m, 0.25 * scene.reach_m + slack_m);
        self.near.clear();
        for (at, (pair, gap_m)) in self.pairs.iter_mut().zip(gaps).enumerate() {
            if gap_m <= between || pair.deep_m > 0.0 {
                self.near.push(at as u32);
            } else {
                (pair.sign, pair.on, pair.damped_n) = (0, false, 0.0);
            }
        }
        self.allowed_m = 0.5 * between;
        self.due_m = path_m + 0.5 * self.allowed_m;
        self.seen_m.clear();
        self.seen_m.extend(self.nodes.iter().map(|n| scene.x[*n as usize]));
    }
}
