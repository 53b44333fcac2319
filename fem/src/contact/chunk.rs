//! A few hundred records that are looked at, and stepped, together; their forces add up in a small array of their own.

use super::closest::{Closest, Feature, describe, nearest};
use super::pack::{Pack, Touches};
use super::record::{Reach, Record};
use super::surface::{NONE, Surface};
use crate::sheet::group::LANES;
use crate::terms::slide;
use crate::vec3::{V3, add, along, cross, dot, node, norm, scale, sub};

/// Records per chunk.
pub(super) const RECORDS: usize = 256;

/// An element near a record's node, its corners in the chunk's numbering.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Candidate {
    pub element: u32,
    pub local: [u32; 4],
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
    /// Each node may move this much before the next look.
    pub allowed_m: f64,
    /// Path of the fastest node at which the motion must be measured again.
    pub due_m: f64,
    /// True if `out` holds forces.
    pub active: bool,
    pub sums: Sums,
}

/// Energies of a chunk in one step \[J\].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    pub stored: f64,
    pub friction: f64,
    pub damping: f64,
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
        self.records.iter_mut().for_each(|r| r.local[0] = find(r.node));
        self.due_m = f64::NEG_INFINITY;
        self.allowed_m = 0.0;
        self.seen_m.clear();
    }

    /// One step: looks again if nodes moved too far, then adds up the forces of the near records in `out`.
    pub fn step(&mut self, step: &Step, out: &mut [[f64; 4]]) {
        self.sums = Sums::default();
        if step.path_m >= self.due_m && self.moved_too_far(step) {
            self.look(step);
        }
        if self.near.is_empty() && !self.active {
            return;
        }
        self.active = false;
        out[..self.nodes.len()].fill([0.0; 4]);
        step.arch.dispatch(Pass { chunk: self, step, out });
        for at in &self.near[self.faces as usize..] {
            let record = &mut self.records[*at as usize];
            let touch = touch(record, step.x);
            if touch.depth_m > 0.0 || record.last_m > 0.0 {
                press_round(record, &touch, step, &mut self.sums, out);
                self.active = true;
            }
            record.last_m = touch.depth_m;
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

    /// Measures how far nodes moved against the mean motion, or puts the next measurement off.
    fn moved_too_far(&mut self, step: &Step) -> bool {
        if self.seen_m.is_empty() {
            return true;
        }
        let mut mean = [0.0; 3];
        for (n, seen) in self.nodes.iter().zip(&self.seen_m) {
            mean = add(mean, sub(node(step.x, *n as usize), [seen[0], seen[1], seen[2]]));
        }
        let mean = scale(mean, 1.0 / self.nodes.len() as f64);
        let mut far: f64 = 0.0;
        for (n, seen) in self.nodes.iter().zip(&self.seen_m) {
            let moved = sub(sub(node(step.x, *n as usize), [seen[0], seen[1], seen[2]]), mean);
            far = far.max(dot(moved, moved));
        }
        let left = self.allowed_m - far.sqrt();
        // A node and the mean may part at twice the pace of the fastest node.
        self.due_m = step.path_m + 0.5 * left;
        left <= 0.05 * self.allowed_m || left.is_nan()
    }

    /// Finds the closest feature of every record and the records that may touch soon.
    pub fn look(&mut self, step: &Step) {
        self.unload();
        let mut closest_m = f64::INFINITY;
        for record in &mut self.records {
            let candidates = &self.candidates[record.first as usize..(record.first + record.count) as usize];
            let Some((found, local)) = closest(step, record, candidates) else { continue };
            let held = (record.side, record.slide_j());
            let depth_m = if held.0 == 0 { 0.0 } else { touch(record, step.x).depth_m };
            record.settle(step.surface, &found, &step.reach);
            if record.side == held.0 && held.0 != 0 {
                let now_m = touch(record, step.x).depth_m;
                self.sums.damping += record.ease(depth_m, now_m);
            } else if held.0 != 0 {
                self.sums.friction += held.1;
                self.sums.damping += 0.5 * record.stiffness_n_m * depth_m.max(0.0).powi(2);
                (record.spring_m, record.damped_n) = ([0.0; 3], 0.0);
            }
            let [a, b, c] = found.corners.map(|k| local[k as usize]);
            record.local = [record.local[0], a, b, c];
            record.last_m = if record.side == 0 { 0.0 } else { touch(record, step.before).depth_m };
            if record.last_m <= 0.0 && record.holds() {
                self.sums.friction += record.slide_j();
                (record.spring_m, record.damped_n) = ([0.0; 3], 0.0);
            }
            let gap_m = if record.side == 0 { record.distance_m } else { record.distance_m - record.rest_m };
            closest_m = closest_m.min(gap_m);
        }
        let reach = &step.reach;
        // Half of the way left, so that a far pair is looked at again well before it touches.
        let between = (0.5 * closest_m).clamp(reach.slack_m, 0.25 * reach.side_m + reach.slack_m);
        self.near.clear();
        let near = |r: &Record| r.side != 0 && (r.distance_m - r.rest_m <= between || r.last_m > 0.0);
        for faces in [true, false] {
            let wanted = |r: &Record| (r.feature == Feature::Face) == faces && near(r);
            self.near.extend(self.records.iter().enumerate().filter(|(_, r)| wanted(r)).map(|(i, _)| i as u32));
            if faces {
                self.faces = self.near.len() as u32;
            }
        }
        self.load();
        self.allowed_m = 0.5 * between;
        self.due_m = step.path_m + 0.5 * self.allowed_m;
        self.seen_m.clear();
        self.seen_m.extend(self.nodes.iter().map(|n| step.x[*n as usize]));
    }
}

/// The closest feature among a record's candidates; the first wins a tie.
pub(super) fn closest(step: &Step, record: &Record, candidates: &[Candidate]) -> Option<(Closest, [u32; 4])> {
    let p = node(step.x, record.node as usize);
    let mut best: Option<(f64, &Candidate)> = None;
    for candidate in candidates {
        let square = nearest(step.surface, step.x, p, candidate.element).0;
        if best.is_none_or(|b| square < b.0 * (1.0 - 1e-9)) {
            best = Some((square, candidate));
        }
    }
    let (_, candidate) = best?;
    let found = describe(step.surface, step.x, p, candidate.element, 0.4 * step.reach.slack_m);
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
    out: &'a mut [[f64; 4]],
}

impl pulp::WithSimd for Pass<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        let mut touches = Touches::NONE;
        let Chunk { packs, records, sums, active, .. } = self.chunk;
        for pack in packs {
            pack.measure(simd, self.step.x, &mut touches);
            for lane in 0..LANES {
                if touches.depth_m[lane] > 0.0 || pack.last_m[lane] > 0.0 {
                    press_lane(pack, lane, &touches, records, self.step, sums, self.out);
                    *active = true;
                }
            }
            pack.last_m = touches.depth_m;
        }
    }
}

/// A lane that touches, or did in the step before.
#[inline(always)]
fn press_lane(
    pack: &mut Pack,
    lane: usize,
    touches: &Touches,
    records: &mut [Record],
    step: &Step,
    sums: &mut Sums,
    out: &mut [[f64; 4]],
) {
    let touch = touches.of(lane);
    let (k, c, last_m) = (pack.stiffness_n_m[lane], pack.damping_n_s_m[lane], pack.last_m[lane]);
    let spring = Spring { k, c_dt: c / step.dt_s, last_m };
    let normal_n = spring.press(touch.depth_m, &mut pack.damped_n[lane], sums);
    let mut force = scale(touch.normal, normal_n);
    if step.friction > 0.0 {
        force = add(force, rub(&mut records[pack.record[lane] as usize], &touch, normal_n, step, sums));
    }
    spread([0, 1, 2, 3].map(|k: usize| pack.local[k][lane]), touch.weights, force, out);
}

/// The same for an edge or corner.
fn press_round(record: &mut Record, touch: &Touch, step: &Step, sums: &mut Sums, out: &mut [[f64; 4]]) {
    let c_dt = record.damping_n_s_m / step.dt_s;
    let spring = Spring { k: record.stiffness_n_m, c_dt, last_m: record.last_m };
    let normal_n = spring.press(touch.depth_m, &mut record.damped_n, sums);
    let mut force = scale(touch.normal, normal_n);
    if step.friction > 0.0 {
        force = add(force, rub(record, touch, normal_n, step, sums));
    }
    spread(record.local, touch.weights, force, out);
}

/// The normal part of a pair.
struct Spring {
    k: f64,
    /// Damping coefficient over the step.
    c_dt: f64,
    last_m: f64,
}

impl Spring {
    /// Normal force; `damped_n` goes from the step before to this one. The loss is the work of the step less what the
    /// spring stores: damping, and what a step that ends or begins within the gap takes or gives.
    #[inline(always)]
    fn press(&self, depth_m: f64, damped_n: &mut f64, sums: &mut Sums) -> f64 {
        let closed = depth_m - self.last_m;
        let (deep, was) = (positive(depth_m), positive(self.last_m));
        let elastic = self.k * deep;
        let pull = self.c_dt * closed;
        // The layers do not stick to each other: damping never pulls more than the spring pushes.
        let damped = if depth_m > 0.0 { if pull > -elastic { pull } else { -elastic } } else { 0.0 };
        let work = 0.5 * (damped + *damped_n + self.k * (deep + was)) * closed;
        let stored = 0.5 * elastic * deep;
        sums.damping += work - (stored - 0.5 * self.k * was * was);
        sums.stored += stored;
        *damped_n = damped;
        elastic + damped
    }
}

#[inline(always)]
fn positive(value: f64) -> f64 {
    if value > 0.0 { value } else { 0.0 }
}

/// Friction force of a pair.
#[inline]
fn rub(record: &mut Record, touch: &Touch, normal_n: f64, step: &Step, sums: &mut Sums) -> V3 {
    let k = record.stiffness_n_m;
    let moved = motion(record, touch, step.x, step.before);
    let (spring, lost) = slide(record.spring_m, moved, touch.normal, k, step.friction * normal_n);
    record.spring_m = spring;
    sums.friction += lost;
    sums.stored += record.slide_j();
    scale(spring, -k)
}

/// Motion of the node against the touched point since the step before.
#[inline(always)]
pub(super) fn motion(record: &Record, touch: &Touch, x: &[[f64; 4]], before: &[[f64; 4]]) -> V3 {
    let one = |n: u32| sub(node(x, n as usize), node(before, n as usize));
    let mut moved = one(record.node);
    for (n, w) in record.corners.iter().zip(touch.weights) {
        moved = along(moved, -w, one(*n));
    }
    moved
}

#[inline(always)]
fn spread(local: [u32; 4], weights: [f64; 3], force: V3, out: &mut [[f64; 4]]) {
    let [p, a, b, c] = local.map(|n| n as usize);
    push(&mut out[p], 1.0, force);
    push(&mut out[a], -weights[0], force);
    push(&mut out[b], -weights[1], force);
    push(&mut out[c], -weights[2], force);
}

#[inline(always)]
pub(super) fn push(out: &mut [f64; 4], weight: f64, force: V3) {
    out[0] += weight * force[0];
    out[1] += weight * force[1];
    out[2] += weight * force[2];
}
