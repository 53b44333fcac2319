//! Closest points on elements, and which feature (face, edge, corner) they lie on.

use super::surface::{ContactSurface, NONE};
use crate::vec3::{Nodes, V3, add, along, cross, dot, node, norm, scale, sub, unit};

/// Where on an element the closest point is, and how the distance from it is measured until the next look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[repr(u8)]
pub(super) enum Feature {
    /// Distance to the plane of the triangle.
    #[default]
    Face,
    /// Distance to the line through the first two corners.
    Edge,
    Corner,
}

/// The closest point of an element to a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Closest {
    pub element: u32,
    pub feature: Feature,
    /// Corners within the element, in the order the feature uses them.
    pub corners: [u8; 3],
    pub(crate) square_m2: f64,
    /// Distance, positive on the front \[m\].
    pub height_m: f64,
    /// Cosine between the way to the node and the normal; ±1 for faces.
    pub cosine: f64,
    /// On an edge or corner where the layer ends.
    pub rim: bool,
    /// Unit normal of the element there.
    pub normal: V3,
}

pub(super) const TRIANGLES: [[u8; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// Closest point of one triangle as weights of its corners (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
pub(super) fn on_triangle(p: V3, a: V3, b: V3, c: V3) -> V3 {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return [1.0 - t, t, 0.0];
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - t, t];
    }
    let total = va + vb + vc;
    [va / total, vb / total, vc / total]
}

/// The point of an element that is nearest to a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    pub(crate) square_m2: f64,
    pub half: usize,
    pub weights: [f64; 3],
}

/// Nearest point of an element; the first half of a quad wins a tie.
#[inline]
pub(super) fn nearest(surface: &ContactSurface, x: &Nodes, p: V3, element: u32) -> Nearest {
    let nodes = &surface.elements[element as usize];
    let halves = if nodes[3] == NONE { 1 } else { 2 };
    let mut best = Nearest { square_m2: f64::INFINITY, half: 0, weights: [0.0; 3] };
    for (half, triangle) in TRIANGLES.iter().enumerate().take(halves) {
        let [a, b, c] = triangle.map(|k| node(x, nodes[k as usize] as usize));
        let weights = on_triangle(p, a, b, c);
        let r = sub(p, blend(weights, a, b, c));
        let square_m2 = dot(r, r);
        if square_m2 < best.square_m2 {
            best = Nearest { square_m2, half, weights };
        }
    }
    best
}

/// Turns a nearest point into a feature. Within `flat_m` of a face its plane is used: there the surface is nearly flat.
pub(super) fn describe(
    surface: &ContactSurface,
    x: &Nodes,
    p: V3,
    element: u32,
    nearest: &Nearest,
    flat_m: f64,
) -> Closest {
    let Nearest { square_m2, half, weights: w } = *nearest;
    let nodes = &surface.elements[element as usize];
    let triangle = TRIANGLES[half];
    let [a, b, c] = triangle.map(|k| node(x, nodes[k as usize] as usize));
    let normal = unit(cross(sub(b, a), sub(c, a))).unwrap_or([0.0; 3]);
    let height = dot(sub(p, a), normal);
    let aside = square_m2 - height * height;
    let face = Closest {
        element,
        feature: Feature::Face,
        corners: triangle,
        square_m2,
        height_m: height,
        cosine: if height < 0.0 { -1.0 } else { 1.0 },
        rim: false,
        normal,
    };
    let free = w.iter().filter(|w| **w > 0.0).count();
    if free == 3 || aside <= flat_m * flat_m {
        return face;
    }
    // The edge is opposite the corner without weight.
    let first = (0..3).find(|k| if free == 2 { w[(k + 2) % 3] == 0.0 } else { w[*k] > 0.0 }).unwrap_or(2);
    let corners = [0, 1, 2].map(|k| triangle[(first + k) % 3]);
    let feature = if free == 2 { Feature::Edge } else { Feature::Corner };
    let (outward, rim) = match feature {
        Feature::Edge => edge_normal(surface, x, element, [corners[0], corners[1]], normal),
        _ => corner_normal(surface, x, element, corners[0]),
    };
    let r = sub(p, blend(w, a, b, c));
    let cosine = dot(r, outward) / (norm(outward) * square_m2.sqrt()).max(f64::MIN_POSITIVE);
    let height_m = if cosine < 0.0 { -square_m2.sqrt() } else { square_m2.sqrt() };
    Closest { feature, corners, height_m, cosine, rim, ..face }
}

/// Unit normal of an element at its middle.
pub(super) fn element_normal(surface: &ContactSurface, x: &Nodes, element: u32) -> V3 {
    let nodes = &surface.elements[element as usize];
    let at = |k: usize| node(x, nodes[k] as usize);
    let (d, e) =
        if nodes[3] == NONE { (sub(at(1), at(0)), sub(at(2), at(0))) } else { (sub(at(2), at(0)), sub(at(3), at(1))) };
    unit(cross(d, e)).unwrap_or([0.0; 3])
}

#[inline(always)]
pub(super) fn blend(w: V3, a: V3, b: V3, c: V3) -> V3 {
    along(along(scale(a, w[0]), w[1], b), w[2], c)
}

/// Sum of the normals on both sides of an edge, and whether there is only one side.
fn edge_normal(surface: &ContactSurface, x: &Nodes, element: u32, edge: [u8; 2], own: V3) -> (V3, bool) {
    let count = surface.corners(element as usize).len() as u8;
    let side = if (edge[0] + 1) % count == edge[1] {
        edge[0]
    } else if (edge[1] + 1) % count == edge[0] {
        edge[1]
    } else {
        return (element_normal(surface, x, element), false);
    };
    match surface.across[element as usize][side as usize] {
        NONE => (own, true),
        other => (add(own, element_normal(surface, x, other)), false),
    }
}

/// Sum of the normals around a corner within the layer, and whether the layer ends there.
fn corner_normal(surface: &ContactSurface, x: &Nodes, element: u32, corner: u8) -> (V3, bool) {
    let layer = surface.layer[element as usize];
    let centre = surface.elements[element as usize][corner as usize];
    let (mut sum, mut rim) = ([0.0; 3], false);
    for &e in surface.around.of(centre as usize).iter().filter(|e| surface.layer[**e as usize] == layer) {
        sum = add(sum, element_normal(surface, x, e));
        let nodes = surface.corners(e as usize);
        let at = nodes.iter().position(|n| *n == centre).unwrap_or(0);
        let before = (at + nodes.len() - 1) % nodes.len();
        let across = &surface.across[e as usize];
        rim |= across[at] == NONE || across[before] == NONE;
    }
    (sum, rim)
}
