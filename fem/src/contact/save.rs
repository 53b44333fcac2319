//! State of the contact as bytes for checkpoints, and back.

use super::body::Contact;
use super::chunk::Chunk;
use super::closest::Feature;
use super::passed::Passed;
use super::press::Sums;
use super::record::Record;
use crate::bytes::{pack, unpack};
use serde::{Deserialize, Serialize};

/// What a contact cannot find again from positions.
#[derive(Serialize, Deserialize)]
struct State {
    elements: usize,
    searches: u64,
    path_m: f64,
    search_due_m: f64,
    sums: Sums,
    placed_m: Vec<[f64; 4]>,
    before_m: Vec<[f64; 4]>,
    passed: Passed,
    chunks: Vec<Chunk>,
}

pub(super) fn write(contact: &Contact) -> Vec<u8> {
    let mut chunks = contact.chunks.clone();
    chunks.iter_mut().for_each(Chunk::unload);
    pack(&State {
        elements: contact.surface.elements.len(),
        searches: contact.searches,
        path_m: contact.path_m,
        search_due_m: contact.search_due_m,
        sums: contact.sums,
        placed_m: contact.placed_m.clone(),
        before_m: contact.before_m.clone(),
        passed: contact.passed.clone(),
        chunks,
    })
}

pub(super) fn read(contact: &mut Contact, saved: &[u8]) -> Option<()> {
    let State { elements, searches, path_m, search_due_m, sums, placed_m, before_m, passed, chunks } = unpack(saved)?;
    let nodes = contact.placed_m.len();
    let fits = elements == contact.surface.elements.len()
        && placed_m.len() == nodes
        && (before_m.is_empty() || before_m.len() == nodes)
        && passed.fits(nodes as u32, elements as u32);
    fits.then_some(())?;
    let chunks = chunks.into_iter().map(|saved| checked(contact, saved)).collect::<Option<Vec<_>>>()?;
    (contact.searches, contact.path_m, contact.search_due_m) = (searches, path_m, search_due_m);
    (contact.sums, contact.placed_m, contact.before_m, contact.passed) = (sums, placed_m, before_m, passed);
    let kept = chunks.clone();
    contact.chunks = chunks;
    contact.arrange();
    for (chunk, kept) in contact.chunks.iter_mut().zip(kept) {
        (chunk.way_m, chunk.next_m, chunk.due_m) = (kept.way_m, kept.next_m, kept.due_m);
        chunk.seen_m = kept.seen_m;
        if !chunk.seen_m.is_empty() && chunk.seen_m.len() != chunk.nodes.len() {
            return None;
        }
        chunk.load();
    }
    Some(())
}

fn checked(contact: &Contact, mut chunk: Chunk) -> Option<Chunk> {
    let (nodes, elements) = (contact.placed_m.len() as u32, contact.surface.elements.len() as u32);
    let Chunk { near, candidates, records, .. } = &chunk;
    let fits = |r: &Record| {
        let last = u64::from(r.first) + u64::from(r.count);
        r.node < nodes
            && r.corners.iter().all(|n| *n < nodes)
            && r.element < elements
            && (-1..=1).contains(&r.side)
            && last <= candidates.len() as u64
    };
    let good = records.iter().all(fits)
        && candidates.iter().all(|c| c.element < elements)
        && near.iter().all(|at| (*at as usize) < records.len());
    good.then_some(())?;
    let on_face = |at: &u32| records[*at as usize].feature == Feature::Face;
    chunk.faces = near.iter().take_while(|at| on_face(at)).count() as u32;
    Some(chunk)
}
