//! Contact as bytes and back.

use super::Contact;
use super::chunk::{Candidate, Chunk};
use super::closest::Feature;
use super::passed::Passed;
use super::record::Record;
use crate::bytes::{Reader, Writer};

/// Changes with the layout of the bytes.
const VERSION: u64 = 5;

pub(super) fn write(contact: &Contact) -> Vec<u8> {
    let mut out = Writer::new();
    out.u64(VERSION);
    out.u64(contact.surface.elements.len() as u64);
    out.u64(contact.searches);
    let sums = &contact.sums;
    out.f64s(&[contact.path_m, contact.search_due_m, sums.stored, sums.friction, sums.damping]);
    out.f64s(contact.placed_m.as_flattened());
    out.f64s(contact.before_m.as_flattened());
    contact.passed.write(&mut out);
    out.u64(contact.chunks.len() as u64);
    for chunk in &contact.chunks {
        let mut chunk = chunk.clone();
        chunk.unload();
        out.f64s(&[chunk.way_m, chunk.next_m, chunk.due_m]);
        out.f64s(chunk.seen_m.as_flattened());
        out.u32s(&chunk.near);
        out.u32s(&chunk.candidates.iter().map(|c| c.element).collect::<Vec<_>>());
        out.f64s(&chunk.candidates.iter().map(|c| c.clear_m).collect::<Vec<_>>());
        out.u32s(&chunk.records.iter().flat_map(integers).collect::<Vec<_>>());
        out.f64s(&chunk.records.iter().flat_map(numbers).collect::<Vec<_>>());
    }
    out.into_bytes()
}

pub(super) fn read(contact: &mut Contact, saved: &[u8]) -> Option<()> {
    let mut from = Reader::new(saved);
    let nodes = contact.placed_m.len();
    if from.u64()? != VERSION || from.u64()? != contact.surface.elements.len() as u64 {
        return None;
    }
    let searches = from.u64()?;
    let mut sums = [0.0; 5];
    from.f64s_into(&mut sums)?;
    let (placed, before) = (from.f64s()?, from.f64s()?);
    if placed.len() != 4 * nodes || !(before.is_empty() || before.len() == 4 * nodes) {
        return None;
    }
    let passed = Passed::read(&mut from, nodes as u32, contact.surface.elements.len() as u32)?;
    let count = from.u64()?;
    let mut chunks = Vec::new();
    for _ in 0..count {
        chunks.push(chunk(contact, &mut from)?);
    }
    from.is_empty().then_some(())?;
    contact.placed_m = placed.as_chunks::<4>().0.to_vec();
    contact.before_m = before.as_chunks::<4>().0.to_vec();
    (contact.searches, contact.passed) = (searches, passed);
    [contact.path_m, contact.search_due_m, contact.sums.stored, contact.sums.friction, contact.sums.damping] = sums;
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

fn chunk(contact: &Contact, from: &mut Reader) -> Option<Chunk> {
    let [way_m, next_m, due_m] = from.f64s()?.try_into().ok()?;
    let seen_m = from.f64s()?.as_chunks::<4>().0.to_vec();
    let near = from.u32s()?;
    let elements = contact.surface.elements.len() as u32;
    let (candidates, clear) = (from.u32s()?, from.f64s()?);
    if candidates.len() != clear.len() {
        return None;
    }
    let candidate = |(element, clear_m)| Candidate { element, clear_m };
    let candidates: Vec<_> = candidates.into_iter().zip(clear).map(candidate).collect();
    let (whole, real) = (from.u32s()?, from.f64s()?);
    if whole.len() / INTEGERS != real.len() / NUMBERS {
        return None;
    }
    let pairs = whole.as_chunks::<INTEGERS>().0.iter().zip(real.as_chunks::<NUMBERS>().0);
    let records: Vec<Record> = pairs.map(|(i, n)| record(i, n)).collect::<Option<_>>()?;
    let nodes = contact.placed_m.len() as u32;
    let fits = |r: &Record| {
        let last = u64::from(r.first) + u64::from(r.count);
        r.node < nodes
            && r.corners.iter().all(|n| *n < nodes)
            && r.element < elements
            && last <= candidates.len() as u64
    };
    let good = records.iter().all(fits)
        && candidates.iter().all(|c| c.element < elements)
        && near.iter().all(|at| (*at as usize) < records.len());
    let on_face = |at: &u32| records.get(*at as usize).is_some_and(|r| r.feature == Feature::Face);
    let faces = near.iter().take_while(|at| on_face(at)).count() as u32;
    let whole = Chunk { faces, records, candidates, near, seen_m, way_m, next_m, due_m, ..Chunk::default() };
    good.then_some(whole)
}

const INTEGERS: usize = 11;
const NUMBERS: usize = 13;

fn integers(r: &Record) -> [u32; INTEGERS] {
    let [a, b, c] = r.corners;
    let side = (i32::from(r.side) + 1) as u32;
    [r.node, a, b, c, r.element, r.layer, r.feature as u32, side, u32::from(r.own), r.first, r.count]
}

fn numbers(r: &Record) -> [f64; NUMBERS] {
    let [x, y, z] = r.spring_m;
    [
        r.sign,
        r.rest_m,
        r.wanted_m,
        r.stiffness_n_m,
        r.damping_n_s_m,
        r.distance_m,
        x,
        y,
        z,
        r.last_m,
        r.damped_n,
        r.within_m,
        r.due_m,
    ]
}

fn record(i: &[u32; INTEGERS], n: &[f64; NUMBERS]) -> Option<Record> {
    let [node, a, b, c, element, layer, feature, side, own, first, count] = *i;
    let [sign, rest_m, wanted_m, stiffness_n_m, damping_n_s_m, distance_m, x, y, z, last_m, damped_n, within_m, due_m] =
        *n;
    let feature = [Feature::Face, Feature::Edge, Feature::Corner].into_iter().find(|f| *f as u32 == feature)?;
    let side = [-1, 0, 1].get(side as usize).copied()?;
    let record = Record {
        node,
        corners: [a, b, c],
        element,
        layer,
        feature,
        side,
        own: own != 0,
        first,
        count,
        ..Record::default()
    };
    Some(Record {
        sign,
        rest_m,
        wanted_m,
        stiffness_n_m,
        damping_n_s_m,
        distance_m,
        spring_m: [x, y, z],
        last_m,
        damped_n,
        within_m,
        due_m,
        ..record
    })
}
