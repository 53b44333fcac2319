//! Shear curve of a fabric from a bias-extension test: a strip pulled at 45° to its yarns.
//!
//! ```text
//! L₀ = H − W      γ = π/2 − 2 acos((L₀ + d)/(√2 L₀))
//! F_sh(γ) = {(H/W − 1) F [cos γ/2 − sin γ/2] − W F_sh(γ/2) cos γ/2} / ((2H − 3W) cos γ)
//! T₁₂ = F_sh cos γ / t
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | H, W | free length and width of the strip, H ≥ 2W | m |
//! | d, F | displacement and force of the clamp | m, N |
//! | γ | shear angle in the middle zone; the zones beside it shear by γ/2 | rad |
//! | F_sh | shear force per width of fabric | N/m |
//! | T₁₂ | moment per reference volume: the shear curve of [`super::Woven`] | Pa |
//!
//! The first formula is the kinematics of unstretched yarns, the second the power balance F ḋ = Σ zones. F_sh(γ/2) comes from
//! the rows before; where there are none it is on the straight line to this row.
//!
//! Valid for yarns that neither stretch nor slip: to about 30°; optical angles differ by 5° and more above. **The paper
//! prints √(2L₀) for √2·L₀**, which has the wrong dimension.
//! Reference: Cao et al. 2008, Composites A 39, 1037, eqs. 13 and 18; eq. 18 derived again here from the power balance.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

/// The strip of a bias-extension test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BiasExtension {
    /// Free length between the clamps H \[m\].
    pub length_m: f64,
    /// Width W \[m\].
    pub width_m: f64,
    /// Thickness t \[m\].
    pub thickness_m: f64,
}

impl BiasExtension {
    /// Rows displacement \[m\], force \[N\] (rising, the first `[0, 0]`) → rows shear angle \[rad\], T₁₂ \[Pa\].
    ///
    /// # Errors
    /// A strip shorter than twice its width, or a displacement that would close the yarns to 90°.
    ///
    /// ```
    /// let strip = models::fabrics::BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: 5e-5 };
    /// let curve = strip.shear(&[[0.0, 0.0], [0.0252325254, 0.2029]]).unwrap();
    /// assert!((curve[1][0] - 0.2335667).abs() < 1e-7);
    /// ```
    pub fn shear(&self, rows: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, String> {
        let forces = self.shear_force(rows)?;
        Ok(forces.iter().map(|[angle, force]| [*angle, force * angle.cos() / self.thickness_m]).collect())
    }

    /// The same rows → rows shear angle \[rad\], shear force per width F_sh \[N/m\]; the thickness does not matter.
    ///
    /// # Errors
    /// As [`BiasExtension::shear`].
    pub fn shear_force(&self, rows: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, String> {
        let fits = self.width_m > 0.0 && self.length_m >= 2.0 * self.width_m && self.thickness_m > 0.0;
        if !(fits && self.length_m.is_finite()) {
            return Err(format!(
                "a bias-extension strip of {} m by {} m; write a length of at least twice the width",
                self.length_m, self.width_m
            ));
        }
        let mut forces: Vec<[f64; 2]> = vec![[0.0, 0.0]];
        for (i, row) in rows.iter().enumerate().filter(|(_, row)| row[0] > 0.0) {
            let angle = self.angle(row[0]).ok_or_else(|| {
                let limit_mm = (SQRT_2 - 1.0) * (self.length_m - self.width_m) * 1e3;
                format!("row {}: the yarns would be parallel; write displacements below {limit_mm:.3} mm", i + 1)
            })?;
            forces.push([angle, self.force(angle, row[1], &forces)]);
        }
        Ok(forces)
    }

    /// Displacement at a shear angle, d = L₀ (√2 cos(π/4 − γ/2) − 1) \[m\].
    pub fn displacement_m(&self, angle: f64) -> f64 {
        (self.length_m - self.width_m) * (SQRT_2 * (0.5 * (FRAC_PI_2 - angle)).cos() - 1.0)
    }

    /// γ(d) \[rad\]; none where the yarns would be parallel (90°).
    pub fn angle(&self, displacement_m: f64) -> Option<f64> {
        let reach = self.length_m - self.width_m;
        let ratio = (reach + displacement_m) / (SQRT_2 * reach);
        (ratio < 1.0).then(|| FRAC_PI_2 - 2.0 * ratio.acos())
    }

    /// F_sh(γ), with the rows before it.
    fn force(&self, angle: f64, pull_n: f64, before: &[[f64; 2]]) -> f64 {
        let (h, w, half) = (self.length_m, self.width_m, 0.5 * angle);
        let scale = 1.0 / ((2.0 * h - 3.0 * w) * angle.cos());
        let pulled = scale * (h / w - 1.0) * pull_n * (half.cos() - half.sin());
        let beside = scale * w * half.cos();
        // F_sh(γ/2) = known + share·F_sh(γ)
        let (known, share) = match before.windows(2).find(|pair| half <= pair[1][0]) {
            Some(pair) => (between(pair[0], pair[1], half), 0.0),
            None => {
                let [x, y] = before[before.len() - 1];
                let share = (half - x) / (angle - x);
                (y * (1.0 - share), share)
            }
        };
        (pulled - beside * known) / (1.0 + beside * share)
    }
}

fn between(a: [f64; 2], b: [f64; 2], x: f64) -> f64 {
    a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRIP: BiasExtension = BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: 1.0 };

    #[test]
    fn a_strip_made_from_a_straight_shear_law_gives_it_back() {
        // F_sh = 0.02 γ N/mm put into the power balance by hand.
        for (d_mm, force_n, angle, shear_n_per_mm) in [
            (25.2325254, 0.202938974, 0.2335667, 0.00467133333),
            (46.9681594, 0.440893099, 0.4669, 0.009338),
            (64.9222197, 0.706023369, 0.7, 0.014_f64),
        ] {
            let [found, moment] = STRIP.shear(&[[0.0, 0.0], [d_mm * 1e-3, force_n]]).unwrap()[1];
            assert!((found - angle).abs() < 1e-6, "{found} {angle}");
            assert!((moment / (1e3 * shear_n_per_mm * angle.cos()) - 1.0).abs() < 1e-6, "{moment}");
        }
    }

    #[test]
    fn many_rows_give_the_straight_law_as_one_does() {
        let (h, w, slope) = (0.25, 0.02, 20.0);
        let row = |angle: f64| {
            let half = 0.5 * angle;
            let reach = h - w;
            let d = SQRT_2 * reach * (0.5 * (FRAC_PI_2 - angle)).cos() - reach;
            let inner = (2.0 * h - 3.0 * w) * angle.cos() * slope * angle + w * slope * half * half.cos();
            [d, inner / ((h / w - 1.0) * (half.cos() - half.sin()))]
        };
        let mut rows = vec![[0.0, 0.0]];
        rows.extend((1..=40).map(|k| row(0.02 * f64::from(k))));
        for [angle, moment] in &STRIP.shear(&rows).unwrap()[1..] {
            assert!((moment / (slope * angle * angle.cos()) - 1.0).abs() < 1e-9, "{angle}: {moment}");
        }
    }

    #[test]
    fn strain_and_shear_angle_belong_together_as_published() {
        for (strain, degrees) in [(0.05, 6.41040), (0.10, 13.25033), (0.24, 36.14225), (0.30, 49.33272)] {
            assert!((STRIP.angle(strain * 0.25).unwrap().to_degrees() - degrees).abs() < 1e-5);
        }
    }

    #[test]
    fn strips_too_short_and_pulled_too_far_are_refused() {
        let message = STRIP.shear(&[[0.0, 0.0], [0.05, 1.0], [0.1, 2.0]]).unwrap_err();
        assert!(message.contains("row 3") && message.contains("95.269"), "{message}");
        assert!(BiasExtension { length_m: 0.03, ..STRIP }.shear(&[]).unwrap_err().contains("twice"));
    }
}
