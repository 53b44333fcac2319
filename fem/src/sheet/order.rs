//! Node order and patches: each patch owns a run of consecutive nodes that lie close together.
//!
//! A patch computes every element that touches one of its nodes, so that its nodal forces need nothing from its
//! neighbours. The few elements on a border are computed twice; in return there is one parallel pass, no shared write,
//! and the sum over the elements of a node has one order, whatever the number of threads.

use std::ops::Range;

use crate::mesh::Mesh;
use crate::vec3::extent;

/// A renumbering of the nodes and the patches in the new numbering.
#[derive(Debug, Clone, PartialEq)]
pub struct Order {
    /// `old[i]`: number in the mesh of the node at place i.
    pub old: Vec<u32>,
    /// `new[m]`: place of mesh node m.
    pub new: Vec<u32>,
    /// Ranges of consecutive places, one per patch.
    pub patches: Vec<Range<usize>>,
}

/// Largest number of nodes of a patch: large enough that few elements are computed twice and few rows are cut, small
/// enough that a patch's data stay in the second-level cache.
const LARGEST: usize = 2048;

impl Order {
    /// Orders the nodes by recursive bisection of the reference shape, all parts together: layers that share seams lie in one
    /// patch, and patches are alike.
    pub fn of(mesh: &Mesh) -> Order {
        let mut order = Order { old: Vec::new(), new: vec![u32::MAX; mesh.points.len()], patches: Vec::new() };
        let mut nodes: Vec<u32> = (0..mesh.points.len() as u32).collect();
        // Two threads share an even number of patches evenly.
        let pieces = match nodes.len().div_ceil(LARGEST) {
            0 | 1 => 1,
            more => more.next_multiple_of(2),
        };
        order.bisect(mesh, &mut nodes, pieces);
        for (place, old) in order.old.iter().enumerate() {
            order.new[*old as usize] = place as u32;
        }
        order
    }

    /// Cuts into `pieces` patches of about the same size.
    fn bisect(&mut self, mesh: &Mesh, nodes: &mut [u32], pieces: usize) {
        let start = self.old.len();
        if pieces > 1 {
            let at = nodes.len() * (pieces / 2) / pieces;
            split(mesh, nodes, at);
            let (low, high) = nodes.split_at_mut(at);
            self.bisect(mesh, low, pieces / 2);
            self.bisect(mesh, high, pieces - pieces / 2);
        } else if !nodes.is_empty() {
            // The generator's own order keeps rows of a structured mesh together.
            nodes.sort_unstable();
            self.old.extend_from_slice(nodes);
            self.patches.push(start..self.old.len());
        }
    }
}

/// Puts the `at` nodes that come first along the longest side of the bounding box in front.
fn split(mesh: &Mesh, nodes: &mut [u32], at: usize) {
    let size = extent(nodes.iter().map(|node| mesh.points[*node as usize]));
    let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
    // The node number breaks ties, so that the order is a function of the mesh alone.
    nodes.select_nth_unstable_by(at, |a, b| {
        let xa = mesh.points[*a as usize][axis];
        let xb = mesh.points[*b as usize][axis];
        xa.total_cmp(&xb).then(a.cmp(b))
    });
}

/// The mesh in the new numbering.
pub fn renumber(mesh: &Mesh, order: &Order) -> Mesh {
    let mut new = mesh.clone();
    for (place, old) in order.old.iter().enumerate() {
        new.points[place] = mesh.points[*old as usize];
        for (new, places) in [(&mut new.start, &mesh.start), (&mut new.membrane, &mesh.membrane)] {
            if !places.is_empty() {
                new[place] = places[*old as usize];
            }
        }
    }
    new.each_node(|n| *n = order.new[*n as usize]);
    new
}
