//! Pairs that can meet, and the search for them.

use super::super::follow::Searched;
use super::super::surface::{ContactSurface, PackedLists};
use super::chunk::{EdgeChunk, PAIRS, nodes};
use super::pair::Pair;
use super::sides::Sides;
use crate::vec3::{Nodes, V3, padded};
use crate::{FemError, Mesh, problem};

/// (ω dt)² of one pair on its lightest node.
const SHARE: f64 = 0.05;

/// Distance that meetings leave, as a share of the gap.
const LEAST: f64 = 0.2;

/// Share of critical damping of a pair.
const DAMPING: f64 = 0.1;

/// Forces that changed the last step.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct ForceMemory {
    pub forces: Vec<(u32, V3)>,
    pub before_m: Vec<[f64; 4]>,
    pub lost_j: f64,
}

/// Contact between sides of elements, and what keeps everything from passing through each other.
#[derive(Debug, Clone, Default)]
pub struct Edges {
    pub(super) sides: Sides,
    pub(super) mass_kg: Vec<f64>,
    /// One over the mass along each axis; 0 where supports, bodies or ties decide.
    pub(super) mobility_1_kg: Vec<[f64; 3]>,
    pub(super) stiffness_1_s2: f64,
    pub(super) damping_1_s: f64,
    pub(super) gap_m: f64,
    pub(super) thickness_m: f64,
    pub(super) reach_m: f64,
    pub(super) skin_m: f64,
    pub(super) chunks: Vec<EdgeChunk>,
    /// Chunks of every node.
    pub(super) around: PackedLists,
    pub(super) searched: Searched,
    pub(super) stored_j: f64,
    pub(super) lost_j: f64,
    pub(super) held: ForceMemory,
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
        let surface = ContactSurface::new(mesh, &settings.parts)?;
        let stiffness_1_s2 = SHARE / (dt_s * dt_s);
        let x: Vec<[f64; 4]> = mesh.starts().into_iter().map(padded).collect();
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
            skin_m: 0.5 * surface.size_m,
            ..Edges::default()
        };
        edges.search(&x);
        edges.start_gaps(&x);
        Ok(edges)
    }

    /// Pairs that start close keep the distance they have.
    fn start_gaps(&mut self, x: &Nodes) {
        for pair in self.chunks.iter_mut().flat_map(|c| &mut c.pairs).filter(|p| !p.face) {
            let distance_m = pair.touch(x).distance_m;
            if distance_m < self.thickness_m {
                pair.rest_m = distance_m.min(self.gap_m).min(self.thickness_m);
            }
        }
    }

    pub(super) fn active(&self) -> impl Iterator<Item = &Pair> {
        self.chunks.iter().flat_map(|chunk| &chunk.pairs).filter(|pair| pair.on)
    }

    pub(super) fn search(&mut self, x: &Nodes) {
        let old = std::mem::take(&mut self.chunks).into_iter().flat_map(|chunk| chunk.pairs);
        let mut old = old.filter(|pair| !pair.face).peekable();
        let [sides, faces] = self.sides.pairs(x, self.reach_m + self.skin_m);
        let mut pairs = Vec::with_capacity(sides.len());
        // Both are in the order of the keys.
        for (key, distance_m) in sides {
            while let Some(gone) = old.next_if(|pair| pair.key < key) {
                self.lost_j += gone.holds_j();
            }
            let kept = old.next_if(|pair| pair.key == key);
            pairs.push((kept.unwrap_or_else(|| self.fresh(key, false)), distance_m));
        }
        self.lost_j += old.map(|gone| gone.holds_j()).sum::<f64>();
        let faces: Vec<_> = faces.into_iter().map(|(key, m)| (self.fresh(key, true), m)).collect();
        let chunks = pairs.chunks(PAIRS).chain(faces.chunks(PAIRS));
        self.chunks = chunks.map(|pairs| EdgeChunk::new(pairs, x, self.least_m())).collect();
        self.arrange();
        self.searched.note(x, self.skin_m);
    }

    /// Distance that meetings leave.
    pub(super) fn least_m(&self) -> f64 {
        LEAST * self.gap_m.min(self.thickness_m)
    }

    /// Lists the chunks of every node.
    pub(super) fn arrange(&mut self) {
        let of = |(i, chunk): (usize, &EdgeChunk)| chunk.nodes.iter().map(|n| (*n, i as u32)).collect::<Vec<_>>();
        let pairs: Vec<(u32, u32)> = self.chunks.iter().enumerate().flat_map(of).collect();
        self.around = PackedLists::new(self.mass_kg.len(), &pairs);
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

    /// What a checkpoint held of a chunk, with what its keys give again; `None` if it does not fit.
    pub(super) fn fitting(&self, saved: EdgeChunk) -> Option<EdgeChunk> {
        let most = |face: bool| match face {
            true => [self.mass_kg.len(), self.sides.triangles.len()],
            false => [self.sides.list.len(); 2],
        };
        let pair = |saved: &Pair| {
            let known = std::iter::zip(saved.key, most(saved.face)).all(|(key, most)| (key as usize) < most);
            let Pair { nodes, stiffness_n_m, damping_n_s_m, .. } = known.then(|| self.fresh(saved.key, saved.face))?;
            Some(Pair { nodes, stiffness_n_m, damping_n_s_m, ..*saved })
        };
        let pairs: Vec<Pair> = saved.pairs.iter().map(pair).collect::<Option<_>>()?;
        let nodes = nodes(pairs.iter());
        let fits =
            [saved.press_at_m.len(), saved.cross_at_m.len()] == [pairs.len(); 2] && saved.seen_m.len() == nodes.len();
        fits.then_some(EdgeChunk { pairs, nodes, ..saved })
    }
}
