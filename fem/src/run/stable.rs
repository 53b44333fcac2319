//! The stable step from bounds and masses, and what ties hand over for it.

use crate::Mesh;

/// Largest stable step \[s\] from the nodes' stiffness bounds \[N/m\] and masses \[kg\].
pub(super) fn stable_step(bound: &[f64], mass: &[f64], viscosity: f64) -> f64 {
    let square = bound.iter().zip(mass).filter(|(_, m)| **m > 0.0).map(|(k, m)| k / m).fold(0.0, f64::max);
    2.0 / square.sqrt() * damped(viscosity)
}

/// What viscosity leaves of the stable step.
pub(super) fn damped(viscosity: f64) -> f64 {
    (1.0 + viscosity * viscosity).sqrt() - viscosity
}

/// Tied nodes hand their mass to the nodes they follow.
pub(super) fn give_tied_masses(mesh: &Mesh, mass: &mut [f64]) {
    for tie in &mesh.ties {
        let own = std::mem::take(&mut mass[tie.node as usize]);
        tie.to.iter().for_each(|(node, weight)| mass[*node as usize] += weight * own);
    }
}

/// Tied nodes hand their stiffness to the nodes they follow: |Σ w u|² ≤ Σ|w| Σ |w| u².
pub(super) fn give_tied_bounds(mesh: &Mesh, bound: &mut [f64]) {
    for tie in &mesh.ties {
        let own = std::mem::take(&mut bound[tie.node as usize]);
        let sum: f64 = tie.to.iter().map(|(_, weight)| weight.abs()).sum();
        tie.to.iter().for_each(|(node, weight)| bound[*node as usize] += sum * weight.abs() * own);
    }
}
