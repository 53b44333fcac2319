//! Sides and rest gaps of layers that are close to each other when a run starts.
//!
//! The side follows from the positions, averaged over the neighbourhood so that small imperfections of coincident layers
//! do not matter. Where layers coincide (closer than `gap_m`) the side spreads from where they do not; if they coincide
//! everywhere the declarations decide, in this order: two parts with a
//! chamber between them (named by both) are on that chamber's side of each other; otherwise the layer with the higher
//! number is in front of the one with the lower number; a layer that coincides with itself has its back inside.
//! The rest gap is the initial distance or `gap_m`, whichever is smaller, so that nothing pushes at the start.

use super::body::Contact;
use super::chunk::touch;
use super::closest::{Closest, element_normal};
use super::surface::Lists;
use crate::problem;
use crate::vec3::dot;
use crate::{FemError, Mesh};

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

pub(super) fn sides(
    contact: &mut Contact,
    mesh: &Mesh,
    settings: &problem::Contact,
    x: &[[f64; 4]],
) -> Result<(), FemError> {
    let mut entries = entries(contact, settings, x);
    let pairs: Vec<(u32, u32)> = entries.iter().enumerate().map(|(i, e)| (e.node, i as u32)).collect();
    let of_node = Lists::new(x.len(), &pairs);
    for _ in 0..PASSES {
        let means: Vec<f64> = entries.iter().map(|e| mean(contact, &entries, &of_node, e)).collect();
        entries.iter_mut().zip(means).for_each(|(e, mean)| e.vote_m = mean);
    }
    let tolerance_m = settings.gap_m.max(0.02 * contact.surface.size_m);
    let apart = |e: &Entry| if e.vote_m.abs() > settings.gap_m { e.vote_m.signum() as i8 } else { 0 };
    let mut side: Vec<i8> = entries.iter().map(apart).collect();
    spread(contact, &entries, &of_node, &mut side);
    for (side, entry) in side.iter_mut().zip(&entries).filter(|(s, _)| **s == 0) {
        *side = declared(contact, mesh, x, entry);
    }
    let above = |(entry, side): (&Entry, &i8)| f64::from(*side) * entry.found.height_m;
    let heights: Vec<f64> = entries.iter().zip(&side).map(above).collect();
    if let Some((entry, height)) = entries.iter().zip(&heights).min_by(|a, b| a.1.total_cmp(b.1))
        && *height < -tolerance_m
    {
        return Err(through(contact, mesh, entry, -height));
    }
    for ((entry, side), height_m) in entries.iter().zip(&side).zip(&heights) {
        let record = &mut contact.chunks[entry.chunk].records[entry.at];
        record.side = *side;
        let wanted_m = if settings.edges { settings.thickness_m } else { settings.gap_m };
        (record.wanted_m, record.rest_m) = (wanted_m, height_m.min(settings.gap_m));
    }
    crossings(contact, mesh, &entries, &of_node, &side)
}

/// Records within reach whose side is clear.
fn entries(contact: &Contact, settings: &problem::Contact, x: &[[f64; 4]]) -> Vec<Entry> {
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

/// Other entries of neighbouring nodes that face the same stretch of the same layer.
fn beside<'a>(
    contact: &'a Contact,
    entries: &'a [Entry],
    of_node: &'a Lists,
    entry: &'a Entry,
) -> impl Iterator<Item = usize> + 'a {
    let surface = &contact.surface;
    surface
        .around
        .of(entry.node as usize)
        .iter()
        .flat_map(|e| surface.corners(*e as usize))
        .filter(|n| **n != entry.node)
        .flat_map(|n| of_node.of(*n as usize))
        .map(|i| *i as usize)
        .filter(|i| entries[*i].layer == entry.layer && dot(entries[*i].found.normal, entry.found.normal) > 0.5)
}

fn mean(contact: &Contact, entries: &[Entry], of_node: &Lists, entry: &Entry) -> f64 {
    let (mut sum, mut count) = (entry.vote_m, 1.0);
    for other in beside(contact, entries, of_node, entry) {
        sum += entries[other].vote_m;
        count += 1.0;
    }
    sum / count
}

/// Gives undecided entries the side of decided neighbours, ring after ring.
fn spread(contact: &Contact, entries: &[Entry], of_node: &Lists, side: &mut [i8]) {
    let mut front: Vec<usize> = (0..entries.len()).filter(|i| side[*i] != 0).collect();
    while !front.is_empty() {
        let mut next = Vec::new();
        for from in front {
            for to in beside(contact, entries, of_node, &entries[from]) {
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
fn declared(contact: &Contact, mesh: &Mesh, x: &[[f64; 4]], entry: &Entry) -> i8 {
    let surface = &contact.surface;
    let around = surface.around.of(entry.node as usize);
    let Some(&own) = around.iter().find(|e| surface.layer[**e as usize] != entry.layer).or(around.first()) else {
        return 0;
    };
    let part = |e: u32| &mesh.parts[surface.origin[e as usize].0 as usize];
    let (a, b) = (part(own), part(entry.found.element));
    let same = |p: &Option<String>, q: &Option<String>| p.is_some() && p == q;
    let opposed = dot(element_normal(surface, x, own), entry.found.normal) < 0.0;
    let (behind, front) = if opposed {
        (same(&a.back, &b.back), same(&a.front, &b.front))
    } else {
        (same(&a.front, &b.back), same(&a.back, &b.front))
    };
    match (behind, front, a.layer.cmp(&b.layer)) {
        (true, false, _) => -1,
        (false, true, _) => 1,
        (_, _, std::cmp::Ordering::Greater) => 1,
        (_, _, std::cmp::Ordering::Less) if opposed => 1,
        (_, _, std::cmp::Ordering::Less) => -1,
        (_, _, std::cmp::Ordering::Equal) if opposed => -1,
        (_, _, std::cmp::Ordering::Equal) => 0,
    }
}

/// Neighbouring nodes on both sides of one stretch of a layer: the layers cross.
fn crossings(contact: &Contact, mesh: &Mesh, entries: &[Entry], of_node: &Lists, side: &[i8]) -> Result<(), FemError> {
    for (i, entry) in entries.iter().enumerate().filter(|(i, _)| side[*i] == 1) {
        if let Some(other) = beside(contact, entries, of_node, entry).find(|o| side[*o] == -side[i]) {
            let height = |e: &Entry| e.found.height_m.abs();
            let other = &entries[other];
            let shallow = if height(other) < height(entry) { other } else { entry };
            return Err(through(contact, mesh, shallow, height(shallow)));
        }
    }
    Ok(())
}

fn through(contact: &Contact, mesh: &Mesh, entry: &Entry, depth_m: f64) -> FemError {
    FemError::Mesh(format!(
        "node {} starts {:.4} mm deep behind {} (layer {}) while its neighbours are on the other side: move it, or \
         order the layers so that they do not pass through each other",
        entry.node + 1,
        depth_m * 1e3,
        contact.surface.name(mesh, entry.found.element as usize),
        entry.layer
    ))
}

/// Lowers rest gaps to the distance as a step measures it, so that the first force is exactly zero.
pub(super) fn relax(contact: &mut Contact, x: &[[f64; 4]]) {
    for chunk in &mut contact.chunks {
        for record in chunk.records.iter_mut().filter(|r| r.side != 0) {
            record.rest_m -= touch(record, x).depth_m.max(0.0);
            record.last_m = touch(record, x).depth_m;
        }
        chunk.load();
    }
}
