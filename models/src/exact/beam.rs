//! Inflated tube in bending: wrinkling, collapse, tendons, and the Timoshenko cantilever.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | p | gauge pressure in the tube | Pa |
//! | R, t, L | radius, wall thickness, length | m |
//! | E t | membrane stiffness along the axis | N/m |
//! | N | thrust in the membrane: pπR² minus any external axial compression | N |
//! | γ0 | half angle of the slack zone: 0 first wrinkle, π hinge | rad |
//! | κ | curvature | 1/m |
//! | M | moment about the centroid of the tube | N m |
//!
//! Wrinkling follows Comer & Levy, AIAA J. 1 (1963) 1652–1655. The paper was not read: the closed form is derived here by
//! integrating a wall that carries tension only, checked by quadrature, and agrees with a published vine-robot code.
//! Valid for a circular section that stays circular, linear elastic tension, no bending stiffness of the wall.

use std::f64::consts::{FRAC_PI_2, PI};

use super::solve::{sine_deficit, sine_lag};

/// Section of an inflated tube whose wall carries tension only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tube {
    /// Radius R \[m\].
    pub radius_m: f64,
    /// Membrane stiffness E t \[N/m\].
    pub membrane_stiffness_n_per_m: f64,
    /// Thrust N in the membrane \[N\], positive; see [`thrust_n`].
    pub thrust_n: f64,
}

/// Membrane thrust `N = p π R² − F` with external axial compression F \[N\].
pub fn thrust_n(pressure_pa: f64, radius_m: f64, axial_compression_n: f64) -> f64 {
    pressure_pa * PI * radius_m.powi(2) - axial_compression_n
}

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

/// Curvature of the first wrinkle, `κ_w = N/(2π E t R²)` \[1/m\]; p/(2 E t) for N = pπR².
pub fn wrinkling_curvature_per_m(tube: &Tube) -> f64 {
    tube.thrust_n / (2.0 * PI * tube.membrane_stiffness_n_per_m * tube.radius_m.powi(2))
}

/// Moment of the first wrinkle, `M_w = N R/2` \[N m\]; pπR³/2 for N = pπR².
pub fn wrinkling_moment_nm(tube: &Tube) -> f64 {
    0.5 * tube.thrust_n * tube.radius_m
}

/// Moment of collapse, `M_c = N R` \[N m\]; pπR³ for N = pπR².
pub fn collapse_moment_nm(tube: &Tube) -> f64 {
    tube.thrust_n * tube.radius_m
}

/// Moment M(κ) \[N m\], odd in κ: `π E t R³ κ` up to the first wrinkle, Comer–Levy beyond. Zero for N ≤ 0.
pub fn moment_nm(tube: &Tube, curvature_per_m: f64) -> f64 {
    if tube.thrust_n <= 0.0 {
        return 0.0;
    }
    collapse_moment_nm(tube) * moment_ratio_from_curvature_ratio(curvature_per_m / wrinkling_curvature_per_m(tube))
}

/// First wrinkle by the strain criterion of an isotropic wall, `M_w = (1 − 2ν) p π R³/2` \[N m\].
///
/// Hoop tension contracts the wall along the axis, so the strain vanishes before the stress does. Attributed to Main et
/// al. (1994), recalled and not checked against the text; Zhu, Seth & Quine (2008, abstract read) call it a lower bound
/// and the stress criterion of [`wrinkling_moment_nm`] an upper one.
pub fn strain_based_wrinkling_moment_nm(pressure_pa: f64, radius_m: f64, poisson: f64) -> f64 {
    0.5 * (1.0 - 2.0 * poisson) * pressure_pa * PI * radius_m.powi(3)
}

/// Tension of a tendon at distance d from the axis that holds the wrinkled tube, `T = p π R³ α/(d + α R)` \[N\].
///
/// Thrust N = pπR² − T and moment T d = N R α, with α from 1/2 (first wrinkle) to 1 (hinge, `p π R³/(R + d)`). Derived here.
pub fn tendon_tension_n(pressure_pa: f64, radius_m: f64, distance_m: f64, moment_ratio: f64) -> f64 {
    pressure_pa * PI * radius_m.powi(3) * moment_ratio / (distance_m + moment_ratio * radius_m)
}

/// Inflated cantilever with a thin isotropic wall.
///
/// S = 2πRt, I = πR³t, P_f = pπR², shear factor k = 1/2. For an orthotropic wall put the axial modulus and the in-plane
/// shear modulus. Valid before the first wrinkle. Attributed to Le Van & Wielgosz, Thin-Walled Structures 43 (2005)
/// 1166–1187, and Fichter, NASA TN D-3466 (1966); recalled, neither was read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cantilever {
    /// Radius R \[m\].
    pub radius_m: f64,
    /// Wall thickness t \[m\].
    pub thickness_m: f64,
    /// Length L \[m\].
    pub length_m: f64,
    /// Young's modulus E \[Pa\].
    pub young_pa: f64,
    /// Shear modulus G \[Pa\].
    pub shear_pa: f64,
    /// Gauge pressure p \[Pa\].
    pub pressure_pa: f64,
}

/// Whose beam: they differ in how pressure stiffens it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamTheory {
    /// Pressure adds P_f/S to E, and P_f to the shear stiffness.
    LeVanWielgosz,
    /// Pressure adds P_f to the shear stiffness only.
    Fichter,
    /// No pressure, no shear: Euler and Bernoulli.
    Euler,
}

/// Tip deflection under a tip load F \[m\]: `v = F L³/(3 (E + P_f/S) I) + F L/(P_f + k G S)`.
///
/// Fichter drops P_f/S; Euler drops the second fraction too.
pub fn tip_deflection_m(beam: &Cantilever, load_n: f64, theory: BeamTheory) -> f64 {
    let bending = load_n * beam.length_m.powi(3) / (3.0 * bending_stiffness_nm2(beam, theory));
    match theory {
        BeamTheory::Euler => bending,
        _ => bending + load_n * beam.length_m / shear_stiffness_n(beam),
    }
}

/// Axial load at which the cantilever buckles \[N\], Ω = π/(2L):
/// `F = (E + P_f/S) I Ω² / (1 + Ω² I/S + (E + P_f/S) I Ω²/(P_f + k G S))`.
///
/// Fichter drops P_f/S and Ω² I/S; Euler is the numerator with E alone.
pub fn buckling_load_n(beam: &Cantilever, theory: BeamTheory) -> f64 {
    let omega_squared = (FRAC_PI_2 / beam.length_m).powi(2);
    let euler = bending_stiffness_nm2(beam, theory) * omega_squared;
    let rotary = omega_squared * 0.5 * beam.radius_m.powi(2);
    match theory {
        BeamTheory::Euler => euler,
        BeamTheory::Fichter => euler / (1.0 + euler / shear_stiffness_n(beam)),
        BeamTheory::LeVanWielgosz => euler / (1.0 + rotary + euler / shear_stiffness_n(beam)),
    }
}

/// Tip load at the first wrinkle, `F_w = p π R³/(2L)` \[N\]; the deflection beyond it is in [`super::inflated_cantilever`].
pub fn wrinkling_tip_load_n(beam: &Cantilever) -> f64 {
    0.5 * collapse_tip_load_n(beam)
}

/// Tip load at collapse, `F_c = p π R³/L` \[N\].
pub fn collapse_tip_load_n(beam: &Cantilever) -> f64 {
    beam.pressure_pa * PI * beam.radius_m.powi(3) / beam.length_m
}

/// `(E + P_f/S) I`, or `E I` for the theories without P_f/S \[N m²\].
fn bending_stiffness_nm2(beam: &Cantilever, theory: BeamTheory) -> f64 {
    let added = if theory == BeamTheory::LeVanWielgosz { pressure_force_n(beam) / wall_area_m2(beam) } else { 0.0 };
    (beam.young_pa + added) * PI * beam.radius_m.powi(3) * beam.thickness_m
}

/// `P_f + k G S` with k = 1/2 \[N\].
fn shear_stiffness_n(beam: &Cantilever) -> f64 {
    pressure_force_n(beam) + 0.5 * beam.shear_pa * wall_area_m2(beam)
}

fn pressure_force_n(beam: &Cantilever) -> f64 {
    beam.pressure_pa * PI * beam.radius_m.powi(2)
}

fn wall_area_m2(beam: &Cantilever) -> f64 {
    2.0 * PI * beam.radius_m * beam.thickness_m
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
    use super::super::oracles;
    use super::*;

    const TUBE: Tube = Tube { radius_m: 0.04, membrane_stiffness_n_per_m: 41.6e3, thrust_n: 10.053096491487338 };

    #[test]
    fn beam_oracles_are_reproduced_to_their_last_digit() {
        oracles::assert_all_agree(&oracles::beam::rows());
    }

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
    fn moment_is_odd_and_linear_before_wrinkling() {
        let kappa = 0.3 * wrinkling_curvature_per_m(&TUBE);
        let linear = PI * TUBE.membrane_stiffness_n_per_m * TUBE.radius_m.powi(3) * kappa;
        assert!((moment_nm(&TUBE, kappa) / linear - 1.0).abs() < 1e-14);
        assert_eq!(moment_nm(&TUBE, -3.0), -moment_nm(&TUBE, 3.0));
        assert_eq!(moment_nm(&Tube { thrust_n: 0.0, ..TUBE }, 1.0), 0.0);
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

    #[test]
    fn tendon_balances_thrust_and_moment() {
        let (p, radius, d, alpha) = (2e3, 0.04, 0.05, 0.8);
        let tension = tendon_tension_n(p, radius, d, alpha);
        assert!((tension * d - thrust_n(p, radius, tension) * radius * alpha).abs() < 1e-14);
    }
}
