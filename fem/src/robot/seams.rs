//! Forces that pull on the welds.
//!
//! A weld edge is one where three or more elements meet. The largest principal tension of an element beside it,
//!
//! ```text
//! N₁ = σ₁ t      [N/m]
//! ```
//!
//! is the largest force per length that its fabric can put on the weld in any direction. **Validity**: a bound of the pull of
//! one sheet, at the resolution of the mesh; the peak at the end of a weld grows with finer elements.

use std::collections::HashMap;

use crate::Mesh;
use crate::run::ElementFields;

/// Elements beside the welds.
#[derive(Debug, Clone, PartialEq)]
pub struct Seams {
    elements: Vec<usize>,
}

/// The largest pull on a weld.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SeamForce {
    /// Force per length \[N/m\].
    pub n_per_m: f64,
    /// Element, in mesh order.
    pub element: usize,
}

impl Seams {
    /// Of a mesh.
    pub fn of(mesh: &Mesh) -> Seams {
        let mut beside: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
        for (index, nodes) in mesh.parts.iter().flat_map(|part| (0..part.len()).map(|i| part.nodes(i))).enumerate() {
            for (k, a) in nodes.iter().enumerate() {
                let b = nodes[(k + 1) % nodes.len()];
                beside.entry((*a.min(&b), *a.max(&b))).or_default().push(index);
            }
        }
        let mut elements: Vec<usize> = beside.into_values().filter(|e| e.len() > 2).flatten().collect();
        elements.sort_unstable();
        elements.dedup();
        Seams { elements }
    }

    /// Elements beside the welds, in mesh order.
    pub fn elements(&self) -> &[usize] {
        &self.elements
    }

    /// The largest pull; `None` without welds.
    pub fn largest(&self, fields: &ElementFields) -> Option<SeamForce> {
        let pull = |element: usize| SeamForce {
            n_per_m: fields.principal_stress_pa[element][0] * fields.thickness_m[element],
            element,
        };
        self.elements.iter().map(|e| pull(*e)).max_by(|a, b| a.n_per_m.total_cmp(&b.n_per_m))
    }
}
