//! A pouch with a Z-fold at each side, laid flat: four layers that inflate to a cylinder.
//!
//! ```text
//!   z ↑   ●━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━●    top          layer 3, front ↑
//!     │   ●━━━━━━━━●             ●━━━━━━━━●    left, right upper  layers 5, 2, front ↓
//!     │   ●━━━━━━━━●             ●━━━━━━━━●    left, right lower  layers 4, 1, front ↑
//!     │   ●━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━━●    bottom       layer 0, front ↓
//!     └────────────────────────────────────→ y     all four layers welded at x = 0 and x = length
//! ```

use std::collections::HashMap;

use super::grid::{Grid, union};
use super::{at_least, few_enough, positive};
use crate::mesh::{Mesh, Part};
use crate::{FemError, Result};

/// Long pouch welded at both ends, with a gusset fold along each side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldedPouch {
    /// Length between the two welded ends, along x \[m\].
    pub length_m: f64,
    /// Flat width of the pouch along y \[m\].
    pub width_m: f64,
    /// Depth of the folds \[m\], below half the width.
    pub fold_m: f64,
    /// Distance between layers at the start \[m\].
    pub gap_m: f64,
    /// Number of elements along the pouch, in x.
    pub along: usize,
    /// Elements over the depth of a fold; those over the width have the same size as nearly as it goes.
    pub in_fold: usize,
}

/// One flat panel: name, contact layer, level above the bottom, and which side it is on (−1, 0 whole width, 1).
type FlatPanel = (&'static str, u32, usize, i8);

/// In this order a panel finds the nodes that it shares with earlier ones.
const PANELS: [FlatPanel; 6] = [
    ("bottom", 0, 0, 0),
    ("right_lower", 1, 1, 1),
    ("right_upper", 2, 2, 1),
    ("top", 3, 3, 0),
    ("left_lower", 4, 1, -1),
    ("left_upper", 5, 2, -1),
];

/// Folded pouch between x = 0 and `length_m`, centred on y = 0, chamber `air`. The stress-free shape is flat; layers start
/// `gap_m` apart.
///
/// Sets `ends` (the welds), `middle_top`, `middle_bottom` (a node each), `creases`.
///
/// # Errors
/// [`FemError::Mesh`] for a length or count out of range, or folds that would meet.
pub fn folded_pouch(pouch: &FoldedPouch) -> Result<Mesh> {
    let what = "folded pouch";
    for (name, value) in [("length_m", pouch.length_m), ("fold_m", pouch.fold_m), ("gap_m", pouch.gap_m)] {
        positive(what, name, value)?;
    }
    at_least(what, "along", pouch.along, 2)?;
    at_least(what, "in_fold", pouch.in_fold, 1)?;
    let rest_m = pouch.width_m - 2.0 * pouch.fold_m;
    if !(rest_m > 0.0 && rest_m.is_finite()) {
        return Err(FemError::Mesh(format!(
            "{what}: width_m is {}, and must be more than two folds of {} m",
            pouch.width_m, pouch.fold_m
        )));
    }
    let between = (rest_m / pouch.fold_m * pouch.in_fold as f64).round().max(1.0) as usize;
    few_enough(what, pouch.along, 6 * pouch.in_fold + 2 * between)?;
    let mut known = HashMap::new();
    let (mut mesh, mut creases, mut heights) = (Mesh::default(), Vec::new(), Vec::new());
    for panel in &PANELS {
        let grid = add(&mut mesh, pouch, between, panel, &mut known);
        heights.resize(mesh.points.len(), 0.0);
        name_nodes(&mut mesh, panel, &grid, &mut creases);
        let turned = matches!(panel.0, "bottom" | "right_upper" | "left_upper");
        let quads = if turned { grid.quads_turned() } else { grid.quads() };
        mesh.parts.push(Part { layer: panel.1, ..Part::round("air", panel.0, quads) });
    }
    for ((joint, ..), node) in known {
        heights[node as usize] = joint.height() * pouch.gap_m;
    }
    mesh.start = mesh.points.iter().zip(heights).map(|(p, z)| [p[0], p[1], z]).collect();
    mesh.name("creases", union(creases));
    Ok(mesh)
}

/// What a node belongs to, and so who shares it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum NodeOwner {
    Inside(usize, i8),
    /// Crease between this level and the next.
    Crease(usize, i8),
    Weld,
}

impl NodeOwner {
    /// Height at the start in gaps.
    fn height(self) -> f64 {
        match self {
            NodeOwner::Inside(level, _) => level as f64,
            NodeOwner::Crease(level, _) => level as f64 + 0.5,
            NodeOwner::Weld => 1.5,
        }
    }

    /// Of the node in column `i` of `along` and at place `j` of `0..=last` across the pouch.
    fn of(panel: &FlatPanel, [i, along]: [usize; 2], [j, last, fold]: [usize; 3]) -> NodeOwner {
        let (_, _, level, side) = *panel;
        if i == 0 || i == along {
            return NodeOwner::Weld;
        }
        // Lower and upper half of a fold meet inside; both meet bottom and top at the edges of the pouch.
        match j {
            0 => NodeOwner::Crease(if level < 2 { 0 } else { 2 }, -1),
            _ if j == last => NodeOwner::Crease(if level < 2 { 0 } else { 2 }, 1),
            _ if side == -1 && j == fold || side == 1 && j == last - fold => NodeOwner::Crease(1, side),
            _ => NodeOwner::Inside(level, side),
        }
    }
}

/// Adds the nodes of a panel, except those that earlier panels share.
fn add(
    mesh: &mut Mesh,
    pouch: &FoldedPouch,
    between: usize,
    panel: &FlatPanel,
    known: &mut HashMap<(NodeOwner, usize, usize), u32>,
) -> Grid {
    let (fold, last) = (pouch.in_fold, 2 * pouch.in_fold + between);
    let (first, count) = match panel.3 {
        -1 => (0, fold),
        1 => (last - fold, fold),
        _ => (0, last),
    };
    let key = |i: usize, j: usize| {
        let j = first + j;
        (NodeOwner::of(panel, [i, pouch.along], [j, last, fold]), i, j)
    };
    let place =
        |i: usize, j: usize| [i as f64 / pouch.along as f64 * pouch.length_m, across_m(pouch, between, first + j), 0.0];
    let grid = Grid::sharing(mesh, pouch.along, count, place, |i, j| known.get(&key(i, j)).copied());
    for (i, j) in (0..=count).flat_map(|j| (0..=pouch.along).map(move |i| (i, j))) {
        known.insert(key(i, j), grid.at(i, j));
    }
    grid
}

/// Place `j` across the pouch \[m\]: even steps in the folds and between them.
fn across_m(pouch: &FoldedPouch, between: usize, j: usize) -> f64 {
    let (fold, half) = (pouch.in_fold, 0.5 * pouch.width_m);
    let step = pouch.fold_m / fold as f64;
    let inner = (pouch.width_m - 2.0 * pouch.fold_m) / between as f64;
    match j {
        _ if j <= fold => j as f64 * step - half,
        _ if j <= fold + between => (j - fold) as f64 * inner + pouch.fold_m - half,
        _ => half - (2 * fold + between - j) as f64 * step,
    }
}

fn name_nodes(mesh: &mut Mesh, panel: &FlatPanel, grid: &Grid, creases: &mut Vec<Vec<u32>>) {
    if panel.3 != 0 {
        creases.extend([grid.row(0), grid.row(grid.nv)]);
        return;
    }
    mesh.name(format!("middle_{}", panel.0), vec![grid.at(grid.nu / 2, grid.nv / 2)]);
    let ends = mesh.sets.entry("ends".into()).or_default();
    *ends = union([std::mem::take(ends), grid.column(0), grid.column(grid.nu)]);
}

#[cfg(test)]
mod tests {
    use super::*;

    const POUCH: FoldedPouch =
        FoldedPouch { length_m: 0.06, width_m: 0.06, fold_m: 0.024, gap_m: 1e-5, along: 20, in_fold: 8 };

    #[test]
    fn a_folded_pouch_is_closed_and_has_the_fabric_of_its_developed_shape() {
        let mesh = folded_pouch(&POUCH).unwrap();
        let quality = crate::mesh::check::check(&mesh, &["air"]).unwrap();
        assert_eq!(mesh.elements(), 20 * (2 * 20 + 4 * 8));
        assert!((quality.side_m.min - 3e-3).abs() < 1e-12);
        assert_eq!(mesh.start.iter().map(|p| (p[2] / 1e-5 * 2.0).round() as i64).max(), Some(6));
    }

    #[test]
    fn folds_that_meet_are_refused() {
        let error = folded_pouch(&FoldedPouch { fold_m: 0.03, ..POUCH }).unwrap_err().to_string();
        assert!(error.contains("more than two folds"), "{error}");
    }
}
