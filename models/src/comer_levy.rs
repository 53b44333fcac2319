//! Moment and curvature of an inflated tube whose wall wrinkles, as ratios.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | N, R | thrust in the membrane, radius | N, m |
//! | γ0 | half angle of the slack zone: 0 first wrinkle, π hinge | rad |
//! | κ, κ_w | curvature, and curvature of the first wrinkle | 1/m |
//! | M | moment about the centroid of the tube | N m |
//!
//! Reference: Comer & Levy, AIAA J. 1 (1963) 1652–1655. The paper was not read: the closed form is derived here by
//! integrating a wall that carries tension only, checked by quadrature, and agrees with a published vine-robot code.
//! Valid for a circular section that stays circular, linear elastic tension, no bending stiffness of the wall.

use crate::trig::{sine_deficit, sine_lag};
use std::f64::consts::PI;

/// Moment of a wrinkled tube, `M/(N R) = α(γ0) = [2π − 2γ0 + sin 2γ0]/(4 [sin γ0 + (π − γ0) cos γ0])`, 0 ≤ γ0 ≤ π.
///
/// From 1/2 at the first wrinkle to 1 at the hinge.
pub fn moment_ratio(gamma0: f64) -> f64 {
    moment_ratio_of_taut(PI - gamma0)
}

/// Curvature of a wrinkled tube, `κ/κ_w = π/[sin γ0 + (π − γ0) cos γ0]`: 1 at the first wrinkle, infinite at the hinge.
pub fn curvature_ratio(gamma0: f64) -> f64 {
    PI / thrust_integral(PI - gamma0)
}

/// Half angle γ0 of the slack zone at a given κ/κ_w; 0 up to the first wrinkle.
pub fn gamma0_from_curvature_ratio(ratio: f64) -> f64 {
    PI - taut_half_angle(ratio.abs())
}

/// `M/(N R)` at a given κ/κ_w, odd in κ: linear, `½ κ/κ_w`, up to the first wrinkle, [`moment_ratio`] beyond.
///
/// Accurate to rounding from κ/κ_w = 0 to infinity.
pub fn moment_ratio_from_curvature_ratio(ratio: f64) -> f64 {
    if ratio.abs() <= 1.0 {
        return 0.5 * ratio;
    }
    moment_ratio_of_taut(taut_half_angle(ratio.abs())).copysign(ratio)
}

/// `sin δ − δ cos δ` with δ = π − γ0 the half angle of the taut zone; equals the bracket `sin γ0 + (π − γ0) cos γ0`.
fn thrust_integral(taut: f64) -> f64 {
    taut.powi(3) * sine_lag(taut)
}

/// α in terms of δ = π − γ0: `(2δ − sin 2δ)/(4 (sin δ − δ cos δ))`, written so that the hinge limit δ → 0 keeps its digits.
fn moment_ratio_of_taut(taut: f64) -> f64 {
    2.0 * sine_deficit(2.0 * taut) / sine_lag(taut)
}

/// δ in \[0, π\] where `sin δ − δ cos δ = π/ratio`: Newton's method inside a shrinking bracket.
///
/// The left side rises on \[0, π\] with slope δ sin δ, which vanishes at both ends; the start is exact to first order there.
fn taut_half_angle(ratio: f64) -> f64 {
    if ratio <= 1.0 {
        return PI;
    }
    let target = PI / ratio;
    let (mut lo, mut hi) = (0.0, PI);
    let mut taut = if target > 2.0 { PI - (2.0 - 2.0 / ratio).sqrt() } else { (3.0 * target).cbrt() };
    // Seven steps at most, measured over ratios from 1 to 1e15; the bracket alone would need 60.
    for _ in 0..60 {
        let excess = thrust_integral(taut) - target;
        // At rounding level the sign of the excess is noise and must not move the bracket.
        if excess.abs() <= 4.0 * f64::EPSILON * target {
            return taut;
        }
        if excess > 0.0 {
            hi = taut
        } else {
            lo = taut
        }
        let newton = taut - excess / (taut * taut.sin());
        taut = if newton > lo && newton < hi { newton } else { 0.5 * (lo + hi) };
    }
    taut
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moment_and_curvature_ratios_rise_with_the_slack_zone() {
        let at = |i: i32| PI * f64::from(i) / 1000.0;
        for i in 0..999 {
            assert!(moment_ratio(at(i + 1)) > moment_ratio(at(i)));
            assert!(curvature_ratio(at(i + 1)) > curvature_ratio(at(i)));
        }
    }

    #[test]
    fn moment_from_curvature_inverts_the_closed_form_over_six_decades() {
        for i in 0..=600 {
            let ratio = 10_f64.powf(f64::from(i) / 100.0);
            let gamma0 = gamma0_from_curvature_ratio(ratio);
            assert!((curvature_ratio(gamma0) / ratio - 1.0).abs() < 1e-11, "κ/κ_w = {ratio}");
            let moment = moment_ratio_from_curvature_ratio(ratio);
            assert!((moment - moment_ratio(gamma0)).abs() < 1e-13, "κ/κ_w = {ratio}");
        }
        assert_eq!(moment_ratio_from_curvature_ratio(f64::INFINITY), 1.0);
        assert_eq!(moment_ratio_from_curvature_ratio(0.0), 0.0);
        assert!(moment_ratio_from_curvature_ratio(f64::NAN).is_nan());
    }

    #[test]
    fn moment_and_its_slope_are_continuous_at_the_first_wrinkle() {
        let h = 1e-6;
        let m = moment_ratio_from_curvature_ratio;
        assert!((m(1.0 + h) - m(1.0 - h) - h).abs() < 1e-2 * h);
    }

    #[test]
    fn closed_form_equals_quadrature_of_a_tension_only_wall() {
        // Tension per width ∝ cos φ − cos δ over the taut half angle δ = π − γ0, φ measured from the tense fibre.
        for gamma0 in [0.0, 0.5, 1.5, 2.5] {
            let (taut, steps): (f64, i32) = (PI - gamma0, 20_000);
            let (mut thrust, mut moment) = (0.0, 0.0);
            for i in 0..steps {
                let phi = taut * (f64::from(i) + 0.5) / f64::from(steps);
                thrust += phi.cos() - taut.cos();
                moment += (phi.cos() - taut.cos()) * phi.cos();
            }
            assert!((moment / thrust - moment_ratio(gamma0)).abs() < 1e-8, "γ0 = {gamma0}");
        }
    }
}
