//! Oracles of the homogeneous neo-Hookean states.

use super::super::membrane::{Sides, sphere_limit_stretch, sphere_pressure_pa, tension_n_per_m};
use super::{OracleRow, section};

/// Rows of [`super::super::membrane`]; C10 t = 1 N/m, R = 1 m.
pub fn rows() -> Vec<OracleRow> {
    section(
        "neo-Hookean sheet and sphere",
        [
            ("P at λ = 2, free", "3.5", tension_n_per_m(1.0, 2.0, Sides::Free)),
            ("P at λ = 2, width kept", "3.75", tension_n_per_m(1.0, 2.0, Sides::Kept)),
            ("P at λ = 2, equal biaxial", "3.9375", tension_n_per_m(1.0, 2.0, Sides::Pulled)),
            ("λ of the sphere's greatest pressure", "1.38308755427", sphere_limit_stretch()),
            ("greatest pressure of the sphere", "2.4789258048", sphere_pressure_pa(1.0, 1.0, sphere_limit_stretch())),
        ],
    )
}
