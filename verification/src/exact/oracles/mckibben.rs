//! Oracles of the McKibben muscles.

use super::super::mckibben::{
    BOLEN_10_MM, BOLEN_PRESSURE_PA, Braid, Motion, bolen_full_force_n, bolen_shape, braid_force_n, festo_pressure_pa,
    max_contraction, rest_angle_from_max_contraction, thick_braid_force_n, tondu_lopez_coefficients,
    tondu_lopez_force_n,
};
use super::{OracleRow, section};

/// Rows of [`super::super::mckibben`].
pub fn rows() -> Vec<OracleRow> {
    [tondu_lopez(), chou_hannaford(), festo()].concat()
}

fn tondu_lopez() -> Vec<OracleRow> {
    let coefficients = |degrees: f64| tondu_lopez_coefficients(degrees.to_radians());
    let force = |degrees: f64, contraction| tondu_lopez_force_n(0.01, degrees.to_radians(), contraction, 30e3, 1.0);
    section(
        "McKibben, Tondu–Lopez, r0 = 10 mm, 30 kPa",
        [
            ("a at α0 = 20°", "22.6458965", coefficients(20.0)[0]),
            ("b at α0 = 20°", "8.54863217", coefficients(20.0)[1]),
            ("F(0) at α0 = 20° [N]", "132.863586", force(20.0, 0.0)),
            ("F(0.1) at α0 = 20° [N]", "92.3114025", force(20.0, 0.1)),
            ("ε_max at α0 = 20°", "0.385596677", max_contraction(20.0_f64.to_radians())),
            ("a at α0 = 30°", "9.00000000", coefficients(30.0)[0]),
            ("b at α0 = 30°", "4.00000000", coefficients(30.0)[1]),
            ("F(0) at α0 = 30° [N]", "47.1238898", force(30.0, 0.0)),
            ("F(0.1) at α0 = 30° [N]", "31.0075195", force(30.0, 0.1)),
            ("ε_max at α0 = 30°", "0.333333333", max_contraction(30.0_f64.to_radians())),
            ("a at α0 = 45°", "3.00000000", coefficients(45.0)[0]),
            ("b at α0 = 45°", "2.00000000", coefficients(45.0)[1]),
            ("F(0) at α0 = 45° [N]", "9.42477796", force(45.0, 0.0)),
            ("F(0.1) at α0 = 45° [N]", "4.05265452", force(45.0, 0.1)),
            ("ε_max at α0 = 45°", "0.183503419", max_contraction(45.0_f64.to_radians())),
            ("α0 for ε_max = 0.3 [°]", "34.433189", rest_angle_from_max_contraction(0.3).to_degrees()),
        ],
    )
}

fn chou_hannaford() -> Vec<OracleRow> {
    let braid = Braid { thread_m: 0.3, turns: 2.0 };
    let force = |degrees: f64| braid_force_n(&braid, degrees.to_radians(), 30e3);
    section(
        "McKibben, Chou–Hannaford, b = 0.3 m, n = 2, 30 kPa",
        [
            ("F at θ = 30° [N]", "67.1434916", force(30.0)),
            ("F at θ = 45° [N]", "26.8573966", force(45.0)),
            (
                "F at θ = 30°, wall 1 mm [N]",
                "62.5492438",
                thick_braid_force_n(&braid, 30.0_f64.to_radians(), 30e3, 1e-3),
            ),
        ],
    )
}

fn festo() -> Vec<OracleRow> {
    let pressure_kpa = |motion| 1e-3 * festo_pressure_pa(100.0, 0.1, 0.165, motion);
    let short_n = bolen_full_force_n(&BOLEN_10_MM, 0.054);
    section(
        "McKibben, Festo fits",
        [
            ("F620, 10 mm, l = 112 mm [N]", "335.326631", bolen_full_force_n(&BOLEN_10_MM, 0.112)),
            ("F620, 10 mm, l = 54 mm [N]", "219.857477", short_n),
            (
                "F, 10 mm, l = 54 mm, 300 kPa, ε* = 0 [N]",
                "106.38265",
                short_n * bolen_shape(&BOLEN_10_MM, 0.0, 300e3 / BOLEN_PRESSURE_PA),
            ),
            ("F*(0.5, 1), 10 mm", "0.368949664", bolen_shape(&BOLEN_10_MM, 0.5, 1.0)),
            ("F*(0.2, 0.5), 10 mm", "0.163393332", bolen_shape(&BOLEN_10_MM, 0.2, 0.5)),
            ("P, shortening [kPa]", "524.825452", pressure_kpa(Motion::Shortening)),
            ("P, still [kPa]", "509.225452", pressure_kpa(Motion::Still)),
            ("P, lengthening [kPa]", "493.625452", pressure_kpa(Motion::Lengthening)),
        ],
    )
}
