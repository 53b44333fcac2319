//! Some dozens of records that are looked at, and stepped, together.

use std::ops::Range;

use super::ask::{DistanceQuestion, Questions};
use super::closest::{Closest, Feature, describe, nearest};
use super::pack::{Pack, Touches};
use super::press::{ContactEnergies, PairForce, press_lane, press_round, push};
use super::record::{ContactStep, Record, Touch};
use super::surface::ContactSurface;
use crate::sheet::group::{LANES, Lane};
use crate::vec3::{Nodes, V3, along, cross, dot, node, norm, scale, sub};

pub(super) const RECORDS: usize = 64;

/// Records are looked at early by this share of the slack, so that few looks serve many.
const EARLY: f64 = 0.3;

#[derive(Debug, Clone, Copy, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct ContactCandidate {
    pub element: u32,
    /// Distance when it was measured, plus the way of the chunk then; this less the way now is a lower bound.
    pub(crate) clear_m: f64,
}

/// Records in order of their nodes; a checkpoint leaves out what they and the positions give again.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Chunk {
    pub records: Vec<Record>,
    pub candidates: Vec<ContactCandidate>,
    /// Nodes of the records and of their candidates.
    #[serde(skip)]
    pub nodes: Vec<u32>,
    /// From the first of them to the last.
    #[serde(skip)]
    pub span: Range<u32>,
    /// Records that may touch before the next look: on faces first, then on edges and corners.
    pub near: Vec<u32>,
    /// Those on faces, ready to be stepped.
    #[serde(skip)]
    pub(crate) packs: Vec<Pack>,
    #[serde(skip)]
    pub faces: u32,
    pub(crate) seen_m: Vec<[f64; 4]>,
    /// Way: sum over the looks of the most that two nodes can have moved against each other in between.
    pub way_m: f64,
    /// Way at which a record is due.
    pub(crate) next_m: f64,
    /// Path of the fastest node at which the motion must be measured again.
    pub(crate) due_m: f64,
    #[serde(skip)]
    pub pushes: Vec<PairForce>,
    #[serde(skip)]
    pub sums: ContactEnergies,
    /// Nodes that looks of the step found on the wrong side of an element.
    #[serde(skip)]
    pub passed: Vec<(u32, u32)>,
    #[serde(skip)]
    pub asked: Vec<DistanceQuestion>,
    #[serde(skip)]
    pub(crate) square_m2: Vec<Lane>,
    /// Records that were asked about, and the closest element of each.
    #[serde(skip)]
    pub chosen: Vec<(u32, u32)>,
}

impl Chunk {
    /// Starts the way at zero again, at positions `x`.
    pub(super) fn close(&mut self, arch: pulp::Arch, x: &Nodes) {
        let way_m = if self.seen_m.is_empty() { f64::INFINITY } else { self.way_m + self.parted_m(arch, x) };
        for record in &mut self.records {
            record.due_m -= way_m;
            record.within_m += way_m;
        }
        self.candidates.iter_mut().for_each(|c| c.clear_m -= way_m);
    }

    /// Lists the nodes, each once; `mark` holds a number for every node, and no two chunks leave the same there.
    pub(super) fn list(&mut self, surface: &ContactSurface, chunk: u32, mark: &mut [u32]) {
        self.nodes.clear();
        let corners = self.candidates.iter().flat_map(|c| surface.corners(c.element as usize));
        for n in self.records.iter().map(|r| &r.node).chain(corners) {
            let mark = &mut mark[*n as usize];
            if *mark != chunk {
                *mark = chunk;
                self.nodes.push(*n);
            }
        }
        // In order they are read faster.
        self.nodes.sort_unstable();
        self.span = self.nodes.first().map_or(0, |n| *n)..self.nodes.last().map_or(0, |n| n + 1);
        (self.due_m, self.way_m, self.next_m) = (f64::NEG_INFINITY, 0.0, f64::NEG_INFINITY);
        self.seen_m.clear();
    }

    /// One step: looks again if nodes moved too far, then adds up the forces of the near records.
    pub(super) fn step(&mut self, step: &ContactStep) {
        self.sums = ContactEnergies::default();
        self.pushes.clear();
        if step.path_m >= self.due_m {
            self.look_if_due(step);
        }
        if !self.packs.is_empty() {
            step.arch.dispatch(ContactPass { chunk: self, step });
        }
        for at in &self.near[self.faces as usize..] {
            let record = &mut self.records[*at as usize];
            let touch = touch(record, step.x);
            if touch.depth_m > 0.0 || record.last_m > 0.0 {
                press_round(record, &touch, step, &mut self.sums, &mut self.pushes);
            }
            record.last_m = touch.depth_m;
        }
    }

    /// Adds the forces of the step to those on the nodes from `first` on.
    pub(crate) fn hand_over(&self, first: u32, force: &mut Nodes) {
        let last = first + force.len() as u32;
        if self.span.end <= first || last <= self.span.start {
            return;
        }
        for PairForce { nodes: [p, a, b, c], weights, force_n } in &self.pushes {
            for (node, weight) in [(p, 1.0), (a, -weights[0]), (b, -weights[1]), (c, -weights[2])] {
                // A node before the first wraps round to beyond the last.
                if let Some(force) = force.get_mut(node.wrapping_sub(first) as usize) {
                    push(force, weight, *force_n);
                }
            }
        }
    }

    /// Brings what the packs hold back to the records.
    pub(super) fn unload(&mut self) {
        for pack in &self.packs {
            pack.unload(&mut self.records);
        }
    }

    /// What a checkpoint held of a chunk, if it is of so many nodes and elements.
    pub(super) fn fitting(mut self, nodes: u32, elements: u32) -> Option<Chunk> {
        let Chunk { near, candidates, records, .. } = &self;
        let fits = |r: &Record| {
            let last = u64::from(r.first) + u64::from(r.count);
            let known = r.node < nodes && r.element < elements && r.corners.iter().all(|n| *n < nodes);
            known && (-1..=1).contains(&r.side) && last <= candidates.len() as u64
        };
        let good = records.iter().all(fits)
            && candidates.iter().all(|c| c.element < elements)
            && near.iter().all(|at| (*at as usize) < records.len());
        good.then_some(())?;
        let on_face = |at: &&u32| records[**at as usize].feature == Feature::Face;
        self.faces = near.iter().take_while(on_face).count() as u32;
        Some(self)
    }

    /// Packs the near records that touch faces.
    pub(super) fn load(&mut self) {
        let faces = &self.near[..self.faces as usize];
        self.packs.clear();
        self.packs.extend(faces.chunks(LANES).map(|members| Pack::new(&self.records, members)));
    }

    /// Measures how far nodes moved against each other and looks, or puts the next measurement off.
    fn look_if_due(&mut self, step: &ContactStep) {
        let moved_m = if self.seen_m.is_empty() { 0.0 } else { self.parted_m(step.arch, step.x) };
        let left_m = self.next_m - (self.way_m + moved_m);
        if left_m > 0.05 * step.reach.slack_m {
            // Two nodes may part at twice the pace of the fastest node.
            self.due_m = step.path_m + 0.5 * left_m;
        } else {
            self.way_m += moved_m;
            self.look(step);
        }
    }

    /// No two nodes moved more than this against each other since the last look: diagonal of the box of all motions.
    fn parted_m(&self, arch: pulp::Arch, x: &Nodes) -> f64 {
        arch.dispatch(Parted { chunk: self, x })
    }

    /// Finds the closest feature of the records that are due, or nearly, and the records that may touch soon.
    pub(super) fn look(&mut self, step: &ContactStep) {
        self.unload();
        self.ask(step, self.way_m + EARLY * step.reach.slack_m);
        for &(at, element) in &self.chosen {
            let record = &mut self.records[at as usize];
            if look_at(record, element, step, &mut self.sums) {
                self.passed.push((record.node, element));
            }
            record.within_m -= self.way_m;
            record.due_m = self.way_m + record.free_m(&step.reach);
        }
        self.next_m = f64::INFINITY;
        self.near.clear();
        let mut round = Vec::new();
        for (at, record) in self.records.iter().enumerate() {
            self.next_m = self.next_m.min(record.due_m);
            if record.side == 0 || (record.gap_m() > record.free_m(&step.reach) && record.last_m <= 0.0) {
                continue;
            }
            if record.feature == Feature::Face { self.near.push(at as u32) } else { round.push(at as u32) }
        }
        self.faces = self.near.len() as u32;
        self.near.extend(round);
        self.load();
        self.due_m = step.path_m + 0.5 * (self.next_m - self.way_m);
        self.seen_m.clear();
        self.seen_m.extend(self.nodes.iter().map(|n| step.x[*n as usize]));
    }

    /// Measures the distances of the records that are due by `ripe_m` from candidates that may be the closest: the closest
    /// cannot have moved farther off than the way since the last look.
    fn ask(&mut self, step: &ContactStep, ripe_m: f64) {
        self.asked.clear();
        for (at, record) in self.records.iter().enumerate() {
            // Not a number is due, too.
            if record.due_m > ripe_m {
                continue;
            }
            let limit_m = record.within_m + self.way_m;
            for candidate in record.first..record.first + record.count {
                let ContactCandidate { element, clear_m } = self.candidates[candidate as usize];
                if clear_m - self.way_m > limit_m * (1.0 + 1e-9) {
                    continue;
                }
                self.asked.push(DistanceQuestion { record: at as u32, candidate, node: record.node, element });
            }
        }
        let questions =
            Questions { surface: step.surface, x: step.x, asked: &self.asked, square_m2: &mut self.square_m2 };
        step.arch.dispatch(questions);
        self.chosen.clear();
        let mut first = 0;
        for own in self.asked.chunk_by(|a, b| a.record == b.record) {
            let squares = &self.square_m2.as_flattened()[first..first + own.len()];
            self.chosen.push((own[0].record, choose(own, squares, &mut self.candidates, self.way_m)));
            first += own.len();
        }
    }

    /// The closest feature of every record at the positions of a step: its position in the chunk, and the feature.
    pub(super) fn all(&mut self, step: &ContactStep) -> Vec<(usize, Closest)> {
        self.ask(step, f64::INFINITY);
        let found = |&(at, element): &(u32, u32)| {
            let node = self.records[at as usize].node;
            (at as usize, closest(step, node, element))
        };
        self.chosen.iter().map(found).collect()
    }
}

/// The closest of one record's candidates; the first wins a tie.
fn choose(own: &[DistanceQuestion], squares: &[f64], candidates: &mut [ContactCandidate], way_m: f64) -> u32 {
    let (mut element, mut least_m2) = (own[0].element, f64::INFINITY);
    for (question, square_m2) in own.iter().zip(squares) {
        candidates[question.candidate as usize].clear_m = square_m2.sqrt() + way_m;
        if *square_m2 < least_m2 * (1.0 - 1e-9) {
            (element, least_m2) = (question.element, *square_m2);
        }
    }
    element
}

fn closest(step: &ContactStep, node: u32, element: u32) -> Closest {
    let p = crate::vec3::node(step.x, node as usize);
    let now = nearest(step.surface, step.x, p, element);
    describe(step.surface, step.x, p, element, &now, step.reach.flat_m)
}

/// Takes the closest feature of one record over; true if the node came through it.
fn look_at(record: &mut Record, element: u32, step: &ContactStep, sums: &mut ContactEnergies) -> bool {
    let found = closest(step, record.node, element);
    let passed = record.has_passed(&found, &step.reach);
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
    record.last_m = if record.side == 0 { 0.0 } else { touch(record, step.before).depth_m };
    if record.last_m <= 0.0 && record.holds() {
        sums.friction += record.slide_j();
        (record.spring_m, record.damped_n) = ([0.0; 3], 0.0);
    }
    passed
}

/// Distance of a record's node from its feature.
#[inline(always)]
pub(super) fn touch(record: &Record, x: &Nodes) -> Touch {
    let p = node(x, record.node as usize);
    let a = node(x, record.corners[0] as usize);
    if record.feature != Feature::Face {
        return round_touch(record, p, a, node(x, record.corners[1] as usize));
    }
    let b = node(x, record.corners[1] as usize);
    let c = node(x, record.corners[2] as usize);
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

/// The box of all motions of a chunk since the last look.
struct Parted<'a> {
    chunk: &'a Chunk,
    x: &'a [[f64; 4]],
}

impl pulp::WithSimd for Parted<'_> {
    type Output = f64;
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> f64 {
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        for (n, seen) in self.chunk.nodes.iter().zip(&self.chunk.seen_m) {
            let p = &self.x[*n as usize];
            for k in 0..4 {
                let moved = p[k] - seen[k];
                low[k] = if moved < low[k] { moved } else { low[k] };
                high[k] = if moved > high[k] { moved } else { high[k] };
            }
        }
        norm([high[0] - low[0], high[1] - low[1], high[2] - low[2]])
    }
}

/// The packs of a chunk in one step.
struct ContactPass<'a, 'b> {
    chunk: &'a mut Chunk,
    step: &'a ContactStep<'b>,
}

impl pulp::WithSimd for ContactPass<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        let mut touches = Touches::NONE;
        let Chunk { packs, records, sums, pushes, .. } = self.chunk;
        for pack in packs {
            if !pack.measure(simd, self.step.x, &mut touches) {
                pack.last_m = touches.depth_m;
                continue;
            }
            for lane in 0..LANES {
                if touches.depth_m[lane] > 0.0 || pack.last_m[lane] > 0.0 {
                    press_lane(pack, lane, &touches, records, self.step, sums, pushes);
                }
            }
            pack.last_m = touches.depth_m;
        }
    }
}
