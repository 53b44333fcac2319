//! Oracles of the clamped cylinder: the four roots of its differential equation and its boundary conditions on a length
//! of 120 mm, with 30 digits. R = 40 mm, t = 0.2 mm, E = 208 MPa, ν = 0.3, 2 kPa, closed ends.

use super::super::shell::{ClampedCylinder, displacement_m, edge_length_m, far_displacement_m, ring_moment_n};
use super::{OracleRow, section};

/// Rows of [`super::super::shell`].
pub fn rows() -> Vec<OracleRow> {
    let (full, thin) = (shell(1.0), shell(0.01));
    let w = |shell, distance_m| 1e6 * displacement_m(shell, 2e3, distance_m);
    section(
        "pressurised cylinder at a clamped ring",
        [
            ("w far away [µm]", "65.3846153846", 1e6 * far_displacement_m(&full, 2e3)),
            ("edge length without tension [mm]", "2.20041365687", 1e3 * edge_length_m(&full)),
            ("w at 1 mm, full D [µm]", "9.506856391", w(&full, 1e-3)),
            ("w at 3 mm, full D [µm]", "42.35335232", w(&full, 3e-3)),
            ("w at 10 mm, full D [µm]", "65.95811239", w(&full, 1e-2)),
            ("moment at the ring, full D [mN]", "4.115547222", 1e3 * ring_moment_n(&full, 2e3)),
            ("w at 1 mm, D/100 [µm]", "31.00758673", w(&thin, 1e-3)),
            ("w at 3 mm, D/100 [µm]", "58.65593153", w(&thin, 3e-3)),
            ("w at 10 mm, D/100 [µm]", "65.36247364", w(&thin, 1e-2)),
            ("moment at the ring, D/100 [mN]", "0.4115547222", 1e3 * ring_moment_n(&thin, 2e3)),
        ],
    )
}

fn shell(factor: f64) -> ClampedCylinder {
    ClampedCylinder {
        radius_m: 0.04,
        membrane_stiffness_n_per_m: 208e6 * 2e-4,
        poisson: 0.3,
        bending_stiffness_nm: factor * 208e6 * 2e-4_f64.powi(3) / (12.0 * 0.91),
        axial_tension_n_per_m: 0.5 * 2e3 * 0.04,
    }
}
