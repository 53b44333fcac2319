//! Nodes that changed side of a layer: told, and a stop if there are many.

use super::Simulation;
use crate::FemError;

/// Nodes that came through a layer although contact should have held them.
#[derive(Debug, Clone, PartialEq)]
pub struct ChangedSides {
    /// Nodes that ever were behind the closest face of another layer by more than `thickness_m`.
    pub nodes: usize,
    /// Their share of all nodes that take part in contact.
    pub share: f64,
    /// The first of them.
    pub first: Option<FirstPassage>,
}

/// Where the first node came through a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstPassage {
    /// Number of the node in the mesh, from 1.
    pub node: usize,
    /// Part that it came through.
    pub part: String,
    /// When it was found there \[s\], and where \[m\].
    pub time_s: f64,
    /// Its position then \[m\].
    pub place_m: [f64; 3],
}

impl std::fmt::Display for FirstPassage {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let [x, y, z] = self.place_m.map(|c| c * 1e3);
        let (node, part, time_s) = (self.node, &self.part, self.time_s);
        write!(f, "node {node} through part `{part}` at ({x:.2}, {y:.2}, {z:.2}) mm, t = {time_s:.6} s")
    }
}

impl Simulation {
    /// Nodes that changed side of a layer so far; `None` without contact.
    pub fn changed_sides(&self) -> Option<ChangedSides> {
        let (nodes, could, first) = self.contact.as_ref()?.passed();
        let first = first.map(|(passage, part)| FirstPassage {
            node: self.order.old[passage.node as usize] as usize + 1,
            part: self.mesh.parts[part as usize].name.clone(),
            time_s: passage.time_s,
            place_m: passage.place_m,
        });
        Some(ChangedSides { nodes, share: nodes as f64 / could.max(1) as f64, first })
    }

    /// Stops a run in which more nodes changed side than are allowed.
    pub(super) fn guard_sides(&self) -> Result<(), FemError> {
        let Some(ChangedSides { nodes, share, first: Some(first) }) = self.changed_sides() else { return Ok(()) };
        let limit = self.limits.guards.sides;
        if !super::guard::passes_through(&self.limits.guards, share) {
            return Ok(());
        }
        Err(self.stopped(format!(
            "{nodes} nodes, {:.1} % of those in contact, changed side of a layer (limit {:.1} %), the first: {first}. With \
             edges = true in [contact] nothing passes through anything; smaller elements help, too. To go on nevertheless, \
             raise guard_sides",
            100.0 * share,
            100.0 * limit
        )))
    }
}
