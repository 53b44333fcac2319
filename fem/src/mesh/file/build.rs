//! A mesh put together from nodes and elements with the numbers and groups of a foreign file.

use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap, HashSet};

use crate::mesh::{Mesh, Part};
use crate::vec3::V3;

/// Mesh of a file in its unit, with named surfaces and notices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshFile {
    /// Its mesh, in the unit of the file.
    pub mesh: Mesh,
    /// Name of the format; empty for a generated mesh, which is in metres and names its chambers.
    pub format: &'static str,
    /// Named surfaces, of which a case may make chambers.
    pub surfaces: Vec<Surface>,
    /// Parts, and the orientations of the file that are not read.
    pub unread: Vec<(String, String)>,
    /// What was left out or changed.
    pub told: Vec<String>,
}

/// A named surface of parts seen from one side each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// Name of the surface in the file.
    pub name: String,
    /// Parts, and whether their back is meant.
    pub faces: Vec<(String, bool)>,
    /// A pressure of the file acts on it.
    pub is_pressed: bool,
    /// Why it cannot be a chamber.
    pub fault: Option<String>,
}

impl From<Mesh> for MeshFile {
    fn from(mesh: Mesh) -> MeshFile {
        MeshFile { mesh, ..MeshFile::default() }
    }
}

/// What a foreign file has said so far.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) mesh: Mesh,
    pub(super) surfaces: Vec<Surface>,
    /// Parts, and the directions of their warp that are not read.
    pub(super) unread: Vec<(String, String)>,
    warps: Vec<String>,
    nodes: HashMap<u64, u32>,
    parts: HashMap<String, usize>,
    seen: HashSet<Vec<u32>>,
    ignored: Vec<(String, usize)>,
}

impl Builder {
    /// A node with its number in the file.
    pub(super) fn node(&mut self, number: u64, place: V3) -> Result<u32, String> {
        let next = u32::try_from(self.mesh.points.len()).map_err(|_| "more nodes than can be numbered".to_string())?;
        match self.nodes.entry(number) {
            Entry::Occupied(_) => Err(format!("node {number} is there twice; renumber one of them")),
            Entry::Vacant(slot) => {
                self.mesh.points.push(place);
                Ok(*slot.insert(next))
            }
        }
    }

    /// Nodes by their numbers in the file.
    pub(super) fn find(&self, words: &[&str]) -> Result<Vec<u32>, String> {
        let one = |word: &&str| {
            let number = super::scan::whole(word)?;
            self.nodes.get(&number).copied().ok_or_else(|| format!("node {number} is not defined above this line"))
        };
        words.iter().map(one).collect()
    }

    /// Adds an element to a part; a quad with two equal corners is a triangle. False if the same element is there already.
    pub(super) fn element(&mut self, part: &str, corners: &[u32]) -> Result<bool, String> {
        let mut nodes = corners.to_vec();
        nodes.dedup();
        if nodes.len() > 3 && nodes.first() == nodes.last() {
            nodes.pop();
        }
        let least = (0..nodes.len()).min_by_key(|k| nodes[*k]).unwrap_or(0);
        let turned: Vec<u32> = nodes[least..].iter().chain(&nodes[..least]).copied().collect();
        if !self.seen.insert(turned) {
            return Ok(false);
        }
        let part = self.part(part);
        match nodes[..] {
            [a, b, c] => part.triangles.push([a, b, c]),
            [a, b, c, d] => part.quads.push([a, b, c, d]),
            _ => return Err(format!("an element needs 3 or 4 different nodes, this one has {}", nodes.len())),
        }
        Ok(true)
    }

    pub(super) fn part(&mut self, name: &str) -> &mut Part {
        let parts = &mut self.mesh.parts;
        let at = *self.parts.entry(name.into()).or_insert_with(|| {
            parts.push(Part::of(name, Vec::new()));
            parts.len() - 1
        });
        &mut parts[at]
    }

    /// Gives the warp of a part, if there is one of that name.
    pub(super) fn warp(&mut self, part: &str, [x, y, z]: V3, source: &str) {
        if self.parts.contains_key(part) {
            self.part(part).warp = vec![[x, y, z]];
            // Adding 0 turns −0 into 0.
            let [x, y, z] = [x, y, z].map(|c| (c * 1e4).round() / 1e4 + 0.0);
            self.warps.push(format!("the warp of part `{part}` is ({x}, {y}, {z}), laid onto it: {source}"));
        }
    }

    pub(super) fn set(&mut self, name: &str, nodes: impl IntoIterator<Item = u32>) {
        self.mesh.sets.entry(name.into()).or_default().extend(nodes);
    }

    /// Notes a keyword that is left out, once by name.
    pub(super) fn ignore(&mut self, what: &str, line: usize) {
        if !self.ignored.iter().any(|(known, _)| known == what) {
            self.ignored.push((what.into(), line));
        }
    }

    /// The mesh without nodes that no element has, and the notices.
    pub(super) fn finish(mut self) -> Result<MeshFile, String> {
        if self.mesh.elements() == 0 {
            return Err("this file has neither triangles nor quadrilaterals; export a mesh of surfaces".into());
        }
        let mut told = std::mem::take(&mut self.warps);
        let unused = drop_unused(&mut self.mesh);
        if unused > 0 {
            told.push(format!("{unused} nodes belong to no element and are left out"));
        }
        if !self.ignored.is_empty() {
            let list: Vec<String> = self.ignored.iter().map(|(what, line)| format!("{what} (line {line})")).collect();
            told.push(format!("left out, because the case sets it: {}", list.join(", ")));
        }
        Ok(MeshFile { mesh: self.mesh, surfaces: self.surfaces, unread: self.unread, told, ..MeshFile::default() })
    }
}

/// Removes nodes without elements, also from sets, each of which keeps a node once.
fn drop_unused(mesh: &mut Mesh) -> usize {
    let mut used = vec![false; mesh.points.len()];
    for node in mesh.faces().flatten() {
        used[*node as usize] = true;
    }
    let mut next = 0;
    let number: Vec<Option<u32>> = used
        .iter()
        .map(|used| {
            next += u32::from(*used);
            used.then(|| next - 1)
        })
        .collect();
    let mut keep = used.iter();
    mesh.points.retain(|_| keep.next() == Some(&true));
    let new = |node: &mut u32| *node = number[*node as usize].unwrap_or(*node);
    for part in &mut mesh.parts {
        part.quads.iter_mut().flatten().for_each(new);
        part.triangles.iter_mut().flatten().for_each(new);
    }
    for nodes in mesh.sets.values_mut() {
        let mut seen = BTreeSet::new();
        *nodes = nodes.iter().filter_map(|n| number[*n as usize]).filter(|n| seen.insert(*n)).collect();
    }
    mesh.sets.retain(|_, nodes| !nodes.is_empty());
    used.iter().filter(|used| !**used).count()
}
