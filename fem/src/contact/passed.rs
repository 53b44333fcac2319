//! Nodes that changed side of a layer.
//!
//! A node remembers its side of another layer from when it came near until it is away again or has gone round the layer's
//! rim. Where a look finds it behind the closest face by more than `thickness_m`, and so by far more than springs give way,
//! it has come through: its spring pulls it back, or it goes on and is forgotten. Within one layer, whose own folds leave
//! less to tell front from back, nothing is counted; nor with `edges`, where nothing passes.

use std::collections::BTreeSet;

use super::chunk::Chunk;
use super::closest::{Closest, Feature};
use super::record::{Reach, Record};
use crate::bytes::{Reader, Writer};
use crate::vec3::V3;

/// A node and a face that it came through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passage {
    pub node: u32,
    pub element: u32,
    pub time_s: f64,
    pub place_m: V3,
}

/// All nodes that ever were on the wrong side, in the solver's order, and the first of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Passed {
    pub nodes: BTreeSet<u32>,
    pub first: Option<Passage>,
}

impl Record {
    /// True if the node is behind the closest face, by more than springs give way.
    pub(super) fn has_passed(&self, found: &Closest, reach: &Reach) -> bool {
        let depth_m = -f64::from(self.side) * found.height_m;
        !reach.solid && !self.own && found.feature == Feature::Face && depth_m > reach.thickness_m
    }
}

impl Passed {
    /// Takes over what the looks of a step found.
    pub fn take(&mut self, chunks: &mut [Chunk], time_s: f64, x: &[[f64; 4]]) {
        for (node, element) in chunks.iter_mut().flat_map(|chunk| chunk.passed.drain(..)) {
            let place_m = crate::vec3::node(x, node as usize);
            self.first.get_or_insert(Passage { node, element, time_s, place_m });
            self.nodes.insert(node);
        }
    }

    pub fn write(&self, out: &mut Writer) {
        out.u32s(&self.nodes.iter().copied().collect::<Vec<_>>());
        let first = self.first.as_ref();
        out.u32s(&first.map_or(Vec::new(), |f| vec![f.node, f.element]));
        out.f64s(&first.map_or(Vec::new(), |f| vec![f.time_s, f.place_m[0], f.place_m[1], f.place_m[2]]));
    }

    pub fn read(from: &mut Reader, nodes: u32, elements: u32) -> Option<Passed> {
        let all: BTreeSet<u32> = from.u32s()?.into_iter().collect();
        let first = match (&from.u32s()?[..], &from.f64s()?[..]) {
            ([], []) => None,
            (&[node, element], &[time_s, x, y, z]) => Some(Passage { node, element, time_s, place_m: [x, y, z] }),
            _ => return None,
        };
        let fits = all.iter().chain(first.as_ref().map(|f| &f.node)).all(|n| *n < nodes)
            && first.as_ref().is_none_or(|f| f.element < elements);
        fits.then_some(Passed { nodes: all, first })
    }
}
