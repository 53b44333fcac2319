//! Node-to-face contact between layers of fabric, with side memory and Coulomb friction.
//!
//! ```text
//! d      distance of a node from the closest triangle of a layer, positive on the remembered side
//! E      = Σ ½ k (g − d)₊² + ½ k |e|²
//! F      = k (g − d)₊ n − c ḋ n − k e        on the node; −wᵢ F on the corners of the triangle
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | g | rest gap: `gap_m` or the initial distance if smaller for layers that start close, `thickness_m` later | m |
//! | n, wᵢ | normal, and weights of the point below the node; Σ wᵢ = 1 | - |
//! | k | 0.05 m/dt², m the lightest of the nodes near the pair | N/m |
//! | c | 2 ζ √(k m), ζ = 0.1; only pushes | N·s/m |
//! | e | elastic slide, |k e| ≤ μ N, see the return map in `terms` | m |
//!
//! Every node is tested against the faces of every layer, so two layers meet twice, once with the nodes of each.
//! Net force and moment of a pair without friction are zero; friction leaves the moment of T over the rest gap.
//!
//! **Sides.** A node remembers on which side of a layer it is, from when it first comes near (1.5 mm on a 4 mm mesh)
//! until it is away again; so thin layers cannot swap. Connected pieces of one layer near a node are remembered one by
//! one, so a tube may fold onto itself. A run starts without contact force: see `start`.
//!
//! **Energy.** Changing from face to face, or a side judged wrongly in a crumple, must not create energy: at such a
//! change the rest gap is lowered so that the depth stays; it grows back to its target when the pair is apart. The energy
//! that this loses, and the gain or loss of a time step that begins or ends within the gap, are in `contact damping`.
//!
//! **Cost.** Candidates are found by a search that is repeated only when nodes moved half the skin. A record is looked at
//! when it may have moved far enough to matter, against what its chunk, a compact stretch of a layer, moved; candidates
//! that cannot be the closest then are passed over, the others measured eight at a time. A step evaluates the pairs that may
//! touch, in vector groups, and hands over forces where they touch.
//!
//! **Validity**: penalty depths p dt²/(0.1 m_A) far below the thickness (m_A areal mass, p pressure); elements larger
//! than about three thicknesses; edges against edges are caught only through their nodes, unless [`edges`] are asked for.
//! Source: penalty contact as in Hallquist et al., Comput. Methods Appl. Mech. Eng. 51 (1985); side memory: this project.

mod ask;
mod body;
mod build;
mod chunk;
mod closest;
pub mod edges;
mod follow;
mod pack;
mod passed;
mod press;
mod record;
mod search;
mod start;
mod surface;

use models::{Account, LedgerLine, Pose, Row, Term};
use rayon::prelude::*;

use crate::bytes::{pack, unpack};
use crate::problem;
use crate::terms::slide;
use crate::transient::{dissipated, stored};
use crate::vec3::{Nodes, dot, norm, padded, scale, share};
use crate::{FemError, Mesh, Result};
use crate::{Tick, Transient};
pub use body::LayerContact;
use build::Penalty;
use chunk::{Chunk, touch};
use follow::{Searched, follow};
pub(crate) use passed::Passage;
use passed::Passed;
use press::{ContactEnergies, motion, push};
use record::ContactReach;
use surface::ContactSurface;

/// (ω dt)² of one pair. A node between two layers holds up to eight such shares: 0.4 of the 4 that central differences
/// allow, so contact does not limit a step of 0.9 of what the fabric allows.
const SHARE: f64 = 0.05;
/// Share of critical damping of a pair.
const DAMPING: f64 = 0.1;

/// Fewest nodes whose forces are handed over at once, and most pieces: every piece looks at all chunks near it.
const PIECE: usize = 4096;
const PIECES: usize = 8;

impl LayerContact {
    /// Contact for a mesh in the solver's node order, with the nodes' masses and the time step.
    ///
    /// # Errors
    /// [`FemError::Problem`] for unknown parts or parameters out of range; [`FemError::Mesh`] naming node, element and
    /// depth where layers pass through each other at the start.
    pub fn new(mesh: &Mesh, settings: &problem::Contact, mass_kg: &[f64], dt_s: f64) -> Result<LayerContact> {
        check(settings, mesh, mass_kg, dt_s)?;
        let surface = ContactSurface::new(mesh, &settings.parts)?;
        let reach = reaches(settings, surface.size_m);
        let light_kg = surface.lightest(mass_kg);
        let stiffness_1_s2 = SHARE / (dt_s * dt_s);
        let damping_1_s = 2.0 * DAMPING * stiffness_1_s2.sqrt();
        let start: Vec<[f64; 4]> = mesh.starts().into_iter().map(padded).collect();
        let mut contact = LayerContact {
            surface,
            penalty: Penalty { mass_kg: mass_kg.to_vec(), light_kg, stiffness_1_s2, damping_1_s },
            reach,
            friction: settings.friction,
            ..LayerContact::default()
        };
        contact.search(&start);
        start::sides(&mut contact, mesh, settings, &start)?;
        let mut chunks = std::mem::take(&mut contact.chunks);
        let step = contact.step_of(&start, 0.0);
        chunks.iter_mut().for_each(|chunk| chunk.look(&step));
        contact.chunks = chunks;
        start::relax(&mut contact, &start);
        Ok(contact)
    }

    /// Contact pressure at every node \[Pa\]: normal spring forces over the node's reference area, both faces added.
    pub fn pressure_pa(&self, q: &[f64]) -> Vec<f64> {
        let mut pressure = vec![0.0; q.len() / crate::NODE];
        for record in self.near() {
            let touch = touch(record, q.as_chunks::<4>().0);
            let force = record.stiffness_n_m * touch.depth_m.max(0.0);
            pressure[record.node as usize] += force;
            for (n, w) in record.corners.iter().zip(touch.weights) {
                pressure[*n as usize] += w.abs() * force;
            }
        }
        for (p, area) in pressure.iter_mut().zip(&self.surface.area_m2) {
            *p = share(*p, *area);
        }
        pressure
    }
    /// Nodes that changed side of a layer so far, nodes that could, and the first that did with the part that it came through.
    pub(crate) fn passed(&self) -> (usize, usize, Option<(Passage, u32)>) {
        let part = |first: Passage| (first, self.surface.origin[first.element as usize].0);
        (self.passed.nodes.len(), self.surface.nodes, self.passed.first.map(part))
    }
}

/// What contact cannot find again from positions, after the number of elements.
type SavedContact = (usize, Searched, ContactEnergies, Vec<[f64; 4]>, Passed, Vec<Chunk>);

impl Term for LayerContact {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("contact", Account::Contact)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        let before = if self.before_m.is_empty() { x } else { &self.before_m };
        let mut energy_j = 0.0;
        for record in self.near() {
            let touch = touch(record, x);
            if touch.depth_m <= 0.0 {
                continue;
            }
            let k = record.stiffness_n_m;
            let mut push_n = scale(touch.normal, k * touch.depth_m);
            energy_j += 0.5 * k * touch.depth_m * touch.depth_m;
            if self.friction > 0.0 {
                let limit = self.friction * k * touch.depth_m;
                let spring = slide(record.spring_m, motion(record, &touch, x, before), touch.normal, k, limit).0;
                push_n = crate::vec3::along(push_n, -k, spring);
                energy_j += 0.5 * k * dot(spring, spring);
            }
            push(&mut force[record.node as usize], 1.0, push_n);
            for (n, w) in record.corners.iter().zip(touch.weights) {
                push(&mut force[*n as usize], -w, push_n);
            }
        }
        energy_j
    }
}

impl Transient for LayerContact {
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64 {
        let x = at.q.as_chunks::<4>().0;
        if self.before_m.is_empty() {
            self.before_m = x.to_vec();
        }
        self.now_m.resize(x.len(), [0.0; 4]);
        self.searched.path_m += follow(self.arch, x, &self.before_m, &mut self.now_m);
        if self.searched.is_due(x, self.reach.skin_m) {
            self.search(x);
        }
        let mut chunks = std::mem::take(&mut self.chunks);
        let step = self.step_of(x, tick.dt_s);
        chunks.par_iter_mut().for_each(|chunk| chunk.step(&step));
        self.passed.take(&mut chunks, tick.time_s, x);
        self.chunks = chunks;
        // Most chunks of a fine mesh touch nothing.
        let mut pushing = Vec::new();
        self.sums.stored = 0.0;
        for chunk in &self.chunks {
            self.sums.stored += chunk.sums.stored;
            self.sums.friction += chunk.sums.friction;
            self.sums.damping += chunk.sums.damping;
            if !chunk.pushes.is_empty() {
                pushing.push(chunk);
            }
        }
        let force = force.as_chunks_mut::<4>().0;
        // One thread need not look at any force twice.
        let pieces = if rayon::current_num_threads() == 1 { 1 } else { PIECES };
        let most = PIECE.max(force.len().div_ceil(pieces));
        hand_over(&pushing, 0, force, most);
        std::mem::swap(&mut self.before_m, &mut self.now_m);
        self.sums.stored
    }

    /// Lines at the positions of the last step (at `at` before the first).
    fn ledger(&self, at: &Pose) -> Vec<Row> {
        let first = self.before_m.is_empty();
        let stored_j = if first { self.add(at, &mut vec![0.0; at.q.len()]) } else { self.sums.stored };
        vec![
            stored("contact", Account::Contact, stored_j),
            dissipated("friction", Account::Contact, self.sums.friction),
            dissipated("contact damping", Account::Contact, self.sums.damping),
        ]
    }

    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        for record in self.near() {
            let touch = touch(record, at.q.as_chunks::<4>().0);
            if touch.depth_m < 0.0 {
                continue;
            }
            // K = k b bᵀ with b = (1, −wᵢ): uᵀK u ≤ k (Σ|b|) Σ|bᵢ| uᵢ².
            let whole = 1.0 + touch.weights.iter().map(|w| w.abs()).sum::<f64>();
            bound[record.node as usize] += record.stiffness_n_m * whole;
            for (n, w) in record.corners.iter().zip(touch.weights) {
                bound[*n as usize] += record.stiffness_n_m * whole * w.abs();
            }
        }
    }

    fn save(&self) -> Vec<u8> {
        let mut chunks = self.chunks.clone();
        chunks.iter_mut().for_each(Chunk::unload);
        let elements = self.surface.elements.len();
        pack(&(elements, &self.searched, self.sums, &self.before_m, &self.passed, chunks))
    }

    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        let (elements, searched, sums, before_m, passed, chunks): SavedContact = unpack(saved)?;
        let nodes = self.searched.placed_m.len();
        let fits = elements == self.surface.elements.len()
            && searched.placed_m.len() == nodes
            && (before_m.is_empty() || before_m.len() == nodes)
            && passed.fits(nodes as u32, elements as u32);
        fits.then_some(())?;
        let fitting = |chunk: Chunk| chunk.fitting(nodes as u32, elements as u32);
        let chunks = chunks.into_iter().map(fitting).collect::<Option<Vec<_>>>()?;
        (self.searched, self.sums, self.before_m, self.passed) = (searched, sums, before_m, passed);
        self.chunks = chunks.clone();
        self.arrange();
        for (chunk, kept) in self.chunks.iter_mut().zip(chunks) {
            (chunk.way_m, chunk.next_m, chunk.due_m) = (kept.way_m, kept.next_m, kept.due_m);
            chunk.seen_m = kept.seen_m;
            if !chunk.seen_m.is_empty() && chunk.seen_m.len() != chunk.nodes.len() {
                return None;
            }
            chunk.load();
        }
        Some(())
    }
}

/// Adds the forces of chunks to those on the nodes from `first` on; every node gets its own in the order of chunks, whatever
/// the number of threads.
fn hand_over(chunks: &[&Chunk], first: u32, force: &mut Nodes, most: usize) {
    if force.len() <= most {
        return chunks.iter().for_each(|chunk| chunk.hand_over(first, force));
    }
    let half = force.len() / 2;
    let (low, high) = force.split_at_mut(half);
    rayon::join(|| hand_over(chunks, first, low, most), || hand_over(chunks, first + half as u32, high, most));
}

fn reaches(settings: &problem::Contact, size_m: f64) -> ContactReach {
    ContactReach {
        side_m: (0.375 * size_m).max(4.0 * settings.thickness_m).max(4.0 * settings.gap_m),
        skin_m: size_m,
        // Looking three times as often leaves the cPAM within the scatter of its seeds, and costs more.
        slack_m: 0.15 * size_m,
        flat_m: 0.02 * size_m,
        thickness_m: settings.thickness_m,
        own_layer_m: 0.5 * size_m,
        solid: settings.edges,
        floor_m: if settings.edges { 0.5 * settings.gap_m.min(settings.thickness_m) } else { f64::NEG_INFINITY },
    }
}

fn check(settings: &problem::Contact, mesh: &Mesh, mass_kg: &[f64], dt_s: f64) -> Result<()> {
    let bad = |what: String| Err(FemError::Problem(format!("contact: {what}")));
    if mass_kg.len() != mesh.points.len() {
        return bad(format!("{} masses for {} nodes", mass_kg.len(), mesh.points.len()));
    }
    if !(dt_s > 0.0 && dt_s.is_finite()) {
        return bad(format!("the time step is {dt_s} s"));
    }
    for (name, value) in
        [("friction", settings.friction), ("gap_m", settings.gap_m), ("thickness_m", settings.thickness_m)]
    {
        if !(value >= 0.0 && value.is_finite()) {
            return bad(format!("{name} is {value}; write a number that is 0 or more"));
        }
    }
    if (0..mesh.points.len()).any(|i| !norm(mesh.start_of(i)).is_finite()) {
        return Err(FemError::Mesh("a node starts at a position that is not a finite number".into()));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
