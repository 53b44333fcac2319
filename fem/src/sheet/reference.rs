//! What an element knows of its stress-free shape.
//!
//! ```text
//!   4 ───── 3     F_a = Σ_n B_na x_n at the centre.  For a quadrilateral B₃ = −B₁ and B₄ = −B₂, so
//!   │       │     F_a = B₁a (x₁ − x₃) + B₂a (x₂ − x₄)
//!   1 ───── 2     γ_n = ¼ (h_n − Σ_a s_a B_na),  h = (1, −1, 1, −1),  s_a = Σ_n h_n X_na
//! ```
//! a = 1 warp, 2 fill. Reference: Flanagan, Belytschko 1981 (one-point quadrature, hourglass vector γ).

use crate::policy;
use crate::problem::Section;
use crate::problem::start::X;
use crate::vec3::{Nodes, V3, along, area, cross, direction, dot, norm, sub};
use models::Fabric;

/// Geometry of one element in its stress-free shape: gradients, area and axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// Gradient of the shape functions in (warp, fill): of corners 1 and 2 for a quadrilateral (3 and 4 are their
    /// negatives), of corners 2 and 3 for a triangle (1 is minus their sum) \[1/m\].
    pub b: [[f64; 2]; 2],
    /// s_a of the hourglass vector \[m\]; zero for a triangle.
    pub s: [f64; 2],
    /// Area of the stress-free element \[m²\].
    pub area: f64,
    /// Warp and fill directions in space.
    pub axes: [[f64; 3]; 2],
}

impl Reference {
    /// From the reference corners (3 or 4), the warp direction of the part and the ply's angle to it.
    pub fn new(corner: &[V3], warp: Option<V3>, angle_rad: f64) -> Reference {
        let axes = axes(direction(area(corner)), warp, angle_rad);
        let flat: Vec<[f64; 2]> =
            corner.iter().map(|x| sub(*x, corner[0])).map(|x| [dot(x, axes[0]), dot(x, axes[1])]).collect();
        if corner.len() == 4 { quad(&flat, axes) } else { triangle(&flat, axes) }
    }

    /// Gradient of corner `n`'s shape function for an element of `corners` corners.
    pub fn gradient(&self, corners: usize, n: usize) -> [f64; 2] {
        let [p, q] = self.b;
        match (corners, n) {
            (4, 0) => p,
            (4, 1) => q,
            (4, 2) => [-p[0], -p[1]],
            (4, _) => [-q[0], -q[1]],
            (_, 0) => [-p[0] - q[0], -p[1] - q[1]],
            (_, 1) => p,
            _ => q,
        }
    }

    /// Σ_n B_na B_nb, the 2×2 matrix (11, 22, 12) that sets the element's highest frequency \[1/m²\].
    pub fn metric(&self, corners: usize) -> V3 {
        let mut g = [0.0; 3];
        for n in 0..corners {
            let b = self.gradient(corners, n);
            g[0] += b[0] * b[0];
            g[1] += b[1] * b[1];
            g[2] += b[0] * b[1];
        }
        g
    }
}

fn axes(normal: V3, warp: Option<V3>, angle_rad: f64) -> [V3; 2] {
    // Any direction will do across x: a sheet with directions is refused without a warp there.
    let any = if policy::is_in_sheet(norm(cross(X, normal))) { X } else { [0.0, 1.0, 0.0] };
    let wanted = warp.unwrap_or(any);
    let warp = direction(along(wanted, -dot(wanted, normal), normal));
    let fill = cross(normal, warp);
    let (sin, cos) = angle_rad.sin_cos();
    let first = along([warp[0] * cos, warp[1] * cos, warp[2] * cos], sin, fill);
    [first, cross(normal, first)]
}

fn quad(x: &[[f64; 2]], axes: [V3; 2]) -> Reference {
    let d13 = [x[2][0] - x[0][0], x[2][1] - x[0][1]];
    let d24 = [x[3][0] - x[1][0], x[3][1] - x[1][1]];
    let twice = d13[0] * d24[1] - d13[1] * d24[0];
    let h = |k: usize| x[0][k] - x[1][k] + x[2][k] - x[3][k];
    Reference {
        b: [[-d24[1] / twice, d24[0] / twice], [d13[1] / twice, -d13[0] / twice]],
        s: [h(0), h(1)],
        area: 0.5 * twice,
        axes,
    }
}

fn triangle(x: &[[f64; 2]], axes: [V3; 2]) -> Reference {
    let p = [x[1][0] - x[0][0], x[1][1] - x[0][1]];
    let q = [x[2][0] - x[0][0], x[2][1] - x[0][1]];
    let twice = p[0] * q[1] - p[1] * q[0];
    Reference {
        b: [[q[1] / twice, -q[0] / twice], [-p[1] / twice, p[0] / twice]],
        s: [0.0; 2],
        area: 0.5 * twice,
        axes,
    }
}

/// Strain (E₁₁, E₂₂, 2E₁₂) of the columns of a deformation gradient, E = ½(FᵀF − 1).
pub(crate) fn strain([f1, f2]: [V3; 2]) -> V3 {
    [0.5 * (dot(f1, f1) - 1.0), 0.5 * (dot(f2, f2) - 1.0), dot(f1, f2)]
}

/// Mean in-plane stiffness ½(A₁₁ + A₂₂) of an unstrained fabric \[N/m\]; scales hourglass and bending stiffness.
pub(crate) fn mean_stiffness(fabric: &dyn Fabric) -> f64 {
    let a = fabric.tangent([0.0; 3], &[0.0; 2]);
    0.5 * (a[0][0] + a[1][1])
}

/// Bending stiffness D of a section \[N m\]: factor · A t²/12, the plies of a bonded stack as one plate of the whole
/// thickness, sliding plies one by one. One isotropic value: the weave's anisotropy of bending is neglected.
pub fn bending_stiffness(section: &Section) -> f64 {
    let thickness: f64 = section.plies.iter().map(|p| p.fabric.thickness_m()).sum();
    let of = |p: &crate::problem::Ply| {
        let t = if section.bonded { thickness } else { p.fabric.thickness_m() };
        mean_stiffness(&*p.fabric) * t * t / 12.0
    };
    section.bending_factor * section.plies.iter().map(of).sum::<f64>()
}

/// One element, for everything that is not the hot loop.
#[derive(Debug, Clone)]
pub struct Element {
    /// Corner nodes; a triangle repeats its third.
    pub node: [u32; 4],
    /// Number of corners, 3 or 4.
    pub corners: usize,
    /// Number of the part in the mesh.
    pub part: usize,
    /// Geometry of the element in its stress-free shape.
    pub reference: Reference,
    /// Stiffness k of the hourglass control of the element \[N/m\].
    pub hourglass: f64,
}

impl Element {
    /// Corner nodes, each once: three for a triangle.
    pub fn nodes(&self) -> &[u32] {
        &self.node[..self.corners]
    }

    /// Columns F₁, F₂ of the deformation gradient at the element's centre.
    pub fn deformation(&self, q: &Nodes) -> [V3; 2] {
        let mut f = [[0.0; 3]; 2];
        for (n, node) in self.nodes().iter().enumerate() {
            let b = self.reference.gradient(self.corners, n);
            let x = q[*node as usize];
            for a in 0..2 {
                (0..3).for_each(|k| f[a][k] += b[a] * x[k]);
            }
        }
        f
    }
}
