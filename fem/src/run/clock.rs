//! Time and energies of a run that only stepping can add up.

use crate::Mesh;
use serde::{Deserialize, Serialize};

/// Times and steps of a run \[s\].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    pub step: u64,
    /// Time of loads and supports; it stops while the run waits.
    pub time_s: f64,
    /// Time that the run has waited.
    pub waited_s: f64,
    pub waits: bool,
    pub dt_s: f64,
    /// Length of the step before; 0 at the start.
    pub(crate) before_s: f64,
    /// Longest step that the start allowed.
    pub(crate) longest_s: f64,
    /// γ: the stable step of the whole mesh over the step from the nodes' bounds.
    pub gain: f64,
}

impl Clock {
    pub(crate) fn runs_s(&self) -> f64 {
        if self.waits { self.waited_s } else { self.time_s }
    }
}

/// Energies that only stepping can add up \[J\].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Books {
    pub kinetic: f64,
    pub stored: f64,
    pub damping: Halves,
    pub support: Halves,
    pub start: f64,
    pub scale: f64,
    /// Supplied and dissipated by loads of an earlier run that are absent from this one.
    pub earlier: [f64; 2],
}

/// A sum of what happens from half a step before to half a step after each moment, read at the moments.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Halves {
    pub sum: f64,
    last: f64,
}

impl Halves {
    pub(super) fn add(&mut self, whole: f64) {
        self.sum += 0.5 * (self.last + whole);
        self.last = whole;
    }
}

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
