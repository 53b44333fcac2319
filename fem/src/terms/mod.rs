//! Folds, loads, obstacles, rest curvature: the small entries of the list of terms.

mod coulomb;
mod dead_loads;
mod folds;
mod obstacles;
mod rest_curvature;

pub(crate) use coulomb::slide;
pub use dead_loads::DeadLoads;
pub use folds::{Folds, edge_stiffness_n};
pub use obstacles::Obstacles;
pub use rest_curvature::RestCurvature;

/// k Δt²/m of the penalty of obstacles. One spring of this stiffness adds as much to (ω Δt)², which central differences allow up
/// to 4; a mesh stepped at 0.9 of the mesh's limit leaves 4 (1 − .81) = .76 free.
const SHARE: f64 = 0.1;

/// Penalty stiffness of obstacles for every node, k = `SHARE` · m/Δt² \[N/m\], of its mass as it is stepped. The depth reached under a
/// pressure p on a fabric of areal mass m_A is p Δt²/(`SHARE` · m_A).
pub(crate) fn penalty_stiffness_n_m(mass_kg: &[f64], dt_s: f64) -> Vec<f64> {
    mass_kg.iter().map(|mass| SHARE * mass / (dt_s * dt_s)).collect()
}
