//! A disc of quads: a square core that grows round, and rings between it and the rim (O-grid).

use std::f64::consts::FRAC_PI_4;

use super::grid::new_node;
use super::{even, few_enough, positive};
use crate::FemError;
use crate::mesh::{Mesh, Part};

/// Half width of the core over the radius. Larger makes core elements as large as those at the rim, and rings thin.
const CORE: f64 = 0.6;
/// Roundness of the core, 0 square to 1 circle: shares the angle at its corners between three quads.
const ROUND: f64 = 0.3;
/// Rings per element across the core. These three are a compromise between time step and shape.
const RINGS: f64 = 0.2;

/// Flat balloon of two discs welded at the rim (the Mylar balloon), in the plane z = 0 around the origin.
///
/// `n` elements across the core give 4n on the rim. Parts `top` (layer 0, front up) and `bottom` (layer 1, front down),
/// chamber `air` between; sets `rim`, `centre_top`, `centre_bottom`. The rim is a regular 4n-gon of radius `radius_m`.
///
/// # Errors
/// [`FemError::Mesh`] for a radius out of range, or `n` odd or below 2.
pub fn disc_balloon(radius_m: f64, n: usize) -> Result<Mesh, FemError> {
    positive("disc balloon", "radius_m", radius_m)?;
    even("disc balloon", "n", n)?;
    few_enough("disc balloon", n.saturating_mul(2), n.saturating_mul(3))?;
    let disc = Disc::new(n);
    let mut mesh = Mesh::default();
    let place = |p: [f64; 2]| [radius_m * p[0], radius_m * p[1], 0.0];
    let top: Vec<u32> = disc.points.iter().map(|p| new_node(&mut mesh, place(*p))).collect();
    let mut bottom = Vec::with_capacity(top.len());
    for (i, point) in disc.points.iter().enumerate() {
        bottom.push(if i >= disc.rim { top[i] } else { new_node(&mut mesh, place(*point)) });
    }
    mesh.name("rim", top[disc.rim..].to_vec());
    for (name, nodes, layer) in [("top", &top, 0), ("bottom", &bottom, 1)] {
        mesh.name(format!("centre_{name}"), disc.centre.iter().map(|i| nodes[*i]).collect());
        let quads = disc.quads(nodes, layer == 1);
        mesh.parts.push(Part { layer, ..Part::round("air", name, quads) });
    }
    Ok(mesh)
}

pub(super) struct Disc {
    /// Places of the nodes, the rim last: counter-clockwise from −45°.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) rim: usize,
    /// Nodes in the middle: 1, or 4 around it.
    pub(super) centre: Vec<usize>,
    corners: Vec<[usize; 4]>,
}

impl Disc {
    /// Disc with `n` elements across the core and 4n on the rim.
    pub(super) fn new(n: usize) -> Disc {
        let rings = ((RINGS * n as f64).round() as usize).max(1);
        let core = |i: usize, j: usize| j * (n + 1) + i;
        let mut points: Vec<[f64; 2]> = (0..=n).flat_map(|j| (0..=n).map(move |i| core_point(i, j, n))).collect();
        let edge: Vec<usize> = (0..4 * n).map(|t| perimeter(t, n)).map(|(i, j)| core(i, j)).collect();
        for ring in 1..=rings {
            let share = ring as f64 / rings as f64;
            for (t, inner) in edge.iter().enumerate() {
                let angle = (t as f64 * 2.0 / n as f64 - 1.0) * FRAC_PI_4;
                let [x, y] = points[*inner];
                points.push([x + share * (angle.cos() - x), y + share * (angle.sin() - y)]);
            }
        }
        let at = |ring: usize, t: usize| {
            let t = t % (4 * n);
            if ring == 0 { edge[t] } else { (n + 1) * (n + 1) + (ring - 1) * 4 * n + t }
        };
        let mut corners: Vec<[usize; 4]> = (0..n)
            .flat_map(|j| (0..n).map(move |i| (i, j)))
            .map(|(i, j)| [core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)])
            .collect();
        for (r, t) in (0..rings).flat_map(|r| (0..4 * n).map(move |t| (r, t))) {
            corners.push([at(r, t), at(r + 1, t), at(r + 1, t + 1), at(r, t + 1)]);
        }
        let near = n / 2..=n.div_ceil(2);
        let centre = near.clone().flat_map(|j| near.clone().map(move |i| core(i, j))).collect();
        Disc { rim: at(rings, 0), points, corners, centre }
    }

    /// Elements in the given node numbers; counter-clockwise, or turned over.
    pub(super) fn quads(&self, nodes: &[u32], turned: bool) -> Vec<[u32; 4]> {
        let quad = |c: &[usize; 4]| c.map(|i| nodes[i]);
        self.corners.iter().map(quad).map(|[a, b, c, d]| if turned { [a, d, c, b] } else { [a, b, c, d] }).collect()
    }
}

/// Core node (i, j): part of the way from a square grid to the elliptical map of the square onto the disc.
fn core_point(i: usize, j: usize, n: usize) -> [f64; 2] {
    let [u, v] = [i, j].map(|k| (2.0 * k as f64 - n as f64) / n as f64);
    let bent = |a: f64, b: f64| CORE * a * (1.0 - ROUND + ROUND * (1.0 - 0.5 * b * b).sqrt());
    [bent(u, v), bent(v, u)]
}

/// Core node (i, j) at step `t` counter-clockwise round the edge, from the corner at −45°.
fn perimeter(t: usize, n: usize) -> (usize, usize) {
    let k = t % n;
    match t / n {
        0 => (n, k),
        1 => (n - k, n),
        2 => (0, n - k),
        _ => (k, 0),
    }
}
