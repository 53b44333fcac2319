//! Edge-to-edge contact: sides of elements that cross the sides of another layer between the nodes.
//!
//! ```text
//! n = s e₁×e₂/|e₁×e₂|     d = (a + u e₁ − b − v e₂)·n     E = Σ ½ k (g − d)₊²
//! F = k (g − d)₊ − c ḋ    along n; (1 − u) F, u F on the ends of the first side, (v − 1) F, −v F on the second
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e₁, e₂ | two sides (or diagonals that halve quadrilaterals) with no node in common, of two layers or more than two rings apart | m |
//! | u, v | places of the closest points of their lines; a pair acts while both are within 0 to 1 | - |
//! | s | sign of the pair, see below | - |
//! | g | rest gap: `gap_m` for layers that start close, `thickness_m` later; never more than the distance at which a pair begins to act | m |
//! | k | 0.05 m/dt², m the lightest of the four nodes | N/m |
//! | c | 2 ζ √(k m), ζ = 0.1; only pushes | N·s/m |
//!
//! d has no slope over u and v, so F is the exact slope of E, and each pair has neither net force nor net moment. There is
//! no friction here: nodes on faces have it.
//!
//! **Sign.** Each side of a pair remembers on which side of its faces the other one is, from when they come near until they
//! are away; a pair that comes near within a layer whose neighbouring pair knows takes that over. When the closest points
//! come within both sides, s is such that n leads from the one to the other by these memories; it is kept until the lines
//! are parallel (sine below 0.1) or the closest points are far beyond the ends.
//!
//! **Ends.** Beyond the ends nodes on faces take over. A pair begins to act with the gap it then has, so nothing pushes at
//! once; what is stored when it ends is in `edge damping`.
//!
//! **Validity**: as in [`super`]; seams of three and more sheets take no part. A pair that begins to act while crossed by more
//! than a fraction of the thickness keeps that depth: edges do not mend what is wrong already.

mod chunk;
mod pair;
mod save;
mod segment;
mod sides;
#[cfg(test)]
mod tests;

use models::{Pose, Row, RowKind, Term, Tick};
use rayon::prelude::*;

use super::surface::Surface;
use super::{Contact, fastest_m, push};
use crate::{FemError, Mesh, problem};
use chunk::{Chunk, PAIRS};
use pair::{Pair, Scene};
use sides::Sides;

/// (ω dt)² of one pair on its lightest node.
const SHARE: f64 = 0.05;
/// Share of critical damping of a pair.
const DAMPING: f64 = 0.1;
/// Passes in which ways spread to neighbouring pairs at the start.
const PASSES: usize = 8;

/// Contact between sides of elements.
#[derive(Debug, Clone)]
pub struct Edges {
    surface: Surface,
    sides: Sides,
    mass_kg: Vec<f64>,
    stiffness_1_s2: f64,
    damping_1_s: f64,
    gap_m: f64,
    thickness_m: f64,
    /// Ways are remembered within this distance.
    reach_m: f64,
    skin_m: f64,
    slack_m: f64,
    chunks: Vec<Chunk>,
    /// Positions at the last search.
    placed_m: Vec<[f64; 4]>,
    /// Positions one step before; empty before the first step.
    before_m: Vec<[f64; 4]>,
    path_m: f64,
    search_due_m: f64,
    searches: u64,
    stored_j: f64,
    lost_j: f64,
}

impl Edges {
    /// Contact of edges beside `contact`, which was made from the same mesh, settings, masses and step.
    ///
    /// # Errors
    /// [`FemError`] as [`Contact::new`].
    pub fn new(
        mesh: &Mesh,
        settings: &problem::Contact,
        mass_kg: &[f64],
        dt_s: f64,
        contact: &Contact,
    ) -> Result<Edges, FemError> {
        let surface = Surface::new(mesh, &settings.parts)?;
        let size_m = surface.size_m;
        let stiffness_1_s2 = SHARE / (dt_s * dt_s);
        let x: Vec<[f64; 4]> =
            (0..mesh.points.len()).map(|i| mesh.start_of(i)).map(|[x, y, z]| [x, y, z, 0.0]).collect();
        let mut edges = Edges {
            sides: Sides::new(&surface, x.len()),
            surface,
            mass_kg: mass_kg.to_vec(),
            stiffness_1_s2,
            damping_1_s: 2.0 * DAMPING * stiffness_1_s2.sqrt(),
            gap_m: settings.gap_m,
            thickness_m: settings.thickness_m,
            reach_m: (0.375 * size_m).max(4.0 * settings.thickness_m).max(4.0 * settings.gap_m),
            skin_m: 0.4 * size_m,
            slack_m: 0.05 * size_m,
            chunks: Vec::new(),
            placed_m: Vec::new(),
            before_m: Vec::new(),
            path_m: 0.0,
            search_due_m: 0.0,
            searches: 0,
            stored_j: 0.0,
            lost_j: 0.0,
        };
        edges.search(&x);
        edges.start(&x, contact);
        Ok(edges)
    }

    /// Searches done so far.
    pub fn searches(&self) -> u64 {
        self.searches
    }
    /// Pairs that are evaluated every step now.
    pub fn near_pairs(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.near.len()).sum()
    }

    fn near(&self) -> impl Iterator<Item = &Pair> {
        self.chunks.iter().flat_map(|chunk| chunk.near.iter().map(|at| &chunk.pairs[*at as usize]))
    }

    fn scene<'a>(&'a self, x: &'a [[f64; 4]], dt_s: f64) -> Scene<'a> {
        let (reach_m, thickness_m) = (self.reach_m, self.thickness_m);
        Scene { surface: &self.surface, sides: &self.sides, x, reach_m, thickness_m, dt_s }
    }

    /// Ways at the start: what the nodes at the ends remember, else what the positions say, else what neighbours know.
    fn start(&mut self, x: &[[f64; 4]], contact: &Contact) {
        let mut chunks = std::mem::take(&mut self.chunks);
        let scene = self.scene(x, 0.0);
        for pair in chunks.iter_mut().flat_map(|c| &mut c.pairs) {
            pair.way = [0, 1].map(|k: usize| self.known(contact, pair, k));
            pair.wanted_m = self.gap_m;
            pair.rest_m = pair.settle(&scene).min(self.gap_m);
        }
        self.chunks = chunks;
        for _ in 0..PASSES {
            let old: Vec<Pair> = self.chunks.iter().flat_map(|c| c.pairs.iter().copied()).collect();
            let mut chunks = std::mem::take(&mut self.chunks);
            chunks.iter_mut().flat_map(|c| &mut c.pairs).for_each(|pair| self.inherit(pair, &old));
            self.chunks = chunks;
        }
    }

    /// On which side of the faces of side `k` contact of nodes knows the other side's ends to be.
    fn known(&self, contact: &Contact, pair: &Pair, k: usize) -> i8 {
        let face = self.sides.list[pair.sides[k] as usize].faces[0];
        let layer = self.surface.layer[face as usize];
        let ends = &pair.nodes[2 - 2 * k..4 - 2 * k];
        let mut sum = 0;
        for chunk in &contact.chunks {
            let (Some(first), Some(last)) = (chunk.records.first(), chunk.records.last()) else { continue };
            for end in ends.iter().filter(|n| (first.node..=last.node).contains(n)) {
                let from = chunk.records.partition_point(|r| r.node < *end);
                let own = chunk.records[from..].iter().take_while(|r| r.node == *end);
                sum += own.filter(|r| r.layer == layer && !r.own).map(|r| i32::from(r.side)).sum::<i32>();
            }
        }
        sum.signum() as i8
    }

    /// Takes missing ways, and the gap, from pairs of which one side is the same and the other a neighbour.
    fn inherit(&self, pair: &mut Pair, old: &[Pair]) {
        let mut votes = [0_i32; 2];
        let mut wanted_m = f64::INFINITY;
        for k in 0..2 {
            let (own, other) = (pair.sides[1 - k], pair.sides[k]);
            let ends = self.sides.list[other as usize].nodes;
            for next in ends.iter().flat_map(|n| self.sides.at.of(*n as usize)).filter(|s| **s != other) {
                let key = [own.min(*next), own.max(*next)];
                let Ok(at) = old.binary_search_by(|p| p.sides.cmp(&key)) else { continue };
                if !self.sides.one_layer(&self.surface, other, *next) {
                    continue;
                }
                let swapped = usize::from(old[at].sides[k] != *next);
                for (j, vote) in votes.iter_mut().enumerate() {
                    *vote += i32::from(old[at].way[j ^ swapped]);
                }
                if old[at].way != [0; 2] {
                    wanted_m = wanted_m.min(old[at].wanted_m);
                }
            }
        }
        for (way, vote) in pair.way.iter_mut().zip(votes).filter(|(way, _)| **way == 0) {
            *way = vote.signum() as i8;
        }
        pair.wanted_m = pair.wanted_m.min(wanted_m);
        pair.rest_m = pair.rest_m.min(pair.wanted_m);
    }

    /// Searches again when some node may have moved more than half the skin.
    fn search_if_due(&mut self, x: &[[f64; 4]]) {
        if self.path_m < self.search_due_m {
            return;
        }
        let left = 0.5 * self.skin_m - fastest_m(x, &self.placed_m);
        self.search_due_m = self.path_m + left;
        if left <= 0.05 * self.skin_m {
            self.search(x);
        }
    }

    fn search(&mut self, x: &[[f64; 4]]) {
        let old: Vec<Pair> = self.chunks.iter().flat_map(|c| c.pairs.iter().copied()).collect();
        let found = self.sides.pairs(x, self.reach_m + self.skin_m);
        let keep = |key: &[u32; 2]| old.binary_search_by(|p| p.sides.cmp(key)).map(|at| old[at]);
        let pairs: Vec<Pair> = found
            .par_iter()
            .with_min_len(256)
            .map(|key| {
                keep(key).unwrap_or_else(|_| {
                    let mut pair = self.fresh(*key);
                    self.inherit(&mut pair, &old);
                    pair
                })
            })
            .collect();
        let dropped = old.iter().filter(|p| p.deep_m > 0.0 && found.binary_search(&p.sides).is_err());
        self.lost_j += dropped.map(|p| 0.5 * p.stiffness_n_m * p.deep_m * p.deep_m).sum::<f64>();
        self.chunks = pairs.chunks(PAIRS).map(|pairs| Chunk::new(pairs.to_vec())).collect();
        self.placed_m.clear();
        self.placed_m.extend_from_slice(x);
        self.search_due_m = self.path_m + 0.5 * self.skin_m;
        self.searches += 1;
    }

    fn fresh(&self, sides: [u32; 2]) -> Pair {
        let [[a, b], [c, d]] = sides.map(|s| self.sides.list[s as usize].nodes);
        let nodes = [a, b, c, d];
        let masses = nodes.iter().map(|n| self.mass_kg[*n as usize]).filter(|m| *m > 0.0);
        let mass = masses.fold(f64::INFINITY, f64::min);
        let mass = if mass.is_finite() { mass } else { 0.0 };
        Pair {
            sides,
            nodes,
            rest_m: self.thickness_m,
            wanted_m: self.thickness_m,
            stiffness_n_m: self.stiffness_1_s2 * mass,
            damping_n_s_m: self.damping_1_s * mass,
            ..Pair::default()
        }
    }
}

impl Term for Edges {
    fn name(&self) -> &'static str {
        "edge contact"
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy_j = 0.0;
        for pair in self.near() {
            let Some(touch) = pair.touch(x).filter(|t| t.depth_m > 0.0) else { continue };
            energy_j += 0.5 * pair.stiffness_n_m * touch.depth_m * touch.depth_m;
            let push_n = crate::vec3::scale(touch.normal, pair.stiffness_n_m * touch.depth_m);
            pair.nodes.iter().zip(touch.weights).for_each(|(n, w)| push(&mut force[*n as usize], w, push_n));
        }
        energy_j
    }

    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        if self.before_m.is_empty() {
            self.before_m = x.to_vec();
        }
        self.path_m += fastest_m(x, &self.before_m);
        self.search_if_due(x);
        let mut chunks = std::mem::take(&mut self.chunks);
        let scene = self.scene(x, tick.dt_s);
        chunks.par_iter_mut().for_each(|chunk| chunk.step(&scene, self.path_m, self.slack_m));
        self.chunks = chunks;
        self.stored_j = 0.0;
        for chunk in &self.chunks {
            self.stored_j += chunk.sums[0];
            self.lost_j += chunk.sums[1];
            for (nodes, weights, push_n) in &chunk.pushes {
                nodes.iter().zip(weights).for_each(|(n, w)| push(&mut force[*n as usize], *w, *push_n));
            }
        }
        self.before_m.copy_from_slice(x);
        self.stored_j
    }

    /// Lines at the positions of the last step.
    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        let row = |name, kind, energy_j| Row { name, kind, energy_j };
        vec![row("edge contact", RowKind::Stored, self.stored_j), row("edge damping", RowKind::Dissipated, self.lost_j)]
    }

    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        let x = at.q.as_chunks::<4>().0;
        for pair in self.near() {
            // K = k b bᵀ, b the weights: uᵀK u ≤ k Σ|b| Σ|bᵢ| uᵢ².
            let Some(touch) = pair.touch(x).filter(|t| t.depth_m > 0.0) else { continue };
            let whole = touch.weights.iter().map(|w| w.abs()).sum::<f64>();
            for (n, w) in pair.nodes.iter().zip(touch.weights) {
                bound[*n as usize] += pair.stiffness_n_m * whole * w.abs();
            }
        }
    }

    fn save(&self) -> Vec<u8> {
        save::write(self)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        save::read(self, saved).is_some()
    }
}
