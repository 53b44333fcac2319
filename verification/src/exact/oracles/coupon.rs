//! Oracles of the flat specimens: the rotated stiffness matrix inverted with 25 digits; a made-up shear law sent through the
//! geometry of the bias extension test and recovered.

use super::super::coupon::{Bias, Sheet, bias_force_n, lengthening_m, modulus_pa, poisson, shear_angle};
use super::super::coupon::{shear_force_n_per_m, shear_per_stretch};
use super::{OracleRow, section};

const BIAS: Bias = Bias { length_m: 0.25, width_m: 0.02 };

/// Rows of [`super::super::coupon`].
pub fn rows() -> Vec<OracleRow> {
    [off_axis(), angles(), made_up()].concat()
}

/// Sheet of 96.5 and 120 MPa, ν12 = 0.3, G = 1.032 MPa; moduli in MPa.
fn off_axis() -> Vec<OracleRow> {
    let sheet = Sheet { warp_pa: 96.5, fill_pa: 120.0, poisson: 0.3, shear_pa: 1.032 };
    let uncoupled = Sheet { poisson: 0.0, ..sheet };
    let at = |degrees: f64| modulus_pa(&sheet, degrees.to_radians());
    section(
        "off-axis specimen",
        [
            ("E(0°) [MPa]", "96.5", at(0.0)),
            ("E(15°) [MPa]", "14.4442574197", at(15.0)),
            ("E(30°) [MPa]", "5.35131110494", at(30.0)),
            ("E(45°) [MPa]", "4.07551663705", at(45.0)),
            ("E(60°) [MPa]", "5.38052667035", at(60.0)),
            ("E(90°) [MPa]", "120.0", at(90.0)),
            ("E(45°), ν12 = 0 [MPa]", "4.04986076926", modulus_pa(&uncoupled, 45_f64.to_radians())),
            ("ν(15°)", "0.897186575865", poisson(&sheet, 15_f64.to_radians())),
            ("ν(45°)", "0.974572014074", poisson(&sheet, 45_f64.to_radians())),
            ("ν(90°)", "0.373056994819", poisson(&sheet, 90_f64.to_radians())),
            ("γ/ε at 15°", "-2.94506381465", shear_per_stretch(&sheet, 15_f64.to_radians())),
            ("γ/ε at 45°", "0.00413534719217", shear_per_stretch(&sheet, 45_f64.to_radians())),
            ("γ/ε at 60°", "1.1045024227", shear_per_stretch(&sheet, 60_f64.to_radians())),
        ],
    )
}

/// H = 250 mm, W = 20 mm.
fn angles() -> Vec<OracleRow> {
    let degrees = |strain: f64| shear_angle(&BIAS, strain * 0.25).to_degrees();
    section(
        "bias extension, shear angle",
        [
            ("γ at 5 % [°]", "6.41040", degrees(0.05)),
            ("γ at 10 % [°]", "13.25033", degrees(0.10)),
            ("γ at 15 % [°]", "20.65072", degrees(0.15)),
            ("γ at 20 % [°]", "28.81883", degrees(0.20)),
            ("γ at 24 % [°]", "36.14225", degrees(0.24)),
            ("γ at 30 % [°]", "49.33272", degrees(0.30)),
            ("d/H at γ = 90°", "0.381076477", lengthening_m(&BIAS, std::f64::consts::FRAC_PI_2) / 0.25),
        ],
    )
}

/// F_sh = 20 N/m per radian.
fn made_up() -> Vec<OracleRow> {
    let law = |angle: f64| 20.0 * angle;
    let force = |angle| bias_force_n(&BIAS, angle, law);
    let turned = [0.7 / 3.0, 1.4 / 3.0, 0.7];
    let found = shear_force_n_per_m(&BIAS, &turned.map(|angle| [angle, force(angle)]));
    section(
        "bias extension, shear force",
        [
            ("d at γ = 0.7007/3 [mm]", "25.2325254", 1e3 * lengthening_m(&BIAS, 0.7007 / 3.0)),
            ("F at γ = 0.7007/3 [N]", "0.202938974", force(0.7007 / 3.0)),
            ("d at γ = 0.4669 [mm]", "46.9681594", 1e3 * lengthening_m(&BIAS, 0.4669)),
            ("F at γ = 0.4669 [N]", "0.440893099", force(0.4669)),
            ("d at γ = 0.7 [mm]", "64.9222197", 1e3 * lengthening_m(&BIAS, 0.7)),
            ("F at γ = 0.7 [N]", "0.706023369", force(0.7)),
            ("recovered at γ = 0.7 [N/m]", "14.0000000", found[2]),
        ],
    )
}
