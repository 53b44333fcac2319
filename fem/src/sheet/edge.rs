//! Curvature along a free edge.
//!
//! ```text
//! κ_s = ∂²x/∂s² − k_g ∂x/∂n       ∂²x/∂s² = 2/(d₋ + d₊) [(x₊ − x)/d₊ + (x₋ − x)/d₋]
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | x₋, x, x₊ | neighbouring nodes of the edge, d₋ and d₊ apart | m |
//! | k_g | curvature of the edge within the reference sheet; 0 for a straight edge | 1/m |
//! | ∂/∂n | slope from the edge into the sheet, from all nodes of the elements round x | 1/m |
//!
//! A straight edge bends as a beam; a curved one does not pay for the curve that it was cut along. No moment acts about
//! the edge. Derived here.

use crate::vec3::{V3, along, cross, direction, dot};

/// An edge that turns by more than this within the sheet \[rad\] is a corner.
const LARGEST_TURN: f64 = 0.5;
/// Turns below this are rounding \[rad\]; without them a row of a straight edge has three nodes.
const SMALLEST_TURN: f64 = 1e-9;

/// Weights of κ_s \[1/m²\] for the neighbours on the edge and, at a curved edge, all nodes `around`; offsets are from
/// the node \[m\]. `None` at a corner.
pub fn weights(edge: [(u32, V3); 2], around: &[(u32, V3)], normal: V3) -> Option<Vec<(u32, f64)>> {
    let length = edge.map(|(_, x)| dot(x, x).sqrt());
    let own = [0, 1].map(|k| 2.0 / ((length[0] + length[1]) * length[k]));
    let second = along(edge[0].1.map(|c| own[0] * c), own[1], edge[1].1);
    let bent = along(second, -dot(second, normal), normal);
    let turn = 0.5 * (length[0] + length[1]) * dot(bent, bent).sqrt();
    if turn.is_nan() || turn > LARGEST_TURN {
        return None;
    }
    let mut all = vec![(edge[0].0, own[0]), (edge[1].0, own[1])];
    if turn > SMALLEST_TURN {
        // Σ c_j X_j = bent with the smallest Σ c_j²: c_j = X_j · M⁻¹ bent, M = Σ X_j X_jᵀ.
        let first = direction(along(bent, -dot(bent, normal), normal));
        let axes = [first, cross(normal, first)];
        let flat: Vec<[f64; 2]> = around.iter().map(|(_, x)| axes.map(|a| dot(*x, a))).collect();
        let sum = |a: usize, b: usize| flat.iter().map(|x| x[a] * x[b]).sum::<f64>();
        let (m11, m22, m12) = (sum(0, 0), sum(1, 1), sum(0, 1));
        let determinant = m11 * m22 - m12 * m12;
        let size = dot(bent, first);
        let slope = [size * m22 / determinant, -size * m12 / determinant];
        all.extend(around.iter().zip(&flat).map(|((n, _), x)| (*n, -(x[0] * slope[0] + x[1] * slope[1]))));
    }
    let mut merged = std::collections::BTreeMap::new();
    all.into_iter().for_each(|(n, w)| *merged.entry(n).or_insert(0.0) += w);
    Some(merged.into_iter().collect())
}

#[cfg(test)]
mod tests {
    use crate::mesh::generate::{Distortion, disc_balloon, plate};
    use crate::sheet::bending::{CurvatureRow, curvature_rows};

    fn curvature(row: &CurvatureRow, place: impl Fn(u32) -> [f64; 3]) -> [f64; 3] {
        let sum = |k: usize| row.weights.iter().map(|(n, w)| w * place(*n)[k]).sum::<f64>() / row.area;
        [sum(0), sum(1), sum(2)]
    }

    #[test]
    fn a_flat_sheet_cut_along_a_circle_has_no_curvature_anywhere() {
        let mesh = disc_balloon(0.1, 12).unwrap();
        let rows = curvature_rows(&mesh, &[1.0, 0.0]);
        let rim = &mesh.sets["rim"];
        assert_eq!(rows.iter().filter(|row| rim.contains(&row.node)).count(), rim.len());
        for row in rows {
            let h = curvature(&row, |n| mesh.points[n as usize]);
            assert!(h.iter().all(|c| c.abs() * 0.1 < 1e-10), "node {}: {h:?}", row.node);
        }
    }

    #[test]
    fn the_edge_of_a_sphere_cap_bends_along_itself() {
        // The rim of z = κ r²/2 has normal curvature κ along the edge and turns within the sheet by 1/r.
        let mesh = disc_balloon(0.1, 24).unwrap();
        let rows = curvature_rows(&mesh, &[1.0, 0.0]);
        let bowl = |n: u32| {
            let [x, y, _] = mesh.points[n as usize];
            [x, y, 0.5 * (x * x + y * y)]
        };
        for row in rows.iter().filter(|row| mesh.sets["rim"].contains(&row.node)) {
            let h = curvature(row, bowl)[2];
            assert!((h - 1.0).abs() < 0.1, "node {}: {h}", row.node);
        }
    }

    #[test]
    fn the_rows_of_a_plate_cover_it_but_for_its_corners() {
        let mesh = plate(0.2, 0.1, 8, 4, Some(Distortion { share: 0.2, seed: 1 })).unwrap();
        let rows = curvature_rows(&mesh, &[1.0]);
        let covered: f64 = rows.iter().map(|row| row.area).sum();
        assert_eq!(rows.len(), mesh.points.len() - 4);
        assert!(covered < 0.02 && covered > 0.02 * (1.0 - 2.0 / 32.0), "{covered}");
    }
}
