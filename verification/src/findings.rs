//! What a measurement has to say, for any page to print.

use serde_json::Value;

/// Text, tables, the same as JSON, and whether a target was missed.
#[derive(Debug)]
pub struct Findings {
    /// Texts and tables to print, in order.
    pub parts: Vec<Printed>,
    /// The same answer for programs, as JSON.
    pub json: Value,
    /// Whether a target was not reached.
    pub missed: bool,
}

/// One piece of an answer that a page prints.
#[derive(Debug)]
pub enum Printed {
    /// Lines of text, as they are printed.
    Text(String),
    /// A table with text columns first.
    Table {
        /// Heads of the columns, from left to right.
        head: &'static [&'static str],
        /// So many first columns are text, the others numbers.
        left: usize,
        /// Cells as text, row by row.
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
    /// A model that has no equilibrium at some pressures.
    #[error(transparent)]
    Unsolved(#[from] models::Unsolved),
    /// Data that cannot be read, or a diagnosis that failed.
    #[error(transparent)]
    Compare(#[from] compare::CompareError),
    /// A folder for answers that cannot be written to, or an interrupt.
    #[error(transparent)]
    Kept(#[from] sweep::SweepError),
    /// A check that does not exist.
    #[error("check `{name}` does not exist; write one of {known}")]
    NoCheck {
        /// Name of the check as it was typed.
        name: String,
        /// Names of all checks, for the message.
        known: String,
    },
}
