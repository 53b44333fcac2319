//! How good the elements are, in their stress-free shape.

use super::chamber::Closed;
use super::elements::{corner, stress_free};
use crate::mesh::Mesh;
use crate::vec3::{V3, area, dot, norm, sub};

/// Of a mesh that passed [`super::check`].
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// Smallest, median and largest length of element sides \[m\].
    pub side_m: LowMidHigh,
    /// Largest ratio of longest to shortest side; 1 is best.
    pub aspect: f64,
    /// Smallest ratio of smallest to largest corner area (Jacobian) of a quad; 1 is best.
    pub jacobian_ratio: f64,
    /// Largest distance of the corners of a quad from its mean plane over the root of its area; 0 is flat.
    pub warpage: f64,
    /// Volume of every chamber at the start \[m³\].
    pub volumes_m3: Vec<(String, f64)>,
    /// Edges at which a chamber touches itself (pouches of one supply line sharing a seam).
    pub seams: usize,
}

/// Smallest, median and largest of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs, reason = "the names say it")]
pub struct LowMidHigh {
    pub min: f64,
    pub median: f64,
    pub max: f64,
}

pub(super) fn measure(mesh: &Mesh, closed: Closed) -> Quality {
    let [mut aspect, mut jacobian_ratio, mut warpage] = [1.0_f64, 1.0, 0.0];
    let mut sides = Vec::with_capacity(4 * mesh.elements());
    for nodes in mesh.faces() {
        let mut corners = [[0.0; 3]; 4];
        let found = measures(stress_free(mesh, nodes, &mut corners), &mut sides);
        (aspect, jacobian_ratio, warpage) = (aspect.max(found[0]), jacobian_ratio.min(found[1]), warpage.max(found[2]));
    }
    let Closed { volumes_m3, seams } = closed;
    Quality { side_m: spread(sides), aspect, jacobian_ratio, warpage, volumes_m3, seams }
}

/// Aspect ratio, Jacobian ratio and warpage of one element; notes the lengths of its sides.
fn measures(x: &[V3], sides: &mut Vec<f64>) -> V3 {
    let normal = area(x);
    let (mut shortest, mut longest) = (f64::INFINITY, 0.0f64);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0f64);
    for k in 0..x.len() {
        let next = sub(x[(k + 1) % x.len()], x[k]);
        let jacobian = dot(corner(x, k), normal) / norm(normal);
        (shortest, longest) = (shortest.min(norm(next)), longest.max(norm(next)));
        (smallest, largest) = (smallest.min(jacobian), largest.max(jacobian));
        sides.push(norm(next));
    }
    if x.len() == 3 {
        return [longest / shortest, 1.0, 0.0];
    }
    let lift = (0..3).map(|k| (x[0][k] - x[1][k] + x[2][k] - x[3][k]) * normal[k]).sum::<f64>() / norm(normal);
    [longest / shortest, smallest / largest, 0.25 * lift.abs() / norm(normal).sqrt()]
}

fn spread(mut values: Vec<f64>) -> LowMidHigh {
    values.sort_unstable_by(f64::total_cmp);
    let at = |i: usize| values.get(i).copied().unwrap_or(0.0);
    LowMidHigh { min: at(0), median: at(values.len() / 2), max: at(values.len().saturating_sub(1)) }
}
