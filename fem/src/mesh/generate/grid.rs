//! Rectangular block of quads, by columns and rows.

use crate::mesh::Mesh;
use crate::vec3::V3;

/// Node numbers of a block of `nu` by `nv` quads; the front is e_u × e_v.
pub(super) struct Grid {
    pub(super) nu: usize,
    pub(super) nv: usize,
    nodes: Vec<u32>,
}

impl Grid {
    /// Adds the nodes of a block to the mesh.
    pub(super) fn add(mesh: &mut Mesh, nu: usize, nv: usize, place: impl Fn(usize, usize) -> V3) -> Grid {
        Grid::sharing(mesh, nu, nv, place, |_, _| None)
    }

    /// The same, where `shared` may name a node that exists already.
    pub(super) fn sharing(
        mesh: &mut Mesh,
        nu: usize,
        nv: usize,
        place: impl Fn(usize, usize) -> V3,
        shared: impl Fn(usize, usize) -> Option<u32>,
    ) -> Grid {
        let mut nodes = Vec::with_capacity((nu + 1) * (nv + 1));
        for (i, j) in (0..=nv).flat_map(|j| (0..=nu).map(move |i| (i, j))) {
            nodes.push(shared(i, j).unwrap_or_else(|| new_node(mesh, place(i, j))));
        }
        Grid { nu, nv, nodes }
    }

    /// Node at column `i`, row `j`.
    pub(super) fn at(&self, i: usize, j: usize) -> u32 {
        self.nodes[j * (self.nu + 1) + i]
    }

    pub(super) fn column(&self, i: usize) -> Vec<u32> {
        (0..=self.nv).map(|j| self.at(i, j)).collect()
    }

    pub(super) fn row(&self, j: usize) -> Vec<u32> {
        (0..=self.nu).map(|i| self.at(i, j)).collect()
    }

    /// All nodes on the four edges, each once, in ascending order.
    pub(super) fn rim(&self) -> Vec<u32> {
        union([self.row(0), self.row(self.nv), self.column(0), self.column(self.nu)])
    }

    pub(super) fn corners(&self) -> Vec<u32> {
        vec![self.at(0, 0), self.at(self.nu, 0), self.at(self.nu, self.nv), self.at(0, self.nv)]
    }

    /// The node in the middle, or the two or four around it.
    pub(super) fn middle(&self) -> Vec<u32> {
        let near = |n: usize| n / 2..=n.div_ceil(2);
        near(self.nv).flat_map(|j| near(self.nu).map(move |i| self.at(i, j))).collect()
    }

    /// Elements row by row, front along e_u × e_v.
    pub(super) fn quads(&self) -> Vec<[u32; 4]> {
        (0..self.nv)
            .flat_map(|j| (0..self.nu).map(move |i| (i, j)))
            .map(|(i, j)| [self.at(i, j), self.at(i + 1, j), self.at(i + 1, j + 1), self.at(i, j + 1)])
            .collect()
    }

    /// The same elements with the front on the other side.
    pub(super) fn quads_turned(&self) -> Vec<[u32; 4]> {
        self.quads().into_iter().map(|[a, b, c, d]| [a, d, c, b]).collect()
    }
}

/// Appends a node and gives its number.
pub(super) fn new_node(mesh: &mut Mesh, at: V3) -> u32 {
    mesh.points.push(at);
    (mesh.points.len() - 1) as u32
}

/// All nodes of several lists, each once, in ascending order.
pub(super) fn union(lists: impl IntoIterator<Item = Vec<u32>>) -> Vec<u32> {
    let mut all: Vec<u32> = lists.into_iter().flatten().collect();
    all.sort_unstable();
    all.dedup();
    all
}
