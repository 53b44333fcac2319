//! Nodes that changed side of a layer: the run reports them, and stops if there are many.

use super::Simulation;
use crate::Result;
use serde::{Deserialize, Serialize};

/// Nodes that came through a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Through {
    /// Number of nodes that changed the side of a layer.
    pub nodes: usize,
    /// Their share of the nodes that were in contact.
    pub share: f64,
    /// The first node that came through; `None` if there is none.
    pub first: Option<FirstThrough>,
}

/// The first node that changed the side of a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FirstThrough {
    /// Number of the node, counted from 1.
    pub node: usize,
    /// Name of the part that it came through.
    pub part: String,
    /// Simulated time at which it came through \[s\].
    pub time_s: f64,
    /// Position x, y, z of the node then \[mm\].
    pub place_mm: [f64; 3],
    /// Node, part, place and time in one sentence.
    pub text: String,
}

impl Simulation {
    /// Nodes that ever were behind the closest face of another layer by more than `thickness_m`, counted from 1; `None` without contact.
    pub fn changed_sides(&self) -> Option<Through> {
        let (nodes, could, first) = self.contact.as_ref()?.passed();
        let first = first.map(|(passage, part)| {
            let node = self.order.old[passage.node as usize] as usize + 1;
            let part = &self.mesh.parts[part as usize].name;
            let (place_mm, time_s) = (passage.place_m.map(|c| c * 1e3), passage.time_s);
            let [x, y, z] = place_mm;
            let text = format!("node {node} through part `{part}` at ({x:.2}, {y:.2}, {z:.2}) mm, t = {time_s:.6} s");
            FirstThrough { node, part: part.clone(), time_s, place_mm, text }
        });
        Some(Through { nodes, share: nodes as f64 / could.max(1) as f64, first })
    }

    /// Stops a run in which more nodes changed side than are allowed.
    pub(super) fn guard_sides(&self) -> Result<()> {
        let Some(Through { nodes, share, first: Some(first) }) = self.changed_sides() else { return Ok(()) };
        let limit = self.settings.guards.sides;
        if !super::guard::passes_through(&self.settings.guards, share) {
            return Ok(());
        }
        Err(self.stopped(format!(
            "{nodes} nodes, {:.1} % of those in contact, changed side of a layer (limit {:.1} %), the first: {}. With \
             edges = true in [contact] nothing passes through anything; smaller elements help, too. To go on nevertheless, \
             raise guard_sides",
            100.0 * share,
            100.0 * limit,
            first.text
        )))
    }
}
