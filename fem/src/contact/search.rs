//! Which nodes are within reach of which elements: nodes in a uniform grid of columns along the shortest direction, inflated
//! boxes of elements asking it.

use rayon::prelude::*;

use super::surface::{ContactSurface, NONE};
use crate::vec3::{Nodes, V3, bounds, dot, node, sub};

const PIECE: usize = 1024;

/// All (node, element) with the node within `radius_m` of the element (and some beyond), sorted by rank of the node, then
/// element.
/// Elements that a node must not touch are left out.
pub(super) fn pairs(surface: &ContactSurface, x: &Nodes, radius_m: f64) -> Vec<(u32, u32)> {
    let used = (0..x.len() as u32).filter(|n| !surface.around.of(*n as usize).is_empty());
    let places = used.map(|n| Placed { place: node(x, n as usize), item: n }).collect();
    let grid = PointGrid::new(places, 0.5 * radius_m.max(surface.size_m));
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
    by_rank(&surface.rank, &found)
}

/// Counting sort by rank; elements stay ascending.
fn by_rank(rank: &[u32], found: &[Vec<(u32, u32)>]) -> Vec<(u32, u32)> {
    let mut place = vec![0_u32; rank.len() + 1];
    for (n, _) in found.iter().flatten() {
        place[rank[*n as usize] as usize + 1] += 1;
    }
    (0..rank.len()).for_each(|i| place[i + 1] += place[i]);
    let mut out = vec![(0, 0); place[rank.len()] as usize];
    for pair in found.iter().flatten() {
        let at = &mut place[rank[pair.0 as usize] as usize];
        out[*at as usize] = *pair;
        *at += 1;
    }
    out
}

/// `own` marks the nodes that must not touch an element with its number.
fn ask(
    surface: &ContactSurface,
    x: &Nodes,
    grid: &PointGrid,
    element: usize,
    radius_m: f64,
    own: &mut [u32],
    out: &mut Vec<(u32, u32)>,
) {
    for n in surface.skip.of(element).iter() {
        own[*n as usize] = element as u32;
    }
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
    for nodes in grid.rows(low, high) {
        // Written without jumps: most nodes are missed, and branch prediction fails.
        let mut end = out.len();
        out.resize(end + nodes.len(), (NONE, NONE));
        for Placed { place: p, item: node } in nodes {
            let r = sub(*p, middle);
            let mut found = (dot(r, r) <= limit) & (own[*node as usize] != element as u32);
            for k in 0..3 {
                found &= (p[k] >= low[k]) & (p[k] <= high[k]);
            }
            out[end] = (*node, element as u32);
            end += usize::from(found);
        }
        out.truncate(end);
    }
}

const COLUMNS: f64 = 4.0;

/// Points sorted into columns along the direction in which they are spread least.
pub(super) struct PointGrid {
    low: V3,
    per_m: f64,
    /// The two directions across the columns, and the number of columns in each.
    across: [usize; 2],
    count: [usize; 2],
    start: Vec<u32>,
    points: Vec<Placed>,
}

/// A point, and its node or element.
#[derive(Clone, Copy, Default)]
pub(super) struct Placed {
    pub place: V3,
    pub item: u32,
}

impl PointGrid {
    /// Columns of `size_m`, or wider ones where the points are spread so thin that there would be too many.
    pub(super) fn new(places: Vec<Placed>, size_m: f64) -> PointGrid {
        let [low, high] = bounds(places.iter().map(|p| p.place));
        let length = sub(high, low).map(|l| l.max(0.0));
        let short = (0..3).fold(0, |s, k| if length[k] < length[s] { k } else { s });
        let across = [(short + 1) % 3, (short + 2) % 3];
        let most = COLUMNS * places.len().max(1) as f64;
        let [a, b] = across.map(|k| length[k]);
        let size_m = size_m.max((a * b / most).sqrt()).max(a.max(b) / most).max(f64::MIN_POSITIVE);
        let count = [a, b].map(|l| (l / size_m) as usize + 1);
        let start = vec![0; count[0] * count[1] + 1];
        let mut grid =
            PointGrid { low, per_m: 1.0 / size_m, across, count, start, points: vec![Placed::default(); places.len()] };
        let columns: Vec<usize> = places.iter().map(|p| grid.number(grid.column_of(p.place))).collect();
        columns.iter().for_each(|c| grid.start[c + 1] += 1);
        for i in 1..grid.start.len() {
            grid.start[i] += grid.start[i - 1];
        }
        let mut next = grid.start.clone();
        for (place, column) in places.into_iter().zip(columns) {
            grid.points[next[column] as usize] = place;
            next[column] += 1;
        }
        grid
    }

    /// The column of a point, or the one nearest to it.
    fn column_of(&self, p: V3) -> [usize; 2] {
        [0, 1].map(|i| {
            let k = self.across[i];
            (((p[k] - self.low[k]) * self.per_m) as usize).min(self.count[i] - 1)
        })
    }

    fn number(&self, [i, j]: [usize; 2]) -> usize {
        i * self.count[1] + j
    }

    /// Points of all columns that a box from `low` to `high` meets, row by row: columns hold few points, and the columns of a row
    /// are consecutive, so that looking at all of them is faster than looking for the first and the last.
    pub(super) fn rows(&self, low: V3, high: V3) -> impl Iterator<Item = &[Placed]> {
        let (from, to) = (self.column_of(low), self.column_of(high));
        (from[0]..=to[0]).map(move |i| {
            let (first, last) = (self.number([i, from[1]]), self.number([i, to[1]]));
            &self.points[self.start[first] as usize..self.start[last + 1] as usize]
        })
    }
}
