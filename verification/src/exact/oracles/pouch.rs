//! Oracles of the pouch motor; L0 = W = 60 mm unless said.

use std::f64::consts::FRAC_PI_2;

use super::super::pouch::{
    KEPERT_VOLUME_HIGH, KEPERT_VOLUME_LOW, MAX_CONTRACTION, Pouch, contraction, elastic_contraction, force_n,
    hinge_theta, hinge_torque_nm, robin_end_factor, sealed_theta, sealed_volume_m3, square_end_factor,
    theta_from_force, volume_m3,
};
use super::{OracleRow, section};

const SQUARE: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };

/// Rows of [`super::super::pouch`].
pub fn rows() -> Vec<OracleRow> {
    [linear(), loaded(), hinge(), ends(), sealed()].concat()
}

/// Simpson's rule with 400 intervals and a golden section, not this crate's quadrature and root.
fn sealed() -> Vec<OracleRow> {
    let free = |ratio: f64| Pouch { length_m: 1.0, width_m: ratio };
    let ends = |ratio: f64| contraction(sealed_theta(&free(ratio)));
    let holds = |ratio: f64| sealed_volume_m3(&free(ratio), sealed_theta(&free(ratio)));
    section(
        "sealed pouch, free",
        [
            ("ε at W/L₀ = 1", "0.218834", ends(1.0)),
            ("ε at W/L₀ = 1.5", "0.276814", ends(1.5)),
            ("ε at W/L₀ = 2", "0.303037", ends(2.0)),
            ("ε at W/L₀ = 4", "0.336628", ends(4.0)),
            ("V/L₀³ at W/L₀ = 1", "0.19609504", holds(1.0)),
            ("V/L₀³ at W/L₀ = 1.5", "0.34937148", holds(1.5)),
            ("V/L₀³ at W/L₀ = 2", "0.50625229", holds(2.0)),
            ("V/L₀³ at W/L₀ = 4", "1.14017416", holds(4.0)),
        ],
    )
}

fn linear() -> Vec<OracleRow> {
    section(
        "pouch motor, linear",
        [
            ("greatest ε", "0.3633802", MAX_CONTRACTION),
            ("ε at θ = 0.25", "0.010384163", contraction(0.25)),
            ("V at θ = 0.25 [m³]", "1.77763346e-5", volume_m3(&SQUARE, 0.25)),
            ("F at θ = 0.25, 30 kPa [N]", "418.570166", force_n(&SQUARE, 0.25, 30e3)),
            ("ε at θ = 0.5", "0.0411489228", contraction(0.5)),
            ("V at θ = 0.5 [m³]", "3.42422673e-5", volume_m3(&SQUARE, 0.5)),
            ("F at θ = 0.5, 30 kPa [N]", "189.557833", force_n(&SQUARE, 0.5, 30e3)),
            ("ε at θ = 1.0", "0.158529015", contraction(1.0)),
            ("V at θ = 1.0 [m³]", "5.88979390e-5", volume_m3(&SQUARE, 1.0)),
            ("F at θ = 1.0, 30 kPa [N]", "58.3526490", force_n(&SQUARE, 1.0, 30e3)),
            ("ε at θ = 1.25", "0.240812305", contraction(1.25)),
            ("V at θ = 1.25 [m³]", "6.57168027e-5", volume_m3(&SQUARE, 1.25)),
            ("F at θ = 1.25, 30 kPa [N]", "27.2438521", force_n(&SQUARE, 1.25, 30e3)),
            ("ε at θ = 1.4", "0.296107336", contraction(1.4)),
            ("V at θ = 1.4 [m³]", "6.79135918e-5", volume_m3(&SQUARE, 1.4)),
            ("F at θ = 1.4, 30 kPa [N]", "13.1117510", force_n(&SQUARE, 1.4, 30e3)),
            ("ε at θ = 1.5", "0.335003342", contraction(1.5)),
            ("V at θ = 1.5 [m³]", "6.86131198e-5", volume_m3(&SQUARE, 1.5)),
            ("F at θ = 1.5, 30 kPa [N]", "5.09307852", force_n(&SQUARE, 1.5, 30e3)),
            ("ε at θ = π/2", "0.363380228", contraction(FRAC_PI_2)),
            ("V at θ = π/2 [m³]", "6.87549354e-5", volume_m3(&SQUARE, FRAC_PI_2)),
            ("F at θ = π/2, 30 kPa [N]", "0.0000000", force_n(&SQUARE, FRAC_PI_2, 30e3)),
        ],
    )
}

fn loaded() -> Vec<OracleRow> {
    let theta = |pressure_pa| theta_from_force(&SQUARE, pressure_pa, 5.0).unwrap_or(f64::NAN);
    section(
        "pouch motor, loaded and elastic",
        [
            ("θ at F = 5 N, 10 kPa", "1.37819214", theta(10e3)),
            ("ε at F = 5 N, 10 kPa", "0.287828559", contraction(theta(10e3))),
            ("θ at F = 5 N, 20 kPa", "1.46863046", theta(20e3)),
            ("ε at F = 5 N, 20 kPa", "0.322644033", contraction(theta(20e3))),
            ("θ at F = 5 N, 30 kPa", "1.50123847", theta(30e3)),
            ("ε at F = 5 N, 30 kPa", "0.335494095", contraction(theta(30e3))),
            ("ε_c at θ = 1, 10 kPa", "0.130342119", elastic_contraction(contraction(1.0), 5e-6, 10e3)),
            ("ε_c at θ = 1, 20 kPa", "0.102155224", elastic_contraction(contraction(1.0), 5e-6, 20e3)),
            ("ε_c at θ = 1, 30 kPa", "0.0739683277", elastic_contraction(contraction(1.0), 5e-6, 30e3)),
        ],
    )
}

fn hinge() -> Vec<OracleRow> {
    section(
        "pouch motor, angular",
        [
            ("θ at α = 0.5", "0.433924191", hinge_theta(0.5)),
            ("τ at α = 0.5, 30 kPa [N m]", "1.54889135", hinge_torque_nm(&SQUARE, 0.5, 30e3)),
            ("θ at α = 1.0", "0.873554261", hinge_theta(1.0)),
            ("τ at α = 1.0, 30 kPa [N m]", "1.00853551", hinge_torque_nm(&SQUARE, 1.0, 30e3)),
            ("θ at α = 1.5", "1.32593310", hinge_theta(1.5)),
            ("τ at α = 1.5, 30 kPa [N m]", "0.259190771", hinge_torque_nm(&SQUARE, 1.5, 30e3)),
            ("θ at α = 2.0", "1.80169651", hinge_theta(2.0)),
            ("τ at α = 2.0, 30 kPa [N m]", "-0.510232272", hinge_torque_nm(&SQUARE, 2.0, 30e3)),
        ],
    )
}

fn ends() -> Vec<OracleRow> {
    section(
        "pouch motor, sealed ends",
        [
            ("η(W/L0 = 1.0)", "0.598504459", robin_end_factor(1.0)),
            ("η(W/L0 = 2.0)", "0.779177452", robin_end_factor(2.0)),
            ("η, 46 mm × 17.25 mm", "0.833070606", robin_end_factor(46.0 / 17.25)),
            ("η(W/L0 = 5.0)", "0.910779661", robin_end_factor(5.0)),
            ("η(W/L0 = 10.0)", "0.955389384", robin_end_factor(10.0)),
            ("η, 30 mm × 22.93 mm", "0.675790722", robin_end_factor(30.0 / 22.93)),
            ("η(1), lower volume bound", "0.6456", square_end_factor(KEPERT_VOLUME_LOW)),
            ("η(1), upper volume bound", "0.6817", square_end_factor(KEPERT_VOLUME_HIGH)),
        ],
    )
}
