//! Oracles of the inflated tube in bending.

use std::f64::consts::PI;

use super::super::beam::{
    BeamTheory, Cantilever, Tube, buckling_load_n, collapse_moment_nm, collapse_tip_load_n, curvature_ratio,
    moment_ratio, moment_ratio_from_curvature_ratio, strain_based_wrinkling_moment_nm, tendon_tension_n, thrust_n,
    tip_deflection_m, wrinkling_curvature_per_m, wrinkling_moment_nm, wrinkling_tip_load_n,
};
use super::{OracleRow, section};

/// Rows of [`super::super::beam`].
pub fn rows() -> Vec<OracleRow> {
    [wrinkled(), moment_curvature(), tendon(), cantilever()].concat()
}

fn wrinkled() -> Vec<OracleRow> {
    section(
        "inflated tube, Comer–Levy",
        [
            ("M/(NR) at γ0 = 0", "0.500000000", moment_ratio(0.0)),
            ("κ/κ_w at γ0 = 0", "1.00000000", curvature_ratio(0.0)),
            ("M/(NR) at γ0 = π/6", "0.551270658", moment_ratio(PI / 6.0)),
            ("κ/κ_w at γ0 = π/6", "1.13527638", curvature_ratio(PI / 6.0)),
            ("M/(NR) at γ0 = π/4", "0.601763247", moment_ratio(PI / 4.0)),
            ("κ/κ_w at γ0 = π/4", "1.32378590", curvature_ratio(PI / 4.0)),
            ("M/(NR) at γ0 = π/3", "0.660510527", moment_ratio(PI / 3.0)),
            ("κ/κ_w at γ0 = π/3", "1.64204211", curvature_ratio(PI / 3.0)),
            ("M/(NR) at γ0 = π/2", "0.785398163", moment_ratio(PI / 2.0)),
            ("κ/κ_w at γ0 = π/2", "3.14159265", curvature_ratio(PI / 2.0)),
            ("M/(NR) at γ0 = 2π/3", "0.896812337", moment_ratio(PI / 1.5)),
            ("κ/κ_w at γ0 = 2π/3", "9.17449870", curvature_ratio(PI / 1.5)),
            ("M/(NR) at γ0 = 3π/4", "0.940378609", moment_ratio(PI * 0.75)),
            ("κ/κ_w at γ0 = 3π/4", "20.7029120", curvature_ratio(PI * 0.75)),
            ("M/(NR) at γ0 = 5π/6", "0.972994247", moment_ratio(PI / 1.2)),
            ("κ/κ_w at γ0 = 5π/6", "67.4883336", curvature_ratio(PI / 1.2)),
            ("M/(NR) at γ0 = 0.9π", "0.990183655", moment_ratio(PI * 0.9)),
            ("κ/κ_w at γ0 = 0.9π", "306.982689", curvature_ratio(PI * 0.9)),
        ],
    )
}

/// R = 40 mm, p = 2 kPa, E t = 41.6 kN/m, and one tube of a published four-point test.
fn moment_curvature() -> Vec<OracleRow> {
    let tube = |radius_m, pressure_pa| Tube {
        radius_m,
        membrane_stiffness_n_per_m: 41.6e3,
        thrust_n: thrust_n(pressure_pa, radius_m, 0.0),
    };
    let body = tube(0.04, 2e3);
    section(
        "inflated tube, moment and curvature",
        [
            ("M/(NR) at κ/κ_w = 2", "0.705409679", moment_ratio_from_curvature_ratio(2.0)),
            ("M/(NR) at κ/κ_w = 5", "0.844115581", moment_ratio_from_curvature_ratio(5.0)),
            ("M/(NR) at κ/κ_w = 10", "0.902652911", moment_ratio_from_curvature_ratio(10.0)),
            ("M/(NR) at κ/κ_w = 50", "0.966991809", moment_ratio_from_curvature_ratio(50.0)),
            ("M/(NR) at κ/κ_w = 100", "0.979237825", moment_ratio_from_curvature_ratio(100.0)),
            ("M/(NR) at κ/κ_w = 1000", "0.995535778", moment_ratio_from_curvature_ratio(1000.0)),
            ("N, R = 40 mm, p = 2 kPa [N]", "10.0530965", body.thrust_n),
            ("M_w, R = 40 mm, p = 2 kPa [N m]", "0.20106193", wrinkling_moment_nm(&body)),
            ("M_c, R = 40 mm, p = 2 kPa [N m]", "0.40212386", collapse_moment_nm(&body)),
            ("κ_w, R = 40 mm, p = 2 kPa [1/m]", "0.0240384615", wrinkling_curvature_per_m(&body)),
            ("M_w, R = 80 mm, p = 69 kPa [N m]", "55.4930926", wrinkling_moment_nm(&tube(0.08, 69e3))),
            ("M_w by strain, ν = 0.3 [N m]", "0.0804247719", strain_based_wrinkling_moment_nm(2e3, 0.04, 0.3)),
        ],
    )
}

fn tendon() -> Vec<OracleRow> {
    let tension = |distance_mm: f64, moment_ratio| tendon_tension_n(2e3, 0.04, 1e-3 * distance_mm, moment_ratio);
    section(
        "inflated tube, tendon, R = 40 mm, p = 2 kPa",
        [
            ("T at d = 40 mm, α = 0.5 [N]", "3.35103216", tension(40.0, 0.5)),
            ("T at d = 40 mm, α = 0.8 [N]", "4.46804289", tension(40.0, 0.8)),
            ("T at d = 40 mm, α = 1.0 [N]", "5.02654825", tension(40.0, 1.0)),
            ("T at d = 50 mm, α = 0.5 [N]", "2.87231328", tension(50.0, 0.5)),
            ("T at d = 50 mm, α = 0.8 [N]", "3.92315961", tension(50.0, 0.8)),
            ("T at d = 50 mm, α = 1.0 [N]", "4.46804289", tension(50.0, 1.0)),
            ("T at d = 59.1 mm, α = 0.5 [N]", "2.54187016", tension(59.1, 0.5)),
            ("T at d = 59.1 mm, α = 0.8 [N]", "3.53127429", tension(59.1, 0.8)),
            ("T at d = 59.1 mm, α = 1.0 [N]", "4.05775842", tension(59.1, 1.0)),
        ],
    )
}

fn cantilever() -> Vec<OracleRow> {
    let beam = Cantilever {
        radius_m: 0.04,
        thickness_m: 0.2e-3,
        length_m: 0.36,
        young_pa: 208e6,
        shear_pa: 80e6,
        pressure_pa: 2e3,
    };
    section(
        "inflated cantilever",
        [
            ("v, Le Van–Wielgosz [m]", "4.07146124e-4", tip_deflection_m(&beam, 0.2, BeamTheory::LeVanWielgosz)),
            ("v, Fichter [m]", "4.0750335e-4", tip_deflection_m(&beam, 0.2, BeamTheory::Fichter)),
            ("v, Euler–Bernoulli [m]", "3.71871646e-4", tip_deflection_m(&beam, 0.2, BeamTheory::Euler)),
            ("F_w [N]", "0.558505361", wrinkling_tip_load_n(&beam)),
            ("F_c [N]", "1.11701072", collapse_tip_load_n(&beam)),
            ("buckling, Le Van–Wielgosz [N]", "145.684412", buckling_load_n(&beam, BeamTheory::LeVanWielgosz)),
            ("buckling, Fichter [N]", "147.609523", buckling_load_n(&beam, BeamTheory::Fichter)),
            ("buckling, Euler [N]", "159.242112", buckling_load_n(&beam, BeamTheory::Euler)),
        ],
    )
}
