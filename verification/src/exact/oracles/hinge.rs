//! Oracles of the virtual-work hinge model: body R = 40 mm, p = 2 kPa, L_b = 360 mm; pouches L0 = W = 60 mm, N = 6, marker
//! at s = 330 mm unless said. Number of pouches and marker station are assumptions about the published robot.

use super::super::hinge::{
    Arm, BentBody, Lever, Unit, arm_m, axis_point_m, contact_theta, equilibrium_theta, fold_angle, restoring_moment_nm,
    theta_from_fold_angle, total_angle_from_height,
};
use super::super::pouch::{Pouch, contraction};
use super::{OracleRow, section};

const BODY_PA: f64 = 2e3;
const SQUARE: Pouch = Pouch { length_m: 0.06, width_m: 0.06 };
const EMBEDDED: Unit = Unit { pouch: SQUARE, body_radius_m: 0.04, end_factor: 1.0, arm: Arm::Embedded };
const EXTERNAL: Unit = Unit { arm: Arm::External, ..EMBEDDED };

/// Rows of [`super::super::hinge`].
pub fn rows() -> Vec<OracleRow> {
    [embedded(), embedded_readings(), external(), contact(), inverse()].concat()
}

/// y of the marker \[mm\] for `count` units at half angle θ.
fn marker_mm(unit: &Unit, theta: f64, count: f64, station_mm: f64) -> f64 {
    let body = BentBody { body_radius_m: 0.04, length_m: 0.36, total_angle: count * fold_angle(unit, theta) };
    1e3 * axis_point_m(&body, 1e-3 * station_mm)[1]
}

fn embedded_theta(actuator_pa: f64) -> f64 {
    equilibrium_theta(&EMBEDDED, actuator_pa, BODY_PA, Lever::VirtualWork)
}

fn embedded_height_mm(end_factor: f64, count: f64, station_mm: f64, actuator_pa: f64) -> f64 {
    marker_mm(&Unit { end_factor, ..EMBEDDED }, embedded_theta(actuator_pa), count, station_mm)
}

fn external_theta(rule: Lever, actuator_pa: f64) -> f64 {
    equilibrium_theta(&EXTERNAL, actuator_pa, BODY_PA, rule)
}

fn external_height_mm(end_factor: f64, rule: Lever, actuator_pa: f64) -> f64 {
    marker_mm(&Unit { end_factor, ..EXTERNAL }, external_theta(rule, actuator_pa), 6.0, 330.0)
}

fn embedded_height_with_contact_mm(actuator_pa: f64) -> f64 {
    marker_mm(&EMBEDDED, embedded_theta(actuator_pa).min(contact_theta(&EMBEDDED)), 6.0, 330.0)
}

fn embedded() -> Vec<OracleRow> {
    let load = restoring_moment_nm(0.04, BODY_PA) / (30e3 * 0.06 * 0.06 * arm_m(&EMBEDDED, 0.0));
    section(
        "hinge model, embedded",
        [
            ("cos θ/θ, 30 kPa", "0.0465421134", load),
            ("θ, 30 kPa, more digits", "1.50088503", embedded_theta(30e3)),
            ("θ, 10 kPa", "1.377286", embedded_theta(10e3)),
            ("θ, 20 kPa", "1.468122", embedded_theta(20e3)),
            ("θ, 30 kPa", "1.500885", embedded_theta(30e3)),
            ("y, η = 1, 10 kPa [mm]", "148.807", embedded_height_mm(1.0, 6.0, 330.0, 10e3)),
            ("y, η = 1, 20 kPa [mm]", "158.494", embedded_height_mm(1.0, 6.0, 330.0, 20e3)),
            ("y, η = 1, 30 kPa [mm]", "161.550", embedded_height_mm(1.0, 6.0, 330.0, 30e3)),
            ("y, η = 0.598504, 10 kPa [mm]", "102.6", embedded_height_mm(0.598504, 6.0, 330.0, 10e3)),
            ("y, η = 0.598504, 20 kPa [mm]", "112.5", embedded_height_mm(0.598504, 6.0, 330.0, 20e3)),
            ("y, η = 0.598504, 30 kPa [mm]", "116.0", embedded_height_mm(0.598504, 6.0, 330.0, 30e3)),
            ("y, η = 0.6456, 10 kPa [mm]", "109.1", embedded_height_mm(0.6456, 6.0, 330.0, 10e3)),
            ("y, η = 0.6456, 20 kPa [mm]", "119.3", embedded_height_mm(0.6456, 6.0, 330.0, 20e3)),
            ("y, η = 0.6456, 30 kPa [mm]", "122.9", embedded_height_mm(0.6456, 6.0, 330.0, 30e3)),
            ("y, η = 0.6817, 10 kPa [mm]", "113.9", embedded_height_mm(0.6817, 6.0, 330.0, 10e3)),
            ("y, η = 0.6817, 20 kPa [mm]", "124.3", embedded_height_mm(0.6817, 6.0, 330.0, 20e3)),
            ("y, η = 0.6817, 30 kPa [mm]", "127.9", embedded_height_mm(0.6817, 6.0, 330.0, 30e3)),
        ],
    )
}

fn embedded_readings() -> Vec<OracleRow> {
    section(
        "hinge model, embedded, other readings",
        [
            ("y, N = 5 on the same body, 10 kPa [mm]", "132.2", embedded_height_mm(1.0, 5.0, 330.0, 10e3)),
            ("y, N = 5 on the same body, 20 kPa [mm]", "142.8", embedded_height_mm(1.0, 5.0, 330.0, 20e3)),
            ("y, N = 5 on the same body, 30 kPa [mm]", "146.3", embedded_height_mm(1.0, 5.0, 330.0, 30e3)),
            ("y at s = 360 mm, 10 kPa [mm]", "173.1", embedded_height_mm(1.0, 6.0, 360.0, 10e3)),
            ("y at s = 360 mm, 20 kPa [mm]", "183.2", embedded_height_mm(1.0, 6.0, 360.0, 20e3)),
            ("y at s = 360 mm, 30 kPa [mm]", "186.3", embedded_height_mm(1.0, 6.0, 360.0, 30e3)),
            ("y, η = 1, 2 kPa [mm]", "79.9", embedded_height_mm(1.0, 6.0, 330.0, 2e3)),
            ("y, η = 1, 5 kPa [mm]", "128.9", embedded_height_mm(1.0, 6.0, 330.0, 5e3)),
            ("y, η = 0.62, 2 kPa [mm]", "51.6", embedded_height_mm(0.62, 6.0, 330.0, 2e3)),
            ("y, η = 0.62, 5 kPa [mm]", "87.9", embedded_height_mm(0.62, 6.0, 330.0, 5e3)),
            ("y, η = 0.62, 10 kPa [mm]", "105.6", embedded_height_mm(0.62, 6.0, 330.0, 10e3)),
            ("y, η = 0.62, 20 kPa [mm]", "115.7", embedded_height_mm(0.62, 6.0, 330.0, 20e3)),
            ("y, η = 0.62, 30 kPa [mm]", "119.2", embedded_height_mm(0.62, 6.0, 330.0, 30e3)),
        ],
    )
}

fn external() -> Vec<OracleRow> {
    section(
        "hinge model, external",
        [
            ("d at θ = 0.5 [mm]", "47.3", 1e3 * (arm_m(&EXTERNAL, 0.5) - 0.04)),
            ("d at θ = 1.4 [mm]", "57.8", 1e3 * (arm_m(&EXTERNAL, 1.4) - 0.04)),
            ("θ, 10 kPa", "1.419135", external_theta(Lever::VirtualWork, 10e3)),
            ("θ, 20 kPa", "1.491654", external_theta(Lever::VirtualWork, 20e3)),
            ("θ, 30 kPa", "1.517228", external_theta(Lever::VirtualWork, 30e3)),
            ("y, η = 1, 10 kPa [mm]", "135.350", external_height_mm(1.0, Lever::VirtualWork, 10e3)),
            ("y, η = 1, 20 kPa [mm]", "142.972", external_height_mm(1.0, Lever::VirtualWork, 20e3)),
            ("y, η = 1, 30 kPa [mm]", "145.515", external_height_mm(1.0, Lever::VirtualWork, 30e3)),
            ("y, η = 0.598504, 10 kPa [mm]", "90.6", external_height_mm(0.598504, Lever::VirtualWork, 10e3)),
            ("y, η = 0.598504, 20 kPa [mm]", "97.2", external_height_mm(0.598504, Lever::VirtualWork, 20e3)),
            ("y, η = 0.598504, 30 kPa [mm]", "99.5", external_height_mm(0.598504, Lever::VirtualWork, 30e3)),
            ("y, current arm, 10 kPa [mm]", "134.27", external_height_mm(1.0, Lever::CurrentArm, 10e3)),
            ("y, current arm, 20 kPa [mm]", "142.44", external_height_mm(1.0, Lever::CurrentArm, 20e3)),
            ("y, current arm, 30 kPa [mm]", "145.16", external_height_mm(1.0, Lever::CurrentArm, 30e3)),
        ],
    )
}

fn contact() -> Vec<OracleRow> {
    section(
        "hinge model, neighbour contact",
        [
            ("θ_c, embedded", "1.452", contact_theta(&EMBEDDED)),
            ("θ_c, external", "1.472", contact_theta(&EXTERNAL)),
            ("ε at contact, embedded", "0.316", contraction(contact_theta(&EMBEDDED))),
            ("y with contact, 10 kPa [mm]", "148.807", embedded_height_with_contact_mm(10e3)),
            ("y with contact, 20 kPa [mm]", "156.922", embedded_height_with_contact_mm(20e3)),
            ("y with contact, 30 kPa [mm]", "156.922", embedded_height_with_contact_mm(30e3)),
        ],
    )
}

/// Contraction that would give the published tip displacement at 30 kPa, read at s = 330 and at s = 360 mm.
fn inverse() -> Vec<OracleRow> {
    let total = |station_mm: f64, y_mm: f64| total_angle_from_height(0.04, 0.36, 1e-3 * station_mm, 1e-3 * y_mm);
    let degrees = |y_mm: f64| total(330.0, y_mm).to_degrees();
    let apparent = |unit: &Unit, station_mm: f64, y_mm: f64| {
        contraction(theta_from_fold_angle(unit, total(station_mm, y_mm) / 6.0))
    };
    // The muscle: 300 mm of it bend the whole 360 mm, axis at d = R + W/π.
    let fabric = |station_mm: f64| total(station_mm, 67.2) * (0.08 + 0.06 / std::f64::consts::PI) / 0.3;
    section(
        "hinge model, contraction seen in a displacement",
        [
            ("Φ for 159.7 mm [°]", "84.4", degrees(159.7)),
            ("Φ for 119.4 mm [°]", "53.7", degrees(119.4)),
            ("Φ for 67.5 mm [°]", "27.4", degrees(67.5)),
            ("Φ for 67.2 mm [°]", "27.3", degrees(67.2)),
            ("ε, embedded, 159.7 mm at 330 mm", "0.3274", apparent(&EMBEDDED, 330.0, 159.7)),
            ("ε, embedded, 159.7 mm at 360 mm", "0.2511", apparent(&EMBEDDED, 360.0, 159.7)),
            ("ε, embedded, 119.4 mm at 330 mm", "0.2083", apparent(&EMBEDDED, 330.0, 119.4)),
            ("ε, embedded, 119.4 mm at 360 mm", "0.1690", apparent(&EMBEDDED, 360.0, 119.4)),
            ("ε, external, 67.5 mm at 330 mm", "0.1228", apparent(&EXTERNAL, 330.0, 67.5)),
            ("ε, external, 67.5 mm at 360 mm", "0.1008", apparent(&EXTERNAL, 360.0, 67.5)),
            ("ε, 300 mm fabric muscle, 67.2 mm at 330 mm", "0.1575", fabric(330.0)),
            ("ε, 300 mm fabric muscle, 67.2 mm at 360 mm", "0.1307", fabric(360.0)),
        ],
    )
}
