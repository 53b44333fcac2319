//! Contact of edges as bytes and back.

use super::Edges;
use super::chunk::Chunk;
use super::pair::Pair;
use crate::bytes::{pack, unpack};
use crate::vec3::V3;
use serde::{Deserialize, Serialize};

/// What edges cannot find again from positions.
#[derive(Serialize, Deserialize)]
struct State {
    sides: usize,
    searches: u64,
    path_m: f64,
    search_due_m: f64,
    stored_j: f64,
    lost_j: f64,
    held_lost_j: f64,
    placed_m: Vec<[f64; 4]>,
    before_m: Vec<[f64; 4]>,
    forces: Vec<(u32, V3)>,
    chunks: Vec<ChunkState>,
}

#[derive(Serialize, Deserialize)]
struct ChunkState {
    way_m: f64,
    press_due_m: f64,
    cross_due_m: f64,
    seen_m: Vec<[f64; 4]>,
    press_at_m: Vec<f64>,
    cross_at_m: Vec<f64>,
    pairs: Vec<PairState>,
}

#[derive(Serialize, Deserialize)]
struct PairState {
    key: [u32; 2],
    face: bool,
    on: bool,
    rest_m: f64,
    wanted_m: f64,
    last_m: f64,
    deep_m: f64,
    damped_n: f64,
}

pub(super) fn write(edges: &Edges) -> Vec<u8> {
    let pair = |&Pair { key, face, on, rest_m, wanted_m, last_m, deep_m, damped_n, .. }: &Pair| PairState {
        key,
        face,
        on,
        rest_m,
        wanted_m,
        last_m,
        deep_m,
        damped_n,
    };
    let chunk = |chunk: &Chunk| ChunkState {
        way_m: chunk.way_m,
        press_due_m: chunk.press_due_m,
        cross_due_m: chunk.cross_due_m,
        seen_m: chunk.seen_m.clone(),
        press_at_m: chunk.press_at_m.clone(),
        cross_at_m: chunk.cross_at_m.clone(),
        pairs: chunk.pairs.iter().map(pair).collect(),
    };
    pack(&State {
        sides: edges.sides.list.len(),
        searches: edges.searches,
        path_m: edges.path_m,
        search_due_m: edges.search_due_m,
        stored_j: edges.stored_j,
        lost_j: edges.lost_j,
        held_lost_j: edges.held.lost_j,
        placed_m: edges.placed_m.clone(),
        before_m: edges.held.before_m.clone(),
        forces: edges.held.forces.clone(),
        chunks: edges.chunks.iter().map(chunk).collect(),
    })
}

pub(super) fn read(edges: &mut Edges, saved: &[u8]) -> Option<()> {
    let state: State = unpack(saved)?;
    let count = edges.placed_m.len();
    let fits = state.sides == edges.sides.list.len()
        && state.placed_m.len() == count
        && (state.before_m.is_empty() || state.before_m.len() == count)
        && state.forces.iter().all(|(node, _)| (*node as usize) < count);
    fits.then_some(())?;
    edges.chunks = state.chunks.into_iter().map(|saved| chunk(edges, saved)).collect::<Option<_>>()?;
    (edges.searches, edges.path_m, edges.search_due_m) = (state.searches, state.path_m, state.search_due_m);
    (edges.stored_j, edges.lost_j, edges.held.lost_j) = (state.stored_j, state.lost_j, state.held_lost_j);
    (edges.placed_m, edges.held.before_m, edges.held.forces) = (state.placed_m, state.before_m, state.forces);
    Some(())
}

fn chunk(edges: &Edges, saved: ChunkState) -> Option<Chunk> {
    let ChunkState { way_m, press_due_m, cross_due_m, seen_m, press_at_m, cross_at_m, pairs } = saved;
    let pairs: Vec<Pair> = pairs.iter().map(|saved| pair(edges, saved)).collect::<Option<_>>()?;
    (press_at_m.len() == pairs.len() && cross_at_m.len() == pairs.len()).then_some(())?;
    let chunk = Chunk { seen_m, press_at_m, cross_at_m, way_m, press_due_m, cross_due_m, ..Chunk::new(pairs) };
    (chunk.seen_m.is_empty() || chunk.seen_m.len() == chunk.nodes.len()).then_some(chunk)
}

fn pair(edges: &Edges, saved: &PairState) -> Option<Pair> {
    let &PairState { key, face, on, rest_m, wanted_m, last_m, deep_m, damped_n } = saved;
    let (sides, triangles, nodes) = (edges.sides.list.len(), edges.sides.triangles.len(), edges.mass_kg.len());
    let most = if face { [nodes, triangles] } else { [sides, sides] };
    ((key[0] as usize) < most[0] && (key[1] as usize) < most[1]).then_some(())?;
    Some(Pair { on, rest_m, wanted_m, last_m, deep_m, damped_n, ..edges.fresh(key, face) })
}
