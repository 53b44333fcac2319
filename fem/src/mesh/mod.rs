//! The mesh: nodes, parts of 4-node and 3-node shells, named sets, ties, chambers by name.
//!
//! ```text
//!   4 ─────── 3        front of an element: the side its nodes run round counter-clockwise
//!   │    ↑    │        (right-hand rule). A pressure in the `back` chamber pushes towards the front.
//!   1 ─────── 2
//! ```

pub mod check;
pub mod file;
pub mod generate;

mod enclose;

pub use enclose::enclose;

use std::collections::BTreeMap;

use crate::vec3::V3;
use crate::{FemError, Result};

/// Nodes and elements in their stress-free shape. Node numbers count from 0 here and from 1 in files and messages.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Stress-free reference positions of all nodes \[m\].
    pub points: Vec<[f64; 3]>,
    /// Positions in which the membrane is free of stress, if not at `points` (a sheet that is not quite its pattern); same
    /// length, or empty. Bending keeps the weights of `points`, which in a structured mesh most nodes share: for departures that
    /// are small against an element.
    pub membrane: Vec<[f64; 3]>,
    /// Where the nodes start, if not where the membrane is free of stress (a folded layer, an imperfection); same length, or empty.
    pub start: Vec<[f64; 3]>,
    /// Blocks of elements of one fabric.
    pub parts: Vec<Part>,
    /// Named node sets (supports, markers, stations).
    pub sets: BTreeMap<String, Vec<u32>>,
    /// Nodes glued to an element that does not share them.
    pub ties: Vec<Tie>,
}

/// A block of elements with one section, one pair of chambers and one contact layer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Part {
    /// Name of the part, unique in the mesh.
    pub name: String,
    /// Elements with 4 nodes, counter-clockwise seen from the front.
    pub quads: Vec<[u32; 4]>,
    /// Elements with 3 nodes, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Warp direction: one vector for the whole part, or one per element (quads first). Projected onto each element;
    /// need not be unit. Empty: the global x axis, which a fabric with directions must have in its sheet.
    pub warp: Vec<[f64; 3]>,
    /// Chamber that the front of the elements faces; `None`: the surroundings.
    pub front: Option<String>,
    /// Chamber that the back of the elements faces; `None`: the surroundings.
    pub back: Option<String>,
    /// Contact layer. Layers of a fold must differ, so that each remembers which side of the others it is on.
    pub layer: u32,
}

/// A node that follows a point of an element.
#[derive(Debug, Clone, PartialEq)]
pub struct Tie {
    /// Node that follows, without degrees of freedom.
    pub node: u32,
    /// The nodes it follows and their weights (sum 1).
    pub to: Vec<(u32, f64)>,
}

impl Part {
    /// Quadrilaterals in surroundings without a chamber.
    pub(crate) fn of(name: &str, quads: Vec<[u32; 4]>) -> Part {
        Part { name: name.into(), quads, ..Part::default() }
    }
    /// The wall of a chamber at its back.
    pub(crate) fn round(chamber: &str, name: &str, quads: Vec<[u32; 4]>) -> Part {
        Part { back: Some(chamber.into()), ..Part::of(name, quads) }
    }
    /// Number of elements, quads and triangles.
    pub fn len(&self) -> usize {
        self.quads.len() + self.triangles.len()
    }
    /// True if the part has neither quads nor triangles.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Nodes of element `i`, quads first.
    pub fn nodes(&self, i: usize) -> &[u32] {
        match self.quads.get(i) {
            Some(quad) => quad,
            None => &self.triangles[i - self.quads.len()],
        }
    }
    /// Nodes of every element, quads first.
    pub(crate) fn faces(&self) -> impl Iterator<Item = &[u32]> {
        self.quads.iter().map(|quad| &quad[..]).chain(self.triangles.iter().map(|triangle| &triangle[..]))
    }
    /// Warp direction given for element `i`, if any.
    pub(crate) fn warp_of(&self, i: usize) -> Option<V3> {
        match self.warp.len() {
            0 => None,
            1 => Some(self.warp[0]),
            _ => self.warp.get(i).copied(),
        }
    }
}

impl Mesh {
    pub(crate) fn part_names(&self) -> Vec<&str> {
        self.parts.iter().map(|part| part.name.as_str()).collect()
    }
    /// Reference positions of nodes.
    pub(crate) fn places(&self, nodes: &[u32]) -> Vec<[f64; 3]> {
        nodes.iter().map(|node| self.points[*node as usize]).collect()
    }
    pub(crate) fn name(&mut self, set: impl Into<String>, nodes: Vec<u32>) {
        self.sets.insert(set.into(), nodes);
    }
    /// Number of elements of all parts, quads and triangles.
    pub fn elements(&self) -> usize {
        self.parts.iter().map(Part::len).sum()
    }
    /// Nodes of every element, part after part.
    pub(crate) fn faces(&self) -> impl Iterator<Item = &[u32]> {
        self.parts.iter().flat_map(Part::faces)
    }
    /// Nodes of a set that `what` asks for.
    ///
    /// # Errors
    /// Unknown or empty set, with the names there are.
    pub(crate) fn set(&self, name: &str, what: &str) -> Result<&[u32]> {
        match self.sets.get(name) {
            Some(nodes) if !nodes.is_empty() => Ok(nodes),
            Some(_) => Err(FemError::Problem(format!("{what}: node set `{name}` is empty"))),
            None => {
                let known = self.sets.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
                let message = format!("{what}: unknown node set `{name}`; the mesh has {known}");
                Err(FemError::Problem(message))
            }
        }
    }
    /// Mean displacement of nodes from where they start \[m\], for node positions in mesh order.
    pub(crate) fn mean_moved(&self, nodes: &[u32], positions: &[V3]) -> V3 {
        let mut sum = [0.0; 3];
        for node in nodes {
            let (now, start) = (positions[*node as usize], self.start_of(*node as usize));
            for k in 0..3 {
                sum[k] += (now[k] - start[k]) / nodes.len() as f64;
            }
        }
        sum
    }
    pub(crate) fn starts(&self) -> Vec<V3> {
        (0..self.points.len()).map(|node| self.start_of(node)).collect()
    }
    /// Where the membrane at node `i` is free of stress.
    pub(crate) fn free_of(&self, i: usize) -> V3 {
        *self.membrane.get(i).unwrap_or(&self.points[i])
    }
    /// Position in which node `i` starts \[m\].
    pub fn start_of(&self, i: usize) -> V3 {
        self.start.get(i).copied().unwrap_or_else(|| self.free_of(i))
    }
    /// Adds another mesh to this one. Part names must differ; sets of the same name unite, and a chamber named by both
    /// is one chamber. Nothing is welded.
    ///
    /// # Errors
    /// [`FemError::Mesh`] naming a part that both have.
    pub fn append(&mut self, mut other: Mesh) -> Result<()> {
        if let Some(part) = other.parts.iter().find(|part| self.parts.iter().any(|own| own.name == part.name)) {
            return Err(FemError::Mesh(format!("both meshes have a part `{}`; rename one", part.name)));
        }
        let Ok(offset) = u32::try_from(self.points.len() + other.points.len()).map(|_| self.points.len() as u32) else {
            return Err(FemError::Mesh("more nodes than can be numbered".into()));
        };
        if self.start.len() + other.start.len() > 0 {
            (self.start, other.start) = (self.starts(), other.starts());
            self.start.append(&mut other.start);
        }
        self.points.append(&mut other.points);
        other.each_node(|n| *n = n.saturating_add(offset));
        self.parts.append(&mut other.parts);
        for (name, nodes) in other.sets.into_iter() {
            self.sets.entry(name).or_default().extend(nodes);
        }
        self.ties.append(&mut other.ties);
        Ok(())
    }

    /// Changes the number of every node in elements, sets and ties.
    pub(crate) fn each_node(&mut self, mut change: impl FnMut(&mut u32)) {
        for part in &mut self.parts {
            part.quads.iter_mut().flatten().for_each(&mut change);
            part.triangles.iter_mut().flatten().for_each(&mut change);
        }
        self.sets.values_mut().flatten().for_each(&mut change);
        for tie in &mut self.ties {
            change(&mut tie.node);
            tie.to.iter_mut().for_each(|(node, _)| change(node));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generate::plate;

    fn shifted(name: &str, x: f64) -> Mesh {
        let mut mesh = plate(1.0, 1.0, 2, 2, None).unwrap();
        mesh.parts[0].name = name.into();
        mesh.points.iter_mut().for_each(|p| p[0] += x);
        mesh
    }

    #[test]
    fn a_part_name_used_twice_is_refused() {
        let error = shifted("a", 0.0).append(shifted("a", 1.0)).unwrap_err();
        assert_eq!(error.to_string(), "mesh: both meshes have a part `a`; rename one");
    }
}
