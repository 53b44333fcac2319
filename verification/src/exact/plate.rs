//! Strip of a thin plate in bending.
//!
//! ```text
//! D = E t³/(12(1 − ν²))      M = D κ per width, wide plate (no curvature across)
//!                            M = E t³/12 κ per width, narrow strip (free to curl across, curvature −ν κ)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D | bending stiffness of the plate | N m |
//! | E, ν, t | modulus, Poisson's ratio, thickness | Pa, –, m |
//! | κ, M | curvature, moment per width | 1/m, N |
//!
//! A cloth is far softer than D of its thickness: its yarns slide. Its measured stiffness goes in directly. For the strip's
//! shape at any rotation see [`super::elastica`]. Valid for κ t ≪ 1. Timoshenko & Woinowsky-Krieger, ch. 1 (recalled).

/// `D = E t³/(12(1 − ν²))` \[N m\].
pub fn plate_bending_stiffness_nm(young_pa: f64, poisson: f64, thickness_m: f64) -> f64 {
    young_pa * thickness_m.powi(3) / (12.0 * (1.0 - poisson * poisson))
}

/// Does the strip curl across its width?
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// Wide, or held flat across: cylindrical bending with D.
    Wide,
    /// Narrow and free to curl across: E t³/12.
    Narrow,
}

/// Bending stiffness `B = D b` or `D (1 − ν²) b` of a strip of width b \[N m²\].
pub fn strip_bending_stiffness_nm2(plate_nm: f64, poisson: f64, width_m: f64, width: Width) -> f64 {
    match width {
        Width::Wide => plate_nm * width_m,
        Width::Narrow => plate_nm * (1.0 - poisson * poisson) * width_m,
    }
}

/// Stiffness of n sheets of equal D \[N m\]: `n D` if they slide on one another, `n³ D` if they are bonded.
pub fn stacked_bending_stiffness_nm(plate_nm: f64, sheets: u32, bonded: bool) -> f64 {
    let n = f64::from(sheets);
    if bonded { n.powi(3) * plate_nm } else { n * plate_nm }
}

/// Tip deflection of a clamped strip under its own weight, small rotations: `w L⁴/(8 D)` \[m\].
pub fn weight_deflection_m(plate_nm: f64, length_m: f64, weight_n_per_m2: f64) -> f64 {
    weight_n_per_m2 * length_m.powi(4) / (8.0 * plate_nm)
}

/// Euler load per width of a wide strip with hinged ends, `π² D/L²` \[N/m\].
pub fn buckling_load_n_per_m(plate_nm: f64, length_m: f64) -> f64 {
    plate_nm * (std::f64::consts::PI / length_m).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffness_is_the_second_moment_of_the_plane_strain_stress() {
        let (young, nu, t) = (208e6, 0.3, 2e-4);
        let layers = 20_000;
        let mut sum = 0.0;
        for i in 0..layers {
            let z = t * ((f64::from(i) + 0.5) / f64::from(layers) - 0.5);
            sum += young / (1.0 - nu * nu) * z * z * t / f64::from(layers);
        }
        let d = plate_bending_stiffness_nm(young, nu, t);
        assert!((sum / d - 1.0).abs() < 1e-8);
        assert!(
            (strip_bending_stiffness_nm2(d, nu, 1.0, Width::Narrow) / (young * t.powi(3) / 12.0) - 1.0).abs() < 1e-14
        );
        assert_eq!(strip_bending_stiffness_nm2(d, nu, 2.0, Width::Wide), 2.0 * d);
    }

    #[test]
    fn bonded_sheets_are_one_thick_plate() {
        let d = plate_bending_stiffness_nm(1e8, 0.3, 1e-4);
        let double = plate_bending_stiffness_nm(1e8, 0.3, 2e-4);
        assert!((stacked_bending_stiffness_nm(d, 2, true) / double - 1.0).abs() < 1e-14);
        assert_eq!(stacked_bending_stiffness_nm(d, 2, false), 2.0 * d);
    }

    #[test]
    fn the_elastica_of_a_small_shortening_buckles_at_the_plates_load() {
        let load = super::super::elastica::strut(1e-4).load;
        assert!((load - 1.0).abs() < 1e-8);
        assert!((buckling_load_n_per_m(2.0, std::f64::consts::PI) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn droop_is_the_integral_of_moment_times_arm() {
        let (d, length, w) = (1e-5, 0.02, 1.5);
        let sum = super::super::solve::integral(|x| 0.5 * w * x * x / d * x, 0.0, length, 1);
        assert!((weight_deflection_m(d, length, w) / sum - 1.0).abs() < 1e-13);
    }
}
