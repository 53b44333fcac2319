//! Some dozens of pairs that are looked at and stepped together.

use super::pair::{EdgeTouch, Pair};
use crate::vec3::{Nodes, V3, add, node, norm, scale, sub};

pub(super) const PAIRS: usize = 64;
/// A meeting is a distance below this share of the present one.
const STOP: f64 = 0.2;
/// Share of the way to that distance that a meeting leaves.
const LEFT: f64 = 0.3;
/// Share of the deficit from the least distance by which a meeting separates the pair.
const OUT: f64 = 0.1;

/// Force of one pair, and how its four nodes share it.
pub(super) type Push = ([u32; 4], [f64; 4], V3);

/// A pair that would meet within a step.
#[derive(Debug, Clone)]
pub(super) struct Hit {
    pub nodes: [u32; 4],
    /// How far it may close \[m\].
    pub(crate) most_m: f64,
    pub touch: EdgeTouch,
}

pub(super) struct MotionBounds<'a> {
    pub x: &'a [[f64; 4]],
    pub by: &'a [V3],
    /// How far the fastest node will have come.
    pub(crate) path_m: f64,
    /// Points closer than this count as one.
    pub one_m: f64,
    pub least_m: f64,
}

/// Pairs in order of their keys; a checkpoint leaves out what they give again.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct EdgeChunk {
    pub pairs: Vec<Pair>,
    /// Way at which the spring of each pair may push, and at which the two may meet.
    pub(crate) press_at_m: Vec<f64>,
    pub(crate) cross_at_m: Vec<f64>,
    #[serde(skip)]
    pub nodes: Vec<u32>,
    /// Positions when the way was summed up last.
    pub(crate) seen_m: Vec<[f64; 4]>,
    /// Way: sum of the most that two nodes can have moved against each other.
    pub way_m: f64,
    /// Path of the fastest node at which springs, and meetings, must be looked at again.
    pub(crate) press_due_m: f64,
    pub(crate) cross_due_m: f64,
    #[serde(skip)]
    pub pushes: Vec<Push>,
    /// Energy stored, and lost in the last step \[J\].
    #[serde(skip)]
    pub sums: [f64; 2],
    #[serde(skip)]
    pub hits: Vec<Hit>,
}

impl EdgeChunk {
    /// Pairs with their distances at `x`.
    pub(super) fn new(near: &[(Pair, f64)], x: &Nodes, least_m: f64) -> EdgeChunk {
        let due = f64::NEG_INFINITY;
        let mut chunk = EdgeChunk { press_due_m: due, cross_due_m: due, ..EdgeChunk::default() };
        for (mut pair, distance_m) in near.iter().copied() {
            chunk.press_at_m.push(pair.far_m(distance_m));
            chunk.cross_at_m.push(distance_m - stop_m(distance_m, least_m));
            chunk.pairs.push(pair);
        }
        chunk.nodes = nodes(chunk.pairs.iter());
        chunk.rebase(x, 0.0);
        chunk
    }

    pub(super) fn press(&mut self, x: &Nodes, path_m: f64, dt_s: f64, floor_m: f64) {
        self.sums = [0.0; 2];
        self.pushes.clear();
        if path_m < self.press_due_m {
            return;
        }
        let moved_m = self.spread_m(|n| node(x, n));
        let left_m = least(&self.press_at_m) - self.way_m - moved_m;
        if left_m > 0.0 {
            self.press_due_m = path_m + 0.5 * left_m;
            return;
        }
        self.rebase(x, moved_m);
        for at in 0..self.press_at_m.len() {
            if self.press_at_m[at] > self.way_m {
                continue;
            }
            let pair = &mut self.pairs[at];
            let touch = pair.touch(x);
            let force = pair.press(&touch, dt_s, floor_m, &mut self.sums);
            self.press_at_m[at] = self.way_m + pair.idle_m(&touch);
            if force > 0.0 {
                self.pushes.push((pair.nodes, touch.weights, scale(touch.normal, force)));
            }
        }
        self.press_due_m = path_m + 0.5 * (least(&self.press_at_m) - self.way_m);
    }

    /// Finds pairs that would meet within the motion of a step.
    pub(super) fn meet(&mut self, step: &MotionBounds) {
        self.hits.clear();
        if step.path_m < self.cross_due_m {
            return;
        }
        let (x, by) = (step.x, step.by);
        let there = |n: usize| add(node(x, n), by[n]);
        let mut moved_m = self.spread_m(there);
        let next_m = least(&self.cross_at_m);
        if next_m > self.way_m + moved_m {
            self.cross_due_m = step.path_m + 0.5 * (next_m - self.way_m - moved_m);
            return;
        }
        let before_m = self.spread_m(|n| node(x, n));
        if before_m > 0.0 {
            self.rebase(x, before_m);
            moved_m = self.spread_m(there);
        }
        for at in 0..self.pairs.len() {
            if self.cross_at_m[at] <= self.way_m + moved_m {
                self.try_to_meet(at, step, moved_m);
            }
        }
        self.cross_due_m = step.path_m + 0.5 * (least(&self.cross_at_m) - self.way_m - moved_m);
    }

    fn try_to_meet(&mut self, at: usize, step: &MotionBounds, moved_m: f64) {
        let pair = &self.pairs[at];
        let now = pair.touch(step.x);
        if now.distance_m < step.one_m {
            // One point for two bodies, as in a weld of two meshes.
            self.cross_at_m[at] = self.way_m + step.one_m;
            return;
        }
        let stop_m = stop_m(now.distance_m, step.least_m);
        self.cross_at_m[at] = self.way_m + now.distance_m - stop_m;
        if self.cross_at_m[at] > self.way_m + moved_m {
            return;
        }
        if let Some(touch) = pair.meets(&now, step.x, step.by, stop_m) {
            let missing_m = step.least_m - now.distance_m;
            let most_m = if missing_m > 0.0 { -OUT * missing_m } else { (1.0 - LEFT) * (now.distance_m - stop_m) };
            self.hits.push(Hit { nodes: pair.nodes, most_m, touch });
        }
    }

    /// Measures the way from here on.
    fn rebase(&mut self, x: &Nodes, moved_m: f64) {
        self.way_m += moved_m;
        self.seen_m.clear();
        self.seen_m.extend(self.nodes.iter().map(|n| x[*n as usize]));
    }

    /// Most that two nodes can have moved against each other.
    fn spread_m(&self, at: impl Fn(usize) -> V3) -> f64 {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (n, seen) in self.nodes.iter().zip(&self.seen_m) {
            let at = at(*n as usize);
            for k in 0..3 {
                let moved = at[k] - seen[k];
                low[k] = if moved < low[k] { moved } else { low[k] };
                high[k] = if moved > high[k] { moved } else { high[k] };
            }
        }
        norm(sub(high, low))
    }
}

/// Nodes of pairs, each once.
pub(super) fn nodes<'a>(pairs: impl Iterator<Item = &'a Pair>) -> Vec<u32> {
    let mut nodes: Vec<u32> = pairs.flat_map(|p| p.nodes).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Distance at which a pair meets.
fn stop_m(distance_m: f64, least_m: f64) -> f64 {
    (STOP * distance_m).max(least_m.min(0.8 * distance_m))
}

fn least(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |least, v| if *v < least { *v } else { least })
}
