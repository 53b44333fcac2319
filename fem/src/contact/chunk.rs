//! Some dozens of records that are looked at, and stepped, together; their forces add up in a small array of their own.

use super::closest::{Closest, Feature, Nearest, describe, nearest};
use super::pack::{Pack, Touches};
use super::press::{Out, Sums, press_lane, press_round, push};
use super::record::{Reach, Record};
use super::surface::{NONE, Surface};
use crate::sheet::group::LANES;
use crate::vec3::{V3, add, along, cross, dot, node, norm, scale, sub};

/// Records per chunk.
pub(super) const RECORDS: usize = 64;

/// Records are looked at early by this share of the slack, so that few looks serve many.
const EARLY: f64 = 0.3;

/// An element near a record's node, its corners in the chunk's numbering.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Candidate {
    pub element: u32,
    pub local: [u32; 4],
    /// Distance when it was measured, plus the way of the chunk then: it is no closer than this less the way now.
    pub clear_m: f64,
}

/// Records in order of their nodes.
#[derive(Debug, Clone, Default)]
pub(super) struct Chunk {
    pub records: Vec<Record>,
    pub candidates: Vec<Candidate>,
    /// Nodes that the chunk may push, ascending.
    pub nodes: Vec<u32>,
    /// Records that may touch before the next look: on faces first, then on edges and corners.
    pub near: Vec<u32>,
    /// Those on faces, ready to be stepped.
    pub packs: Vec<Pack>,
    /// Their number.
    pub faces: u32,
    /// Positions at the last look.
    pub seen_m: Vec<[f64; 4]>,
    /// Way: sum over the looks of the most that two nodes can have moved against each other in between.
    pub way_m: f64,
    /// Way at which a record is due.
    pub next_m: f64,
    /// Path of the fastest node at which the motion must be measured again.
    pub due_m: f64,
    /// Forces on the nodes, and which of them (some more than once) are not zero.
    pub out: Out,
    pub sums: Sums,
}

/// What a step needs to know.
#[derive(Clone, Copy)]
pub(super) struct Step<'a> {
    pub arch: pulp::Arch,
    pub surface: &'a Surface,
    pub x: &'a [[f64; 4]],
    pub before: &'a [[f64; 4]],
    pub reach: Reach,
    pub dt_s: f64,
    pub friction: f64,
    /// Way of the fastest node since the start, summed over steps.
    pub path_m: f64,
}

/// A pair at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// Rest gap minus distance.
    pub depth_m: f64,
    /// Way in which the distance grows.
    pub normal: V3,
    pub weights: [f64; 3],
}

impl Chunk {
    /// Starts the way at zero again, at positions `x`.
    pub fn close(&mut self, x: &[[f64; 4]]) {
        let way_m = if self.seen_m.is_empty() { f64::INFINITY } else { self.way_m + 2.0 * self.spread_m(x) };
        self.records.iter_mut().for_each(|r| r.due_m -= way_m);
        self.candidates.iter_mut().for_each(|c| c.clear_m -= way_m);
    }

    /// Gives every node of the records and their candidates a number within the chunk.
    pub fn number(&mut self, surface: &Surface) {
        self.nodes.clear();
        self.nodes.extend(self.records.iter().map(|r| r.node));
        self.nodes.extend(self.candidates.iter().flat_map(|c| surface.corners(c.element as usize)));
        self.nodes.sort_unstable();
        self.nodes.dedup();
        let nodes = &self.nodes;
        let find = |n: u32| nodes.binary_search(&n).unwrap_or(0) as u32;
        for candidate in &mut self.candidates {
            let corners = surface.elements[candidate.element as usize];
            candidate.local = corners.map(|n| if n == NONE { 0 } else { find(n) });
        }
        for r in &mut self.records {
            r.local = [r.node, r.corners[0], r.corners[1], r.corners[2]].map(find);
        }
        (self.due_m, self.way_m, self.next_m) = (f64::NEG_INFINITY, 0.0, f64::NEG_INFINITY);
        self.seen_m.clear();
        self.out.pushed.clear();
        self.out.force_n.clear();
        self.out.force_n.resize(self.nodes.len(), [0.0; 4]);
    }

    /// One step: looks again if nodes moved too far, then adds up the forces of the near records.
    pub fn step(&mut self, step: &Step) {
        self.sums = Sums::default();
        if step.path_m >= self.due_m {
            self.look_if_due(step);
        }
        if !self.packs.is_empty() {
            step.arch.dispatch(Pass { chunk: self, step });
        }
        for at in &self.near[self.faces as usize..] {
            let record = &mut self.records[*at as usize];
            let touch = touch(record, step.x);
            if touch.depth_m > 0.0 || record.last_m > 0.0 {
                press_round(record, &touch, step, &mut self.sums, &mut self.out);
            }
            record.last_m = touch.depth_m;
        }
    }

    /// Adds the forces of the step to those on all nodes.
    pub fn hand_over(&mut self, force: &mut [[f64; 4]]) {
        for local in self.out.pushed.drain(..).flatten() {
            let own = std::mem::take(&mut self.out.force_n[local as usize]);
            push(&mut force[self.nodes[local as usize] as usize], 1.0, [own[0], own[1], own[2]]);
        }
    }

    /// Brings what the packs hold back to the records.
    pub fn unload(&mut self) {
        for pack in &self.packs {
            pack.unload(&mut self.records);
        }
    }

    /// Packs the near records that touch faces.
    pub fn load(&mut self) {
        let faces = &self.near[..self.faces as usize];
        self.packs.clear();
        self.packs.extend(faces.chunks(LANES).map(|members| Pack::new(&self.records, members)));
    }

    /// Measures how far nodes moved against each other and looks, or puts the next measurement off.
    fn look_if_due(&mut self, step: &Step) {
        let moved_m = if self.seen_m.is_empty() { 0.0 } else { 2.0 * self.spread_m(step.x) };
        let left_m = self.next_m - (self.way_m + moved_m);
        if left_m > 0.05 * step.reach.slack_m {
            // A node and the mean may part at twice the pace of the fastest node.
            self.due_m = step.path_m + 0.25 * left_m;
        } else {
            self.way_m += moved_m;
            self.look(step);
        }
    }

    /// Largest motion of a node against the mean motion since the last look.
    fn spread_m(&self, x: &[[f64; 4]]) -> f64 {
        let mut mean = [0.0; 3];
        for (n, seen) in self.nodes.iter().zip(&self.seen_m) {
            mean = add(mean, sub(node(x, *n as usize), [seen[0], seen[1], seen[2]]));
        }
        let mean = scale(mean, 1.0 / self.nodes.len() as f64);
        let mut far: f64 = 0.0;
        for (n, seen) in self.nodes.iter().zip(&self.seen_m) {
            let moved = sub(sub(node(x, *n as usize), [seen[0], seen[1], seen[2]]), mean);
            far = far.max(dot(moved, moved));
        }
        far.sqrt()
    }

    /// Finds the closest feature of the records that are due, or nearly, and the records that may touch soon.
    pub fn look(&mut self, step: &Step) {
        self.unload();
        let ripe_m = self.way_m + EARLY * step.reach.slack_m;
        self.next_m = f64::INFINITY;
        for record in &mut self.records {
            // Not a number is due, too.
            if record.due_m <= ripe_m || record.due_m.is_nan() {
                let own = record.first as usize..(record.first + record.count) as usize;
                look_at(record, &mut self.candidates[own], step, self.way_m, &mut self.sums);
                record.due_m = self.way_m + record.free_m(&step.reach);
            }
            self.next_m = self.next_m.min(record.due_m);
        }
        self.near.clear();
        let near = |r: &Record| r.side != 0 && (r.gap_m() <= r.free_m(&step.reach) || r.last_m > 0.0);
        for faces in [true, false] {
            let wanted = |r: &Record| (r.feature == Feature::Face) == faces && near(r);
            self.near.extend(self.records.iter().enumerate().filter(|(_, r)| wanted(r)).map(|(i, _)| i as u32));
            if faces {
                self.faces = self.near.len() as u32;
            }
        }
        self.load();
        self.due_m = step.path_m + 0.25 * (self.next_m - self.way_m);
        self.seen_m.clear();
        self.seen_m.extend(self.nodes.iter().map(|n| step.x[*n as usize]));
    }
}

/// Finds the closest feature of one record.
fn look_at(record: &mut Record, candidates: &mut [Candidate], step: &Step, way_m: f64, sums: &mut Sums) {
    let Some((found, local)) = closest(step, record, candidates, way_m) else { return };
    let held = (record.side, record.slide_j());
    let depth_m = if held.0 == 0 { 0.0 } else { touch(record, step.x).depth_m };
    record.settle(step.surface, &found, &step.reach);
    if record.side == held.0 && held.0 != 0 {
        let now_m = touch(record, step.x).depth_m;
        sums.damping += record.ease(depth_m, now_m);
    } else if held.0 != 0 {
        sums.friction += held.1;
        sums.damping += 0.5 * record.stiffness_n_m * depth_m.max(0.0).powi(2);
        (record.spring_m, record.damped_n) = ([0.0; 3], 0.0);
    }
    let [a, b, c] = found.corners.map(|k| local[k as usize]);
    record.local = [record.local[0], a, b, c];
    record.last_m = if record.side == 0 { 0.0 } else { touch(record, step.before).depth_m };
    if record.last_m <= 0.0 && record.holds() {
        sums.friction += record.slide_j();
        (record.spring_m, record.damped_n) = ([0.0; 3], 0.0);
    }
}

/// The closest feature among a record's candidates; the first wins a tie. Candidates that cannot be closer than the
/// element that was closest before are passed over.
pub(super) fn closest(
    step: &Step,
    record: &Record,
    candidates: &mut [Candidate],
    way_m: f64,
) -> Option<(Closest, [u32; 4])> {
    let p = node(step.x, record.node as usize);
    let mut limit_m = f64::INFINITY;
    if candidates.iter().any(|c| c.element == record.element) {
        limit_m = nearest(step.surface, step.x, p, record.element).square_m2.sqrt() * (1.0 + 1e-9);
    }
    let mut best: Option<(Nearest, &Candidate)> = None;
    for candidate in candidates {
        if candidate.clear_m - way_m > limit_m {
            continue;
        }
        let now = nearest(step.surface, step.x, p, candidate.element);
        candidate.clear_m = now.square_m2.sqrt() + way_m;
        if best.as_ref().is_none_or(|b| now.square_m2 < b.0.square_m2 * (1.0 - 1e-9)) {
            best = Some((now, candidate));
        }
    }
    let (now, candidate) = best?;
    let found = describe(step.surface, step.x, p, candidate.element, &now, 0.4 * step.reach.slack_m);
    Some((found, candidate.local))
}

/// Distance of a record's node from its feature.
#[inline(always)]
pub(super) fn touch(record: &Record, x: &[[f64; 4]]) -> Touch {
    let p = node(x, record.node as usize);
    let a = node(x, record.corners[0] as usize);
    if record.feature != Feature::Face {
        return round_touch(record, p, a, node(x, record.corners[1] as usize));
    }
    let (b, c) = (node(x, record.corners[1] as usize), node(x, record.corners[2] as usize));
    let (e1, e2, r) = (sub(b, a), sub(c, a), sub(p, a));
    let n = cross(e1, e2);
    let inverse = 1.0 / dot(n, n);
    let per = record.sign * inverse.sqrt();
    let normal = scale(n, per);
    let w1 = dot(cross(r, e2), n) * inverse;
    let w2 = dot(cross(e1, r), n) * inverse;
    Touch { depth_m: record.rest_m - dot(r, normal), normal, weights: [1.0 - w1 - w2, w1, w2] }
}

/// Distance from an edge line or a corner.
fn round_touch(record: &Record, p: V3, a: V3, b: V3) -> Touch {
    let (mut r, mut t) = (sub(p, a), 0.0);
    if record.feature == Feature::Edge {
        let e = sub(b, a);
        t = dot(r, e) / dot(e, e);
        r = along(r, -t, e);
    }
    let length = norm(r);
    let normal = if length > 0.0 { scale(r, record.sign / length) } else { [0.0; 3] };
    Touch { depth_m: record.rest_m - record.sign * length, normal, weights: [1.0 - t, t, 0.0] }
}

/// The packs of a chunk in one step.
struct Pass<'a, 'b> {
    chunk: &'a mut Chunk,
    step: &'a Step<'b>,
}

impl pulp::WithSimd for Pass<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        let mut touches = Touches::NONE;
        let Chunk { packs, records, sums, out, .. } = self.chunk;
        for pack in packs {
            if !pack.measure(simd, self.step.x, &mut touches) {
                pack.last_m = touches.depth_m;
                continue;
            }
            for lane in 0..LANES {
                if touches.depth_m[lane] > 0.0 || pack.last_m[lane] > 0.0 {
                    press_lane(pack, lane, &touches, records, self.step, sums, out);
                }
            }
            pack.last_m = touches.depth_m;
        }
    }
}
