//! Cylinder along x, with caps at its ends.

use std::f64::consts::{FRAC_PI_3, TAU};

use super::disc::Disc;
use super::grid::new_node;
use super::{at_least, few_enough, positive};
use crate::mesh::{Mesh, Part};
use crate::vec3::V3;
use crate::{FemError, Result};

/// Dimensions, divisions and caps of the cylinder that [`tube`] makes.
#[derive(Debug, Clone, PartialEq)]
pub struct Tube {
    /// Distance of the nodes from the axis \[m\].
    pub radius_m: f64,
    /// Length of the tube from cap to cap \[m\].
    pub length_m: f64,
    /// Angles of the generator lines round the axis.
    pub around: Around,
    /// Number of elements along the axis.
    pub along: usize,
    /// Caps at x = 0 and x = `length_m`.
    pub caps: [Cap; 2],
    /// Angle of the warp to the axis \[rad\], counter-clockwise seen from outside; 0 for axial warp.
    pub warp_rad: f64,
}

/// Generator lines of a tube; the angle is counted from +y towards +z.
#[derive(Debug, Clone, PartialEq)]
pub enum Around {
    /// Equally spaced, the first at angle 0.
    Even(usize),
    /// At these ascending angles within one turn \[rad\], at most 60° apart.
    Angles(Vec<f64>),
}

/// Way in which one end of a tube is closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cap {
    /// Open; pass the sets `base` and `tip` to [`crate::mesh::check::check_open`].
    Open,
    /// Quads that match the ring; needs `Around::Even` with a multiple of 4.
    Quads,
    /// Rings of triangles that grow towards the middle. They allow 0.65 to 0.82 of the time step of quads with the ring's
    /// side (an equilateral triangle 0.82), whatever the number around; `Quads` 0.55 from 16 around.
    Triangles,
}

/// Cylinder of radius r round the x axis, 0 ≤ x ≤ length; part `wall`, front outward, chamber `body` inside; flat caps are
/// parts `base_cap` and `tip_cap`.
///
/// Sets `base`, `base_2` (the row next to it; holding both is encastre), `tip`, `tip_2`, `middle` (the ring nearest to half
/// the length), and with caps `base_cap`, `tip_cap` (all nodes of the cap, ring included), `base_centre`, `tip_centre`.
/// The section is a polygon inscribed in the circle of radius r.
///
/// # Errors
/// [`FemError::Mesh`] for a length, count or angle out of range.
pub fn tube(tube: &Tube) -> Result<Mesh> {
    positive("tube", "radius_m", tube.radius_m)?;
    positive("tube", "length_m", tube.length_m)?;
    at_least("tube", "along", tube.along, 2)?;
    let angles = angles_of(tube)?;
    few_enough("tube", tube.along, angles.len())?;
    let mut mesh = wall(tube, &angles);
    for (end, cap) in tube.caps.into_iter().enumerate() {
        add_cap(&mut mesh, tube, &angles, end, cap)?;
    }
    Ok(mesh)
}

/// The angles of the generator lines, if they go round.
fn angles_of(tube: &Tube) -> Result<Vec<f64>> {
    if !tube.warp_rad.is_finite() {
        return Err(FemError::Mesh(format!("tube: warp_rad is {}, and must be a number", tube.warp_rad)));
    }
    let angles = match &tube.around {
        Around::Even(n) => {
            at_least("tube", "around", *n, 6)?;
            few_enough("tube", tube.along, *n)?;
            (0..*n).map(|i| TAU * i as f64 / *n as f64).collect()
        }
        Around::Angles(angles) => angles.clone(),
    };
    let wrapped = angles.first().map(|first| first + TAU);
    for (a, b) in angles.iter().zip(angles.iter().skip(1).chain(&wrapped)) {
        // Written so that a NaN is refused too; the margin is for 60° that rounding made larger.
        if !(b - a > 0.0 && b - a <= FRAC_PI_3 * (1.0 + 1e-12)) {
            let [a, b] = [a, b].map(|angle| angle.to_degrees());
            let message = format!("tube: angles must ascend in one turn by at most 60°; found {a:.3}° then {b:.3}°");
            return Err(FemError::Mesh(message));
        }
    }
    at_least("tube", "number of angles", angles.len(), 6)?;
    Ok(angles)
}

/// The cylinder without caps; ring `j` holds nodes j·n ‥ (j + 1)·n.
fn wall(tube: &Tube, angles: &[f64]) -> Mesh {
    let (mut mesh, n) = (Mesh::default(), angles.len());
    for j in 0..=tube.along {
        let x = tube.length_m * j as f64 / tube.along as f64;
        mesh.points.extend(angles.iter().map(|a| [x, tube.radius_m * a.cos(), tube.radius_m * a.sin()]));
    }
    let mut part = Part::round("body", "wall", Vec::new());
    let node = |j: usize, i: usize| (j * n + i % n) as u32;
    for (j, i) in (0..tube.along).flat_map(|j| (0..n).map(move |i| (j, i))) {
        part.quads.push([node(j, i), node(j, i + 1), node(j + 1, i + 1), node(j + 1, i)]);
        let next = angles.get(i + 1).copied().unwrap_or(angles[0] + TAU);
        part.warp.push(warp(0.5 * (angles[i] + next), tube.warp_rad));
    }
    if tube.warp_rad == 0.0 {
        part.warp = vec![[1.0, 0.0, 0.0]];
    }
    let rings =
        [("base", 0), ("base_2", 1), ("middle", tube.along / 2), ("tip_2", tube.along - 1), ("tip", tube.along)];
    for (name, j) in rings {
        mesh.name(name, (node(j, 0)..=node(j, n - 1)).collect());
    }
    mesh.parts.push(part);
    mesh
}

/// The axis turned by `turn` counter-clockwise seen from outside, on the facet facing `angle`: cos e_x + sin (n × e_x).
fn warp(angle: f64, turn: f64) -> V3 {
    [turn.cos(), turn.sin() * angle.sin(), -turn.sin() * angle.cos()]
}

fn add_cap(mesh: &mut Mesh, tube: &Tube, angles: &[f64], end: usize, cap: Cap) -> Result<()> {
    let n = angles.len();
    let (name, x) = [("base", 0.0), ("tip", tube.length_m)][end];
    let first = (end * tube.along * n) as u32;
    let ring: Vec<u32> = (first..first + n as u32).collect();
    let own = mesh.points.len() as u32;
    let mut part = Part::round("body", &format!("{name}_cap"), Vec::new());
    part.warp = vec![[0.0, 1.0, 0.0]];
    let centre = match cap {
        Cap::Open => return Ok(()),
        Cap::Quads => {
            if !matches!(tube.around, Around::Even(_)) || !n.is_multiple_of(4) || n < 8 {
                let message =
                    "tube: a cap of quads needs equal angles and a multiple of 4, at least 8, elements around";
                return Err(FemError::Mesh(format!("{message}; found {n}; use a cap of triangles")));
            }
            quad_cap(mesh, &mut part, &ring, x, tube.radius_m, end == 0)
        }
        Cap::Triangles => triangle_cap(mesh, &mut part, &ring, angles, x, tube.radius_m, end == 0),
    };
    let nodes = ring.into_iter().chain(own..mesh.points.len() as u32).collect();
    mesh.name(format!("{name}_cap"), nodes);
    mesh.name(format!("{name}_centre"), centre);
    mesh.parts.push(part);
    Ok(())
}

/// Disc of quads inside a ring; gives the nodes in the middle.
fn quad_cap(mesh: &mut Mesh, part: &mut Part, ring: &[u32], x: f64, radius: f64, turned: bool) -> Vec<u32> {
    let disc = Disc::new(ring.len() / 4);
    // The disc's rim starts at −45°, the ring at 0.
    let (c, s) = (0.5f64.sqrt() * radius, 0.5f64.sqrt() * radius);
    let mut nodes: Vec<u32> = Vec::with_capacity(disc.points.len());
    for [a, b] in &disc.points[..disc.rim] {
        nodes.push(new_node(mesh, [x, c * a - s * b, s * a + c * b]));
    }
    nodes.extend(ring);
    part.quads = disc.quads(&nodes, turned);
    disc.centre.iter().map(|i| nodes[*i]).collect()
}

/// Rings of triangles, each with about half the generators of the one outside it; gives the node in the middle.
fn triangle_cap(
    mesh: &mut Mesh,
    part: &mut Part,
    ring: &[u32],
    angles: &[f64],
    x: f64,
    mut radius: f64,
    turned: bool,
) -> Vec<u32> {
    let mut outer: Vec<(f64, u32)> = angles.iter().copied().zip(ring.iter().copied()).collect();
    // A fan of 16 triangles is still as wide as the quads outside it.
    while outer.len() > 16 {
        // 1.4 sides inward, which makes triangles no lower than wide, yet inside every chord of the ring.
        let chord = (0.5 * widest(&outer)).cos();
        radius *= (1.0 - 1.4 * TAU / outer.len() as f64).min(0.9 * chord);
        let place = |angle: f64| [x, radius * angle.cos(), radius * angle.sin()];
        let inner: Vec<(f64, u32)> =
            halved(&outer).into_iter().map(|angle| (angle, new_node(mesh, place(angle)))).collect();
        zip_rings(&mut part.triangles, &outer, &inner);
        outer = inner;
    }
    let centre = new_node(mesh, [x, 0.0, 0.0]);
    for (k, (_, node)) in outer.iter().enumerate() {
        part.triangles.push([*node, outer[(k + 1) % outer.len()].1, centre]);
    }
    if turned {
        part.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    vec![centre]
}

/// Half as many angles, spread half like the ring's own and half evenly, so that inner rings forget a grading.
fn halved(ring: &[(f64, u32)]) -> Vec<f64> {
    let count = ring.len().div_ceil(2);
    let spread = |j: usize| {
        let share = j as f64 / count as f64;
        let at = share * ring.len() as f64;
        let (k, rest) = (at.floor() as usize, at.fract());
        let own = angle_at(ring, k) + rest * (angle_at(ring, k + 1) - angle_at(ring, k));
        0.5 * own + 0.5 * (ring[0].0 + TAU * share)
    };
    (0..count).map(spread).collect()
}

/// Largest angle between neighbours of a ring.
fn widest(ring: &[(f64, u32)]) -> f64 {
    (0..ring.len()).map(|k| angle_at(ring, k + 1) - angle_at(ring, k)).fold(0.0, f64::max)
}

/// Angle of node `k`, which may be one turn on.
fn angle_at(ring: &[(f64, u32)], k: usize) -> f64 {
    ring[k % ring.len()].0 + if k >= ring.len() { TAU } else { 0.0 }
}

/// Fills the band between two rings that start at the same angle with counter-clockwise triangles.
fn zip_rings(triangles: &mut Vec<[u32; 3]>, outer: &[(f64, u32)], inner: &[(f64, u32)]) {
    let node = |ring: &[(f64, u32)], k: usize| ring[k % ring.len()].1;
    let (mut i, mut j) = (0, 0);
    while i < outer.len() || j < inner.len() {
        let middle = |ring, k| angle_at(ring, k) + angle_at(ring, k + 1);
        // Equal middles differ by rounding; the inner side goes first, so that even rings give the same fan everywhere.
        let inner_first = j < inner.len() && middle(inner, j) <= middle(outer, i) + 1e-9;
        if i == outer.len() || inner_first {
            triangles.push([node(inner, j + 1), node(inner, j), node(outer, i)]);
            j += 1;
        } else {
            triangles.push([node(outer, i), node(outer, i + 1), node(inner, j)]);
            i += 1;
        }
    }
}
