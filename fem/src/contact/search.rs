//! Which nodes are within reach of which elements: nodes in a uniform grid of columns along the shortest direction, inflated
//! boxes of elements asking it.

use std::ops::Range;

use pulp::Simd;
use rayon::prelude::*;

use super::surface::{NONE, Surface};
use crate::sheet::group::{LANES, Lane};
use crate::sheet::lanes::{V, axes, inner};
use crate::vec3::{V3, dot, node, sub};

/// Elements per parallel piece.
const PIECE: usize = 1024;

/// All (node, element) with the node within `radius_m` of the element (and some beyond), sorted by rank of the node, then
/// element.
/// Elements that a node must not touch are left out.
pub(super) fn pairs(arch: pulp::Arch, surface: &Surface, x: &[[f64; 4]], radius_m: f64) -> Vec<(u32, u32)> {
    let used = (0..x.len() as u32).filter(|n| !surface.around.of(*n as usize).is_empty());
    let places = used.map(|n| Placed { place: node(x, n as usize), item: n }).collect();
    let grid = Grid::new(places, radius_m.max(surface.size_m));
    let mark = || vec![NONE; x.len()];
    let pieces = surface.elements.len().div_ceil(PIECE);
    let found: Vec<Vec<(u32, u32)>> = (0..pieces)
        .into_par_iter()
        .map_init(mark, |own, piece| {
            let mut out = Vec::new();
            let elements = piece * PIECE..((piece + 1) * PIECE).min(surface.elements.len());
            arch.dispatch(Ask { surface, x, grid: &grid, elements, radius_m, own, out: &mut out });
            out
        })
        .collect();
    by_rank(&surface.rank, &found)
}

/// Counting sort by rank; elements stay ascending.
fn by_rank(rank: &[u32], found: &[Vec<(u32, u32)>]) -> Vec<(u32, u32)> {
    let mut place = vec![0_u32; rank.len() + 1];
    found.iter().flatten().for_each(|(n, _)| place[rank[*n as usize] as usize + 1] += 1);
    (0..rank.len()).for_each(|i| place[i + 1] += place[i]);
    let mut out = vec![(0, 0); place[rank.len()] as usize];
    for pair in found.iter().flatten() {
        let at = &mut place[rank[pair.0 as usize] as usize];
        out[*at as usize] = *pair;
        *at += 1;
    }
    out
}

/// Elements that ask the grid; `own` marks the nodes that must not touch an element with its number.
struct Ask<'a> {
    surface: &'a Surface,
    x: &'a [[f64; 4]],
    grid: &'a Grid,
    elements: Range<usize>,
    radius_m: f64,
    own: &'a mut [u32],
    out: &'a mut Vec<(u32, u32)>,
}

impl pulp::WithSimd for Ask<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for element in self.elements {
            for n in self.surface.skip.of(element) {
                self.own[*n as usize] = element as u32;
            }
            let reach = Reach::of(self.surface.corners(element), self.x, self.radius_m);
            let (from, to) = (self.grid.column_of(reach.low), self.grid.column_of(reach.high));
            for i in from[0]..=to[0] {
                let row = self.grid.row_range(i, from[1], to[1]);
                // Most nodes are missed, and nobody can tell which: eight at a time, without jumps.
                for first in row.clone().step_by(LANES) {
                    let mut inside = [0.0; LANES];
                    if !reach.holds(simd, &self.grid.axes, first, &mut inside) {
                        continue;
                    }
                    for at in first..row.end.min(first + LANES) {
                        let node = self.grid.points[at].item;
                        if inside[at - first] >= 0.0 && self.own[node as usize] != element as u32 {
                            self.out.push((node, element as u32));
                        }
                    }
                }
            }
        }
    }
}

/// What is within reach of an element: inside an inflated box and an inflated ball.
struct Reach {
    low: V3,
    high: V3,
    middle: V3,
    square_m2: f64,
}

impl Reach {
    #[inline(always)]
    fn of(corners: &[u32], x: &[[f64; 4]], radius_m: f64) -> Reach {
        let (mut low, mut high, mut middle) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3], [0.0; 3]);
        for n in corners {
            let p = node(x, *n as usize);
            for k in 0..3 {
                low[k] = if p[k] < low[k] { p[k] } else { low[k] };
                high[k] = if p[k] > high[k] { p[k] } else { high[k] };
                middle[k] += p[k] / corners.len() as f64;
            }
        }
        let mut far = 0.0;
        for n in corners {
            let r = sub(node(x, *n as usize), middle);
            far = if dot(r, r) > far { dot(r, r) } else { far };
        }
        for k in 0..3 {
            (low[k], high[k]) = (low[k] - radius_m, high[k] + radius_m);
        }
        Reach { low, high, middle, square_m2: (far.sqrt() + radius_m).powi(2) }
    }

    /// Writes a number that is not negative where one of the eight points from `first` on is inside; false if none is.
    #[inline(always)]
    fn holds<S: Simd>(&self, simd: S, axes: &[Vec<f64>; 3], first: usize, inside: &mut Lane) -> bool {
        let mut any = false;
        for part in 0..LANES / S::F64_LANES {
            let at = first + part * S::F64_LANES;
            let p = axes!(k => V::load_from(simd, &axes[k], at));
            let r = axes!(k => p[k] - V::all(simd, self.middle[k]));
            let mut least = V::all(simd, self.square_m2) - inner(r, r);
            for (k, p) in p.into_iter().enumerate() {
                let (low, high) = (V::all(simd, self.low[k]), V::all(simd, self.high[k]));
                least = least.min((p - low).min(high - p));
            }
            least.store(inside, part);
            any |= least.largest() >= 0.0;
        }
        any
    }
}

/// Columns per point at most.
const COLUMNS: f64 = 4.0;

/// Points sorted into columns along the direction in which they are spread least.
pub(super) struct Grid {
    low: V3,
    per_m: f64,
    /// The two directions across the columns, and the number of columns in each.
    across: [usize; 2],
    count: [usize; 2],
    start: Vec<u32>,
    points: Vec<Placed>,
    /// The same places by axis, and eight more that are nowhere.
    axes: [Vec<f64>; 3],
}

/// A point, and what it stands for.
#[derive(Clone, Copy, Default)]
pub(super) struct Placed {
    pub place: V3,
    pub item: u32,
}

impl Grid {
    /// Columns of `size_m`, or wider ones where the points are spread so thin that there would be too many.
    pub fn new(places: Vec<Placed>, size_m: f64) -> Grid {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for Placed { place: p, .. } in &places {
            (0..3).for_each(|k| (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k])));
        }
        let length = sub(high, low).map(|l| l.max(0.0));
        let short = (0..3).fold(0, |s, k| if length[k] < length[s] { k } else { s });
        let across = [(short + 1) % 3, (short + 2) % 3];
        let most = COLUMNS * places.len().max(1) as f64;
        let [a, b] = across.map(|k| length[k]);
        let size_m = size_m.max((a * b / most).sqrt()).max(a.max(b) / most).max(f64::MIN_POSITIVE);
        let count = [a, b].map(|l| (l / size_m) as usize + 1);
        let start = vec![0; count[0] * count[1] + 1];
        let points = vec![Placed::default(); places.len()];
        let axes = [const { Vec::new() }; 3];
        let mut grid = Grid { low, per_m: 1.0 / size_m, across, count, start, points, axes };
        let columns: Vec<usize> = places.iter().map(|p| grid.number(grid.column_of(p.place))).collect();
        columns.iter().for_each(|c| grid.start[c + 1] += 1);
        (1..grid.start.len()).for_each(|i| grid.start[i] += grid.start[i - 1]);
        let mut next = grid.start.clone();
        for (place, column) in places.into_iter().zip(columns) {
            grid.points[next[column] as usize] = place;
            next[column] += 1;
        }
        for k in 0..3 {
            grid.axes[k].extend(grid.points.iter().map(|p| p.place[k]).chain([f64::INFINITY; LANES]));
        }
        grid
    }

    /// The column of a point, or the one nearest to it.
    pub fn column_of(&self, p: V3) -> [usize; 2] {
        [0, 1].map(|i| {
            let k = self.across[i];
            (((p[k] - self.low[k]) * self.per_m) as usize).min(self.count[i] - 1)
        })
    }

    fn number(&self, [i, j]: [usize; 2]) -> usize {
        i * self.count[1] + j
    }

    /// Points of some columns beside each other.
    pub fn row(&self, i: usize, from: usize, to: usize) -> &[Placed] {
        &self.points[self.row_range(i, from, to)]
    }

    fn row_range(&self, i: usize, from: usize, to: usize) -> Range<usize> {
        self.start[self.number([i, from])] as usize..self.start[self.number([i, to]) + 1] as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::closest::nearest;
    use crate::contact::tests::rig::Noise;
    use crate::mesh::generate;

    #[test]
    fn no_node_within_reach_of_an_element_is_missed_and_none_that_must_not_touch_it_is_found() {
        let mesh = generate::pillow(1.0, 12, 0.02).unwrap();
        let surface = Surface::new(&mesh, &[]).unwrap();
        let (mut noise, radius_m) = (Noise(11), 0.1);
        let shaken = |p: &V3| {
            let [a, b, c] = noise.point(0.06);
            [p[0] + a, p[1] + b, p[2] + c, 0.0]
        };
        let x: Vec<[f64; 4]> = mesh.points.iter().map(shaken).collect();
        let found = pairs(pulp::Arch::new(), &surface, &x, radius_m);
        let (mut close, mut far) = (0, 0);
        for e in 0..surface.elements.len() as u32 {
            for n in 0..x.len() as u32 {
                let (skipped, listed) = (surface.skip.of(e as usize).contains(&n), found.contains(&(n, e)));
                let square_m2 = nearest(&surface, &x, node(&x, n as usize), e).square_m2;
                let within = square_m2 <= radius_m * radius_m && !skipped;
                assert!(listed || !within, "node {n}, element {e}");
                assert!(!(listed && skipped), "node {n}, element {e}");
                close += usize::from(within);
                far += usize::from(listed && !within);
            }
        }
        assert_eq!(found.len(), close + far);
        assert!(close > 1000 && far < 2 * close, "{close} within reach, {far} beyond");
    }
}
