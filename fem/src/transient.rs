//! What a term of the finite element engine does in addition to its energy: it steps through time and keeps its own memory.

use models::{Account, Pose, Row, RowKind, Term};

/// Step and time at which a term is advanced.
#[derive(Debug, Clone, Copy)]
pub struct Tick {
    /// Number of steps done before this one.
    pub step: u64,
    /// Simulated time of the positions \[s\].
    pub time_s: f64,
    /// Length of the step from these positions \[s\].
    pub dt_s: f64,
}

/// Energy of the rows of a kind \[J\].
pub(crate) fn sum_of(rows: &[Row], kind: RowKind) -> f64 {
    rows.iter().filter(|row| row.kind == kind).map(|row| row.energy_j).sum()
}

pub(crate) fn stored(name: &'static str, account: Account, energy_j: f64) -> Row {
    Row { name, account, kind: RowKind::Stored, energy_j }
}

pub(crate) fn dissipated(name: &'static str, account: Account, energy_j: f64) -> Row {
    Row { name, account, kind: RowKind::Dissipated, energy_j }
}

pub(crate) fn supplied(name: &'static str, account: Account, energy_j: f64) -> Row {
    Row { name, account, kind: RowKind::Supplied, energy_j }
}

/// A term over the nodes of a mesh, stepped in time.
pub trait Transient: Term {
    /// One time step: what [`Term::add`] does, plus whatever depends on rate or history (viscosity, friction, hysteresis,
    /// the work of a load). Called once per step.
    fn advance(&mut self, at: &Pose, tick: &Tick, force: &mut [f64]) -> f64;

    /// This term's rows of the energy ledger, at the positions of the last step (at `at` before the first).
    fn ledger(&self, at: &Pose) -> Vec<Row>;

    /// Adds to `bound[i]` a stiffness kᵢ \[N/m\] of node i such that `u·K u ≤ Σᵢ kᵢ |uᵢ|²` for this term's tangent K at
    /// `at`. The stable step of central differences then is at least `2/√(maxᵢ kᵢ/mᵢ)`. Nothing for loads.
    fn stiffness_bound(&self, _at: &Pose, _bound: &mut [f64]) {}

    /// What a checkpoint must keep, so that a resumed run ends bit-identical.
    fn save(&self) -> Vec<u8>;

    /// Takes back what [`Transient::save`] gave; `None` if it does not fit this term.
    fn restore(&mut self, saved: &[u8]) -> Option<()>;
}
