//! The material tangent of the elements as an operator, for the highest frequency of a whole mesh.

use super::Element;
use crate::vec3::{Nodes, V3, dot};

/// What an element adds to the tangent: A Bᵀ D B, and viscosity.
pub struct Tangent {
    /// Nodes of which F holds the differences, first minus second.
    pairs: [[u32; 2]; 2],
    /// Shape gradients that go with them \[1/m\].
    b: [[f64; 2]; 2],
    /// Columns of the deformation gradient F, along warp and fill.
    f: [[f64; 3]; 2],
    /// Area times tangent stiffness, A D \[N m\].
    stiff: [[f64; 3]; 3],
    /// Area times viscosity, A η \[N m s\].
    viscous: f64,
}

impl Tangent {
    /// From the columns of the deformation gradient, the fabric's tangent \[N/m\] and its viscosity \[N s/m\].
    pub fn new(item: &Element, f: [V3; 2], d: [V3; 3], viscosity: f64) -> Tangent {
        let area = item.reference.area;
        let [a, b, c, last] = item.node;
        // The first corner of a triangle has minus the gradients of both others.
        let pairs = if item.corners == 4 { [[a, c], [b, last]] } else { [[b, a], [c, a]] };
        let stiff = d.map(|row| row.map(|d| area * d));
        Tangent { pairs, b: item.reference.b, f, stiff, viscous: area * viscosity }
    }

    /// Adds (K + s C) u to `force`, both by nodes.
    pub fn add(&self, s: f64, u: &Nodes, force: &mut Nodes) {
        let mut g = [[0.0; 3]; 2];
        for (b, [plus, minus]) in self.b.iter().zip(self.pairs) {
            let (plus, minus) = (&u[plus as usize], &u[minus as usize]);
            for k in 0..3 {
                let apart = plus[k] - minus[k];
                g[0][k] += b[0] * apart;
                g[1][k] += b[1] * apart;
            }
        }
        let [f1, f2] = self.f;
        let e = [dot(f1, g[0]), dot(f2, g[1]), dot(f1, g[1]) + dot(f2, g[0])];
        let slow = s * self.viscous;
        let slow = [slow * e[0], slow * e[1], 0.5 * slow * e[2]];
        let t: [f64; 3] = std::array::from_fn(|i| dot(self.stiff[i], e) + slow[i]);
        for (b, [plus, minus]) in self.b.iter().zip(self.pairs) {
            for k in 0..3 {
                let pull = b[0] * (t[0] * f1[k] + t[2] * f2[k]) + b[1] * (t[1] * f2[k] + t[2] * f1[k]);
                force[plus as usize][k] += pull;
                force[minus as usize][k] -= pull;
            }
        }
    }
}
