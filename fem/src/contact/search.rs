//! Which nodes are within reach of which elements: nodes in a uniform grid, inflated boxes of elements asking it.

use rayon::prelude::*;

use super::surface::{NONE, Surface};
use crate::vec3::{V3, dot, node, sub};

/// Elements per parallel piece.
const PIECE: usize = 1024;

/// All (node, element) with the node within `radius_m` of the element (and some beyond), sorted by node then element.
/// Elements that a node must not touch are left out.
pub(super) fn pairs(surface: &Surface, x: &[[f64; 4]], radius_m: f64) -> Vec<(u32, u32)> {
    let grid = Grid::new(surface, x, (2.0 * radius_m).max(surface.size_m));
    let mark = || vec![NONE; x.len()];
    let pieces = surface.elements.len().div_ceil(PIECE);
    let found: Vec<Vec<(u32, u32)>> = (0..pieces)
        .into_par_iter()
        .map_init(mark, |own, piece| {
            let mut out = Vec::new();
            for e in piece * PIECE..((piece + 1) * PIECE).min(surface.elements.len()) {
                ask(surface, x, &grid, e, radius_m, own, &mut out);
            }
            out
        })
        .collect();
    by_node(x.len(), &found)
}

/// Counting sort by node; elements stay ascending.
fn by_node(nodes: usize, found: &[Vec<(u32, u32)>]) -> Vec<(u32, u32)> {
    let mut place = vec![0_u32; nodes + 1];
    found.iter().flatten().for_each(|(n, _)| place[*n as usize + 1] += 1);
    (0..nodes).for_each(|i| place[i + 1] += place[i]);
    let mut out = vec![(0, 0); place[nodes] as usize];
    for pair in found.iter().flatten() {
        let at = &mut place[pair.0 as usize];
        out[*at as usize] = *pair;
        *at += 1;
    }
    out
}

/// `own` marks the nodes that must not touch an element with its number.
fn ask(
    surface: &Surface,
    x: &[[f64; 4]],
    grid: &Grid,
    element: usize,
    radius_m: f64,
    own: &mut [u32],
    out: &mut Vec<(u32, u32)>,
) {
    surface.skip.of(element).iter().for_each(|n| own[*n as usize] = element as u32);
    let corners = surface.corners(element);
    let (mut low, mut high, mut middle) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3], [0.0; 3]);
    for n in corners {
        let p = node(x, *n as usize);
        for k in 0..3 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
            middle[k] += p[k] / corners.len() as f64;
        }
    }
    let far = corners.iter().map(|n| sub(node(x, *n as usize), middle)).map(|r| dot(r, r)).fold(0.0, f64::max);
    let limit = (far.sqrt() + radius_m).powi(2);
    let (low, high) = (low.map(|v| v - radius_m), high.map(|v| v + radius_m));
    grid.within(low, high, |n, p| {
        let r = sub(p, middle);
        if dot(r, r) > limit || own[n as usize] == element as u32 {
            return;
        }
        if (0..3).all(|k| p[k] >= low[k] && p[k] <= high[k]) {
            out.push((n, element as u32));
        }
    });
}

/// Nodes sorted into cells; cells are hashed, so that a long thin robot needs no large table.
struct Grid {
    low: V3,
    per_m: f64,
    mask: u64,
    start: Vec<u32>,
    nodes: Vec<u32>,
    cell: Vec<[i32; 3]>,
    place: Vec<V3>,
}

impl Grid {
    fn new(surface: &Surface, x: &[[f64; 4]], size_m: f64) -> Grid {
        let used: Vec<u32> = (0..x.len() as u32).filter(|n| !surface.around.of(*n as usize).is_empty()).collect();
        let mut low = [f64::INFINITY; 3];
        for n in &used {
            let p = node(x, *n as usize);
            (0..3).for_each(|k| low[k] = low[k].min(p[k]));
        }
        let slots = (2 * used.len()).next_power_of_two().max(16);
        let mut grid = Grid {
            low,
            per_m: 1.0 / size_m,
            mask: slots as u64 - 1,
            start: vec![0; slots + 1],
            nodes: vec![0; used.len()],
            cell: vec![[0; 3]; used.len()],
            place: vec![[0.0; 3]; used.len()],
        };
        let cells: Vec<[i32; 3]> = used.iter().map(|n| grid.cell_of(node(x, *n as usize))).collect();
        cells.iter().for_each(|c| grid.start[grid_slot(*c, slots as u64 - 1) + 1] += 1);
        (0..slots).for_each(|i| grid.start[i + 1] += grid.start[i]);
        let mut next = grid.start[..slots].to_vec();
        for (n, c) in used.iter().zip(cells) {
            let at = &mut next[grid_slot(c, grid.mask)];
            grid.nodes[*at as usize] = *n;
            grid.cell[*at as usize] = c;
            grid.place[*at as usize] = node(x, *n as usize);
            *at += 1;
        }
        grid
    }
    fn cell_of(&self, p: V3) -> [i32; 3] {
        [0, 1, 2].map(|k| ((p[k] - self.low[k]) * self.per_m).floor() as i32)
    }
    fn within(&self, low: V3, high: V3, mut visit: impl FnMut(u32, V3)) {
        let (from, to) = (self.cell_of(low), self.cell_of(high));
        let cells = (0..3).map(|k| (f64::from(to[k]) - f64::from(from[k]) + 1.0).max(0.0)).product::<f64>();
        if cells > self.nodes.len() as f64 {
            return self.nodes.iter().zip(&self.place).for_each(|(n, p)| visit(*n, *p));
        }
        for i in from[0]..=to[0] {
            for j in from[1]..=to[1] {
                for k in from[2]..=to[2] {
                    let slot = grid_slot([i, j, k], self.mask);
                    for at in self.start[slot] as usize..self.start[slot + 1] as usize {
                        if self.cell[at] == [i, j, k] {
                            visit(self.nodes[at], self.place[at]);
                        }
                    }
                }
            }
        }
    }
}

fn grid_slot(cell: [i32; 3], mask: u64) -> usize {
    let mix = |h: u64, v: i32| (h ^ u64::from(v as u32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let h = cell.iter().fold(0x51_7C_C1_B7, |h, v| mix(h, *v));
    ((h >> 32) & mask) as usize
}
