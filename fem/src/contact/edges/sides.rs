//! Sides of elements, diagonals that halve quadrilaterals, and triangles, and which of them are within reach of each other.

use rayon::prelude::*;

use super::super::closest::TRIANGLES;
use super::super::search::{Placed, PointGrid};
use super::super::surface::{ContactSurface, NONE};
use super::pair::touch;
use crate::vec3::{Nodes, V3, node};

const PIECE: usize = 256;

/// What can meet: the ends of sides, the corners of triangles.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    pub list: Vec<[u32; 2]>,
    pub triangles: Vec<[u32; 3]>,
    nodes: Vec<u32>,
}

impl Sides {
    pub(super) fn new(surface: &ContactSurface) -> Sides {
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
    pub(super) fn pairs(&self, x: &Nodes, radius_m: f64) -> [Vec<Near>; 2] {
        let place = |n: u32| node(x, n as usize);
        let sides = Boxes::new(self.list.iter().map(|s| s.as_slice()), x, radius_m);
        let side = |i: u32, near: &mut Vec<u32>, out: &mut Vec<Near>| {
            let own = self.list[i as usize];
            sides.near(x, &own, i + 1, near);
            for j in near.iter() {
                let other = self.list[*j as usize];
                if !other.iter().any(|n| own.contains(n)) {
                    let nodes = [own[0], own[1], other[0], other[1]];
                    out.push(([i, *j], touch(false, nodes.map(place)).distance_m));
                }
            }
        };
        let triangles = Boxes::new(self.triangles.iter().map(|t| t.as_slice()), x, radius_m);
        let point = |i: u32, near: &mut Vec<u32>, out: &mut Vec<Near>| {
            let own = self.nodes[i as usize];
            triangles.near(x, &[own], 0, near);
            for j in near.iter() {
                let [a, b, c] = self.triangles[*j as usize];
                if ![a, b, c].contains(&own) {
                    out.push(([own, *j], touch(true, [own, a, b, c].map(place)).distance_m));
                }
            }
        };
        [gather(self.list.len(), radius_m, side), gather(self.nodes.len(), radius_m, point)]
    }
}

/// `of` lists the neighbours of an item; those within the radius stay.
fn gather(count: usize, radius_m: f64, of: impl Fn(u32, &mut Vec<u32>, &mut Vec<Near>) + Sync) -> Vec<Near> {
    let piece = |p: usize| {
        let (mut near, mut out) = (Vec::new(), Vec::new());
        (p * PIECE..((p + 1) * PIECE).min(count)).for_each(|i| of(i as u32, &mut near, &mut out));
        out.retain(|(_, distance_m)| *distance_m <= radius_m);
        out
    };
    let found: Vec<Vec<Near>> = (0..count.div_ceil(PIECE)).into_par_iter().map(piece).collect();
    found.concat()
}

/// Numbers of a pair, and its distance \[m\].
pub(super) type Near = ([u32; 2], f64);

/// Least and largest heights along the axes and the four diagonals of space; the last is 0.
type Bounds = [[f64; 8]; 2];

/// Items by the column of their middle, with their boxes, which are larger by the radius.
struct Boxes {
    grid: PointGrid,
    boxes: Vec<Bounds>,
    /// Largest half box along each axis.
    half_m: V3,
}

fn touch_each_other(a: &Bounds, b: &Bounds) -> bool {
    // Written without jumps.
    (0..8).fold(true, |near, k| near & (a[0][k] <= b[1][k]) & (b[0][k] <= a[1][k]))
}

/// Larger by a radius.
fn bounds(x: &Nodes, nodes: &[u32], radius_m: f64) -> Bounds {
    let (mut low, mut high) = ([f64::INFINITY; 8], [f64::NEG_INFINITY; 8]);
    for n in nodes {
        let [x, y, z] = node(x, *n as usize);
        let heights = [x, y, z, x + y + z, x + y - z, x - y + z, y + z - x, 0.0];
        for k in 0..8 {
            low[k] = if heights[k] < low[k] { heights[k] } else { low[k] };
            high[k] = if heights[k] > high[k] { heights[k] } else { high[k] };
        }
    }
    for k in 0..8 {
        let by = if k < 3 { radius_m } else { 3_f64.sqrt() * radius_m };
        (low[k], high[k]) = (low[k] - by, high[k] + by);
    }
    [low, high]
}

impl Boxes {
    fn new<'a>(items: impl Iterator<Item = &'a [u32]>, x: &Nodes, radius_m: f64) -> Boxes {
        let boxes: Vec<Bounds> = items.map(|nodes| bounds(x, nodes, radius_m)).collect();
        let mut half_m = [0.0_f64; 3];
        for [low, high] in &boxes {
            for k in 0..3 {
                half_m[k] = half_m[k].max(0.5 * (high[k] - low[k]));
            }
        }
        let place = |[low, high]: &Bounds| [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let middle = |(i, bounds)| Placed { place: place(bounds), item: i as u32 };
        let places = boxes.iter().enumerate().map(middle).collect();
        let size_m = half_m.iter().fold(0.0, |most: f64, h| most.max(*h));
        Boxes { grid: PointGrid::new(places, size_m), boxes, half_m }
    }

    /// Items from number `first` on whose boxes touch the box of `nodes`, sorted.
    fn near(&self, x: &Nodes, nodes: &[u32], first: u32, out: &mut Vec<u32>) {
        let own = bounds(x, nodes, 0.0);
        out.clear();
        // A little more than half a box, lest rounding lose a column.
        let [low, high] = [-1.001, 1.001].map(|side| {
            let corner = own[usize::from(side > 0.0)];
            [0, 1, 2].map(|k| corner[k] + side * self.half_m[k])
        });
        for row in self.grid.rows(low, high) {
            // Written without jumps: most items are missed, and branch prediction fails.
            let mut end = out.len();
            out.resize(end + row.len(), 0);
            for Placed { place, item } in row {
                let mut near = *item >= first;
                for k in 0..3 {
                    near &= (place[k] >= low[k]) & (place[k] <= high[k]);
                }
                out[end] = *item;
                end += usize::from(near);
            }
            out.truncate(end);
        }
        out.retain(|item| touch_each_other(&own, &self.boxes[*item as usize]));
        out.sort_unstable();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::tests::rig::Noise;

    #[test]
    fn the_search_finds_what_asking_every_pair_finds() {
        let (mut noise, mut sides, mut x) = (Noise(7), Sides::default(), Vec::new());
        for i in 0..300_u32 {
            let [u, v, w] = noise.point(10.0);
            let size = if i % 50 == 0 { 3.0 } else { 0.5 };
            for _ in 0..3 {
                let [a, b, c] = noise.point(size);
                x.push([u + a, v + b, 0.2 * w + c, 0.0]);
            }
            sides.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
            sides.list.extend([[3 * i, 3 * i + 1], [3 * i + 1, 3 * i + 2]]);
            sides.nodes.extend([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let place = |n: u32| node(&x, n as usize);
        let close = |face: bool, nodes: [u32; 4]| touch(face, nodes.map(place)).distance_m <= 0.7;
        let (mut edges, mut faces) = (Vec::new(), Vec::new());
        for (i, [a, b]) in sides.list.iter().enumerate() {
            for (j, [c, d]) in sides.list.iter().enumerate().skip(i + 1) {
                if ![c, d].iter().any(|n| [a, b].contains(n)) && close(false, [*a, *b, *c, *d]) {
                    edges.push([i as u32, j as u32]);
                }
            }
        }
        for n in &sides.nodes {
            for (j, [a, b, c]) in sides.triangles.iter().enumerate() {
                if ![a, b, c].contains(&n) && close(true, [*n, *a, *b, *c]) {
                    faces.push([*n, j as u32]);
                }
            }
        }
        assert!(edges.len() > 100 && faces.len() > 100);
        let keys = sides.pairs(&x, 0.7).map(|near| near.iter().map(|(key, _)| *key).collect::<Vec<_>>());
        assert_eq!(keys, [edges, faces]);
    }
}
