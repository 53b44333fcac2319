//! Nodes that changed side of a layer.
//!
//! A node remembers its side of another layer from when it came near until it is away again or has gone round the layer's
//! rim. Where a look finds it behind the closest face by more than `thickness_m`, and so by far more than springs give way,
//! it has come through: its spring pulls it back, or it goes on and is forgotten. Within one layer, whose own folds hardly
//! separate front from back, nothing is counted; nor with `edges`, where nothing passes.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

use super::chunk::Chunk;
use super::closest::{Closest, Feature};
use super::record::{ContactReach, Record};
use crate::vec3::{Nodes, V3};

/// A node and a face that it came through.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Passage {
    pub node: u32,
    pub element: u32,
    pub time_s: f64,
    pub place_m: V3,
}

/// All nodes that ever were on the wrong side, in the solver's order, and the first of them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Passed {
    pub nodes: BTreeSet<u32>,
    pub first: Option<Passage>,
}

impl Record {
    /// True if the node is behind the closest face, by more than springs give way.
    pub(super) fn has_passed(&self, found: &Closest, reach: &ContactReach) -> bool {
        let depth_m = -f64::from(self.side) * found.height_m;
        !reach.solid && !self.own && found.feature == Feature::Face && depth_m > reach.thickness_m
    }
}

impl Passed {
    /// Takes over what the looks of a step found.
    pub(super) fn take(&mut self, chunks: &mut [Chunk], time_s: f64, x: &Nodes) {
        for (node, element) in chunks.iter_mut().flat_map(|chunk| chunk.passed.drain(..)) {
            let place_m = crate::vec3::node(x, node as usize);
            self.first.get_or_insert(Passage { node, element, time_s, place_m });
            self.nodes.insert(node);
        }
    }

    /// Whether all of it is of a surface of so many nodes and elements.
    pub(super) fn fits(&self, nodes: u32, elements: u32) -> bool {
        let first = self.first.as_ref();
        self.nodes.iter().chain(first.map(|f| &f.node)).all(|n| *n < nodes)
            && first.is_none_or(|f| f.element < elements)
    }
}
