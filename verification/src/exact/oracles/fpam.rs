//! Oracles of the fabric muscle: W = 60 mm, Lf = 300 mm.

use super::super::fpam::{
    Fpam, bending_alpha, contraction, force_n, free_alpha, length_m, shear_modulus_from_bias_pa, total_angle,
};
use super::super::hinge::{BentBody, Lever, axis_point_m};
use super::{OracleRow, section};

/// Rows of [`super::super::fpam`].
pub fn rows() -> Vec<OracleRow> {
    [fabric(), linear(), bending(), bending_by_virtual_work()].concat()
}

fn muscle(shear_stiffness_n_per_m: f64) -> Fpam {
    Fpam { flat_width_m: 0.06, rest_length_m: 0.3, shear_stiffness_n_per_m }
}

fn alpha(shear: f64, pressure_pa: f64, rule: Lever) -> f64 {
    bending_alpha(&muscle(shear), 0.04, pressure_pa, 2e3, rule)
}

fn angle(shear: f64, pressure_pa: f64, rule: Lever) -> f64 {
    total_angle(&muscle(shear), 0.04, alpha(shear, pressure_pa, rule))
}

fn height_mm(shear: f64, pressure_pa: f64, rule: Lever) -> f64 {
    let body = BentBody { body_radius_m: 0.04, length_m: 0.3, total_angle: angle(shear, pressure_pa, rule) };
    1e3 * axis_point_m(&body, 0.33)[1]
}

fn fabric() -> Vec<OracleRow> {
    let shear_pa = shear_modulus_from_bias_pa(4.05e6, 96.5e6, 120e6);
    section(
        "fabric muscle, bias modulus 4.05 MPa, t = 50 µm",
        [("G [MPa]", "1.032", 1e-6 * shear_pa), ("G t [N/m]", "51.6", 50e-6 * shear_pa)],
    )
}

fn linear() -> Vec<OracleRow> {
    let magic = (1.0 / 3.0_f64.sqrt()).acos().to_degrees();
    let force = |degrees: f64| force_n(&muscle(0.0), degrees.to_radians(), 30e3);
    // 50.625 N/m is t E45/4: these numbers were computed with 1/G = 4/E45, without 1/E0 + 1/E90.
    let free = |pressure_pa| contraction(free_alpha(&muscle(50.625), pressure_pa));
    section(
        "fabric muscle, linear, 30 kPa or G t = 50.625 N/m",
        [
            ("L at α = 35° [m]", "0.347536779", length_m(&muscle(0.0), 35.0_f64.to_radians())),
            ("F at α = 35°, no shear stiffness [N]", "69.650827", force(35.0)),
            ("F at α = 40°, no shear stiffness [N]", "52.2862216", force(40.0)),
            ("F at α = 45°, no shear stiffness [N]", "34.3774677", force(45.0)),
            ("F at α = 50°, no shear stiffness [N]", "16.4687138", force(50.0)),
            ("F at α = 54.7356°, no shear stiffness [N]", "0.0000000", force(magic)),
            ("free ε, 1 kPa", "0.0385253351", free(1e3)),
            ("free ε, 5 kPa", "0.106759542", free(5e3)),
            ("free ε, 10 kPa", "0.13551793", free(10e3)),
            ("free ε, 20 kPa", "0.15611875", free(20e3)),
            ("free ε, 30 kPa", "0.164349531", free(30e3)),
            ("free ε, no shear stiffness", "0.183503419", contraction(free_alpha(&muscle(0.0), 30e3))),
        ],
    )
}

/// Body R = 40 mm, p = 2 kPa; the marker is 30 mm beyond the end of the muscle.
///
/// Two readings. "Current arm": F (R + d) = p π R³ with d = R + r(α) at the solution. "Virtual work": all of dΠ/dα = 0,
/// expected values from the slope of Π by central differences; it lifts the marker by up to 0.9 %.
fn bending() -> Vec<OracleRow> {
    let rule = Lever::CurrentArm;
    section(
        "fabric muscle, bending, current arm, G t = 51.6 N/m",
        [
            ("α, 10 kPa [°]", "49.67632", alpha(51.6, 10e3, rule).to_degrees()),
            ("α, 20 kPa [°]", "51.84999", alpha(51.6, 20e3, rule).to_degrees()),
            ("α, 30 kPa [°]", "52.71809", alpha(51.6, 30e3, rule).to_degrees()),
            ("ε, 10 kPa", "0.0848555", contraction(alpha(51.6, 10e3, rule))),
            ("ε, 20 kPa", "0.1264084", contraction(alpha(51.6, 20e3, rule))),
            ("ε, 30 kPa", "0.1433583", contraction(alpha(51.6, 30e3, rule))),
            ("Φ, 10 kPa", "0.2530682", angle(51.6, 10e3, rule)),
            ("Φ, 20 kPa", "0.3745797", angle(51.6, 20e3, rule)),
            ("Φ, 30 kPa", "0.4237586", angle(51.6, 30e3, rule)),
            ("y, 10 kPa [mm]", "43.995", height_mm(51.6, 10e3, rule)),
            ("y, 20 kPa [mm]", "63.736", height_mm(51.6, 20e3, rule)),
            ("y, 30 kPa [mm]", "71.416", height_mm(51.6, 30e3, rule)),
            ("y, no shear stiffness, 10 kPa [mm]", "58.662", height_mm(0.0, 10e3, rule)),
            ("y, no shear stiffness, 20 kPa [mm]", "73.910", height_mm(0.0, 20e3, rule)),
            ("y, no shear stiffness, 30 kPa [mm]", "78.895", height_mm(0.0, 30e3, rule)),
        ],
    )
}

fn bending_by_virtual_work() -> Vec<OracleRow> {
    let rule = Lever::VirtualWork;
    section(
        "fabric muscle, bending, virtual work, G t = 51.6 N/m",
        [
            ("α, 10 kPa [°]", "49.712", alpha(51.6, 10e3, rule).to_degrees()),
            ("y, 10 kPa [mm]", "44.32", height_mm(51.6, 10e3, rule)),
            ("y, no shear stiffness, 10 kPa [mm]", "59.21", height_mm(0.0, 10e3, rule)),
            ("α, 20 kPa [°]", "51.878", alpha(51.6, 20e3, rule).to_degrees()),
            ("y, 20 kPa [mm]", "63.99", height_mm(51.6, 20e3, rule)),
            ("y, no shear stiffness, 20 kPa [mm]", "74.23", height_mm(0.0, 20e3, rule)),
            ("α, 30 kPa [°]", "52.740", alpha(51.6, 30e3, rule).to_degrees()),
            ("y, 30 kPa [mm]", "71.60", height_mm(51.6, 30e3, rule)),
            ("y, no shear stiffness, 30 kPa [mm]", "79.12", height_mm(0.0, 30e3, rule)),
        ],
    )
}
