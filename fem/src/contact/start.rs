//! Sides and rest gaps of layers that are close to each other when a run starts.
//!
//! The side follows from the positions, averaged over the neighbourhood so that small imperfections of coincident layers
//! do not matter. Where layers coincide (closer than `gap_m`) the side spreads from where they do not; if they coincide
//! everywhere the declarations decide, in this order: two parts with a
//! chamber between them (named by both) are on that chamber's side of each other; otherwise the layer with the higher
//! number is in front of the one with the lower number; a layer that coincides with itself has its back inside.
//! The rest gap is the initial distance or `gap_m`, whichever is smaller, so that nothing pushes at the start.

use super::body::LayerContact;
use super::chunk::touch;
use super::closest::{Closest, element_normal};
use super::surface::PackedLists;
use crate::problem;
use crate::vec3::{Nodes, dot};
use crate::{FemError, Mesh, Result};
use std::cmp::Ordering;

/// Averaging passes: noise of single nodes falls to a fifth or less.
const PASSES: usize = 3;

/// One record and what its positions say.
struct Entry {
    chunk: usize,
    at: usize,
    node: u32,
    layer: u32,
    found: Closest,
    /// Height above the front, cut to a few gaps.
    vote_m: f64,
}

/// Records within reach whose side is clear, and the entries of every node.
struct ContactStart<'a> {
    contact: &'a LayerContact,
    mesh: &'a Mesh,
    x: &'a [[f64; 4]],
    entries: Vec<Entry>,
    of_node: PackedLists,
}

pub(super) fn sides(contact: &mut LayerContact, mesh: &Mesh, settings: &problem::Contact, x: &Nodes) -> Result<()> {
    let entries = entries(contact, settings, x);
    let pairs: Vec<(u32, u32)> = entries.iter().enumerate().map(|(i, e)| (e.node, i as u32)).collect();
    let mut start = ContactStart { contact, mesh, x, entries, of_node: PackedLists::new(x.len(), &pairs) };
    for _ in 0..PASSES {
        let means: Vec<f64> = start.entries.iter().map(|e| start.mean(e)).collect();
        for (e, mean) in start.entries.iter_mut().zip(means) {
            e.vote_m = mean;
        }
    }
    let tolerance_m = settings.gap_m.max(0.02 * contact.surface.size_m);
    let apart = |e: &Entry| if e.vote_m.abs() > settings.gap_m { e.vote_m.signum() as i8 } else { 0 };
    let mut side: Vec<i8> = start.entries.iter().map(apart).collect();
    start.spread(&mut side);
    for (side, entry) in side.iter_mut().zip(&start.entries).filter(|(s, _)| **s == 0) {
        *side = start.declared(entry);
    }
    let above = |(entry, side): (&Entry, &i8)| f64::from(*side) * entry.found.height_m;
    let heights: Vec<f64> = start.entries.iter().zip(&side).map(above).collect();
    let deepest = start.entries.iter().zip(&heights).min_by(|a, b| a.1.total_cmp(b.1));
    if let Some((entry, height)) = deepest.filter(|(_, height)| **height < -tolerance_m) {
        return Err(start.through(entry, -height));
    }
    start.crossings(&side)?;
    let entries = start.entries;
    for ((entry, side), height_m) in entries.iter().zip(&side).zip(&heights) {
        let record = &mut contact.chunks[entry.chunk].records[entry.at];
        record.side = *side;
        let wanted_m = if settings.edges { settings.thickness_m } else { settings.gap_m };
        (record.wanted_m, record.rest_m) = (wanted_m, height_m.min(settings.gap_m));
    }
    Ok(())
}

/// Records within reach whose side is clear.
fn entries(contact: &LayerContact, settings: &problem::Contact, x: &Nodes) -> Vec<Entry> {
    let step = contact.step_of(x, 0.0);
    let cut = 4.0 * settings.gap_m.max(1e-9);
    let mut entries = Vec::new();
    for (c, chunk) in contact.chunks.iter().enumerate() {
        for (at, found) in chunk.clone().all(&step) {
            let record = &chunk.records[at];
            let clear = found.cosine.abs() >= 0.5;
            if found.square_m2.sqrt() <= contact.reach.side_m && clear {
                let vote_m = found.height_m.clamp(-cut, cut);
                entries.push(Entry { chunk: c, at, node: record.node, layer: record.layer, found, vote_m });
            }
        }
    }
    entries
}

impl ContactStart<'_> {
    /// Other entries of neighbouring nodes that face the same stretch of the same layer.
    fn beside(&self, entry: &Entry) -> impl Iterator<Item = usize> {
        let (surface, entries) = (&self.contact.surface, &self.entries);
        let (node, layer, normal) = (entry.node, entry.layer, entry.found.normal);
        let around = surface.around.of(node as usize).iter().flat_map(|e| surface.corners(*e as usize));
        let others = around.filter(move |n| **n != node).flat_map(|n| self.of_node.of(*n as usize));
        let faces = move |e: &Entry| e.layer == layer && dot(e.found.normal, normal) > 0.5;
        others.map(|i| *i as usize).filter(move |i| faces(&entries[*i]))
    }

    fn mean(&self, entry: &Entry) -> f64 {
        let (mut sum, mut count) = (entry.vote_m, 1.0);
        for other in self.beside(entry) {
            sum += self.entries[other].vote_m;
            count += 1.0;
        }
        sum / count
    }

    /// Gives undecided entries the side of decided neighbours, ring after ring.
    fn spread(&self, side: &mut [i8]) {
        let mut front: Vec<usize> = (0..side.len()).filter(|i| side[*i] != 0).collect();
        while !front.is_empty() {
            let mut next = Vec::new();
            for from in front {
                for to in self.beside(&self.entries[from]) {
                    if side[to] == 0 {
                        side[to] = side[from];
                        next.push(to);
                    }
                }
            }
            front = next;
        }
    }

    /// The side that the parts declare for layers that coincide.
    fn declared(&self, entry: &Entry) -> i8 {
        let surface = &self.contact.surface;
        let around = surface.around.of(entry.node as usize);
        let other = around.iter().find(|e| surface.layer[**e as usize] != entry.layer);
        let Some(&own) = other.or(around.first()) else { return 0 };
        let part = |e: u32| &self.mesh.parts[surface.origin[e as usize].0 as usize];
        let (a, b) = (part(own), part(entry.found.element));
        let same = |p: &Option<String>, q: &Option<String>| p.is_some() && p == q;
        let opposed = dot(element_normal(surface, self.x, own), entry.found.normal) < 0.0;
        let (behind, front) = match opposed {
            true => (same(&a.back, &b.back), same(&a.front, &b.front)),
            false => (same(&a.front, &b.back), same(&a.back, &b.front)),
        };
        match (behind, front, a.layer.cmp(&b.layer)) {
            (true, false, _) => -1,
            (false, true, _) => 1,
            (_, _, Ordering::Greater) => 1,
            (_, _, Ordering::Less) => {
                if opposed {
                    1
                } else {
                    -1
                }
            }
            (_, _, Ordering::Equal) => -i8::from(opposed),
        }
    }

    /// Neighbouring nodes on both sides of one stretch of a layer: the layers cross.
    fn crossings(&self, side: &[i8]) -> Result<()> {
        let height = |e: &Entry| e.found.height_m.abs();
        for (i, entry) in self.entries.iter().enumerate().filter(|(i, _)| side[*i] == 1) {
            if let Some(other) = self.beside(entry).find(|o| side[*o] == -side[i]) {
                let other = &self.entries[other];
                let shallow = if height(other) < height(entry) { other } else { entry };
                return Err(self.through(shallow, height(shallow)));
            }
        }
        Ok(())
    }

    fn through(&self, entry: &Entry, depth_m: f64) -> FemError {
        let element = self.contact.surface.name(self.mesh, entry.found.element as usize);
        let (node, depth_mm, layer) = (entry.node + 1, depth_m * 1e3, entry.layer);
        FemError::Mesh(format!(
            "node {node} starts {depth_mm:.4} mm deep behind {element} (layer {layer}) while its neighbours are on the other \
             side: move it, or order the layers so that they do not pass through each other"
        ))
    }
}

/// Lowers rest gaps to the distance as a step measures it, so that the first force is exactly zero.
pub(super) fn relax(contact: &mut LayerContact, x: &Nodes) {
    for chunk in &mut contact.chunks {
        for record in chunk.records.iter_mut().filter(|r| r.side != 0) {
            record.rest_m -= touch(record, x).depth_m.max(0.0);
            record.last_m = touch(record, x).depth_m;
        }
        chunk.load();
    }
}
