//! Contact of edges as bytes and back.

use super::Edges;
use super::chunk::Chunk;
use super::pair::Pair;
use crate::output::bytes::{Reader, Writer};

/// Changes with the layout of the bytes.
const VERSION: u64 = 1;
const NUMBERS: usize = 5;

pub(super) fn write(edges: &Edges) -> Vec<u8> {
    let mut out = Writer::new();
    out.u64(VERSION);
    out.u64(edges.sides.list.len() as u64);
    out.u64(edges.searches);
    out.f64s(&[edges.path_m, edges.search_due_m, edges.stored_j, edges.lost_j]);
    out.f64s(edges.placed_m.as_flattened());
    out.f64s(edges.before_m.as_flattened());
    out.u64(edges.chunks.len() as u64);
    for chunk in &edges.chunks {
        out.f64s(&[chunk.allowed_m, chunk.due_m]);
        out.f64s(chunk.seen_m.as_flattened());
        out.u32s(&chunk.near);
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
    let mut sums = [0.0; 4];
    from.f64s_into(&mut sums)?;
    let (placed, before) = (from.f64s()?, from.f64s()?);
    let length = 4 * edges.placed_m.len();
    (placed.len() == length && (before.is_empty() || before.len() == length)).then_some(())?;
    let count = from.u64()?;
    let mut chunks = Vec::new();
    for _ in 0..count {
        chunks.push(chunk(edges, &mut from)?);
    }
    from.is_empty().then_some(())?;
    edges.placed_m = placed.as_chunks::<4>().0.to_vec();
    edges.before_m = before.as_chunks::<4>().0.to_vec();
    (edges.searches, edges.chunks) = (searches, chunks);
    [edges.path_m, edges.search_due_m, edges.stored_j, edges.lost_j] = sums;
    Some(())
}

fn chunk(edges: &Edges, from: &mut Reader) -> Option<Chunk> {
    let [allowed_m, due_m] = from.f64s()?.try_into().ok()?;
    let seen_m = from.f64s()?.as_chunks::<4>().0.to_vec();
    let near = from.u32s()?;
    let (whole, real) = (from.u32s()?, from.f64s()?);
    let (whole, real) = (whole.as_chunks::<4>().0, real.as_chunks::<NUMBERS>().0);
    (whole.len() == real.len()).then_some(())?;
    let pairs: Vec<Pair> = whole.iter().zip(real).map(|(i, n)| pair(edges, *i, n)).collect::<Option<_>>()?;
    near.iter().all(|at| (*at as usize) < pairs.len()).then_some(())?;
    let chunk = Chunk { near, seen_m, allowed_m, due_m, ..Chunk::new(pairs) };
    (chunk.seen_m.is_empty() || chunk.seen_m.len() == chunk.nodes.len()).then_some(chunk)
}

/// Sides, then ways, sign and state as one number.
fn integers(pair: &Pair) -> [u32; 4] {
    let three = |s: i8| (i32::from(s) + 1) as u32;
    let ways = three(pair.way[0]) + 3 * three(pair.way[1]);
    [pair.sides[0], pair.sides[1], ways, three(pair.sign) + 3 * u32::from(pair.on)]
}

fn numbers(pair: &Pair) -> [f64; NUMBERS] {
    [pair.rest_m, pair.wanted_m, pair.last_m, pair.deep_m, pair.damped_n]
}

fn pair(edges: &Edges, [first, second, ways, state]: [u32; 4], numbers: &[f64; NUMBERS]) -> Option<Pair> {
    let sides = edges.sides.list.len() as u32;
    (first < sides && second < sides && ways < 9 && state < 6).then_some(())?;
    let three = |v: u32| (v % 3) as i8 - 1;
    let [rest_m, wanted_m, last_m, deep_m, damped_n] = *numbers;
    Some(Pair {
        way: [three(ways), three(ways / 3)],
        sign: three(state),
        on: state >= 3,
        rest_m,
        wanted_m,
        last_m,
        deep_m,
        damped_n,
        ..edges.fresh([first, second])
    })
}
