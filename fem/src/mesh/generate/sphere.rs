//! A sphere of quads: a cube blown up (equal angles along the edges of each face).

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_4;

use super::{at_least, few_enough, positive};
use crate::FemError;
use crate::mesh::{Mesh, Part};
use crate::vec3::V3;

/// Sphere around the origin, `n` elements along each edge of the cube, 6n² quads; part `sphere`, front outward, chamber
/// `air` inside. Sets `top` (highest nodes, 1 or 4), `bottom`.
///
/// ```
/// let mesh = fem::mesh::generate::sphere(0.05, 8).unwrap();
/// assert_eq!(mesh.elements(), 6 * 8 * 8);
/// assert!(mesh.points.iter().all(|p| (fem::vec3::norm(*p) - 0.05).abs() < 1e-15));
/// ```
///
/// # Errors
/// [`FemError::Mesh`] for a radius or count out of range.
pub fn sphere(radius_m: f64, n: usize) -> Result<Mesh, FemError> {
    positive("sphere", "radius_m", radius_m)?;
    at_least("sphere", "n", n, 1)?;
    few_enough("sphere", n.saturating_mul(2), n.saturating_mul(3))?;
    let mut mesh = Mesh::default();
    let mut known = HashMap::new();
    let mut quads = Vec::with_capacity(6 * n * n);
    for (axis, side) in [(0, n), (1, n), (2, n), (0, 0), (1, 0), (2, 0)] {
        let mut node = |i: usize, j: usize| {
            let mut key = [side; 3];
            (key[(axis + 1) % 3], key[(axis + 2) % 3]) = (i, j);
            *known.entry(key).or_insert_with(|| {
                mesh.points.push(on_sphere(key, n, radius_m));
                (mesh.points.len() - 1) as u32
            })
        };
        for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            quads.push(if side == n { [a, b, c, d] } else { [a, d, c, b] });
        }
    }
    let near = || n / 2..=n.div_ceil(2);
    for (name, side) in [("top", n), ("bottom", 0)] {
        let nodes = near().flat_map(|j| near().map(move |i| [i, j, side])).map(|place| known[&place]).collect();
        mesh.name(name, nodes);
    }
    mesh.parts.push(Part::round("air", "sphere", quads));
    Ok(mesh)
}

/// Node (i, j, k) of the cube's surface, pushed onto the sphere.
fn on_sphere(key: [usize; 3], n: usize, radius: f64) -> V3 {
    let cube = key.map(|k| ((2.0 * k as f64 - n as f64) / n as f64 * FRAC_PI_4).tan());
    let length = (cube[0] * cube[0] + cube[1] * cube[1] + cube[2] * cube[2]).sqrt();
    cube.map(|c| c / length * radius)
}
