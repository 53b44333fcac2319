//! Nothing passes through anything: springs between sides of elements, and steps that stop short of a meeting.
//!
//! ```text
//! d = |a + u e₁ − b − v e₂|      E = Σ ½ k (g − d)₊²      F = k (g − d)₊ − c ḋ   along n = ∇d
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e₁, e₂ | two sides (or diagonals that halve quadrilaterals) without a common node | m |
//! | u, v | places of their closest points; the spring acts while both are inside and the sine between them is over 0.1 | - |
//! | g | rest gap: `gap_m` or the distance if smaller for layers that start close, later `thickness_m` (at most a quarter of an element) as far as the pair was apart | m |
//! | k | 0.05 m/dt², m the lightest of the four nodes | N/m |
//! | c | 2 ζ √(k m), ζ = 0.1; only pushes | N·s/m |
//!
//! **Springs** hold sides apart that cross between their nodes; nodes on faces are held by [`super`], which has friction,
//! too. A distance has no side: since nothing ever passed, the present side is the right one, and no memory can be wrong.
//! [`super`] then trusts the present side of a face as well. A spring pushes nothing at once; what it stores when the closest
//! points leave the ends is in `edge damping`. A pair that is pressed closer than half of `gap_m` gets a larger rest gap,
//! slowly, until its spring carries the load; the work of that is a negative loss.
//!
//! **Meetings.** Springs are finite, so all pairs of sides and all pairs of a node and a triangle are followed through the
//! motion of the coming step (additive continuous collision detection). Where two would come closer than a fifth of their
//! distance, or of `gap_m`, the motion is changed by an impulse along their normal at that moment that leaves some of the
//! distance, pair by pair until none is left; pairs that after 20 rounds still meet move as one body in that step. An
//! impulse is a force of the step: momentum is kept, and its work is in `collisions` (inelastic: it is a loss, but for
//! parting pairs closer than a fifth of `gap_m`).
//!
//! **Cost.** A pair is looked at when nodes of its chunk can have moved far enough against each other to matter. A folded
//! pouch of 1500 elements takes 8 times the CPU time per step of one with nodes against faces alone, and the step is a tenth shorter:
//! two fifths are the search, the rest springs and meetings, one pair after the other. A skin of twice or half the size makes it
//! 1.6 times slower.
//!
//! **Validity**: layers must start apart and not crossed. What starts as one point (closer than 0.0001 `gap_m`) is left alone
//! until it parts; what starts crossed stays so. Nodes that ties, rigid bodies or supports move count as driven.
//! Sources: Li, Kaufman, Jiang, ACM Trans. Graph. 40 (2021), 170 (detection); Bridson, Fedkiw, Anderson, ACM Trans. Graph.
//! 21 (2002), 594 (impulses, bodies that move as one); growing gaps: this project.

mod chunk;
pub(crate) mod hold;
mod pair;
mod save;
mod sides;
#[cfg(test)]
mod tests;

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};
use rayon::prelude::*;

use super::follow::farthest_m;
use super::push;
use super::surface::Surface;
use crate::{FemError, Mesh, problem};
use crate::{Tick, Transient};
use chunk::{Chunk, PAIRS};
use pair::Pair;
use sides::Sides;

/// (ω dt)² of one pair on its lightest node.
const SHARE: f64 = 0.05;
/// Share of critical damping of a pair.
const DAMPING: f64 = 0.1;

/// Contact between sides of elements, and what keeps everything from passing through each other.
#[derive(Debug, Clone)]
pub struct Edges {
    sides: Sides,
    mass_kg: Vec<f64>,
    /// One over the mass along each axis; 0 where supports, bodies or ties decide.
    mobility_1_kg: Vec<[f64; 3]>,
    stiffness_1_s2: f64,
    damping_1_s: f64,
    gap_m: f64,
    thickness_m: f64,
    reach_m: f64,
    skin_m: f64,
    chunks: Vec<Chunk>,
    /// Positions at the last search.
    placed_m: Vec<[f64; 4]>,
    path_m: f64,
    search_due_m: f64,
    searches: u64,
    stored_j: f64,
    lost_j: f64,
    held: hold::Held,
}

impl Edges {
    /// Contact of edges of a mesh in the solver's node order, with the nodes' masses, the time step, and the axes that
    /// something else drives.
    ///
    /// # Errors
    /// [`FemError::Problem`] for unknown parts.
    pub fn new(
        mesh: &Mesh,
        settings: &problem::Contact,
        mass_kg: &[f64],
        dt_s: f64,
        driven: &[[bool; 3]],
    ) -> Result<Edges, FemError> {
        let surface = Surface::new(mesh, &settings.parts)?;
        let stiffness_1_s2 = SHARE / (dt_s * dt_s);
        let x: Vec<[f64; 4]> =
            (0..mesh.points.len()).map(|i| mesh.start_of(i)).map(|[x, y, z]| [x, y, z, 0.0]).collect();
        let mobility = |(m, axes): (&f64, &[bool; 3])| axes.map(|a| if a || *m <= 0.0 { 0.0 } else { 1.0 / m });
        let mut edges = Edges {
            sides: Sides::new(&surface),
            mass_kg: mass_kg.to_vec(),
            mobility_1_kg: mass_kg.iter().zip(driven).map(mobility).collect(),
            stiffness_1_s2,
            damping_1_s: 2.0 * DAMPING * stiffness_1_s2.sqrt(),
            gap_m: settings.gap_m,
            // The own mesh of a layer must not push itself.
            thickness_m: settings.thickness_m.min(0.25 * surface.size_m),
            reach_m: settings.thickness_m.max(4.0 * settings.gap_m),
            skin_m: 0.25 * surface.size_m,
            chunks: Vec::new(),
            placed_m: Vec::new(),
            path_m: 0.0,
            search_due_m: 0.0,
            searches: 0,
            stored_j: 0.0,
            lost_j: 0.0,
            held: hold::Held::default(),
        };
        edges.search(&x);
        edges.start_gaps(&x);
        Ok(edges)
    }

    /// Pairs that start close keep the distance they have.
    fn start_gaps(&mut self, x: &[[f64; 4]]) {
        for pair in self.chunks.iter_mut().flat_map(|c| &mut c.pairs).filter(|p| !p.face) {
            let distance_m = pair.touch(x).distance_m;
            if distance_m < self.thickness_m {
                pair.rest_m = distance_m.min(self.gap_m).min(self.thickness_m);
            }
        }
    }

    fn active(&self) -> impl Iterator<Item = &Pair> {
        self.chunks.iter().flat_map(|chunk| &chunk.pairs).filter(|pair| pair.on)
    }

    /// Searches again when some node may have moved more than half the skin.
    fn search_if_due(&mut self, x: &[[f64; 4]]) {
        if self.path_m < self.search_due_m {
            return;
        }
        let left = 0.5 * self.skin_m - farthest_m(x, &self.placed_m);
        self.search_due_m = self.path_m + left;
        if left <= 0.05 * self.skin_m {
            self.search(x);
        }
    }

    fn search(&mut self, x: &[[f64; 4]]) {
        let mut old: Vec<Pair> = self.chunks.iter().flat_map(|c| &c.pairs).filter(|p| !p.face).copied().collect();
        old.sort_unstable_by_key(|p| p.key);
        let [sides, faces] = self.sides.pairs(x, self.reach_m + self.skin_m);
        let kept = |key: &[u32; 2]| old.binary_search_by(|p| p.key.cmp(key)).map(|at| old[at]);
        let fresh = |key: &[u32; 2]| kept(key).unwrap_or_else(|_| self.fresh(*key, false));
        let mut pairs: Vec<Pair> = sides.iter().map(fresh).collect();
        let dropped = old.iter().filter(|p| p.deep_m > 0.0 && sides.binary_search(&p.key).is_err());
        self.lost_j += dropped.map(|p| 0.5 * p.stiffness_n_m * p.deep_m * p.deep_m).sum::<f64>();
        let sides = pairs.chunks(PAIRS).map(|pairs| Chunk::new(pairs.to_vec()));
        let mut chunks: Vec<Chunk> = sides.collect();
        pairs.clear();
        pairs.extend(faces.iter().map(|key| self.fresh(*key, true)));
        chunks.extend(pairs.chunks(PAIRS).map(|pairs| Chunk::new(pairs.to_vec())));
        self.chunks = chunks;
        self.placed_m.clear();
        self.placed_m.extend_from_slice(x);
        self.search_due_m = self.path_m + 0.5 * self.skin_m;
        self.searches += 1;
    }

    fn fresh(&self, key: [u32; 2], face: bool) -> Pair {
        if face {
            let [a, b, c] = self.sides.triangles[key[1] as usize];
            return Pair { face, key, nodes: [key[0], a, b, c], ..Pair::default() };
        }
        let [[a, b], [c, d]] = key.map(|s| self.sides.list[s as usize]);
        let nodes = [a, b, c, d];
        let masses = nodes.iter().map(|n| self.mass_kg[*n as usize]).filter(|m| *m > 0.0);
        let mass = masses.fold(f64::INFINITY, f64::min);
        let mass = if mass.is_finite() { mass } else { 0.0 };
        Pair {
            key,
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
    fn line(&self) -> LedgerLine {
        LedgerLine { name: "edge contact", account: Account::Contact }
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let mut energy_j = 0.0;
        for pair in self.active() {
            let touch = pair.touch(x);
            let depth_m = pair.rest_m - touch.distance_m;
            if !touch.inside || depth_m <= 0.0 {
                continue;
            }
            energy_j += 0.5 * pair.stiffness_n_m * depth_m * depth_m;
            let push_n = crate::vec3::scale(touch.normal, pair.stiffness_n_m * depth_m);
            pair.nodes.iter().zip(touch.weights).for_each(|(n, w)| push(&mut force[*n as usize], w, push_n));
        }
        energy_j
    }
}

impl Transient for Edges {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        self.search_if_due(x);
        let (path_m, floor_m) = (self.path_m, 0.5 * self.gap_m.min(self.thickness_m));
        self.chunks.par_iter_mut().for_each(|chunk| chunk.press(x, path_m, tick.dt_s, floor_m));
        self.stored_j = 0.0;
        for chunk in &self.chunks {
            self.stored_j += chunk.sums[0];
            self.lost_j += chunk.sums[1];
            for (nodes, weights, push_n) in &chunk.pushes {
                nodes.iter().zip(weights).for_each(|(n, w)| push(&mut force[*n as usize], *w, *push_n));
            }
        }
        self.stored_j
    }

    /// Lines at the positions of the last step.
    fn ledger(&self, _at: &Pose) -> Vec<Row> {
        let row = |name, account, kind, energy_j| Row { name, account, kind, energy_j };
        vec![
            row("edge contact", Account::Contact, RowKind::Stored, self.stored_j),
            row("edge damping", Account::Contact, RowKind::Dissipated, self.lost_j),
            row("collisions", Account::Contact, RowKind::Dissipated, self.held.lost_j),
        ]
    }

    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        let x = at.q.as_chunks::<4>().0;
        for pair in self.active() {
            // K = k b bᵀ, b the weights: uᵀK u ≤ k Σ|b| Σ|bᵢ| uᵢ².
            let touch = pair.touch(x);
            if !touch.inside {
                continue;
            }
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
