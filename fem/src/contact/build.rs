//! From pairs within reach to records: candidates of one layer that hang together are one record, and what was
//! remembered of them goes on.

use super::chunk::{Candidate, Chunk, RECORDS};
use super::record::Record;
use super::surface::Surface;

/// Candidates that close a chunk, so that chunks stay small on very fine meshes.
const CANDIDATES: usize = 4096;

/// Penalty of every pair.
#[derive(Debug, Clone)]
pub(super) struct Penalty {
    pub mass_kg: Vec<f64>,
    /// k = share · m.
    pub stiffness_1_s2: f64,
    /// c = share · m.
    pub damping_1_s: f64,
}

/// Chunks of records for `pairs` (sorted by node); `old` are the records so far, in order of their nodes. The second
/// result is the energy of elastic slides that were dropped \[J\].
pub(super) fn chunks(surface: &Surface, pairs: &[(u32, u32)], old: &Memory, penalty: &Penalty) -> (Vec<Chunk>, f64) {
    let mut chunks = vec![Chunk::default()];
    let mut work = Work::default();
    let mut lost = 0.0;
    let mut rest = &old.records[..];
    for group in pairs.chunk_by(|a, b| a.0 == b.0) {
        let node = group[0].0;
        while let Some((first, after)) = rest.split_first().filter(|(r, _)| r.node < node) {
            lost += first.slide_j();
            rest = after;
        }
        let own = rest.iter().take_while(|r| r.node == node).count();
        let (remembered, after) = rest.split_at(own);
        rest = after;
        work.split(surface, group);
        lost += work.records(surface, node, remembered, penalty);
        work.inherit(remembered, old);
        if chunks.last().is_none_or(|c| c.records.len() >= RECORDS || c.candidates.len() >= CANDIDATES) {
            chunks.push(Chunk::default());
        }
        if let Some(chunk) = chunks.last_mut() {
            work.append(chunk);
        }
    }
    lost += rest.iter().map(Record::slide_j).sum::<f64>();
    chunks.retain(|c| !c.records.is_empty());
    (chunks, lost)
}

/// Records before a search, in order of their nodes, and all their candidates.
pub(super) struct Memory {
    records: Vec<Record>,
    candidates: Vec<Candidate>,
    /// What was no candidate is no closer than this.
    clear_m: f64,
}

impl Memory {
    /// No records.
    pub fn new(clear_m: f64) -> Memory {
        Memory { records: Vec::new(), candidates: Vec::new(), clear_m }
    }

    /// Adds a chunk whose way was closed.
    pub fn append(&mut self, chunk: &Chunk) {
        let first = self.candidates.len() as u32;
        self.candidates.extend_from_slice(&chunk.candidates);
        self.records.extend(chunk.records.iter().map(|r| Record { first: r.first + first, ..*r }));
    }

    fn of(&self, record: &Record) -> &[Candidate] {
        &self.candidates[record.first as usize..(record.first + record.count) as usize]
    }
}

/// The candidates of one node, sorted into connected pieces.
#[derive(Default)]
struct Work {
    elements: Vec<u32>,
    piece: Vec<u32>,
    pieces: u32,
    made: Vec<Record>,
    /// As in [`Candidate::clear_m`], for each element.
    clear_m: Vec<f64>,
}

impl Work {
    /// Numbers connected pieces; elements of one layer that share a corner are connected.
    fn split(&mut self, surface: &Surface, group: &[(u32, u32)]) {
        self.elements.clear();
        self.elements.extend(group.iter().map(|p| p.1));
        self.piece.clear();
        self.piece.resize(group.len(), u32::MAX);
        self.pieces = 0;
        let mut open = Vec::new();
        for seed in 0..group.len() {
            if self.piece[seed] != u32::MAX {
                continue;
            }
            self.piece[seed] = self.pieces;
            open.push(seed);
            while let Some(at) = open.pop() {
                for other in seed + 1..group.len() {
                    if self.piece[other] == u32::MAX && touching(surface, self.elements[at], self.elements[other]) {
                        self.piece[other] = self.pieces;
                        open.push(other);
                    }
                }
            }
            self.pieces += 1;
        }
    }

    /// One record per piece, with what was remembered; returns the slide energy of what was dropped.
    fn records(&mut self, surface: &Surface, node: u32, remembered: &[Record], penalty: &Penalty) -> f64 {
        self.made.clear();
        let mut lost = 0.0;
        for piece in 0..self.pieces {
            let members = || self.elements.iter().zip(&self.piece).filter(move |(_, p)| **p == piece).map(|(e, _)| *e);
            let layer = members().next().map_or(0, |e| surface.layer[e as usize]);
            let mut record = Record { node, layer, own: surface.is_in(node as usize, layer), ..Record::NEW };
            let heirs = remembered.iter().filter(|r| members().any(|e| e == r.element));
            if let Some(best) = heirs.min_by(|a, b| order(a).total_cmp(&order(b))) {
                record = *best;
            }
            let corners = members().flat_map(|e| surface.corners(e as usize));
            let light = |m: f64, n: &u32| m.min(Some(penalty.mass_kg[*n as usize]).filter(|m| *m > 0.0).unwrap_or(m));
            let mass = std::iter::once(&node).chain(corners).fold(f64::INFINITY, light);
            let mass = if mass.is_finite() { mass } else { 0.0 };
            let stiffness = penalty.stiffness_1_s2 * mass;
            // A pair under load keeps its spring, unless lighter nodes came near.
            if !(record.stiffness_n_m > 0.0 && record.distance_m < record.rest_m && record.stiffness_n_m < stiffness) {
                lost += record.slide_j();
                record.stiffness_n_m = stiffness;
                lost -= record.slide_j();
                record.damping_n_s_m = penalty.damping_1_s * mass;
            }
            self.made.push(record);
        }
        let kept =
            |old: &Record| self.made.iter().any(|r| r.side != 0 && r.element == old.element && r.layer == old.layer);
        lost + remembered.iter().filter(|r| !kept(r)).map(Record::slide_j).sum::<f64>()
    }

    /// Takes over how far elements were, and when records are due. A record is due at once if it is new or if there are
    /// elements in its piece that were in another.
    fn inherit(&mut self, remembered: &[Record], old: &Memory) {
        self.clear_m.clear();
        for (element, piece) in self.elements.iter().zip(&self.piece) {
            let record = &mut self.made[*piece as usize];
            let keeper = remembered.iter().find_map(|r| Some((r, old.of(r).iter().find(|c| c.element == *element)?)));
            let known = keeper.map_or(old.clear_m, |(_, c)| c.clear_m);
            if keeper.is_some_and(|(r, _)| r.element != record.element || r.layer != record.layer) {
                record.due_m = f64::NEG_INFINITY;
            }
            self.clear_m.push(known);
        }
    }

    fn append(&self, chunk: &mut Chunk) {
        for (piece, record) in self.made.iter().enumerate() {
            let first = chunk.candidates.len() as u32;
            let members = (0..self.elements.len()).filter(|i| self.piece[*i] as usize == piece);
            let candidate =
                |i| Candidate { element: self.elements[i], clear_m: self.clear_m[i], ..Candidate::default() };
            chunk.candidates.extend(members.map(candidate));
            chunk.records.push(Record { first, count: chunk.candidates.len() as u32 - first, ..*record });
        }
    }
}

/// Decided records first, then the closer one.
fn order(record: &Record) -> f64 {
    if record.side == 0 { f64::INFINITY } else { record.distance_m.abs() }
}

fn touching(surface: &Surface, e: u32, f: u32) -> bool {
    let others = surface.corners(f as usize);
    surface.layer[e as usize] == surface.layer[f as usize]
        && surface.corners(e as usize).iter().any(|n| others.contains(n))
}
