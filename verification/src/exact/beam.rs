//! Inflated tube in bending: wrinkling, collapse, tendons, and the Timoshenko cantilever.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | p | gauge pressure in the tube | Pa |
//! | R, t, L | radius, wall thickness, length | m |
//! | E t | membrane stiffness along the axis | N/m |
//! | N | thrust in the membrane: pπR² minus any external axial compression | N |
//! | κ | curvature | 1/m |
//! | M | moment about the centroid of the tube | N m |
//!
//! Wrinkling follows Comer & Levy: [`models::comer_levy`]. Valid for a circular section that stays circular, linear elastic
//! tension, no bending stiffness of the wall.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Known;
pub use models::comer_levy::{curvature_ratio, moment_ratio, moment_ratio_from_curvature_ratio};

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

/// See `known.txt`; R = 40 mm, p = 2 kPa, E t = 41.6 kN/m.
pub(super) fn known() -> Known {
    let slack = [0.0, PI / 6.0, PI / 4.0, PI / 3.0, PI / 2.0, PI / 1.5, PI * 0.75, PI / 1.2, PI * 0.9];
    let tube = |radius_m, pressure_pa| Tube {
        radius_m,
        membrane_stiffness_n_per_m: 41.6e3,
        thrust_n: thrust_n(pressure_pa, radius_m, 0.0),
    };
    let body = tube(0.04, 2e3);
    let moments = [
        body.thrust_n,
        wrinkling_moment_nm(&body),
        collapse_moment_nm(&body),
        wrinkling_curvature_per_m(&body),
        wrinkling_moment_nm(&tube(0.08, 69e3)),
        strain_based_wrinkling_moment_nm(2e3, 0.04, 0.3),
    ];
    let tendon = [40.0, 50.0, 59.1]
        .map(|distance_mm| [0.5, 0.8, 1.0].map(|ratio| tendon_tension_n(2e3, 0.04, 1e-3 * distance_mm, ratio)));
    let beam = Cantilever {
        radius_m: 0.04,
        thickness_m: 0.2e-3,
        length_m: 0.36,
        young_pa: 208e6,
        shear_pa: 80e6,
        pressure_pa: 2e3,
    };
    let theories = [BeamTheory::LeVanWielgosz, BeamTheory::Fichter, BeamTheory::Euler];
    let cantilever = [
        &theories.map(|theory| tip_deflection_m(&beam, 0.2, theory))[..],
        &[wrinkling_tip_load_n(&beam), collapse_tip_load_n(&beam)],
        &theories.map(|theory| buckling_load_n(&beam, theory)),
    ];
    let bent = [2.0, 5.0, 10.0, 50.0, 100.0, 1000.0].map(moment_ratio_from_curvature_ratio);
    vec![
        ("inflated tube, Comer–Levy", slack.map(|gamma0| [moment_ratio(gamma0), curvature_ratio(gamma0)]).concat()),
        ("inflated tube, moment and curvature", [bent, moments].concat()),
        ("inflated tube, tendon, R = 40 mm, p = 2 kPa", tendon.concat()),
        ("inflated cantilever", cantilever.concat()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TUBE: Tube = Tube { radius_m: 0.04, membrane_stiffness_n_per_m: 41.6e3, thrust_n: 10.053096491487338 };

    #[test]
    fn moment_is_odd_and_linear_before_wrinkling() {
        let kappa = 0.3 * wrinkling_curvature_per_m(&TUBE);
        let linear = PI * TUBE.membrane_stiffness_n_per_m * TUBE.radius_m.powi(3) * kappa;
        assert!((moment_nm(&TUBE, kappa) / linear - 1.0).abs() < 1e-14);
        assert_eq!(moment_nm(&TUBE, -3.0), -moment_nm(&TUBE, 3.0));
        assert_eq!(moment_nm(&Tube { thrust_n: 0.0, ..TUBE }, 1.0), 0.0);
    }

    #[test]
    fn tendon_balances_thrust_and_moment() {
        let (p, radius, d, alpha) = (2e3, 0.04, 0.05, 0.8);
        let tension = tendon_tension_n(p, radius, d, alpha);
        assert!((tension * d - thrust_n(p, radius, tension) * radius * alpha).abs() < 1e-14);
    }
}
