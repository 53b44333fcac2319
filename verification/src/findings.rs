//! What a measurement has to say, for any page to print.

use serde_json::Value;

/// Text, tables, the same as JSON, and whether all that is wanted was met.
#[derive(Debug)]
pub struct Findings {
    /// What to print, in order.
    pub parts: Vec<Printed>,
    /// The same for programs.
    pub json: Value,
    /// Whether something that is wanted was not reached.
    pub missed: bool,
}

/// A piece of an answer.
#[derive(Debug)]
pub enum Printed {
    /// Lines of text.
    Text(String),
    /// A table.
    Table {
        /// Heads of the columns.
        head: &'static [&'static str],
        /// So many first columns are text, the others numbers.
        left: usize,
        /// Cells row by row.
        rows: Vec<Vec<String>>,
    },
}

impl Printed {
    /// A table; the first `left` columns are text.
    pub(crate) fn table(
        head: &'static [&'static str],
        left: usize,
        rows: impl Iterator<Item = Vec<String>>,
    ) -> Printed {
        Printed::Table { head, left, rows: rows.collect() }
    }
}

/// What a measurement cannot go on without.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A finite element run that cannot be made or was stopped.
    #[error(transparent)]
    Fem(#[from] fem::FemError),
    /// A model without equilibrium.
    #[error(transparent)]
    Unsolved(#[from] models::Unsolved),
    /// Data or a diagnosis.
    #[error(transparent)]
    Compare(#[from] compare::CompareError),
    /// A folder for answers that cannot be written to, or an interrupt.
    #[error(transparent)]
    Kept(#[from] sweep::SweepError),
    /// A check that does not exist.
    #[error("there is no check `{name}`; write one of {known}")]
    NoCheck {
        /// As it was asked for.
        name: String,
        /// All that there are.
        known: String,
    },
}
