//! One element, for everything but the hot loop.

use super::reference::Reference;

/// One element, for everything that is not the hot loop.
#[derive(Debug, Clone)]
pub struct Element {
    /// Corner nodes; a triangle repeats its third.
    pub node: [u32; 4],
    /// 3 or 4.
    pub corners: usize,
    /// Part number.
    pub part: usize,
    /// Reference data.
    pub reference: Reference,
    /// Hourglass stiffness k \[N/m\].
    pub hourglass: f64,
}

impl Element {
    /// Corner nodes without repetition.
    pub fn nodes(&self) -> &[u32] {
        &self.node[..self.corners]
    }

    /// Columns F₁, F₂ of the deformation gradient at the element's centre.
    pub fn deformation(&self, q: &[[f64; 4]]) -> [[f64; 3]; 2] {
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
