//! Limits of a table, and the reasons for refusing one.

use crate::error::Unsolved;
use thiserror::Error;

/// Most bytes of constants of a table that is given out.
pub const MOST_BYTES: usize = 2048;
/// Its largest miss, as a share of the robot's length or in rad.
pub const MOST_MISS: f64 = 1e-3;
/// Reason for which a model cannot be written as a table over the pressure.
#[expect(missing_docs, reason = "fields have the words and units of their message")]
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Untabulated {
    /// The model has no prediction somewhere in the range.
    #[error(transparent)]
    Unsolved(#[from] Unsolved),
    /// Range of pressures that is empty, falls, or begins below 0.
    #[error("pressures from {low_kpa} to {high_kpa} kPa are no range: they rise, from 0 or more")]
    Order { low_kpa: f64, high_kpa: f64 },
    /// A range in which the actuator stays flat.
    #[error(
        "pressures from {low_kpa} to {high_kpa} kPa are no range that opens the actuator (it is flat up to {open_kpa:.3} kPa)"
    )]
    Range { low_kpa: f64, high_kpa: f64, open_kpa: f64 },
    /// One pressure does not say where the robot is.
    #[error("{channels} supply channels move this robot, and a table knows one pressure")]
    Channels { channels: usize },
    /// Response with a jump or a corner that no table of the allowed size follows.
    #[error(
        "no table of {MOST_BYTES} bytes follows this robot to {MOST_MISS} of its length: it has a jump or a corner at {at_kpa:.3} kPa"
    )]
    TooRough { at_kpa: f64 },
}
