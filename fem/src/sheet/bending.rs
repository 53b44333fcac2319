//! Bending as a constant sparse matrix.
//!
//! ```text
//! U = ½ Σ_i D_i A_i |H_i|²       H_i = (1/A_i) Σ_j w_ij (x_j − x_i)       F = −K x,  K = Σ_i (D_i/A_i) L_iᵀ L_i
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | H_i | mean curvature vector κ₁ + κ₂ at node i (points inwards) | 1/m |
//! | w_ij | cotangent weights of the reference shape, mean of both triangulations of a quadrilateral | – |
//! | A_i | share of the elements round node i | m² |
//! | D | bending stiffness | N m |
//!
//! The fabric hardly stretches, so the reference weights stay valid and K is constant: 12 neighbours per node on a
//! regular grid. At free edges, and where another layer or another stiffness begins, the fabric hinges freely about the edge and bends
//! along it: a node there has the curvature along the edge instead (see [`super::edge`]), so that a strip of width b has the
//! stiffness D b. At corners there is neither. What a jump of stiffness does to the turn across the edge is in [`crate::terms::Folds`]. **Do not use it when stretch changes the element size by tens of per cent.**
//!
//! (κ₁ + κ₂)² is the energy of a plate less a multiple of its Gaussian curvature, which only matters where an edge is
//! free: there the sheet curls across as if ν were 1, over a width of about √(t/κ) that its membrane keeps small. **Do not
//! use it for narrow strips with free long edges that bend little**: measured, a cantilever deflects 2 % too far at
//! b²κ/t ≈ 100, 4 % at 20, and 3.6 times too far in the linear limit (b/L = 0.4). An edge that a weld, a second sheet or a
//! support keeps straight is not concerned.
//! Reference: Bergou et al. 2006, A quadratic bending model for inextensible surfaces.

use std::collections::BTreeMap;

use super::edge;
use crate::mesh::Mesh;
use crate::vec3::{Nodes, V3, along, cross, direction, dot, sub};

/// Row of the curvature operator at one node: H_i A_i = Σ_j w_ij x_j (the diagonal is in the list, first).
#[derive(Debug, Clone, PartialEq)]
pub struct CurvatureRow {
    /// Number of the node, at which the curvature is taken.
    pub node: u32,
    /// Share A_i of the area of the elements round the node \[m²\].
    pub area: f64,
    /// Its bending stiffness D \[N m\].
    pub stiffness: f64,
    /// (node, weight), weights summing to 0.
    pub weights: Vec<(u32, f64)>,
    /// Area vectors of its shares of the elements, for the normal of the sheet.
    pub(crate) facets: Vec<Facet>,
}

/// Share of an element that belongs to a corner: `share` (x_b − x_a) × (x_d − x_c) is its area vector \[m²\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Facet {
    pub nodes: [u32; 4],
    /// ⅛ of a quadrilateral's diagonals, ⅙ of a triangle's sides.
    pub share: f64,
    pub part: usize,
}

/// Sparse symmetric matrix K, row by row \[N/m\].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BendingMatrix {
    /// Start of each row in the two lists below; one more than nodes.
    pub start: Vec<u32>,
    /// Column (node number) of each entry, row after row.
    pub column: Vec<u32>,
    /// Value of each entry, in the order of `column` \[N/m\].
    pub value: Vec<f64>,
}

/// Curvature rows of every node that bends; `stiffness[part]` is D of each part \[N m\].
pub fn curvature_rows(mesh: &Mesh, stiffness: &[f64]) -> Vec<CurvatureRow> {
    let mut rows = Vec::new();
    each_row(mesh, stiffness, |row| rows.push(row));
    rows
}

fn each_row(mesh: &Mesh, stiffness: &[f64], mut take: impl FnMut(CurvatureRow)) {
    let mut pieces: BTreeMap<(u32, u64), Vec<usize>> = BTreeMap::new();
    for (index, part) in mesh.parts.iter().enumerate().filter(|(index, _)| stiffness[*index] > 0.0) {
        pieces.entry((part.layer, stiffness[index].to_bits())).or_default().push(index);
    }
    pieces.values().for_each(|parts| piece_rows(mesh, parts, stiffness[parts[0]], &mut take));
}

/// What a node sees of the elements of one piece: parts of one layer that bend alike.
#[derive(Default)]
struct Fan {
    area: f64,
    weights: BTreeMap<u32, f64>,
    /// Elements on each spoke (edge from the node); a closed fan has two on every one.
    spokes: BTreeMap<u32, u32>,
    facets: Vec<Facet>,
}

fn piece_rows(mesh: &Mesh, parts: &[usize], stiffness: f64, take: impl FnMut(CurvatureRow)) {
    let elements = || parts.iter().flat_map(|part| (0..mesh.parts[*part].len()).map(|i| (*part, i)));
    let mut around: Vec<(u32, u32)> = Vec::new();
    for (number, (part, i)) in elements().enumerate() {
        around.extend(mesh.parts[part].nodes(i).iter().map(|node| (*node, number as u32)));
    }
    around.sort_unstable();
    around.dedup();
    let elements: Vec<(usize, usize)> = elements().collect();
    let row = |around: &[(u32, u32)]| {
        let mut fan = Fan::default();
        for (node, number) in around {
            let (part, i) = elements[*number as usize];
            fan.add_element(mesh, mesh.parts[part].nodes(i), part, *node);
        }
        fan.row(mesh, around[0].0, stiffness)
    };
    around.chunk_by(|a, b| a.0 == b.0).filter_map(row).for_each(take);
}

impl Fan {
    /// The mean curvature where the fan is closed, the curvature along the edge where it is open.
    fn row(self, mesh: &Mesh, node: u32, stiffness: f64) -> Option<CurvatureRow> {
        let weights =
            if self.spokes.values().all(|n| *n == 2) { self.weights.clone() } else { self.along_edge(mesh, node)? };
        // The diagonals of rectangles carry rounding only; without them a row has 12 neighbours instead of 24.
        let spokes: Vec<(u32, f64)> = weights.into_iter().filter(|(_, w)| w.abs() > 1e-12).collect();
        let sum: f64 = spokes.iter().map(|s| s.1).sum();
        let weights = std::iter::once((node, -sum)).chain(spokes).collect();
        Some(CurvatureRow { node, area: self.area, stiffness, weights, facets: self.facets })
    }

    /// `None` at corners and where sheets meet in more than one edge.
    fn along_edge(&self, mesh: &Mesh, node: u32) -> Option<BTreeMap<u32, f64>> {
        let [before, after] = self.spokes.iter().filter(|s| *s.1 == 1).map(|s| *s.0).collect::<Vec<u32>>()[..] else {
            return None;
        };
        if self.spokes.values().any(|n| *n > 2) {
            return None;
        }
        let offset = |n: u32| sub(mesh.points[n as usize], mesh.points[node as usize]);
        let around: Vec<(u32, [f64; 3])> = self.weights.keys().map(|n| (*n, offset(*n))).collect();
        let normal =
            self.facets.iter().fold([0.0; 3], |sum, f| along(sum, 1.0, f.area_vector(|n| mesh.points[n as usize])));
        let ends = [before, after].map(|n| (n, offset(n)));
        let weights = edge::weights(ends, &around, direction(normal))?;
        Some(weights.into_iter().map(|(n, w)| (n, w * self.area)).collect())
    }

    /// Adds what an element gives its corner `node`.
    fn add_element(&mut self, mesh: &Mesh, nodes: &[u32], part: usize, node: u32) {
        let count = nodes.len();
        for k in (0..count).filter(|k| nodes[*k] == node) {
            for beside in [k + 1, k + count - 1] {
                *self.spokes.entry(nodes[beside % count]).or_default() += 1;
            }
            self.facets.push(facet(nodes, part));
        }
        if count == 3 {
            return self.add_triangle(mesh, [nodes[0], nodes[1], nodes[2]], 1.0, node);
        }
        for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]] {
            self.add_triangle(mesh, [nodes[a], nodes[b], nodes[c]], 0.5, node);
        }
    }

    /// Adds `share` of a triangle's cotangent weights at `node`, ½ cot(angle opposite the edge), and a third of its area.
    fn add_triangle(&mut self, mesh: &Mesh, nodes: [u32; 3], share: f64, node: u32) {
        if !nodes.contains(&node) {
            return;
        }
        let x = nodes.map(|n| mesh.points[n as usize]);
        let normal = cross(sub(x[1], x[0]), sub(x[2], x[0]));
        let twice_area = dot(normal, normal).sqrt();
        for k in 0..3 {
            let (i, j, apex) = (k, (k + 1) % 3, (k + 2) % 3);
            let (to_i, to_j) = (sub(x[i], x[apex]), sub(x[j], x[apex]));
            let weight = 0.5 * share * dot(to_i, to_j) / twice_area;
            for [from, to] in [[i, j], [j, i]] {
                if nodes[from] == node {
                    *self.weights.entry(nodes[to]).or_default() += weight;
                }
            }
            if nodes[i] == node {
                self.area += share * twice_area / 6.0;
            }
        }
    }
}

impl Facet {
    /// Area vector with the nodes at these places \[m²\].
    pub(crate) fn area_vector(&self, at: impl Fn(u32) -> V3) -> V3 {
        let [a, b, c, d] = self.nodes.map(at);
        cross(sub(b, a), sub(d, c)).map(|v| self.share * v)
    }
}

fn facet(nodes: &[u32], part: usize) -> Facet {
    match *nodes {
        [a, b, c, d] => Facet { nodes: [a, c, b, d], share: 0.125, part },
        _ => Facet { nodes: [nodes[0], nodes[1], nodes[0], nodes[2]], share: 1.0 / 6.0, part },
    }
}

impl BendingMatrix {
    /// K of a mesh; `stiffness[part]` is D of each part \[N m\].
    pub(super) fn of(mesh: &Mesh, stiffness: &[f64]) -> BendingMatrix {
        let mut rows = Vec::new();
        // Their facets are not needed here, and as large as the rest.
        each_row(mesh, stiffness, |row| rows.push(CurvatureRow { facets: Vec::new(), ..row }));
        BendingMatrix::new(mesh.points.len(), &rows)
    }

    /// K = Σ_i (D_i/A_i) L_iᵀ L_i over `nodes` rows.
    pub fn new(nodes: usize, rows: &[CurvatureRow]) -> BendingMatrix {
        // Which curvature rows have each node, ascending: the order of the additions is a function of the mesh alone.
        let mut parts: Vec<(u32, u32)> = Vec::new();
        for (number, row) in rows.iter().enumerate() {
            parts.extend(row.weights.iter().map(|(i, _)| (*i, number as u32)));
        }
        parts.sort_unstable();
        let mut matrix = BendingMatrix { start: vec![0; nodes + 1], column: Vec::new(), value: Vec::new() };
        let mut entries: Vec<(u32, f64)> = Vec::new();
        for parts in parts.chunk_by(|a, b| a.0 == b.0) {
            let node = parts[0].0;
            entries.clear();
            for (_, number) in parts {
                let row = &rows[*number as usize];
                let scale = row.stiffness / row.area;
                for (_, wi) in row.weights.iter().filter(|(i, _)| *i == node) {
                    entries.extend(row.weights.iter().map(|(j, wj)| (*j, scale * wi * wj)));
                }
            }
            entries.sort_by_key(|e| e.0);
            for same in entries.chunk_by(|a, b| a.0 == b.0) {
                matrix.column.push(same[0].0);
                matrix.value.push(same[1..].iter().fold(same[0].1, |sum, e| sum + e.1));
                matrix.start[node as usize + 1] += 1;
            }
        }
        for i in 0..nodes {
            matrix.start[i + 1] += matrix.start[i];
        }
        matrix
    }

    /// Entries of row `i` as (column, value).
    pub fn row(&self, i: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        let range = self.start[i] as usize..self.start[i + 1] as usize;
        range.map(|k| (self.column[k], self.value[k]))
    }

    /// Adds −K x to `force` (stride 4) and returns ½ xᵀKx.
    pub fn add(&self, q: &Nodes, force: &mut Nodes) -> f64 {
        let mut energy = 0.0;
        for i in 0..q.len() {
            let mut kx = [0.0; 3];
            for (j, value) in self.row(i) {
                for k in 0..3 {
                    kx[k] += value * (q[j as usize][k] - q[i][k]);
                }
            }
            (0..3).for_each(|k| force[i][k] -= kx[k]);
            energy += 0.5 * (0..3).map(|k| kx[k] * q[i][k]).sum::<f64>();
        }
        energy
    }
}
