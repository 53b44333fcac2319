//! Sides of elements and diagonals that halve quadrilaterals, and which pairs of them are within reach of each other.

use std::collections::HashMap;

use rayon::prelude::*;

use super::super::surface::{Lists, NONE, Surface};
use super::segment::closest;
use crate::vec3::{V3, add, cross, node, norm, scale, sub};

/// Sides per parallel piece.
const PIECE: usize = 256;

/// A side of one or two elements, or the diagonal of one (which is both faces).
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub nodes: [u32; 2],
    /// The second is [`NONE`] at a free border.
    pub faces: [u32; 2],
}

/// All sides between which contact is looked for. Seams of three and more sheets are left out.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    pub list: Vec<Side>,
    /// Sides at each node.
    pub at: Lists,
    /// Elements in two rings around each side, of its own layers, ascending.
    skip: Vec<Vec<u32>>,
}

impl Sides {
    pub fn new(surface: &Surface, nodes: usize) -> Sides {
        let mut found = Vec::new();
        for e in 0..surface.elements.len() {
            let corners = surface.corners(e);
            for (k, a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                found.push(([*a.min(&b), *a.max(&b)], e as u32));
            }
        }
        found.sort_unstable();
        let mut list = Vec::new();
        for group in found.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() <= 2) {
            list.push(Side { nodes: group[0].0, faces: [group[0].1, group.get(1).map_or(NONE, |g| g.1)] });
        }
        for e in (0..surface.elements.len() as u32).filter(|e| surface.elements[*e as usize][3] != NONE) {
            let [a, _, c, _] = surface.elements[e as usize];
            list.push(Side { nodes: [a.min(c), a.max(c)], faces: [e, e] });
        }
        let pairs: Vec<(u32, u32)> =
            list.iter().enumerate().flat_map(|(i, s)| s.nodes.map(|n| (n, i as u32))).collect();
        let skip = list.iter().map(|side| rings(surface, side)).collect();
        Sides { list, at: Lists::new(nodes, &pairs), skip }
    }

    /// Mean normal of the faces at a side; short where they are folded onto each other.
    pub fn normal(&self, surface: &Surface, x: &[[f64; 4]], side: u32) -> V3 {
        let mut sum = [0.0; 3];
        let faces = self.list[side as usize].faces;
        for e in faces.into_iter().filter(|e| *e != NONE) {
            let p: Vec<V3> = surface.corners(e as usize).iter().map(|n| node(x, *n as usize)).collect();
            let [u, v] =
                if p.len() == 4 { [sub(p[2], p[0]), sub(p[3], p[1])] } else { [sub(p[1], p[0]), sub(p[2], p[0])] };
            let n = cross(u, v);
            let length = norm(n);
            if length > 0.0 {
                sum = add(sum, scale(n, if faces[1] == NONE { 1.0 } else { 0.5 } / length));
            }
        }
        sum
    }

    /// True if some element at one is of the layer of some element at the other.
    pub fn one_layer(&self, surface: &Surface, a: u32, b: u32) -> bool {
        let layers = |s: u32| self.list[s as usize].faces.into_iter().filter(|e| *e != NONE);
        layers(a).any(|e| layers(b).any(|f| surface.layer[e as usize] == surface.layer[f as usize]))
    }

    /// Pairs (lower, higher number) within `radius_m`, sorted.
    pub fn pairs(&self, x: &[[f64; 4]], radius_m: f64) -> Vec<[u32; 2]> {
        let ends = |s: &Side| s.nodes.map(|n| node(x, n as usize));
        let longest = self.list.iter().map(ends).map(|[a, b]| norm(sub(b, a))).fold(0.0, f64::max);
        let per_m = 1.0 / (longest + radius_m).max(f64::MIN_POSITIVE);
        let cell = |[a, b]: [V3; 2]| [0, 1, 2].map(|k| (0.5 * (a[k] + b[k]) * per_m).floor() as i64);
        let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (i, side) in self.list.iter().enumerate() {
            cells.entry(cell(ends(side))).or_default().push(i as u32);
        }
        let of = |i: u32| {
            let own = ends(&self.list[i as usize]);
            let [cx, cy, cz] = cell(own);
            let around = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
            let mut near = Vec::new();
            for c in around {
                let members = cells.get(&[cx + c[0], cy + c[1], cz + c[2]]);
                near.extend(members.into_iter().flatten().filter(|j| **j > i && self.near(x, own, i, **j, radius_m)));
            }
            near.sort_unstable();
            near.into_iter().map(move |j| [i, j])
        };
        let pieces = self.list.len().div_ceil(PIECE);
        let piece = |p: usize| (p * PIECE..((p + 1) * PIECE).min(self.list.len())).flat_map(|i| of(i as u32)).collect();
        let found: Vec<Vec<[u32; 2]>> = (0..pieces).into_par_iter().map(piece).collect();
        found.concat()
    }

    fn near(&self, x: &[[f64; 4]], [p, q]: [V3; 2], i: u32, j: u32, radius_m: f64) -> bool {
        let other = &self.list[j as usize];
        let [r, s] = other.nodes.map(|n| node(x, n as usize));
        for k in 0..3 {
            if p[k].max(q[k]) + radius_m < r[k].min(s[k]) || r[k].max(s[k]) + radius_m < p[k].min(q[k]) {
                return false;
            }
        }
        if other.nodes.iter().any(|n| self.list[i as usize].nodes.contains(n)) {
            return false;
        }
        let close = |e: &u32| self.skip[i as usize].binary_search(e).is_ok();
        !other.faces.iter().any(close) && norm(closest([p, q], [r, s]).2) <= radius_m
    }
}

/// Elements around a side that are of its own layers: those that share a node with an element at its ends.
fn rings(surface: &Surface, side: &Side) -> Vec<u32> {
    let layers: Vec<u32> = side.faces.iter().filter(|e| **e != NONE).map(|e| surface.layer[*e as usize]).collect();
    let own = |e: &&u32| layers.contains(&surface.layer[**e as usize]);
    let around = |n: &u32| surface.around.of(*n as usize).iter().filter(own);
    let first = side.nodes.iter().flat_map(around);
    let mut out: Vec<u32> = first.flat_map(|e| surface.corners(*e as usize)).flat_map(around).copied().collect();
    out.sort_unstable();
    out.dedup();
    out
}
