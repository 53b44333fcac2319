//! Two flat rectangles on top of each other that share some of their edges.
//!
//! ```text
//!        front ↑                 part `top`,    layer 0, back = `air`
//!   ●━━━━━━━━━━━━━━━●  welded
//!        front ↓                 part `bottom`, layer 1, back = `air`
//! ```

use super::grid::{Grid, union};
use super::{at_least, even, few_enough, positive};
use crate::mesh::{Mesh, Part};
use crate::{FemError, Result};

/// Square pillow: two layers `side_m` by `side_m` of `n` by `n` quads, welded along all four edges, centred on the z axis.
///
/// The stress-free shape is flat, both layers at z = 0. With `gap_m` above 0 the inner nodes start at z = ±`gap_m`/2.
/// Parts `top` (layer 0, front up) and `bottom` (layer 1, front down), chamber `air` between. Sets `rim`, `corners`,
/// `mid_edges` (4 nodes), `mid_edge` (the one at x > 0), `centre_top`, `centre_bottom`.
///
/// ```
/// let mesh = fem::mesh::generate::pillow(0.1, 4, 0.0).unwrap();
/// // Two layers share the nodes of the weld.
/// assert_eq!((mesh.elements(), mesh.points.len()), (2 * 16, 2 * 25 - 16));
/// assert!(fem::mesh::check::check(&mesh, &["air"]).is_ok(), "no leak");
/// ```
///
/// # Errors
/// [`FemError::Mesh`] for a length out of range, or `n` odd or below 2.
pub fn pillow(side_m: f64, n: usize, gap_m: f64) -> Result<Mesh> {
    positive("pillow", "side_m", side_m)?;
    even("pillow", "n", n)?;
    few_enough("pillow", n, n.saturating_mul(2))?;
    let size = [side_m, side_m];
    let (mut mesh, top, bottom) = two_layers(size, [n, n], |i, j| i == 0 || j == 0 || i == n || j == n);
    name_centres(&mut mesh, &top, &bottom);
    mesh.name("rim", top.rim());
    mesh.name("corners", top.corners());
    let middles = vec![top.at(n / 2, 0), top.at(n, n / 2), top.at(n / 2, n), top.at(0, n / 2)];
    mesh.name("mid_edge", vec![middles[1]]);
    mesh.name("mid_edges", middles);
    open_gap(&mut mesh, &top, &bottom, gap_m)?;
    Ok(mesh)
}

/// Strip of an endlessly wide pouch: two layers `length_flat_m` (x) by `width_m` (y), welded along the two short edges
/// x = ±`length_flat_m`/2 and open at both sides y = ±`width_m`/2.
///
/// The sides are planes of symmetry: hold the nodes of `open_0` and `open_1` in y, and pass these two names to
/// [`crate::mesh::check::check_open`]. The inner nodes start at z = ±`gap_m`/2. Sets `left`, `right` (the welds), `open_0`
/// (y < 0), `open_1`, `middle` (the line y = 0 of both layers), `centre_top`, `centre_bottom`. Parts and chamber as in
/// [`pillow`].
///
/// ```
/// let mesh = fem::mesh::generate::long_pouch(0.06, 0.02, 6, 2, 0.0).unwrap();
/// assert!(fem::mesh::check::check(&mesh, &["air"]).is_err(), "open at both sides");
/// assert!(fem::mesh::check::check_open(&mesh, &["air"], &["open_0", "open_1"]).is_ok());
/// ```
///
/// # Errors
/// [`FemError::Mesh`] for a length out of range, `n` (along x) or `m` (along y) odd or below 2.
pub fn long_pouch(length_flat_m: f64, width_m: f64, n: usize, m: usize, gap_m: f64) -> Result<Mesh> {
    positive("long pouch", "length_flat_m", length_flat_m)?;
    positive("long pouch", "width_m", width_m)?;
    even("long pouch", "n", n)?;
    even("long pouch", "m", m)?;
    few_enough("long pouch", n, m.saturating_mul(2))?;
    let (mut mesh, top, bottom) = two_layers([length_flat_m, width_m], [n, m], |i, _| i == 0 || i == n);
    name_centres(&mut mesh, &top, &bottom);
    mesh.name("left", top.column(0));
    mesh.name("right", top.column(n));
    mesh.name("open_0", union([top.row(0), bottom.row(0)]));
    mesh.name("open_1", union([top.row(m), bottom.row(m)]));
    mesh.name("middle", union([top.row(m / 2), bottom.row(m / 2)]));
    open_gap(&mut mesh, &top, &bottom, gap_m)?;
    Ok(mesh)
}

/// Flat tube along x with pinched, welded ends: a fabric muscle (fPAM) as it is cut from the bolt, 0 ≤ x ≤ `length_m`,
/// |y| ≤ `flat_width_m`/2.
///
/// The warp runs round the tube as one helix at `warp_rad` to the axis, counter-clockwise seen from outside; at ±45° the
/// weave is the same on both layers. Free contraction needs supports that remove rigid motion only: hold the node
/// `anchor` (middle of end 0) in x, y, z, `anchor_end` (middle of end 1) in y and z, and `corners_0` in z; end 1 is free to
/// come closer. The pinched ends disturb about one flat width; the contraction of the undisturbed part is the change of the
/// distance between the rings `gauge_0` and `gauge_1` at a quarter and three quarters of the length.
///
/// Sets `end_0`, `end_1` (the welds), `corners_0`, `anchor`, `anchor_end`, `gauge_0`, `gauge_1`, `centre_top`,
/// `centre_bottom`. Parts and chamber as in [`pillow`]; the inner nodes start at z = ±`gap_m`/2.
///
/// # Errors
/// [`FemError::Mesh`] for a length out of range, `n_w` (across) odd or below 2, `n_l` (along) not a multiple of 4.
pub fn flat_tube(flat_width_m: f64, length_m: f64, n_w: usize, n_l: usize, warp_rad: f64, gap_m: f64) -> Result<Mesh> {
    positive("flat tube", "flat_width_m", flat_width_m)?;
    positive("flat tube", "length_m", length_m)?;
    even("flat tube", "n_w", n_w)?;
    at_least("flat tube", "n_l", n_l, 4)?;
    few_enough("flat tube", n_l, n_w.saturating_mul(2))?;
    if !n_l.is_multiple_of(4) || !warp_rad.is_finite() {
        let message = "flat tube: n_l must be a multiple of 4 (gauge rings at the quarters), the angle a number";
        return Err(FemError::Mesh(format!("{message}; found {n_l} and {warp_rad}")));
    }
    let edge = |i, j| i == 0 || j == 0 || i == n_l || j == n_w;
    let (mut mesh, top, bottom) = two_layers([length_m, flat_width_m], [n_l, n_w], edge);
    for point in &mut mesh.points {
        point[0] += 0.5 * length_m;
    }
    name_centres(&mut mesh, &top, &bottom);
    for (name, nodes) in [
        ("end_0", top.column(0)),
        ("end_1", top.column(n_l)),
        ("corners_0", vec![top.at(0, 0), top.at(0, n_w)]),
        ("anchor", vec![top.at(0, n_w / 2)]),
        ("anchor_end", vec![top.at(n_l, n_w / 2)]),
        ("gauge_0", union([top.column(n_l / 4), bottom.column(n_l / 4)])),
        ("gauge_1", union([top.column(n_l / 4 * 3), bottom.column(n_l / 4 * 3)])),
    ] {
        mesh.name(name, nodes);
    }
    // Seen from below, the same turn from the axis has the other sign in y.
    mesh.parts[0].warp = vec![[warp_rad.cos(), warp_rad.sin(), 0.0]];
    mesh.parts[1].warp = vec![[warp_rad.cos(), -warp_rad.sin(), 0.0]];
    open_gap(&mut mesh, &top, &bottom, gap_m)?;
    Ok(mesh)
}

/// Parts `top` and `bottom` of `size` centred on the origin, with common nodes where `shared` is true.
fn two_layers(size: [f64; 2], n: [usize; 2], shared: impl Fn(usize, usize) -> bool) -> (Mesh, Grid, Grid) {
    // Measured from the middle, so that mirrored nodes have mirrored bits.
    let at = |i: usize, n: usize, length: f64| (2.0 * i as f64 - n as f64) / (2.0 * n as f64) * length;
    let place = |i: usize, j: usize| [at(i, n[0], size[0]), at(j, n[1], size[1]), 0.0];
    let mut mesh = Mesh::default();
    let top = Grid::add(&mut mesh, n[0], n[1], place);
    let bottom = Grid::sharing(&mut mesh, n[0], n[1], place, |i, j| shared(i, j).then(|| top.at(i, j)));
    mesh.parts = vec![
        Part::round("air", "top", top.quads()),
        Part { layer: 1, ..Part::round("air", "bottom", bottom.quads_turned()) },
    ];
    (mesh, top, bottom)
}

fn name_centres(mesh: &mut Mesh, top: &Grid, bottom: &Grid) {
    mesh.name("centre_top", top.middle());
    mesh.name("centre_bottom", bottom.middle());
}

/// Starts the nodes that the layers do not share half the gap above and below.
fn open_gap(mesh: &mut Mesh, top: &Grid, bottom: &Grid, gap_m: f64) -> Result<()> {
    if !(gap_m.is_finite() && gap_m >= 0.0) {
        return Err(FemError::Mesh(format!("gap_m is {gap_m}, and must be 0 or a positive length in metres")));
    }
    if gap_m == 0.0 {
        return Ok(());
    }
    mesh.start = mesh.points.clone();
    for (i, j) in (0..=top.nv).flat_map(|j| (0..=top.nu).map(move |i| (i, j))) {
        if top.at(i, j) != bottom.at(i, j) {
            mesh.start[top.at(i, j) as usize][2] = 0.5 * gap_m;
            mesh.start[bottom.at(i, j) as usize][2] = -0.5 * gap_m;
        }
    }
    Ok(())
}
