//! Inflated tube in bending: wrinkling, collapse, and the Timoshenko cantilever.
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

use std::f64::consts::PI;

use super::KnownSections;
pub use models::comer_levy::{curvature_ratio, moment_ratio, moment_ratio_from_curvature_ratio};

/// Section of an inflated tube whose wall carries tension only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TubeSection {
    /// Radius R of the tube \[m\].
    pub radius_m: f64,
    /// Membrane stiffness E t along the tube \[N/m\].
    pub membrane_stiffness_n_per_m: f64,
    /// Thrust N in the membrane \[N\], positive; see [`thrust_n`].
    pub thrust_n: f64,
}

/// Membrane thrust `N = p π R² − F` with external axial compression F \[N\].
pub fn thrust_n(pressure_pa: f64, radius_m: f64, axial_compression_n: f64) -> f64 {
    pressure_pa * PI * radius_m.powi(2) - axial_compression_n
}

/// Curvature of the first wrinkle, `κ_w = N/(2π E t R²)` \[1/m\]; p/(2 E t) for N = pπR².
pub fn wrinkling_curvature_per_m(tube: &TubeSection) -> f64 {
    tube.thrust_n / (2.0 * PI * tube.membrane_stiffness_n_per_m * tube.radius_m.powi(2))
}

/// Moment of the first wrinkle, `M_w = N R/2` \[N m\]; pπR³/2 for N = pπR².
pub fn wrinkling_moment_nm(tube: &TubeSection) -> f64 {
    0.5 * tube.thrust_n * tube.radius_m
}

/// Moment of collapse, `M_c = N R` \[N m\]; pπR³ for N = pπR².
pub fn collapse_moment_nm(tube: &TubeSection) -> f64 {
    tube.thrust_n * tube.radius_m
}

/// Inflated cantilever with a thin isotropic wall.
///
/// S = 2πRt, I = πR³t, P_f = pπR², shear factor k = 1/2. For an orthotropic wall put the axial modulus and the in-plane
/// shear modulus. Valid before the first wrinkle. Attributed to Fichter, NASA TN D-3466 (1966); recalled, not read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cantilever {
    /// Radius R of the tube \[m\].
    pub radius_m: f64,
    /// Thickness t of the wall \[m\].
    pub thickness_m: f64,
    /// Length L from clamp to tip \[m\].
    pub length_m: f64,
    /// Young's modulus E of the wall \[Pa\].
    pub young_pa: f64,
    /// Shear modulus G of the wall \[Pa\].
    pub shear_pa: f64,
    /// Gauge pressure p of the gas \[Pa\].
    pub pressure_pa: f64,
}

/// Whose beam: they differ in how pressure stiffens it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamTheory {
    /// Pressure adds P_f to the shear stiffness.
    Fichter,
    /// No pressure, no shear: Euler and Bernoulli.
    Euler,
}

/// Tip deflection under a tip load F \[m\]: `v = F L³/(3 E I) + F L/(P_f + k G S)`; Euler drops the second fraction.
pub fn tip_deflection_m(beam: &Cantilever, load_n: f64, theory: BeamTheory) -> f64 {
    let bending =
        load_n * beam.length_m.powi(3) / (3.0 * beam.young_pa * PI * beam.radius_m.powi(3) * beam.thickness_m);
    match theory {
        BeamTheory::Euler => bending,
        _ => bending + load_n * beam.length_m / shear_stiffness_n(beam),
    }
}

/// Tip load at collapse, `F_c = p π R³/L` \[N\].
pub fn collapse_tip_load_n(beam: &Cantilever) -> f64 {
    beam.pressure_pa * PI * beam.radius_m.powi(3) / beam.length_m
}

/// `P_f + k G S` with k = 1/2 \[N\].
fn shear_stiffness_n(beam: &Cantilever) -> f64 {
    PI * beam.radius_m * (beam.pressure_pa * beam.radius_m + beam.shear_pa * beam.thickness_m)
}

/// See `known.txt`; R = 40 mm, p = 2 kPa, E t = 41.6 kN/m.
pub(super) fn known() -> KnownSections {
    let slack = [0.0, PI / 6.0, PI / 4.0, PI / 3.0, PI / 2.0, PI / 1.5, PI * 0.75, PI / 1.2, PI * 0.9];
    let tube = |radius_m, pressure_pa| TubeSection {
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
    ];
    let beam = Cantilever {
        radius_m: 0.04,
        thickness_m: 0.2e-3,
        length_m: 0.36,
        young_pa: 208e6,
        shear_pa: 80e6,
        pressure_pa: 2e3,
    };
    let [fichter, euler] = [BeamTheory::Fichter, BeamTheory::Euler].map(|theory| tip_deflection_m(&beam, 0.2, theory));
    let bent = [2.0, 5.0, 10.0, 50.0, 100.0, 1000.0].map(moment_ratio_from_curvature_ratio);
    vec![
        ("inflated tube, Comer–Levy", slack.map(|gamma0| [moment_ratio(gamma0), curvature_ratio(gamma0)]).concat()),
        ("inflated tube, moment and curvature", [&bent[..], &moments].concat()),
        ("inflated cantilever", vec![fichter, euler, collapse_tip_load_n(&beam)]),
    ]
}
