//! Flat specimen of fabric pulled at an angle to the warp; the bias extension test is [`BiasExtension`] of the models.
//!
//! ```text
//! 1/E(ψ) = cos⁴ψ/E₁ + sin⁴ψ/E₂ + (1/G − 2ν₁₂/E₁) sin²ψ cos²ψ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ψ | angle between pull and warp | rad |
//! | E₁, E₂, G, ν₁₂ | moduli along warp and fill, shear modulus, contraction along fill per stretch along warp | Pa, – |
//!
//! E(ψ) holds for small strains and free edges, or a specimen many widths long: grips stiffen a bias specimen.

use std::f64::consts::FRAC_PI_2;

use super::KnownSections;
use models::fabrics::BiasExtension;

/// Elastic constants of a linear orthotropic sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrthotropicSheet {
    /// Modulus E₁ along the warp \[Pa\].
    pub warp_pa: f64,
    /// Modulus E₂ along the fill \[Pa\].
    pub fill_pa: f64,
    /// Contraction ν₁₂ along the fill per stretch along the warp.
    pub poisson: f64,
    /// Shear modulus G in the sheet's plane \[Pa\].
    pub shear_pa: f64,
}

/// Modulus E(ψ) of a specimen pulled at an angle to the warp \[Pa\].
pub fn modulus_pa(sheet: &OrthotropicSheet, angle: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    1.0 / (c.powi(4) / sheet.warp_pa + s.powi(4) / sheet.fill_pa + mixed(sheet) * (s * c).powi(2))
}

/// Contraction across per stretch along, `ν(ψ) = E(ψ) [ν₁₂/E₁ (cos⁴ψ + sin⁴ψ) − (1/E₁ + 1/E₂ − 1/G) sin²ψ cos²ψ]`.
pub fn poisson(sheet: &OrthotropicSheet, angle: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    let cross = 1.0 / sheet.warp_pa + 1.0 / sheet.fill_pa - 1.0 / sheet.shear_pa;
    let straight = sheet.poisson / sheet.warp_pa * (s.powi(4) + c.powi(4));
    modulus_pa(sheet, angle) * (straight - cross * (s * c).powi(2))
}

fn mixed(sheet: &OrthotropicSheet) -> f64 {
    1.0 / sheet.shear_pa - 2.0 * sheet.poisson / sheet.warp_pa
}

/// See `known.txt`; for the bias extension test, [`BiasExtension`] of 250 mm by 20 mm.
pub(super) fn known() -> KnownSections {
    let sheet = OrthotropicSheet { warp_pa: 96.5, fill_pa: 120.0, poisson: 0.3, shear_pa: 1.032 };
    let uncoupled = OrthotropicSheet { poisson: 0.0, ..sheet };
    let moduli = [0.0_f64, 15.0, 30.0, 45.0, 60.0, 90.0].map(|degrees| modulus_pa(&sheet, degrees.to_radians()));
    let ratios = [15.0_f64, 45.0, 90.0].map(|degrees| poisson(&sheet, degrees.to_radians()));
    let off_axis = [&moduli[..], &[modulus_pa(&uncoupled, 45_f64.to_radians())], &ratios];
    let strip = BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: 1.0 };
    let turned = |strain: f64| strip.angle(strain * 0.25).map_or(f64::NAN, f64::to_degrees);
    let angles = [0.05, 0.10, 0.15, 0.20, 0.24, 0.30].map(turned);
    let pulled = |angle: f64| strip.pulled(angle, |angle| 20.0 * angle, None);
    let rows: Vec<[f64; 2]> = [0.0, 0.7 / 3.0, 1.4 / 3.0, 0.7].map(pulled).into();
    let found = strip.shear_force(&rows, None).map_or(f64::NAN, |rows| rows[rows.len() - 1][1]);
    let made_up = [0.7007 / 3.0, 0.4669, 0.7].map(pulled).map(|[lengthening_m, force]| [1e3 * lengthening_m, force]);
    vec![
        ("off-axis specimen", off_axis.concat()),
        ("bias extension, shear angle", [&angles[..], &[strip.displacement_m(FRAC_PI_2) / 0.25]].concat()),
        ("bias extension, shear force", [made_up.as_flattened(), &[found]].concat()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use models::fabrics::shear_modulus;
    use std::f64::consts::FRAC_PI_4;

    const SHEET: OrthotropicSheet =
        OrthotropicSheet { warp_pa: 96.5e6, fill_pa: 120e6, poisson: 0.3, shear_pa: 1.032e6 };
    const BIAS: BiasExtension = BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: 1.0 };

    #[test]
    fn shear_modulus_of_the_bias_modulus_is_the_sheets_own() {
        let bias = modulus_pa(&SHEET, FRAC_PI_4);
        assert!((shear_modulus(96.5e6, 120e6, bias, 0.3).unwrap() / 1.032e6 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_isotropic_sheet_is_the_same_at_every_angle() {
        let sheet = OrthotropicSheet { warp_pa: 1e8, fill_pa: 1e8, poisson: 0.3, shear_pa: 1e8 / 2.6 };
        for angle in [0.0, 0.4, 1.1] {
            assert!((modulus_pa(&sheet, angle) / 1e8 - 1.0).abs() < 1e-14);
            assert!((poisson(&sheet, angle) - 0.3).abs() < 1e-14);
        }
    }

    #[test]
    fn work_of_the_grips_is_the_shear_work_of_the_zones() {
        let law = |shear: f64| 20.0 * shear + 300.0 * shear.powi(3);
        for shear in [0.1, 0.5, 0.9] {
            let h = 1e-6;
            let rate = (BIAS.displacement_m(shear + h) - BIAS.displacement_m(shear - h)) / (2.0 * h);
            let middle = 0.5 * (2.0 * 0.25 * 0.02 - 3.0 * 0.02 * 0.02) * law(shear) * shear.cos();
            let sides = 0.02 * 0.02 * law(0.5 * shear) * (0.5 * shear).cos() * 0.5;
            assert!((BIAS.pulled(shear, law, None)[1] * rate / (middle + sides) - 1.0).abs() < 1e-8);
            assert!((BIAS.angle(BIAS.displacement_m(shear)).unwrap() - shear).abs() < 1e-13);
        }
    }

    #[test]
    fn reduction_recovers_a_curved_law_with_the_square_of_the_spacing() {
        let law = |shear: f64| 20.0 * shear + 300.0 * shear.powi(3);
        let error = |points: i32| {
            let angle = |i: i32| 0.8 * f64::from(i) / f64::from(points);
            let measured: Vec<_> = (0..=points).map(|i| BIAS.pulled(angle(i), law, None)).collect();
            let found = BIAS.shear_force(&measured, None).unwrap();
            (found[found.len() - 1][1] - law(0.8)).abs()
        };
        let (coarse, fine) = (error(9), error(36));
        assert!(coarse < 0.05 && fine < coarse / 8.0, "{coarse} {fine}");
    }
}
