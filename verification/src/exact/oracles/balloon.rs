//! Oracles of the Mylar balloon: adaptive quadrature with 25 digits; the elastic ones by shooting in the meridian's slope
//! with adaptive steps to 1e-9, and within 3e-6 by minimising the energy of a meridian of 400 pieces.

use super::super::balloon::{RADIUS_RATIO, THICKNESS_RATIO, elastic, height_ratio, meridian_ratio, volume_m3};
use super::{OracleRow, section};

/// Rows of [`super::super::balloon`].
pub fn rows() -> Vec<OracleRow> {
    [stretchless(), of_film()].concat()
}

fn stretchless() -> Vec<OracleRow> {
    section(
        "Mylar balloon",
        [
            ("r/R0", "0.762759763502", 1.0 / meridian_ratio(1.0)),
            ("thickness/r", "1.1981402347356", 2.0 * height_ratio(0.0)),
            ("thickness/R0", "0.9138931620889", THICKNESS_RATIO * RADIUS_RATIO),
            ("z/r at x = r/2", "0.556828104462", height_ratio(0.5)),
            ("z/r at x = 0.9 r", "0.302958697948", height_ratio(0.9)),
            ("s/r at x = r/2", "0.503209443177", meridian_ratio(0.5)),
            ("V/R0³", "1.2185242161186", volume_m3(1.0)),
        ],
    )
}

fn of_film() -> Vec<OracleRow> {
    let (stiff, soft) = (elastic(1e-3, 0.3), elastic(1e-2, 0.3));
    section(
        "Mylar balloon of elastic film, ν = 0.3",
        [
            ("r/R0 at p R0/(Et) = 0.001", "0.76322817", stiff.radius),
            ("thickness/R0 at 0.001", "0.918986", stiff.thickness),
            ("V/R0³ at 0.001", "1.22098340", stiff.volume),
            ("r/R0 at p R0/(Et) = 0.01", "0.76643222", soft.radius),
            ("thickness/R0 at 0.01", "0.936357", soft.thickness),
            ("V/R0³ at 0.01", "1.23836150", soft.volume),
            ("stretch at the pole at 0.01", "1.0071858", soft.pole_stretch),
        ],
    )
}
