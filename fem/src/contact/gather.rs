//! From the chunks' forces to the nodes', in an order that no number of threads changes.

use rayon::prelude::*;

use super::chunk::Chunk;
use super::surface::Lists;

/// Nodes per parallel piece.
const PIECE: usize = 1024;

/// Where the forces of every node lie.
#[derive(Debug, Clone, Default)]
pub(super) struct Gather {
    slots: Lists,
    /// Length of a chunk's block.
    pub stride: usize,
}

impl Gather {
    pub fn new(nodes: usize, chunks: &[Chunk]) -> Gather {
        let stride = chunks.iter().map(|c| c.nodes.len()).max().unwrap_or(0);
        let place = |(c, chunk): (usize, &Chunk)| {
            let own: Vec<_> = chunk.nodes.iter().enumerate().map(|(i, n)| (*n, (c * stride + i) as u32)).collect();
            own
        };
        let pairs: Vec<(u32, u32)> = chunks.iter().enumerate().flat_map(place).collect();
        Gather { slots: Lists::new(nodes, &pairs), stride }
    }

    /// Adds every node's forces, chunk after chunk.
    pub fn add(&self, out: &[[f64; 4]], force: &mut [[f64; 4]]) {
        force.par_chunks_mut(PIECE).enumerate().for_each(|(piece, force)| {
            for (i, f) in force.iter_mut().enumerate() {
                for slot in self.slots.of(piece * PIECE + i) {
                    let add = out[*slot as usize];
                    f[0] += add[0];
                    f[1] += add[1];
                    f[2] += add[2];
                }
            }
        });
    }
}
