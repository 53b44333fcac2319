//! Contact of edges as bytes and back.

use super::Edges;
use super::chunk::Chunk;
use super::pair::Pair;
use crate::bytes::{Reader, Writer};

/// Changes with the layout of the bytes.
const VERSION: u64 = 2;
const NUMBERS: usize = 5;

pub(super) fn write(edges: &Edges) -> Vec<u8> {
    let mut out = Writer::new();
    out.u64(VERSION);
    out.u64(edges.sides.list.len() as u64);
    out.u64(edges.searches);
    out.f64s(&[edges.path_m, edges.search_due_m, edges.stored_j, edges.lost_j, edges.held.lost_j]);
    out.f64s(edges.placed_m.as_flattened());
    out.f64s(edges.held.before_m.as_flattened());
    out.u32s(&edges.held.forces.iter().map(|f| f.0).collect::<Vec<_>>());
    out.f64s(&edges.held.forces.iter().flat_map(|f| f.1).collect::<Vec<_>>());
    out.u64(edges.chunks.len() as u64);
    for chunk in &edges.chunks {
        out.f64s(&[chunk.way_m, chunk.press_due_m, chunk.cross_due_m]);
        out.f64s(chunk.seen_m.as_flattened());
        out.f64s(&chunk.press_at_m);
        out.f64s(&chunk.cross_at_m);
        out.u32s(&chunk.pairs.iter().flat_map(integers).collect::<Vec<_>>());
        out.f64s(&chunk.pairs.iter().flat_map(numbers).collect::<Vec<_>>());
    }
    out.into_bytes()
}

pub(super) fn read(edges: &mut Edges, saved: &[u8]) -> Option<()> {
    let mut from = Reader::new(saved);
    let fits = from.u64()? == VERSION && from.u64()? == edges.sides.list.len() as u64;
    fits.then_some(())?;
    let searches = from.u64()?;
    let mut sums = [0.0; 5];
    from.f64s_into(&mut sums)?;
    let (placed, before) = (from.f64s()?, from.f64s()?);
    let count = edges.placed_m.len();
    let length = 4 * count;
    (placed.len() == length && (before.is_empty() || before.len() == length)).then_some(())?;
    let (held, forces) = (from.u32s()?, from.f64s()?);
    (3 * held.len() == forces.len() && held.iter().all(|n| (*n as usize) < count)).then_some(())?;
    let chunks = from.u64()?;
    let chunks = (0..chunks).map(|_| chunk(edges, &mut from)).collect::<Option<Vec<_>>>()?;
    from.is_empty().then_some(())?;
    edges.placed_m = placed.as_chunks::<4>().0.to_vec();
    edges.held.before_m = before.as_chunks::<4>().0.to_vec();
    edges.held.forces = held.into_iter().zip(forces.as_chunks::<3>().0.iter().copied()).collect();
    (edges.searches, edges.chunks) = (searches, chunks);
    [edges.path_m, edges.search_due_m, edges.stored_j, edges.lost_j, edges.held.lost_j] = sums;
    Some(())
}

fn chunk(edges: &Edges, from: &mut Reader) -> Option<Chunk> {
    let [way_m, press_due_m, cross_due_m] = from.f64s()?.try_into().ok()?;
    let seen_m = from.f64s()?.as_chunks::<4>().0.to_vec();
    let (press_at_m, cross_at_m) = (from.f64s()?, from.f64s()?);
    let (whole, real) = (from.u32s()?, from.f64s()?);
    let (whole, real) = (whole.as_chunks::<3>().0, real.as_chunks::<NUMBERS>().0);
    (whole.len() == real.len()).then_some(())?;
    let pairs: Vec<Pair> = whole.iter().zip(real).map(|(i, n)| pair(edges, *i, n)).collect::<Option<_>>()?;
    (press_at_m.len() == pairs.len() && cross_at_m.len() == pairs.len()).then_some(())?;
    let chunk = Chunk { seen_m, press_at_m, cross_at_m, way_m, press_due_m, cross_due_m, ..Chunk::new(pairs) };
    (chunk.seen_m.is_empty() || chunk.seen_m.len() == chunk.nodes.len()).then_some(chunk)
}

/// Key, then kind and state as one number.
fn integers(pair: &Pair) -> [u32; 3] {
    [pair.key[0], pair.key[1], u32::from(pair.face) + 2 * u32::from(pair.on)]
}

fn numbers(pair: &Pair) -> [f64; NUMBERS] {
    [pair.rest_m, pair.wanted_m, pair.last_m, pair.deep_m, pair.damped_n]
}

fn pair(edges: &Edges, [first, second, state]: [u32; 3], numbers: &[f64; NUMBERS]) -> Option<Pair> {
    let face = state % 2 == 1;
    let (sides, triangles, nodes) = (edges.sides.list.len(), edges.sides.triangles.len(), edges.mass_kg.len());
    let most = if face { [nodes, triangles] } else { [sides, sides] };
    ((first as usize) < most[0] && (second as usize) < most[1] && state < 4).then_some(())?;
    let [rest_m, wanted_m, last_m, deep_m, damped_n] = *numbers;
    let fresh = edges.fresh([first, second], face);
    Some(Pair { on: state >= 2, rest_m, wanted_m, last_m, deep_m, damped_n, ..fresh })
}
