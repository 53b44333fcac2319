//! Contact of edges as bytes and back.

use super::body::Edges;
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
    chunks: Vec<Chunk>,
}

pub(super) fn write(edges: &Edges) -> Vec<u8> {
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
        chunks: edges.chunks.clone(),
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

fn chunk(edges: &Edges, saved: Chunk) -> Option<Chunk> {
    let pairs: Vec<Pair> = saved.pairs.iter().map(|saved| pair(edges, *saved)).collect::<Option<_>>()?;
    let nodes = Chunk::new(pairs.clone()).nodes;
    let fits = saved.press_at_m.len() == pairs.len()
        && saved.cross_at_m.len() == pairs.len()
        && (saved.seen_m.is_empty() || saved.seen_m.len() == nodes.len());
    fits.then_some(Chunk { pairs, nodes, ..saved })
}

fn pair(edges: &Edges, saved: Pair) -> Option<Pair> {
    let (sides, triangles, nodes) = (edges.sides.list.len(), edges.sides.triangles.len(), edges.mass_kg.len());
    let most = if saved.face { [nodes, triangles] } else { [sides, sides] };
    let [first, second] = saved.key.map(|k| k as usize);
    (first < most[0] && second < most[1]).then_some(())?;
    let Pair { nodes, stiffness_n_m, damping_n_s_m, .. } = edges.fresh(saved.key, saved.face);
    Some(Pair { nodes, stiffness_n_m, damping_n_s_m, ..saved })
}
