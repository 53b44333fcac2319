//! Curvature of the stress-free shape: a tube that was made round does not want to be flat.
//!
//! ```text
//! ½ D A |H − H̄ N|² = ½ D A |H|² − D A H̄ H·N + ½ D A H̄² |N|²       H = (1/A) Σ w_j x_j    N = (1/A) Σ share (x_b − x_a)×(x_d − x_c)
//! ```
//!
//! The first part is the energy of [`crate::sheet::bending`]; this term is the other two, so that both together are a square:
//! zero, with zero force, at the reference shape and wherever it is moved to.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | H | mean curvature vector, or curvature vector along a free edge | 1/m |
//! | N | area vector of the node's share of the elements over its reference area: a unit normal while the sheet does not stretch | – |
//! | H̄ | H·N/N·N of the reference shape | 1/m |
//! | D, A | bending stiffness of the parts that keep their curvature; area of the node | N m, m² |
//!
//! **Validity**: as for the bending; where elements are so irregular that H and N are not parallel in the reference shape,
//! it keeps a stress of the order of the element size. Derived here.

use models::{Account, LedgerLine, Pose, Row, RowKind, Term};

use crate::bytes::{pack, unpack};
use crate::mesh::Mesh;
use crate::problem::Section;
use crate::sheet::bending::{CurvatureRow, curvature_rows};
use crate::sheet::reference::bending_stiffness;
use crate::vec3::{Nodes, V3, add, along, cross, dot, node, norm, padded, scale, sub};
use crate::{Tick, Transient};

/// Rest curvature of all nodes that have one.
#[derive(Debug, Clone)]
pub struct RestCurvature {
    nodes: Vec<RestRow>,
    /// Energy at the last step \[J\]; `None` before the first.
    stored_j: Option<f64>,
}

#[derive(Debug, Clone)]
struct RestRow {
    row: CurvatureRow,
    /// D of the parts that keep their curvature \[N m\].
    stiffness: f64,
    /// Curvature H̄ of the stress-free shape \[1/m\].
    curvature: f64,
}

impl RestCurvature {
    /// Of the parts of `mesh` (solver's node order) whose section asks for it.
    pub fn new(mesh: &Mesh, sections: &[Section]) -> RestCurvature {
        if !sections.iter().any(|s| s.rest_curvature) {
            return RestCurvature { nodes: Vec::new(), stored_j: None };
        }
        let stiffness: Vec<f64> = sections.iter().map(bending_stiffness).collect();
        let x: Vec<[f64; 4]> = mesh.points.iter().copied().map(padded).collect();
        let rows = curvature_rows(mesh, &stiffness).into_iter();
        let nodes = rows.filter_map(|row| RestRow::new(row, sections, &stiffness, &x)).collect();
        RestCurvature { nodes, stored_j: None }
    }
    /// True if nothing has a rest curvature.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

impl RestRow {
    /// `None` where nothing asks for it or the reference is flat.
    fn new(row: CurvatureRow, sections: &[Section], stiffness: &[f64], x: &Nodes) -> Option<RestRow> {
        let weight = |asked: bool| {
            let own = row.facets.iter().filter(|f| !asked || sections[f.part].rest_curvature);
            own.map(|f| stiffness[f.part] * norm(f.area_vector(|n| node(x, n as usize)))).sum::<f64>()
        };
        let share = weight(true) / weight(false);
        let stiffness = share * row.stiffness;
        let mut rest = RestRow { row, stiffness, curvature: 0.0 };
        let (h, n) = (rest.curvature_vector(x), rest.normal(x));
        rest.curvature = dot(h, n) / dot(n, n);
        // A flat sheet has rounding only.
        let flat = rest.curvature.abs() * rest.row.area.sqrt() < 1e-12;
        (share > 0.0 && !flat).then_some(rest)
    }

    fn curvature_vector(&self, x: &Nodes) -> V3 {
        let own = node(x, self.row.node as usize);
        let step = |sum, (n, w): &(u32, f64)| along(sum, *w, sub(node(x, *n as usize), own));
        scale(self.row.weights.iter().fold([0.0; 3], step), 1.0 / self.row.area)
    }

    fn normal(&self, x: &Nodes) -> V3 {
        let step = |sum, f: &crate::sheet::bending::Facet| add(sum, f.area_vector(|n| node(x, n as usize)));
        scale(self.row.facets.iter().fold([0.0; 3], step), 1.0 / self.row.area)
    }

    /// A ∂E/∂N per area: D H̄ (H̄ N − H) \[N\].
    fn slope(&self, h: V3, n: V3) -> V3 {
        scale(sub(scale(n, self.curvature), h), self.stiffness * self.curvature)
    }

    fn add(&self, x: &Nodes, force: &mut Nodes) -> f64 {
        let (h, n) = (self.curvature_vector(x), self.normal(x));
        let mut push = |i: u32, f: V3| (0..3).for_each(|k| force[i as usize][k] += f[k]);
        for (i, w) in &self.row.weights {
            push(*i, scale(n, self.stiffness * self.curvature * w));
        }
        let g = self.slope(h, n);
        for facet in &self.row.facets {
            let [a, b, c, d] = facet.nodes;
            let side = |from: u32, to: u32| sub(node(x, to as usize), node(x, from as usize));
            let first = scale(cross(side(c, d), g), facet.share);
            let second = scale(cross(g, side(a, b)), facet.share);
            push(a, first);
            push(b, scale(first, -1.0));
            push(c, second);
            push(d, scale(second, -1.0));
        }
        self.energy_of(h, n)
    }

    fn energy(&self, x: &Nodes) -> f64 {
        self.energy_of(self.curvature_vector(x), self.normal(x))
    }

    fn energy_of(&self, h: V3, n: V3) -> f64 {
        let scale = self.stiffness * self.row.area * self.curvature;
        scale * (0.5 * self.curvature * dot(n, n) - dot(h, n))
    }

    /// Cauchy–Schwarz on 2 |δH||δN| H̄ + |δN|² H̄² and on g·δ²N, with |δH| ≤ Σ a_j |u_j| and |δN| ≤ Σ b_j |u_j|.
    fn bound(&self, x: &Nodes, bound: &mut [f64]) {
        let (h, n) = (self.curvature_vector(x), self.normal(x));
        let by_weight = self.row.weights.iter().map(|(i, w)| (*i, w.abs() / self.row.area));
        let by_weight: Vec<(u32, f64)> = by_weight.collect();
        let mut by_facet: Vec<(u32, f64)> = Vec::new();
        for facet in &self.row.facets {
            let [a, b, c, d] = facet.nodes;
            let side = |from: u32, to: u32| norm(sub(node(x, to as usize), node(x, from as usize)));
            let share = facet.share / self.row.area;
            let (first, second) = (share * side(c, d), share * side(a, b));
            by_facet.extend([(a, first), (b, first), (c, second), (d, second)]);
        }
        let sum = |list: &[(u32, f64)]| list.iter().map(|e| e.1).sum::<f64>();
        let (all_weights, all_facets) = (sum(&by_weight), sum(&by_facet));
        let (scale, rest) = (self.stiffness * self.row.area, self.curvature.abs());
        for (i, a) in by_weight {
            bound[i as usize] += scale * rest * a * all_facets;
        }
        for (i, b) in by_facet {
            bound[i as usize] += scale * rest * b * (all_weights + rest * all_facets);
        }
        let g = norm(self.slope(h, n));
        for facet in &self.row.facets {
            for i in facet.nodes.iter() {
                bound[*i as usize] += 2.0 * facet.share * g;
            }
        }
    }
}

impl Term for RestCurvature {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("rest curvature", Account::Wall)
    }
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (x, force) = (at.q.as_chunks::<4>().0, force.as_chunks_mut::<4>().0);
        self.nodes.iter().map(|rest| rest.add(x, force)).sum()
    }
}

impl Transient for RestCurvature {
    fn advance(&mut self, at: &Pose, _tick: &Tick, force: &mut [f64]) -> f64 {
        let energy_j = self.add(at, force);
        self.stored_j = Some(energy_j);
        energy_j
    }
    /// At the positions of the last step (at `at` before the first).
    fn ledger(&self, at: &Pose) -> Vec<Row> {
        let x = at.q.as_chunks::<4>().0;
        let energy_j = self.stored_j.unwrap_or_else(|| self.nodes.iter().map(|rest| rest.energy(x)).sum());
        vec![self.line().row(RowKind::Stored, energy_j)]
    }
    fn stiffness_bound(&self, at: &Pose, bound: &mut [f64]) {
        for rest in self.nodes.iter() {
            rest.bound(at.q.as_chunks::<4>().0, bound);
        }
    }
    fn save(&self) -> Vec<u8> {
        pack(&self.stored_j)
    }
    fn restore(&mut self, saved: &[u8]) -> Option<()> {
        self.stored_j = unpack(saved)?;
        Some(())
    }
}

#[cfg(test)]
#[path = "rest_curvature_tests.rs"]
mod tests;
