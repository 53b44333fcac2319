//! The mesh as contact sees it: elements of all layers in one list, who borders on whom, whom a node must not touch.

use std::collections::HashMap;

use crate::vec3::{V3, area, norm, share, sub};
use crate::{FemError, Mesh, Result};

pub(super) const NONE: u32 = u32::MAX;

/// Elements of the parts that take part.
#[derive(Debug, Clone, Default)]
pub(super) struct ContactSurface {
    /// Corners; the fourth is [`NONE`] for a triangle.
    pub elements: Vec<[u32; 4]>,
    pub layer: Vec<u32>,
    pub origin: Vec<(u32, u32)>,
    /// Element of the same layer across the edge from corner k to the next.
    pub across: Vec<[u32; 4]>,
    pub around: PackedLists,
    /// Number of nodes that have some.
    pub nodes: usize,
    /// Nodes of an element's layer that never touch it, ascending: two rings.
    pub skip: PackedLists,
    /// Place of each node in an order that keeps neighbours of a layer together.
    pub rank: Vec<u32>,
    /// Reference area of each node \[m²\].
    pub area_m2: Vec<f64>,
    pub size_m: f64,
}

#[derive(Debug, Clone, Default)]
pub(super) struct PackedLists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl PackedLists {
    /// Sorts `pairs` (list, item) into lists, keeping the order within each.
    pub(super) fn new(lists: usize, pairs: &[(u32, u32)]) -> PackedLists {
        let mut start = vec![0; lists + 1];
        pairs.iter().for_each(|p| start[p.0 as usize + 1] += 1);
        (0..lists).for_each(|i| start[i + 1] += start[i]);
        let mut next: Vec<u32> = start[..lists].to_vec();
        let mut items = vec![0; pairs.len()];
        for (list, item) in pairs {
            let place = &mut next[*list as usize];
            items[*place as usize] = *item;
            *place += 1;
        }
        PackedLists { start, items }
    }
    #[inline]
    pub(super) fn of(&self, i: usize) -> &[u32] {
        &self.items[self.start[i] as usize..self.start[i + 1] as usize]
    }
}

/// Layer, then the lower and the higher node number.
type LayerEdge = (u32, u32, u32);

impl ContactSurface {
    pub(super) fn new(mesh: &Mesh, parts: &[String]) -> Result<ContactSurface> {
        let mut surface = ContactSurface::default();
        if let Some(name) = parts.iter().find(|name| mesh.parts.iter().all(|part| part.name != **name)) {
            let known = mesh.part_names().join(", ");
            return Err(FemError::Problem(format!("contact names part {name:?}; the mesh has: {known}")));
        }
        for (p, part) in mesh.parts.iter().enumerate().filter(|(_, p)| parts.is_empty() || parts.contains(&p.name)) {
            for i in 0..part.len() {
                let nodes = part.nodes(i);
                surface.elements.push([nodes[0], nodes[1], nodes[2], nodes.get(3).copied().unwrap_or(NONE)]);
                surface.layer.push(part.layer);
                surface.origin.push((p as u32, i as u32));
            }
        }
        let corners = |e: usize| surface.corners(e).iter().map(move |n| (*n, e as u32));
        let pairs: Vec<(u32, u32)> = (0..surface.elements.len()).flat_map(corners).collect();
        surface.around = PackedLists::new(mesh.points.len(), &pairs);
        surface.nodes = (0..mesh.points.len()).filter(|n| !surface.around.of(*n).is_empty()).count();
        surface.border(mesh)?;
        surface.skip = surface.rings(mesh.points.len());
        surface.measure(&mesh.points);
        surface.rank = surface.along_curve(&mesh.points);
        Ok(surface)
    }

    /// Corners of an element: 3 or 4.
    #[inline]
    pub(super) fn corners(&self, element: usize) -> &[u32] {
        let nodes = &self.elements[element];
        if nodes[3] == NONE { &nodes[..3] } else { nodes }
    }
    pub(super) fn name(&self, mesh: &Mesh, element: usize) -> String {
        let (part, i) = self.origin[element];
        format!("element {} of part {:?}", i + 1, mesh.parts[part as usize].name)
    }
    /// Least mass of each element's corners that are free to move (infinite without one).
    pub(super) fn lightest(&self, mass_kg: &[f64]) -> Vec<f64> {
        let free = |n: &u32| Some(mass_kg[*n as usize]).filter(|m| *m > 0.0);
        let of = |e: usize| self.corners(e).iter().filter_map(free).fold(f64::INFINITY, f64::min);
        (0..self.elements.len()).map(of).collect()
    }
    /// True if `node` is a corner of an element of `layer`.
    pub(super) fn is_in(&self, node: usize, layer: u32) -> bool {
        self.around.of(node).iter().any(|e| self.layer[*e as usize] == layer)
    }

    /// Finds the element across each edge; the fronts of neighbours in one layer must be on the same side.
    fn border(&mut self, mesh: &Mesh) -> Result<()> {
        let mut open: HashMap<LayerEdge, Vec<(u32, u8, bool)>> = HashMap::new();
        for e in 0..self.elements.len() {
            let nodes = self.corners(e);
            for k in 0..nodes.len() {
                let (a, b) = (nodes[k], nodes[(k + 1) % nodes.len()]);
                let edge = (self.layer[e], a.min(b), a.max(b));
                open.entry(edge).or_default().push((e as u32, k as u8, a < b));
            }
        }
        self.across = vec![[NONE; 4]; self.elements.len()];
        let mut flipped = None;
        for users in open.into_values() {
            let [(e, k, up), (f, l, down)] = users[..] else { continue };
            if up == down {
                flipped = flipped.max(Some((e, f)));
            }
            self.across[e as usize][k as usize] = f;
            self.across[f as usize][l as usize] = e;
        }
        flipped.map_or(Ok(()), |(e, f)| {
            Err(FemError::Mesh(format!(
                "{} and {} are neighbours in contact layer {} but face opposite ways: turn one of them over, or give \
                 their parts different layers",
                self.name(mesh, e as usize),
                self.name(mesh, f as usize),
                self.layer[e as usize]
            )))
        })
    }

    fn rings(&self, nodes: usize) -> PackedLists {
        let mut pairs = Vec::new();
        let mut seen = Vec::new();
        for node in 0..nodes {
            seen.clear();
            let own = self.around.of(node);
            for &first in own {
                for &corner in self.corners(first as usize) {
                    let near = self.around.of(corner as usize);
                    seen.extend(near.iter().filter(|e| self.layer[**e as usize] == self.layer[first as usize]));
                }
            }
            seen.extend_from_slice(own);
            seen.sort_unstable();
            seen.dedup();
            pairs.extend(seen.iter().map(|e| (*e, node as u32)));
        }
        PackedLists::new(self.elements.len(), &pairs)
    }

    /// Ranks nodes layer by layer along a Z-order curve through cells of half an element.
    fn along_curve(&self, points: &[V3]) -> Vec<u32> {
        let low = points.iter().fold([f64::INFINITY; 3], |low, p| [0, 1, 2].map(|k| low[k].min(p[k])));
        let cell = |p: &V3, k: usize| (2.0 * (p[k] - low[k]) / self.size_m).clamp(0.0, 65535.0) as u64;
        let spaced = |v: u64| (0..16).fold(0, |sum, bit| sum | (v >> bit & 1) << (3 * bit));
        let place = |p: &V3| spaced(cell(p, 0)) | spaced(cell(p, 1)) << 1 | spaced(cell(p, 2)) << 2;
        let layer = |n: usize| self.around.of(n).first().map_or(NONE, |e| self.layer[*e as usize]);
        let mut order: Vec<(u32, u64, u32)> =
            points.iter().enumerate().map(|(n, p)| (layer(n), place(p), n as u32)).collect();
        order.sort_unstable();
        let mut rank = vec![0; points.len()];
        for (at, (_, _, n)) in order.iter().enumerate() {
            rank[*n as usize] = at as u32;
        }
        rank
    }

    fn measure(&mut self, points: &[V3]) {
        let (mut length, mut edges) = (0.0, 0);
        self.area_m2 = vec![0.0; points.len()];
        for e in 0..self.elements.len() {
            let nodes = self.corners(e).to_vec();
            let x: Vec<V3> = nodes.iter().map(|n| points[*n as usize]).collect();
            for k in 0..x.len() {
                length += norm(sub(x[(k + 1) % x.len()], x[k]));
                edges += 1;
            }
            let share = norm(area(&x)) / x.len() as f64;
            nodes.iter().for_each(|n| self.area_m2[*n as usize] += share);
        }
        self.size_m = share(length, edges as f64);
    }
}
