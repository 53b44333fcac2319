//! Distances of nodes from elements, eight at a time: what a look asks before it chooses the closest.
//!
//! ```text
//! d² = h²  above the inside of a triangle, h = (p − a)·m/|m|, m = e₁×e₂;   else the least of |p − a − t e|², 0 ≤ t ≤ 1, over its sides
//! ```

use pulp::Simd;

use super::pack::rows;
use super::surface::{ContactSurface, NONE};
use crate::sheet::group::{LANES, Lane};
use crate::sheet::lanes::{V, axes, inner, product};
use crate::vec3::Nodes;

/// A question: how far is this node from this element?
#[derive(Debug, Clone, Copy)]
pub(super) struct DistanceQuestion {
    /// Record and candidate, positions in the chunk.
    pub record: u32,
    pub candidate: u32,
    pub node: u32,
    pub element: u32,
}

/// All questions of a look, and room for the squares of the distances \[m²\].
pub(super) struct Questions<'a> {
    pub surface: &'a ContactSurface,
    pub x: &'a [[f64; 4]],
    pub asked: &'a [DistanceQuestion],
    pub(crate) square_m2: &'a mut Vec<Lane>,
}

impl pulp::WithSimd for Questions<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.square_m2.clear();
        for eight in self.asked.chunks(LANES) {
            let (mut node, mut corner) = ([0; LANES], [[0; LANES]; 4]);
            for lane in 0..LANES {
                // Empty lanes repeat the last question.
                let question = &eight[lane.min(eight.len() - 1)];
                let [a, b, c, d] = self.surface.elements[question.element as usize];
                node[lane] = question.node;
                // A triangle is its own second half, turned over.
                let d = if d == NONE { b } else { d };
                (corner[0][lane], corner[1][lane], corner[2][lane], corner[3][lane]) = (a, b, c, d);
            }
            let mut square = [0.0; LANES];
            for part in 0..LANES / S::F64_LANES {
                squares(simd, self.x, [&node, &corner[0], &corner[1], &corner[2], &corner[3]], part)
                    .store(&mut square, part);
            }
            self.square_m2.push(square);
        }
    }
}

/// Squared distances of nodes from the two triangles of quadrilaterals.
#[inline(always)]
fn squares<S: Simd>(simd: S, x: &Nodes, ids: [&[u32; LANES]; 5], part: usize) -> V<S> {
    let (p, a) = (rows(simd, x, ids[0], part), rows(simd, x, ids[1], part));
    let b = rows(simd, x, ids[2], part);
    let c = rows(simd, x, ids[3], part);
    let d = rows(simd, x, ids[4], part);
    let (r, e1) = (axes!(k => p[k] - a[k]), axes!(k => b[k] - a[k]));
    let (e2, e3) = (axes!(k => c[k] - a[k]), axes!(k => d[k] - a[k]));
    let (rb, rc) = (axes!(k => p[k] - b[k]), axes!(k => p[k] - c[k]));
    let sides = to_side(simd, r, e1).min(to_side(simd, r, e2)).min(to_side(simd, r, e3));
    let sides = sides.min(to_side(simd, rb, axes!(k => c[k] - b[k]))).min(to_side(simd, rc, axes!(k => d[k] - c[k])));
    above(r, e1, e2, sides).min(above(r, e2, e3, sides))
}

/// Squared distance of a point from the segment e; both from its beginning.
#[inline(always)]
fn to_side<S: Simd>(simd: S, r: [V<S>; 3], e: [V<S>; 3]) -> V<S> {
    let t = (inner(r, e) * inner(e, e).inverse()).max(V::all(simd, 0.0)).min(V::all(simd, 1.0));
    let q = axes!(k => r[k] - e[k] * t);
    inner(q, q)
}

/// Squared height over the triangle of e₁ and e₂, or `outside` where the point is not above its inside.
#[inline(always)]
fn above<S: Simd>(r: [V<S>; 3], e1: [V<S>; 3], e2: [V<S>; 3], outside: V<S>) -> V<S> {
    let m = product(e1, e2);
    let square = inner(m, m);
    let (w1, w2) = (inner(product(r, e2), m), inner(product(e1, r), m));
    let height = inner(r, m);
    w1.min(w2).min(square - w1 - w2).choose(height * height * square.inverse(), outside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::closest::nearest;
    use crate::contact::tests::rig::Noise;
    use crate::vec3::node;

    #[test]
    fn eight_distances_at_once_are_those_of_one_after_the_other() {
        let mut noise = Noise(3);
        let mut surface = ContactSurface::default();
        let mut x = Vec::new();
        let mut asked = Vec::new();
        for i in 0..1003_u32 {
            let quad = [5 * i, 5 * i + 1, 5 * i + 2, if i % 5 == 0 { NONE } else { 5 * i + 3 }];
            for corner in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]] {
                let [a, b, c] = noise.point(0.4);
                x.push([corner[0] + a, corner[1] + b, c, 0.0]);
            }
            let far = noise.point(2.0);
            (0..3).for_each(|k| x[5 * i as usize + 4][k] += far[k]);
            surface.elements.push(quad);
            asked.push(DistanceQuestion { record: 0, candidate: 0, node: 5 * i + 4, element: i });
        }
        let mut square_m2 = Vec::new();
        let questions = Questions { surface: &surface, x: &x, asked: &asked, square_m2: &mut square_m2 };
        pulp::Arch::new().dispatch(questions);
        for (q, got) in asked.iter().zip(square_m2.as_flattened()) {
            let expected = nearest(&surface, &x, node(&x, q.node as usize), q.element).square_m2;
            assert!((got - expected).abs() <= 1e-12 * expected.max(1.0), "{got} {expected}");
        }
    }
}
