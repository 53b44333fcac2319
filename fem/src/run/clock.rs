//! Time of a run, energies that only stepping can add up, and the energy balance.

use crate::Mesh;
use crate::transient::sum_of;
use crate::vec3::share;
use models::{Account, Row, RowKind};
use serde::{Deserialize, Serialize};

/// Times and steps of a run \[s\].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RunClock {
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

impl RunClock {
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
        for (node, weight) in tie.to.iter() {
            mass[*node as usize] += weight * own;
        }
    }
}

/// Tied nodes hand their stiffness to the nodes they follow: |Σ w u|² ≤ Σ|w| Σ |w| u².
pub(super) fn give_tied_bounds(mesh: &Mesh, bound: &mut [f64]) {
    for tie in &mesh.ties {
        let own = std::mem::take(&mut bound[tie.node as usize]);
        let sum: f64 = tie.to.iter().map(|(_, weight)| weight.abs()).sum();
        for (node, weight) in tie.to.iter() {
            bound[*node as usize] += sum * weight.abs() * own;
        }
    }
}

/// The energy balance at one moment: kinetic + Σ stored + Σ dissipated = Σ supplied + residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Ledger {
    /// Kinetic energy of all nodes \[J\].
    pub kinetic_j: f64,
    /// Stored, dissipated and supplied energies of all terms.
    pub rows: Vec<Row>,
    /// Kinetic, stored and dissipated energy beyond what start and loads supplied \[J\].
    pub residual_j: f64,
    /// Work done from outside so far \[J\].
    pub external_work_j: f64,
    /// What the residual is judged against: the largest external work, or energy present at the start, so far, and at least what
    /// `run::guard` expects of the loads \[J\].
    pub scale_j: f64,
}

impl Ledger {
    /// Closes the balance. `start_j` is the energy stored before the first step.
    pub fn close(kinetic_j: f64, rows: Vec<Row>, start_j: f64, scale_before_j: f64) -> Ledger {
        let sum = |kind: RowKind| sum_of(&rows, kind);
        let external_work_j = sum(RowKind::Supplied);
        let held = kinetic_j + sum(RowKind::Stored) + sum(RowKind::Dissipated);
        let residual_j = held - external_work_j - start_j;
        let scale_j = scale_before_j.max(external_work_j.abs()).max(start_j.abs());
        Ledger { kinetic_j, rows, residual_j, external_work_j, scale_j }
    }

    /// |residual| over what it is judged against; 0 while nothing happened.
    pub fn residual_share(&self) -> f64 {
        share(self.residual_j.abs(), self.scale_j)
    }

    /// Kinetic energy over kinetic and stored energy; 0 while there is none.
    pub fn kinetic_share(&self) -> f64 {
        share(self.kinetic_j, self.stored_j(|_| true) + self.kinetic_j)
    }

    /// Energy of hourglass control over all stored energy; 0 while nothing is stored.
    pub fn hourglass_share(&self) -> f64 {
        self.share_of(Account::Numerical)
    }

    /// Stored energy on an account over all stored energy; 0 while nothing is stored.
    pub(super) fn share_of(&self, account: Account) -> f64 {
        share(self.stored_j(|row| row.account == account), self.stored_j(|_| true))
    }

    pub(crate) fn stored_j(&self, wanted: impl Fn(&Row) -> bool) -> f64 {
        let rows = self.rows.iter().filter(|r| r.kind == RowKind::Stored && wanted(r));
        rows.map(|r| r.energy_j).sum()
    }
}
