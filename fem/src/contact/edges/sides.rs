//! Sides of elements, diagonals that halve quadrilaterals, and triangles, and which of them are within reach of each other.

use std::collections::HashMap;

use rayon::prelude::*;

use super::super::closest::TRIANGLES;
use super::super::surface::{NONE, Surface};
use super::pair::touch;
use crate::vec3::{V3, add, node, norm, scale, sub};

/// Items per parallel piece.
const PIECE: usize = 256;

/// What can meet: the ends of sides, the corners of triangles.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    pub list: Vec<[u32; 2]>,
    pub triangles: Vec<[u32; 3]>,
    nodes: Vec<u32>,
}

impl Sides {
    pub fn new(surface: &Surface) -> Sides {
        let mut sides = Sides::default();
        for e in 0..surface.elements.len() {
            let nodes = surface.elements[e];
            let halves = if nodes[3] == NONE { 1 } else { 2 };
            for triangle in &TRIANGLES[..halves] {
                let t = triangle.map(|k| nodes[k as usize]);
                sides.triangles.push(t);
                sides.list.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| [a.min(b), a.max(b)]));
            }
        }
        sides.list.sort_unstable();
        sides.list.dedup();
        sides.nodes = sides.list.as_flattened().to_vec();
        sides.nodes.sort_unstable();
        sides.nodes.dedup();
        sides
    }

    /// Pairs of sides (lower, higher number) within `radius_m`, and of nodes and triangles, both sorted.
    pub fn pairs(&self, x: &[[f64; 4]], radius_m: f64) -> [Vec<[u32; 2]>; 2] {
        let sides = Grid::new(self.list.iter().map(|s| s.as_slice()), x, radius_m);
        let side = |i: u32| {
            let own = self.list[i as usize];
            let mut near = Vec::new();
            sides.near(x, &own, radius_m, |j| {
                let other = self.list[j as usize];
                if j > i && !other.iter().any(|n| own.contains(n)) {
                    let nodes = [own[0], own[1], other[0], other[1]];
                    if touch(false, nodes.map(|n| node(x, n as usize))).distance_m <= radius_m {
                        near.push([i, j]);
                    }
                }
            });
            near.sort_unstable();
            near
        };
        let triangles = Grid::new(self.triangles.iter().map(|t| t.as_slice()), x, radius_m);
        let point = |i: u32| {
            let own = self.nodes[i as usize];
            let mut near = Vec::new();
            triangles.near(x, &[own], radius_m, |j| {
                let [a, b, c] = self.triangles[j as usize];
                if ![a, b, c].contains(&own)
                    && touch(true, [own, a, b, c].map(|n| node(x, n as usize))).distance_m <= radius_m
                {
                    near.push([own, j]);
                }
            });
            near.sort_unstable();
            near
        };
        [gather(self.list.len(), side), gather(self.nodes.len(), point)]
    }
}

fn gather(count: usize, of: impl Fn(u32) -> Vec<[u32; 2]> + Sync) -> Vec<[u32; 2]> {
    let piece = |p: usize| (p * PIECE..((p + 1) * PIECE).min(count)).flat_map(|i| of(i as u32)).collect();
    let found: Vec<Vec<[u32; 2]>> = (0..count.div_ceil(PIECE)).into_par_iter().map(piece).collect();
    found.concat()
}

/// Items by the cell in which their middle lies, with their boxes.
struct Grid {
    per_m: f64,
    cells: HashMap<[i64; 3], Vec<u32>>,
    boxes: Vec<[V3; 2]>,
}

fn bounds(x: &[[f64; 4]], nodes: &[u32]) -> [V3; 2] {
    let start = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    nodes
        .iter()
        .map(|n| node(x, *n as usize))
        .fold(start, |[low, high], p| [[0, 1, 2].map(|k| low[k].min(p[k])), [0, 1, 2].map(|k| high[k].max(p[k]))])
}

impl Grid {
    fn new<'a>(items: impl Iterator<Item = &'a [u32]>, x: &[[f64; 4]], radius_m: f64) -> Grid {
        let boxes: Vec<[V3; 2]> = items.map(|nodes| bounds(x, nodes)).collect();
        let longest = boxes.iter().map(|[low, high]| norm(sub(*high, *low))).fold(0.0, f64::max);
        let mut grid = Grid { per_m: 1.0 / (longest + radius_m).max(f64::MIN_POSITIVE), cells: HashMap::new(), boxes };
        for i in 0..grid.boxes.len() {
            grid.cells.entry(grid.cell(grid.boxes[i])).or_default().push(i as u32);
        }
        grid
    }

    fn cell(&self, [low, high]: [V3; 2]) -> [i64; 3] {
        scale(add(low, high), 0.5 * self.per_m).map(|v| v.floor() as i64)
    }

    /// Items whose boxes are within `radius_m` of that of some nodes.
    fn near(&self, x: &[[f64; 4]], nodes: &[u32], radius_m: f64, mut found: impl FnMut(u32)) {
        let own = bounds(x, nodes);
        let [cx, cy, cz] = self.cell(own);
        for [i, j, k] in (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k]))) {
            for item in self.cells.get(&[cx + i, cy + j, cz + k]).into_iter().flatten() {
                let [low, high] = self.boxes[*item as usize];
                if (0..3).all(|k| own[0][k] <= high[k] + radius_m && low[k] <= own[1][k] + radius_m) {
                    found(*item);
                }
            }
        }
    }
}
