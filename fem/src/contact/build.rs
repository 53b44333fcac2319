//! From pairs within reach to records: candidates of one layer that hang together are one record, and what was
//! remembered of them goes on.

use rayon::prelude::*;

use super::chunk::{Chunk, ContactCandidate, RECORDS};
use super::record::Record;
use super::surface::{ContactSurface, NONE};

/// Candidates that close a chunk, so that chunks stay small on very fine meshes.
const CANDIDATES: usize = 4096;

#[derive(Debug, Clone, Default)]
pub(super) struct Penalty {
    pub mass_kg: Vec<f64>,
    /// Least mass of the corners of each element, infinite if all are held.
    pub(crate) light_kg: Vec<f64>,
    /// Stiffness of a contact over its mass, k/m.
    pub(crate) stiffness_1_s2: f64,
    /// Damping of a contact over its mass, c/m.
    pub damping_1_s: f64,
}

/// Chunks of records for `pairs` (grouped by node); `old` are the records so far. The second result is the energy
/// of elastic slides that were dropped \[J\].
pub(super) fn chunks(
    surface: &ContactSurface,
    pairs: &[(u32, u32)],
    old: &PreviousRecords,
    penalty: &Penalty,
) -> (Vec<Chunk>, f64) {
    let mut gone: Vec<bool> = vec![true; old.place.len()];
    pairs.iter().for_each(|(node, _)| gone[*node as usize] = false);
    let room = || SortedCandidates {
        place: vec![0; surface.elements.len()],
        corner: vec![(0, 0); old.place.len()],
        ..SortedCandidates::default()
    };
    let pieces =
        pieces(pairs).into_par_iter().map_init(room, |work, pairs| some_chunks(surface, pairs, old, penalty, work));
    let (mut all, mut lost) = (Vec::new(), old.slides_j(&gone));
    for (chunks, of) in pieces.collect::<Vec<_>>() {
        all.extend(chunks);
        lost += of;
    }
    (all, lost)
}

/// Pairs that one thread takes at once; fixed, so that chunks do not depend on the number of threads.
const PIECE: usize = 16_384;

/// About as many pairs each; the pairs of a node stay together.
fn pieces(mut pairs: &[(u32, u32)]) -> Vec<&[(u32, u32)]> {
    let mut pieces = Vec::new();
    while pairs.len() > PIECE {
        let node = pairs[PIECE - 1].0;
        let (piece, rest) = pairs.split_at(PIECE + pairs[PIECE..].iter().take_while(|pair| pair.0 == node).count());
        pieces.push(piece);
        pairs = rest;
    }
    pieces.push(pairs);
    pieces
}

fn some_chunks(
    surface: &ContactSurface,
    pairs: &[(u32, u32)],
    old: &PreviousRecords,
    penalty: &Penalty,
    work: &mut SortedCandidates,
) -> (Vec<Chunk>, f64) {
    let mut chunks = vec![Chunk::default()];
    let mut lost = 0.0;
    for group in pairs.chunk_by(|a, b| a.0 == b.0) {
        let node = group[0].0;
        let (remembered, candidates) = old.of(node);
        if work.are_known(group, remembered, candidates) {
            work.piece.clone_from(&work.from);
            work.pieces = remembered.len() as u32;
        } else {
            work.split(surface);
        }
        lost += work.records(surface, node, remembered, penalty);
        work.inherit(remembered, old.clear_m);
        if chunks.last().is_none_or(|c| c.records.len() >= RECORDS || c.candidates.len() >= CANDIDATES) {
            chunks.push(Chunk::default());
        }
        if let Some(chunk) = chunks.last_mut() {
            work.append(chunk);
        }
    }
    chunks.retain(|c| !c.records.is_empty());
    chunks.iter_mut().for_each(|c| c.records.sort_by_key(|r| r.node));
    (chunks, lost)
}

/// Records before a search, and their candidates.
pub(super) struct PreviousRecords {
    chunks: Vec<Chunk>,
    /// Chunk, first record and number of records of every node.
    place: Vec<[u32; 3]>,
    /// Least distance of a pair that was not a candidate.
    clear_m: f64,
}

impl PreviousRecords {
    /// Records of chunks whose way was closed, for so many nodes.
    pub(super) fn new(chunks: Vec<Chunk>, nodes: usize, clear_m: f64) -> PreviousRecords {
        let mut place = vec![[0; 3]; nodes];
        for (c, chunk) in chunks.iter().enumerate() {
            for (i, record) in chunk.records.iter().enumerate() {
                let place = &mut place[record.node as usize];
                *place = [c as u32, if place[2] == 0 { i as u32 } else { place[1] }, place[2] + 1];
            }
        }
        PreviousRecords { chunks, place, clear_m }
    }

    /// Records of a node, and the candidates of its chunk.
    fn of(&self, node: u32) -> (&[Record], &[ContactCandidate]) {
        let [chunk, first, count] = self.place[node as usize].map(|i| i as usize);
        match self.chunks.get(chunk) {
            Some(chunk) => (&chunk.records[first..first + count], &chunk.candidates),
            None => (&[], &[]),
        }
    }

    /// Energy of the slides of the nodes that are `gone`.
    fn slides_j(&self, gone: &[bool]) -> f64 {
        let all = self.chunks.iter().flat_map(|c| &c.records);
        all.filter(|r| gone[r.node as usize]).map(Record::slide_j).sum()
    }
}

/// The candidates of one node, sorted into connected pieces.
#[derive(Default)]
struct SortedCandidates {
    elements: Vec<u32>,
    piece: Vec<u32>,
    pieces: u32,
    made: Vec<Record>,
    /// The remembered record that had each element, [`NONE`] for a new one, and [`ContactCandidate::clear_m`] there.
    from: Vec<u32>,
    clear_m: Vec<f64>,
    layers: Vec<u32>,
    /// Where each element of the mesh is in `elements`, if it is there.
    place: Vec<u32>,
    /// Of each node of the mesh: at which stamp an element had this corner, and the first that had.
    corner: Vec<(u32, u32)>,
    stamp: u32,
}

impl SortedCandidates {
    fn find(&self, element: u32) -> Option<usize> {
        let at = self.place[element as usize] as usize;
        self.elements.get(at).is_some_and(|e| *e == element).then_some(at)
    }

    /// Lists the elements of a node with their records; true if the search before had the same, whose pieces are then the records.
    fn are_known(&mut self, group: &[(u32, u32)], remembered: &[Record], candidates: &[ContactCandidate]) -> bool {
        self.elements.clear();
        self.elements.extend(group.iter().map(|p| p.1));
        for (at, element) in self.elements.iter().enumerate() {
            self.place[*element as usize] = at as u32;
        }
        self.from.clear();
        self.from.resize(group.len(), NONE);
        self.clear_m.clear();
        self.clear_m.resize(group.len(), f64::NAN);
        let (mut known, mut all) = (0, 0);
        for (from, old) in remembered.iter().enumerate() {
            for candidate in &candidates[old.first as usize..(old.first + old.count) as usize] {
                all += 1;
                let Some(at) = self.find(candidate.element) else { continue };
                (self.from[at], self.clear_m[at]) = (from as u32, candidate.clear_m);
                known += 1;
            }
        }
        known == group.len() && all == group.len()
    }

    /// Numbers connected pieces; elements of one layer that share a corner are connected. Each first has its own number, then the
    /// least one among those connected with it.
    fn split(&mut self, surface: &ContactSurface) {
        let count = self.elements.len() as u32;
        self.piece.clear();
        self.piece.extend(0..count);
        self.layers.clear();
        for element in &self.elements {
            let layer = surface.layer[*element as usize];
            if !self.layers.contains(&layer) {
                self.layers.push(layer);
            }
        }
        for layer in &self.layers {
            self.stamp += 1;
            for (at, element) in (0..).zip(&self.elements).filter(|(_, e)| surface.layer[**e as usize] == *layer) {
                for n in surface.corners(*element as usize) {
                    let (stamp, first) = &mut self.corner[*n as usize];
                    if *stamp == self.stamp {
                        join(&mut self.piece, *first, at);
                    } else {
                        (*stamp, *first) = (self.stamp, at);
                    }
                }
            }
        }
        self.pieces = 0;
        for at in 0..self.piece.len() {
            let least = self.piece[at] as usize;
            // What `least` had was turned into the number of its piece.
            self.piece[at] = if least == at { self.pieces } else { self.piece[least] };
            self.pieces += u32::from(least == at);
        }
    }

    /// One record per piece, with what was remembered; returns the slide energy of what was dropped.
    fn records(&mut self, surface: &ContactSurface, node: u32, remembered: &[Record], penalty: &Penalty) -> f64 {
        self.made.clear();
        let own_kg = Some(penalty.mass_kg[node as usize]).filter(|m| *m > 0.0).unwrap_or(f64::INFINITY);
        let mut lost = 0.0;
        for piece in 0..self.pieces {
            let members = || self.elements.iter().zip(&self.piece).filter(move |(_, p)| **p == piece).map(|(e, _)| *e);
            let layer = members().next().map_or(0, |e| surface.layer[e as usize]);
            let heirs = remembered.iter().filter(|r| self.find(r.element).is_some_and(|at| self.piece[at] == piece));
            let mut record = match heirs.min_by(|a, b| order(a).total_cmp(&order(b))) {
                Some(best) => *best,
                None => Record { node, layer, own: surface.is_in(node as usize, layer), ..Record::new() },
            };
            let mass = members().map(|e| penalty.light_kg[e as usize]).fold(own_kg, f64::min);
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
    /// elements in its piece that were in another, and soon if there are new ones.
    fn inherit(&mut self, remembered: &[Record], clear_m: f64) {
        for ((known_m, from), piece) in self.clear_m.iter_mut().zip(&self.from).zip(&self.piece) {
            let record = &mut self.made[*piece as usize];
            match remembered.get(*from as usize) {
                Some(old) if old.element != record.element || old.layer != record.layer => {
                    record.due_m = f64::NEG_INFINITY;
                }
                Some(_) => {}
                None => {
                    *known_m = clear_m;
                    record.due_m = record.due_m.min(0.25 * clear_m);
                }
            }
        }
    }

    fn append(&self, chunk: &mut Chunk) {
        for (piece, record) in self.made.iter().enumerate() {
            let first = chunk.candidates.len() as u32;
            let members = (0..self.elements.len()).filter(|i| self.piece[*i] as usize == piece);
            chunk
                .candidates
                .extend(members.map(|i| ContactCandidate { element: self.elements[i], clear_m: self.clear_m[i] }));
            chunk.records.push(Record { first, count: chunk.candidates.len() as u32 - first, ..*record });
        }
    }
}

/// The pieces of two elements become one.
fn join(piece: &mut [u32], one: u32, other: u32) {
    let (one, other) = (root(piece, one), root(piece, other));
    piece[one.max(other) as usize] = one.min(other);
}

fn root(piece: &mut [u32], mut at: u32) -> u32 {
    while piece[at as usize] != at {
        let up = piece[piece[at as usize] as usize];
        piece[at as usize] = up;
        at = up;
    }
    at
}

/// Decided records first, then the closer one.
fn order(record: &Record) -> f64 {
    if record.side == 0 { f64::INFINITY } else { record.distance_m.abs() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::tests::rig::Noise;

    #[test]
    fn pieces_hold_every_pair_once_and_no_node_is_cut() {
        for (pairs, of_a_node) in [(0, 1), (10, 3), (PIECE, 1), (PIECE + 1, 2), (3 * PIECE, 7), (3 * PIECE, 2 * PIECE)]
        {
            let pairs: Vec<(u32, u32)> = (0..pairs).map(|i| ((i / of_a_node) as u32, i as u32)).collect();
            let pieces = pieces(&pairs);
            assert_eq!(pieces.concat(), pairs);
            assert!(pieces.windows(2).all(|w| w[0].last().unwrap().0 < w[1].first().map_or(u32::MAX, |pair| pair.0)));
        }
    }

    #[test]
    fn pieces_are_those_that_joining_every_two_elements_with_a_corner_finds() {
        let mut noise = Noise(9);
        let mut surface = ContactSurface::default();
        let mut work = SortedCandidates { corner: vec![(0, 0); 64], ..SortedCandidates::default() };
        for number in 0..200_u32 {
            let node = |share: f64| ((share + 1.0) * 32.0) as u32 % 64;
            let [a, b, c] = noise.point(1.0).map(node);
            let [d, layer, _] = noise.point(1.0);
            surface.elements.push([a, b, c, if number % 4 == 0 { NONE } else { node(d) }]);
            surface.layer.push(u32::from(layer > 0.2));
        }
        work.place = vec![0; 200];
        for (first, count) in [(0, 3), (3, 12), (20, 9), (40, 30), (100, 100)] {
            let group: Vec<(u32, u32)> = (first..first + count).map(|e| (0, e)).collect();
            assert!(!work.are_known(&group, &[], &[]));
            work.split(&surface);
            let meet = |a: u32, b: u32| {
                let (own, other) = (surface.corners(a as usize), surface.corners(b as usize));
                surface.layer[a as usize] == surface.layer[b as usize] && own.iter().any(|n| other.contains(n))
            };
            let mut least: Vec<usize> = (0..group.len()).collect();
            for _ in 0..group.len() {
                for (i, a) in group.iter().enumerate() {
                    for j in (0..group.len()).filter(|j| meet(a.1, group[*j].1)) {
                        (least[i], least[j]) = (least[i].min(least[j]), least[i].min(least[j]));
                    }
                }
            }
            let firsts: Vec<usize> = (0..group.len()).filter(|i| least[*i] == *i).collect();
            let number = |i: &usize| firsts.iter().position(|first| first == i).unwrap() as u32;
            assert_eq!(work.piece, least.iter().map(number).collect::<Vec<u32>>());
            assert_eq!(work.pieces as usize, firsts.len());
        }
    }
}
