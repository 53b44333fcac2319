//! Folds, loads, obstacles, rest curvature: the small entries of the list of terms.

mod coulomb;
mod folds;
mod gravity;
mod nodal_forces;
mod obstacles;
mod rest_curvature;

pub(crate) use coulomb::slide;
pub use folds::{Folds, edge_stiffness_n};
pub use gravity::Gravity;
pub use nodal_forces::NodalForces;
pub use obstacles::Obstacles;
pub use rest_curvature::RestCurvature;

/// Penalty stiffness of every node k = share · m/dt² \[N/m\].
///
/// One spring of this stiffness adds `share` to (ω dt)², which central differences allow up to 4. A mesh stepped at
/// 0.9 of its own limit leaves 4 (1 − .81) = .76 free, so shares up to .7 never limit the step. Valid for any dt > 0;
/// the depth reached under a pressure p on a fabric of areal mass m_A is p dt²/(share · m_A).
pub fn penalty_stiffness_n_m(mass_kg: &[f64], dt_s: f64, share: f64) -> Vec<f64> {
    mass_kg.iter().map(|mass| share * mass / (dt_s * dt_s)).collect()
}
