//! The energy balance of a run.

use crate::vec3::share;
use models::{Account, Row, RowKind};

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
        let sum = |kind: RowKind| rows.iter().filter(|r| r.kind == kind).map(|r| r.energy_j).sum::<f64>();
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
