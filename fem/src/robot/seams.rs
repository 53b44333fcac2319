//! Forces that pull on the welds.
//!
//! A weld edge is one where three or more elements meet. The largest principal tension of an element next to it,
//!
//! ```text
//! N₁ = σ₁ t      [N/m]
//! ```
//!
//! is the largest force per length that its fabric can put on the weld in any direction. **Validity**: a bound of the pull of
//! one sheet, at the resolution of the mesh; the peak at the end of a weld grows with finer elements.

use std::collections::{BTreeSet, HashMap};

use crate::Mesh;
use crate::run::ElementFields;

/// Elements next to the welds of a robot, by their number in the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Seams {
    elements: Vec<usize>,
    /// Elements next to a weld across the robot.
    across: Vec<usize>,
}

/// The largest pull on a weld.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SeamForce {
    /// Largest force per length that fabric can put on the weld \[N/m\].
    pub n_per_m: f64,
    /// Number of the element, in mesh order.
    pub element: usize,
    /// Whether the weld runs across the robot, and not along a side of its actuator.
    pub is_across: bool,
}

impl Seams {
    /// Finds the sides that more than two elements share: those are welded.
    pub fn of(mesh: &Mesh) -> Seams {
        let mut beside: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
        for (index, nodes) in mesh.faces().enumerate() {
            for (k, a) in nodes.iter().enumerate() {
                let b = nodes[(k + 1) % nodes.len()];
                beside.entry((*a.min(&b), *a.max(&b))).or_default().push(index);
            }
        }
        beside.retain(|_, elements| elements.len() > 2);
        let is_across = |(a, b): &(u32, u32)| {
            let side = [a, b].map(|node| mesh.points[*node as usize]);
            let [x, y, z] = [0, 1, 2].map(|k| side[1][k] - side[0][k]);
            x.abs() < y.hypot(z)
        };
        let listed = |wanted: &dyn Fn(&(u32, u32)) -> bool| {
            let welds = beside.iter().filter(|(edge, _)| wanted(edge));
            welds.flat_map(|(_, elements)| elements).copied().collect::<BTreeSet<usize>>().into_iter().collect()
        };
        Seams { elements: listed(&|_| true), across: listed(&is_across) }
    }

    /// Elements next to the welds, in mesh order.
    pub fn elements(&self) -> &[usize] {
        &self.elements
    }

    /// The largest pull; `None` without welds.
    pub fn largest(&self, fields: &ElementFields) -> Option<SeamForce> {
        let pull = |element: usize| SeamForce {
            n_per_m: fields.principal_stress_pa[element][0] * fields.thickness_m[element],
            element,
            is_across: self.across.binary_search(&element).is_ok(),
        };
        self.elements.iter().map(|e| pull(*e)).max_by(|a, b| a.n_per_m.total_cmp(&b.n_per_m))
    }
}
