//! Oracles of folds: moments by stepping the pendulum equation (fourth order, 4000 steps), not by its first integral.

use super::super::fold::{moment_n, stiffened_moment_n};
use super::{OracleRow, section};

/// Rows of [`super::super::fold`].
pub fn rows() -> Vec<OracleRow> {
    section(
        "fold of a pulled sheet",
        [
            ("M/√(DT) at a clamp at 1 rad", "0.958851077208406", moment_n(1.0, 1.0, 1.0)),
            ("M/√(DT) behind 7.5 √(D/T) of 60 D, 0.5 rad", "3.04125142", stiffened_moment_n(1.0, 60.0, 7.5, 1.0, 0.5)),
            ("M/√(DT) behind 7.5 √(D/T) of 60 D, 1.0 rad", "5.74163142", stiffened_moment_n(1.0, 60.0, 7.5, 1.0, 1.0)),
            ("M/√(DT) behind 7.5 √(D/T) of 60 D, 1.5 rad", "7.74386021", stiffened_moment_n(1.0, 60.0, 7.5, 1.0, 1.5)),
        ],
    )
}
