//! Flat sheets: one plate, or two that cross.

use super::grid::{Grid, union};
use super::{at_least, few_enough, positive};
use crate::mesh::{Mesh, Part};
use crate::random::Draws;
use crate::{FemError, Result};

/// Random in-plane shift of the inner nodes, for patch tests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distortion {
    /// Largest shift as a share of the element's sides, below .25 so that no element turns inside out.
    pub share: f64,
    /// Seed; the same seed gives the same mesh on every machine.
    pub seed: u64,
}

/// Rectangle 0 ≤ x ≤ `lx_m`, 0 ≤ y ≤ `ly_m` in the plane z = 0, front up; part `plate`.
///
/// Sets `left` (x = 0), `right`, `bottom` (y = 0), `top`, `corners`, `centre` (the 1, 2 or 4 nodes nearest to it).
///
/// ```
/// let mesh = fem::mesh::generate::plate(0.2, 0.1, 4, 2, None).unwrap();
/// assert_eq!((mesh.elements(), mesh.points.len(), mesh.sets["left"].len()), (4 * 2, 5 * 3, 3));
/// ```
///
/// # Errors
/// [`FemError::Mesh`] for a length, count or distortion out of range.
pub fn plate(lx_m: f64, ly_m: f64, nx: usize, ny: usize, distortion: Option<Distortion>) -> Result<Mesh> {
    positive("plate", "lx_m", lx_m)?;
    positive("plate", "ly_m", ly_m)?;
    at_least("plate", "nx", nx, 1)?;
    at_least("plate", "ny", ny, 1)?;
    few_enough("plate", nx, ny)?;
    let mut mesh = Mesh::default();
    let (dx, dy) = (lx_m / nx as f64, ly_m / ny as f64);
    let grid = Grid::add(&mut mesh, nx, ny, |i, j| [i as f64 * dx, j as f64 * dy, 0.0]);
    for (name, nodes) in [
        ("left", grid.column(0)),
        ("right", grid.column(nx)),
        ("bottom", grid.row(0)),
        ("top", grid.row(ny)),
        ("corners", grid.corners()),
        ("centre", grid.middle()),
    ] {
        mesh.name(name, nodes);
    }
    if let Some(distortion) = distortion {
        distort(&mut mesh, &grid, distortion, [dx, dy])?;
    }
    mesh.parts.push(Part::of("plate", grid.quads()));
    Ok(mesh)
}

/// Two strips without chambers: `lower` along x in the plane z = 0, `upper` along y at z = `gap_m`, each `length_m` by
/// `width_m`, both centred on the z axis. Both fronts are up, layers 0 and 1.
///
/// The upper strip has one column of elements less, so that nodes of the two strips do not coincide. Sets
/// `lower`, `upper` (all nodes), `lower_ends`, `upper_ends` (short edges).
///
/// # Errors
/// [`FemError::Mesh`] for a length or count (`n` elements over the width, at least 2) out of range.
pub fn crossed_sheets(length_m: f64, width_m: f64, n: usize, gap_m: f64) -> Result<Mesh> {
    positive("crossed sheets", "length_m", length_m)?;
    positive("crossed sheets", "width_m", width_m)?;
    positive("crossed sheets", "gap_m", gap_m)?;
    at_least("crossed sheets", "n", n, 2)?;
    let along = (n as f64 * length_m / width_m).round().max(2.0) as usize;
    few_enough("crossed sheets", along, n)?;
    let at = |i: usize, n: usize, length: f64| (i as f64 / n as f64 - 0.5) * length;
    let mut mesh = Mesh::default();
    let lower = Grid::add(&mut mesh, along, n, |i, j| [at(i, along, length_m), at(j, n, width_m), 0.0]);
    let upper =
        Grid::add(&mut mesh, n - 1, along - 1, |i, j| [at(i, n - 1, width_m), at(j, along - 1, length_m), gap_m]);
    let count = (along + 1) * (n + 1);
    mesh.name("lower", (0..count as u32).collect());
    mesh.name("upper", (count as u32..mesh.points.len() as u32).collect());
    mesh.name("lower_ends", union([lower.column(0), lower.column(along)]));
    mesh.name("upper_ends", union([upper.row(0), upper.row(along - 1)]));
    mesh.parts.push(Part::of("lower", lower.quads()));
    mesh.parts.push(Part { layer: 1, ..Part::of("upper", upper.quads()) });
    Ok(mesh)
}

/// Shifts the inner nodes in the plane.
fn distort(mesh: &mut Mesh, grid: &Grid, distortion: Distortion, side: [f64; 2]) -> Result<()> {
    let share = distortion.share;
    if !(0.0..0.25).contains(&share) {
        return Err(FemError::Mesh(format!("plate: distortion is {share}, and must be at least 0 and below 0.25")));
    }
    let mut draws = Draws(distortion.seed);
    for j in 1..grid.nv {
        for i in 1..grid.nu {
            let point = &mut mesh.points[grid.at(i, j) as usize];
            for k in 0..2 {
                point[k] += share * side[k] * (2.0 * draws.next() - 1.0);
            }
        }
    }
    Ok(())
}
