//! Flat specimens of fabric: pulled at an angle to the warp, and the bias extension test.
//!
//! ```text
//! 1/E(ψ) = cos⁴ψ/E₁ + sin⁴ψ/E₂ + (1/G − 2ν₁₂/E₁) sin²ψ cos²ψ
//! γ = π/2 − 2 arccos((L0 + d)/(√2 L0))       L0 = H − W
//! F_sh(γ) = {(H/W − 1) F (cos γ/2 − sin γ/2) − W F_sh(γ/2) cos γ/2} / ((2H − 3W) cos γ)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ψ | angle between pull and warp | rad |
//! | E₁, E₂, G, ν₁₂ | moduli along warp and fill, shear modulus, contraction along fill per stretch along warp | Pa, – |
//! | H, W | free length and width of the bias specimen | m |
//! | d, F | lengthening, force | m, N |
//! | γ, F_sh | shear angle of the middle, shear force per length of the sheared side | rad, N/m |
//!
//! E(ψ) holds for small strains and free edges, or a specimen many widths long: grips stiffen a bias specimen.
//!
//! Bias extension: H ≥ 2W, yarns at ±45°, stretchless and without slip, uniform shear in each zone, half as much in the
//! side zones. Reference: Cao et al., Composites A 39 (2008) 1037–1053, read; (13) is printed with √(2L0) where only √2 L0
//! is dimensionally possible, and the last term with F_sh·(γ/2) where F_sh at γ/2 is meant: (18) was derived again from
//! the balance of power. Optical angles agree within 5° up to 30°.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

/// Linear orthotropic sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sheet {
    /// E₁ \[Pa\].
    pub warp_pa: f64,
    /// E₂ \[Pa\].
    pub fill_pa: f64,
    /// ν₁₂.
    pub poisson: f64,
    /// G \[Pa\].
    pub shear_pa: f64,
}

/// Modulus E(ψ) of a specimen pulled at an angle to the warp \[Pa\].
pub fn modulus_pa(sheet: &Sheet, angle: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    1.0 / (c.powi(4) / sheet.warp_pa + s.powi(4) / sheet.fill_pa + mixed(sheet) * (s * c).powi(2))
}

/// Contraction across per stretch along, `ν(ψ) = E(ψ) [ν₁₂/E₁ (cos⁴ψ + sin⁴ψ) − (1/E₁ + 1/E₂ − 1/G) sin²ψ cos²ψ]`.
pub fn poisson(sheet: &Sheet, angle: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    let cross = 1.0 / sheet.warp_pa + 1.0 / sheet.fill_pa - 1.0 / sheet.shear_pa;
    let straight = sheet.poisson / sheet.warp_pa * (s.powi(4) + c.powi(4));
    modulus_pa(sheet, angle) * (straight - cross * (s * c).powi(2))
}

/// Shear angle per stretch along, `E(ψ) sin ψ cos ψ [2 cos²ψ/E₁ − 2 sin²ψ/E₂ − (1/G − 2ν₁₂/E₁)(cos²ψ − sin²ψ)]`.
///
/// For a pull along x and the warp turned by +ψ from x towards y; the sign is that of γ_xy. Zero for balanced ±45°.
pub fn shear_per_stretch(sheet: &Sheet, angle: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    let straight = 2.0 * (c * c / sheet.warp_pa - s * s / sheet.fill_pa);
    modulus_pa(sheet, angle) * s * c * (straight - mixed(sheet) * (c * c - s * s))
}

/// Shear modulus from the bias modulus E₄₅, `1/G = 4/E₄₅ − 1/E₁ − 1/E₂ + 2ν₁₂/E₁` \[Pa\].
pub fn shear_modulus_from_bias_pa(bias_pa: f64, warp_pa: f64, fill_pa: f64, poisson: f64) -> f64 {
    1.0 / (4.0 / bias_pa - 1.0 / warp_pa - 1.0 / fill_pa + 2.0 * poisson / warp_pa)
}

/// Specimen of the bias extension test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bias {
    /// Free length H between the grips \[m\], at least 2W.
    pub length_m: f64,
    /// Width W \[m\].
    pub width_m: f64,
}

/// Shear angle γ of the middle zone \[rad\] after a lengthening; not a number beyond `d = (√2 − 1)(H − W)`.
pub fn shear_angle(bias: &Bias, lengthening_m: f64) -> f64 {
    let side = bias.length_m - bias.width_m;
    FRAC_PI_2 - 2.0 * ((side + lengthening_m) / (SQRT_2 * side)).acos()
}

/// Lengthening at a shear angle, `d = (H − W)(√2 cos(π/4 − γ/2) − 1)` \[m\].
pub fn lengthening_m(bias: &Bias, shear_angle: f64) -> f64 {
    (bias.length_m - bias.width_m) * (SQRT_2 * (0.5 * (FRAC_PI_2 - shear_angle)).cos() - 1.0)
}

/// Force that shears the fabric to γ, for a known law F_sh(γ) \[N\]: the last equation solved for F.
pub fn bias_force_n(bias: &Bias, shear_angle: f64, law_n_per_m: impl Fn(f64) -> f64) -> f64 {
    let (h, w, half) = (bias.length_m, bias.width_m, 0.5 * shear_angle);
    let middle = (2.0 * h - 3.0 * w) * law_n_per_m(shear_angle) * shear_angle.cos();
    (middle + w * law_n_per_m(half) * half.cos()) / ((h / w - 1.0) * (half.cos() - half.sin()))
}

/// Shear force per length F_sh \[N/m\] at each measured (γ, F), γ rising from above 0.
///
/// F_sh(γ/2) is interpolated linearly between the points, the first of them (0, 0).
pub fn shear_force_n_per_m(bias: &Bias, measured: &[[f64; 2]]) -> Vec<f64> {
    let mut found = vec![[0.0, 0.0]];
    for &[angle, force] in measured {
        let [last_angle, last_value] = found[found.len() - 1];
        // Beyond the last point F_sh(γ/2) lies between it and the wanted one: last + share·(wanted − last).
        let share = ((0.5 * angle - last_angle) / (angle - last_angle)).max(0.0);
        let known = if share > 0.0 { (1.0 - share) * last_value } else { interpolate(&found, 0.5 * angle) };
        found.push([angle, one_point(bias, angle, force, known, share)]);
    }
    found.into_iter().skip(1).map(|point| point[1]).collect()
}

/// `1/G − 2ν₁₂/E₁` \[1/Pa\].
fn mixed(sheet: &Sheet) -> f64 {
    1.0 / sheet.shear_pa - 2.0 * sheet.poisson / sheet.warp_pa
}

/// F_sh(γ) where `F_sh(γ/2) = known + share F_sh(γ)`.
fn one_point(bias: &Bias, angle: f64, force: f64, known: f64, share: f64) -> f64 {
    let (h, w, half) = (bias.length_m, bias.width_m, 0.5 * angle);
    let pull = (h / w - 1.0) * force * (half.cos() - half.sin());
    let sides = w * half.cos();
    (pull - sides * known) / ((2.0 * h - 3.0 * w) * angle.cos() + sides * share)
}

fn interpolate(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.partition_point(|point| point[0] < x).clamp(1, points.len() - 1);
    let ([x0, y0], [x1, y1]) = (points[after - 1], points[after]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

#[cfg(test)]
mod tests {
    use super::super::oracles;
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    const SHEET: Sheet = Sheet { warp_pa: 96.5e6, fill_pa: 120e6, poisson: 0.3, shear_pa: 1.032e6 };
    const BIAS: Bias = Bias { length_m: 0.25, width_m: 0.02 };

    #[test]
    fn coupon_oracles_are_reproduced_to_their_last_digit() {
        oracles::assert_all_agree(&oracles::coupon::rows());
    }

    #[test]
    fn shear_modulus_of_the_bias_modulus_is_the_sheets_own() {
        let bias = modulus_pa(&SHEET, FRAC_PI_4);
        assert!((shear_modulus_from_bias_pa(bias, 96.5e6, 120e6, 0.3) / 1.032e6 - 1.0).abs() < 1e-12);
        let plain = super::super::fpam::shear_modulus_from_bias_pa(4.05e6, 96.5e6, 120e6);
        assert!((shear_modulus_from_bias_pa(4.05e6, 96.5e6, 120e6, 0.0) / plain - 1.0).abs() < 1e-15);
    }

    #[test]
    fn an_isotropic_sheet_is_the_same_at_every_angle() {
        let sheet = Sheet { warp_pa: 1e8, fill_pa: 1e8, poisson: 0.3, shear_pa: 1e8 / 2.6 };
        for angle in [0.0, 0.4, 1.1] {
            assert!((modulus_pa(&sheet, angle) / 1e8 - 1.0).abs() < 1e-14);
            assert!((poisson(&sheet, angle) - 0.3).abs() < 1e-14 && shear_per_stretch(&sheet, angle).abs() < 1e-14);
        }
    }

    #[test]
    fn work_of_the_grips_is_the_shear_work_of_the_zones() {
        let law = |shear: f64| 20.0 * shear + 300.0 * shear.powi(3);
        for shear in [0.1, 0.5, 0.9] {
            let h = 1e-6;
            let rate = (lengthening_m(&BIAS, shear + h) - lengthening_m(&BIAS, shear - h)) / (2.0 * h);
            let middle = 0.5 * (2.0 * 0.25 * 0.02 - 3.0 * 0.02 * 0.02) * law(shear) * shear.cos();
            let sides = 0.02 * 0.02 * law(0.5 * shear) * (0.5 * shear).cos() * 0.5;
            assert!((bias_force_n(&BIAS, shear, law) * rate / (middle + sides) - 1.0).abs() < 1e-8);
            assert!((shear_angle(&BIAS, lengthening_m(&BIAS, shear)) - shear).abs() < 1e-13);
        }
    }

    #[test]
    fn reduction_recovers_a_curved_law_with_the_square_of_the_spacing() {
        let law = |shear: f64| 20.0 * shear + 300.0 * shear.powi(3);
        let error = |points: i32| {
            let angle = |i: i32| 0.8 * f64::from(i) / f64::from(points);
            let measured: Vec<_> = (1..=points).map(|i| [angle(i), bias_force_n(&BIAS, angle(i), law)]).collect();
            let found = shear_force_n_per_m(&BIAS, &measured);
            (found[found.len() - 1] - law(0.8)).abs()
        };
        let (coarse, fine) = (error(9), error(36));
        assert!(coarse < 0.05 && fine < coarse / 8.0, "{coarse} {fine}");
    }
}
