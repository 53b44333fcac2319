//! Which law of every mechanism a robot has.

use serde::{Deserialize, Serialize};

/// Whether hidden effects act by their first or their second laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Laws {
    /// Written together with the catalogue, each different from its entry.
    #[default]
    First,
    /// Taken from the literature or derived, without the diagnosis in view.
    Second,
}

impl Laws {
    /// Whether these are the first ones, which need no mention.
    pub fn are_first(&self) -> bool {
        *self == Laws::First
    }
}

/// Amounts of one mechanism by law, first and second; both off at 0.
pub(crate) type ByLaw = [f64; 2];
