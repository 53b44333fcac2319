//! Oracles of the inflated cantilever: adaptive quadrature of κ(m), itself from bisection, with 20 digits.

use super::super::inflated_cantilever::{deflection_ratio, rotation_ratio};
use super::{OracleRow, section};

/// Rows of [`super::super::inflated_cantilever`].
pub fn rows() -> Vec<OracleRow> {
    section(
        "inflated cantilever under a tip load",
        [
            ("v/(κ_w L²) at 1/4 of collapse", "0.16666666667", deflection_ratio(0.25)),
            ("v/(κ_w L²) at 1/2 of collapse", "0.33333333333", deflection_ratio(0.5)),
            ("v/(κ_w L²) at 0.6 of collapse", "0.40638380201", deflection_ratio(0.6)),
            ("v/(κ_w L²) at 3/4 of collapse", "0.58813559642", deflection_ratio(0.75)),
            ("v/(κ_w L²) at 0.9 of collapse", "1.152306953", deflection_ratio(0.9)),
            ("v/(κ_w L²) at 0.95 of collapse", "1.8490060238", deflection_ratio(0.95)),
            ("v/(κ_w L²) at 0.99 of collapse", "5.0027516216", deflection_ratio(0.99)),
            ("φ/(κ_w L) at 1/2 of collapse", "0.5", rotation_ratio(0.5)),
            ("φ/(κ_w L) at 3/4 of collapse", "0.84550912802", rotation_ratio(0.75)),
            ("φ/(κ_w L) at 0.9 of collapse", "1.5002306548", rotation_ratio(0.9)),
            ("φ/(κ_w L) at 0.99 of collapse", "5.5051275259", rotation_ratio(0.99)),
        ],
    )
}
