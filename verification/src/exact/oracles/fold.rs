//! Oracles of folds: moments by stepping the pendulum equation (fourth order, 4000 steps), not by its first integral.

use super::super::fold::{moment_n, stiffened_moments_n};
use super::{OracleRow, section};

/// Rows of [`super::super::fold`].
pub fn rows() -> Vec<OracleRow> {
    let behind = |angle: f64| stiffened_moments_n(1.0, 60.0, 7.5, 1.0, angle);
    section(
        "fold of a pulled sheet",
        [
            ("M/√(DT) at a clamp at 1 rad", "0.958851077208406", moment_n(1.0, 1.0, 1.0)),
            ("M/√(DT) behind 7.5 √(D/T) of 60 D, 0.5 rad", "3.04125142", behind(0.5)[0]),
            ("M/√(DT) behind 7.5 √(D/T) of 60 D, 1.0 rad", "5.74163142", behind(1.0)[0]),
            ("M/√(DT) behind 7.5 √(D/T) of 60 D, 1.5 rad", "7.74386021", behind(1.5)[0]),
            ("M/√(DT) where they meet, 1.0 rad", "0.613373", behind(1.0)[1]),
        ],
    )
}
