//! Where a plane of the reference shape cuts the mesh, drawn as lines where the material is now.
//!
//! The cut stays with the material: elements are cut once, in the shape they started in, and the pieces are drawn at the
//! present positions. What a plane through a bent robot would cut elsewhere does not come in.

use super::{Corner, FINE, Image, PictureLook, check, drawn};
use crate::vec3::{V3, dot, share, sub};
use crate::{FemError, Mesh, Result};

const LINE: f64 = 3.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cut {
    pub normal: [f64; 3],
    /// Its distance from the origin along it \[m\].
    pub at_m: f64,
}

/// Draws a cut. Across the view (its normal along the view's depth at the start) the section is turned to face the viewer.
pub(crate) fn section(mesh: &Mesh, positions: &[V3], values: &[f64], cut: &Cut, look: &PictureLook) -> Result<Image> {
    check(mesh, positions, values, look)?;
    let pieces = pieces(mesh, positions, cut);
    if pieces.is_empty() {
        let at = cut.at_m * 1e3;
        return Err(FemError::Problem(format!(
            "picture: no element is cut by the plane at {at} mm; move it onto the mesh"
        )));
    }
    let axes = facing(&pieces, look.view.axes());
    let flat = |p: [f64; 3]| axes.map(|axis| dot(axis, p));
    let seen: Vec<[f64; 3]> = pieces.iter().flat_map(|piece| piece.1).map(flat).collect();
    let shown: Vec<usize> = pieces.iter().map(|piece| piece.0).collect();
    Ok(drawn(look, axes, &seen, values, &shown, |canvas, place, colour| {
        for (element, ends) in shown.iter().zip(seen.chunks_exact(2)) {
            let [a, b] = [ends[0], ends[1]].map(|p| place.on_canvas([p[0], p[1], 0.0]));
            let length = (b.x - a.x).hypot(b.y - a.y).max(f64::MIN_POSITIVE);
            let half = 0.5 * LINE * FINE as f64;
            let along = [(b.x - a.x) / length * half, (b.y - a.y) / length * half];
            // A little longer than the piece, so that neighbours join.
            let corner = |p: &Corner, s: f64, t: f64| Corner {
                x: p.x + s * 0.4 * along[0] - t * along[1],
                y: p.y + s * 0.4 * along[1] + t * along[0],
                depth: 0.0,
            };
            let corners = [corner(&a, -1.0, -1.0), corner(&b, 1.0, -1.0), corner(&b, 1.0, 1.0), corner(&a, -1.0, 1.0)];
            canvas.element(&corners, colour(*element), 0.0, 0.0);
        }
    }))
}

/// A cut element, and where it is cut now.
type CutElement = (usize, [[f64; 3]; 2]);

fn pieces(mesh: &Mesh, positions: &[V3], cut: &Cut) -> Vec<CutElement> {
    let height: Vec<f64> = (0..mesh.points.len()).map(|n| dot(cut.normal, mesh.start_of(n)) - cut.at_m).collect();
    // A node in the plane counts as behind it: a ring of nodes is then drawn once, by the elements on one side.
    let before = |node: u32| height[node as usize] > 1e-9;
    let mut pieces = Vec::new();
    for (element, nodes) in mesh.faces().enumerate() {
        let sides = (0..nodes.len()).map(|k| (nodes[k], nodes[(k + 1) % nodes.len()]));
        let ends: Vec<[f64; 3]> = sides
            .filter(|(a, b)| before(*a) != before(*b))
            .map(|(a, b)| {
                let (h, g) = (height[a as usize], height[b as usize]);
                let (p, q) = (positions[a as usize], positions[b as usize]);
                [0, 1, 2].map(|k| p[k] + (q[k] - p[k]) * h / (h - g))
            })
            .collect();
        if let [a, b] = ends[..] {
            pieces.push((element, [a, b]));
        }
    }
    pieces
}

/// The view's axes, turned about its right so that it looks along the normal of the points' mean plane.
fn facing(pieces: &[CutElement], axes: [V3; 3]) -> [V3; 3] {
    let [right, up, towards] = axes;
    let all = || pieces.iter().flat_map(|piece| piece.1);
    let count = all().count() as f64;
    let mean = all().fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k] / count));
    // Regression of depth on height: the plane's tilt about the right.
    let (mut high, mut deep) = (0.0, 0.0);
    for p in all() {
        let d = sub(p, mean);
        high += dot(d, up) * dot(d, up);
        deep += dot(d, up) * dot(d, towards);
    }
    let (s, c) = share(deep, high).atan().sin_cos();
    let mix = |a: [f64; 3], x: f64, b: [f64; 3], y: f64| [0, 1, 2].map(|k| a[k] * x + b[k] * y);
    [right, mix(up, c, towards, s), mix(towards, c, up, -s)]
}

#[cfg(test)]
mod tests {
    use super::super::Viewpoint;
    use super::*;
    use crate::mesh::generate::{Around, Cap, Tube, tube};

    #[test]
    fn the_section_of_a_turned_tube_is_its_circle_seen_face_on() {
        let mesh = tube(&Tube {
            radius_m: 0.04,
            length_m: 0.2,
            around: Around::Even(24),
            along: 8,
            caps: [Cap::Open, Cap::Open],
            warp_rad: 0.0,
        })
        .unwrap();
        let (s, c) = 0.9_f64.sin_cos();
        let turned: Vec<[f64; 3]> =
            mesh.points.iter().map(|p| [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]]).collect();
        let cut = Cut { normal: [1.0, 0.0, 0.0], at_m: 0.11 };
        let found = pieces(&mesh, &turned, &cut);
        assert_eq!(found.len(), 24);
        let axes = facing(&found, Viewpoint::End.axes());
        let centre = [0.11 * c, 0.11 * s, 0.0];
        for p in found.iter().flat_map(|piece| piece.1) {
            let d = sub(p, centre);
            assert!((dot(d, axes[0]).hypot(dot(d, axes[1])) - 0.04).abs() < 1e-6 && dot(d, axes[2]).abs() < 1e-9);
        }
        let look = PictureLook { view: Viewpoint::End, ..PictureLook::default() };
        assert!(section(&mesh, &turned, &[], &cut, &look).is_ok());
        let beside = Cut { at_m: 0.5, ..cut };
        assert!(section(&mesh, &turned, &[], &beside, &look).unwrap_err().to_string().contains("500 mm"));
    }
}
