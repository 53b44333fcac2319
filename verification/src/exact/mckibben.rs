//! McKibben muscles: a braid of inextensible threads around a bladder.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α0 | angle of the threads from the axis at rest | rad |
//! | r0 | radius at rest | m |
//! | ε | contraction, 1 − L/L_rest | – |
//! | P, F | gauge pressure, pulling force | Pa, N |
//!
//! The text of Tondu and Lopez was not read: their formula is standard.
//! Without bladder stiffness, end caps and friction, free contraction does not depend on pressure. **Real muscles do.**

use std::f64::consts::PI;

use super::KnownSections;

/// Coefficients `[a, b]` of [`tondu_lopez_force_n`]: `a = 3/tan²α0`, `b = 1/sin²α0`.
pub fn tondu_lopez_coefficients(rest_angle: f64) -> [f64; 2] {
    [3.0 / rest_angle.tan().powi(2), rest_angle.sin().powi(-2)]
}

/// Force `F = π r0² P [a (1 − k ε)² − b]` \[N\]; k = 1 for a cylinder to the ends, larger where the ends taper.
///
/// B. Tondu & P. Lopez, IEEE Control Systems 20 (2000) 15–38. Read in third-party code; k is recalled. The friction of the
/// braid, `±f` against the motion, is left out.
pub fn tondu_lopez_force_n(radius_m: f64, rest_angle: f64, contraction: f64, pressure_pa: f64, end_shape: f64) -> f64 {
    let [a, b] = tondu_lopez_coefficients(rest_angle);
    PI * radius_m.powi(2) * pressure_pa * (a * (1.0 - end_shape * contraction).powi(2) - b)
}

/// Free contraction `ε_max = 1 − 1/(√3 cos α0)` at k = 1, whatever the pressure. Derived here.
pub fn max_contraction(rest_angle: f64) -> f64 {
    1.0 - 1.0 / (3.0_f64.sqrt() * rest_angle.cos())
}

pub(super) fn known() -> KnownSections {
    let tondu_lopez = [20.0_f64, 30.0, 45.0].map(f64::to_radians).map(|rest| {
        let [a, b] = tondu_lopez_coefficients(rest);
        let [blocked, shorter] = [0.0, 0.1].map(|contraction| tondu_lopez_force_n(0.01, rest, contraction, 30e3, 1.0));
        [a, b, blocked, shorter, max_contraction(rest)]
    });
    vec![("McKibben, Tondu–Lopez, r0 = 10 mm, 30 kPa", tondu_lopez.as_flattened().to_vec())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_vanishes_at_the_free_contraction() {
        let rest = 0.5;
        assert!(tondu_lopez_force_n(0.01, rest, max_contraction(rest), 30e3, 1.0).abs() < 1e-12);
    }
}
