//! Who is on which side of whom: what the checks of contact share.

use super::setup::*;
use fem::Part;
use fem::vec3::{V3, cross, dot, sub};

/// Triangles of a part at positions `x`, quadrilaterals cut in two.
pub(super) fn triangles(part: &Part, x: &[V3]) -> Vec<[V3; 3]> {
    let at = |n: u32| x[n as usize];
    let halves = part.quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    halves.chain(part.triangles.iter().copied()).map(|t| t.map(at)).collect()
}

/// Height of a point over each triangle above or below it \[m\].
pub(super) fn heights(faces: &[[V3; 3]], p: V3) -> Vec<f64> {
    faces.iter().filter_map(|face| height(face, p)).collect()
}

/// Height of a point over a triangle along z, if it is above or below it.
fn height([a, b, c]: &[V3; 3], p: V3) -> Option<f64> {
    let flat = |u: V3, v: V3| u[0] * v[1] - u[1] * v[0];
    let (u, v, w) = (sub(*b, *a), sub(*c, *a), sub(p, *a));
    let area = flat(u, v);
    let (s, t) = (flat(w, v) / area, flat(u, w) / area);
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then(|| w[2] - s * u[2] - t * v[2])
}

/// Smallest height of the nodes of `upper` over `lower` and of `lower` under `upper`, both sheets that have one height
/// at each place \[m\].
pub(super) fn clearance_m(upper: &Part, lower: &Part, x: &[V3]) -> f64 {
    let (top, base) = (triangles(upper, x), triangles(lower, x));
    let over = nodes(upper).into_iter().flat_map(|n| heights(&base, x[n]));
    let under = nodes(lower).into_iter().flat_map(|n| heights(&top, x[n])).map(|h| -h);
    over.chain(under).fold(f64::INFINITY, f64::min)
}

/// Nodes of a part, each once.
pub(super) fn nodes(part: &Part) -> Vec<usize> {
    let all = part.quads.iter().flatten().chain(part.triangles.iter().flatten());
    let mut all: Vec<usize> = all.map(|n| *n as usize).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Mass of each node \[kg\] for areal masses by part \[kg/m²\].
pub(super) fn masses(mesh: &Mesh, areal: &[f64]) -> Vec<f64> {
    let mut mass = vec![0.0; mesh.points.len()];
    for (part, areal) in mesh.parts.iter().zip(areal) {
        for i in 0..part.len() {
            let corners = part.nodes(i);
            let x: Vec<V3> = corners.iter().map(|n| mesh.points[*n as usize]).collect();
            let (d1, d2) =
                if x.len() == 4 { (sub(x[2], x[0]), sub(x[3], x[1])) } else { (sub(x[1], x[0]), sub(x[2], x[0])) };
            let normal = cross(d1, d2);
            let share = 0.5 * dot(normal, normal).sqrt() * areal / x.len() as f64;
            corners.iter().for_each(|n| mass[*n as usize] += share);
        }
    }
    mass
}

pub(super) fn momentum(mass: &[f64], v: &[V3]) -> V3 {
    let mut sum = [0.0; 3];
    mass.iter().zip(v).for_each(|(m, v)| (0..3).for_each(|k| sum[k] += m * v[k]));
    sum
}
