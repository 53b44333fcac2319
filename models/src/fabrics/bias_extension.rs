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
//! | γ | shear angle in the middle zone; the adjacent zones shear by γ/2 | rad |
//! | F_sh | shear force per width of fabric | N/m |
//! | T₁₂ | moment per reference volume: the shear curve of [`super::Woven`] | Pa |
//!
//! The first formula is the kinematics of unstretched yarns, the second the power balance F ḋ = Σ zones. F_sh(γ/2) comes from
//! the rows before; where there are none it is on the straight line to this row.
//!
//! The paper's yarns do not stretch. Where the law of the yarns is given, their stretch is subtracted from d first:
//!
//! ```text
//! N₁ = F (λ₁ + λ₂ sin γ)/(2Wλ)     N₂ likewise     λ² = ½(λ₁² + λ₂²) + λ₁λ₂ sin γ     d = d(γ) + H (λ − √(1 + sin γ))
//! T₁₂ t = F λ₁λ₂ cos γ/(2Wλ)
//! ```
//!
//! These are statics of the middle zone, whose edges are free: S = F/(Wλ) along the pull alone. N₁, N₂ are the yarns' forces
//! per reference width \[N/m\], λ₁, λ₂ their stretches. That all of H stretches so is exact for a long strip; the clamps' zones,
//! a share W/H of it, carry the yarns otherwise.
//!
//! Valid for yarns that do not slip: to about 30°; optical angles differ by 5° and more above. **The paper
//! prints √(2L₀) for √2·L₀**, which has the wrong dimension.
//! Reference: Cao et al. 2008, Composites A 39, 1037, eqs. 13 and 18; eq. 18 derived again here from the power balance.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

use super::fabric::Fabric;

/// Iterations that more than suffice: the iteration for the yarns' small stretch is a contraction.
const MOST: usize = 60;

/// The strip of a bias-extension test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BiasExtension {
    /// Free length between the clamps H \[m\].
    pub length_m: f64,
    /// Width W of the strip between its free edges \[m\].
    pub width_m: f64,
    /// Thickness t of the fabric \[m\].
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
        let forces = self.shear_force(rows, None)?;
        Ok(forces.iter().map(|[angle, force]| [*angle, force * angle.cos() / self.thickness_m]).collect())
    }

    /// The same rows → rows shear angle \[rad\], shear force per width F_sh \[N/m\]; the thickness does not matter.
    ///
    /// The stretch of `yarns` (only their part of that law is used) is taken out; without them they are stiff. Rows whose
    /// angle does not rise are left out.
    pub fn shear_force(&self, rows: &[[f64; 2]], yarns: Option<&dyn Fabric>) -> Result<Vec<[f64; 2]>, String> {
        let fits = self.width_m > 0.0 && self.length_m >= 2.0 * self.width_m && self.thickness_m > 0.0;
        if !(fits && self.length_m.is_finite()) {
            return Err(format!(
                "a bias-extension strip of {} m by {} m; write a length of at least twice the width",
                self.length_m, self.width_m
            ));
        }
        let mut forces: Vec<[f64; 2]> = vec![[0.0, 0.0]];
        for (i, row) in rows.iter().enumerate().filter(|(_, row)| row[0] > 0.0) {
            let [angle, pull_n] = self.sheared(*row, yarns).ok_or_else(|| {
                let limit_mm = (SQRT_2 - 1.0) * (self.length_m - self.width_m) * 1e3;
                format!("row {}: the yarns would be parallel; write displacements below {limit_mm:.3} mm", i + 1)
            })?;
            if forces.last().is_some_and(|last| angle > last[0]) {
                forces.push([angle, self.force(angle, pull_n, &forces)]);
            }
        }
        Ok(forces)
    }

    /// γ at a displacement and a force, and the force that would shear stiff yarns as much.
    fn sheared(&self, [displacement_m, pull_n]: [f64; 2], yarns: Option<&dyn Fabric>) -> Option<[f64; 2]> {
        let (mut angle, mut share) = (self.angle(displacement_m)?, 1.0);
        let Some(yarns) = yarns else { return Some([angle, pull_n]) };
        for _ in 0..MOST {
            let stretch_m;
            [stretch_m, share] = self.yarn_stretch(angle, pull_n, yarns);
            let next = self.angle(displacement_m - stretch_m)?;
            let done = (next - angle).abs() < 1e-13;
            angle = next;
            if done {
                break;
            }
        }
        Some([angle, share * pull_n])
    }

    /// What the yarns' stretch adds to the displacement at a shear angle under a force, H (λ − √(1 + sin γ)) \[m\], and by how
    /// much it raises the moment of that force, λ₁λ₂ √(1 + sin γ)/λ.
    pub fn yarn_stretch(&self, angle: f64, pull_n: f64, yarns: &dyn Fabric) -> [f64; 2] {
        let sin = angle.sin();
        let stretch = |[a, b]: [f64; 2]| (0.5 * (a * a + b * b) + a * b * sin).sqrt();
        let (mut lambda, mut e) = ([1.0, 1.0], [0.0; 2]);
        for _ in 0..MOST {
            let along = 0.5 * pull_n / (self.width_m * stretch(lambda));
            e = stretched(yarns, e, [0, 1].map(|i| along * (lambda[i] + lambda[1 - i] * sin)));
            let next = e.map(|e| (1.0 + 2.0 * e).max(0.0).sqrt());
            let done = (next[0] - lambda[0]).abs() + (next[1] - lambda[1]).abs() < 1e-14;
            lambda = next;
            if done {
                break;
            }
        }
        let stiff = (1.0 + sin).sqrt();
        [self.length_m * (stretch(lambda) - stiff), lambda[0] * lambda[1] * stiff / stretch(lambda)]
    }

    /// The way back: displacement \[m\] and force \[N\] of this strip at a shear angle, for a law F_sh(γ) \[N/m\].
    pub fn pulled(&self, angle: f64, law_n_per_m: impl Fn(f64) -> f64, yarns: Option<&dyn Fabric>) -> [f64; 2] {
        let (h, w, half) = (self.length_m, self.width_m, 0.5 * angle);
        let middle = (2.0 * h - 3.0 * w) * law_n_per_m(angle) * angle.cos();
        let stiff_n = (middle + w * law_n_per_m(half) * half.cos()) / ((h / w - 1.0) * (half.cos() - half.sin()));
        let Some(yarns) = yarns else { return [self.displacement_m(angle), stiff_n] };
        let (mut pull_n, mut stretch_m) = (stiff_n, 0.0);
        for _ in 0..MOST {
            let share;
            [stretch_m, share] = self.yarn_stretch(angle, pull_n, yarns);
            let done = (stiff_n / share - pull_n).abs() < 1e-14 * stiff_n;
            pull_n = stiff_n / share;
            if done {
                break;
            }
        }
        [self.displacement_m(angle) + stretch_m, pull_n]
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

/// Strains \[E₁₁, E₂₂\] at which the yarns carry these forces N = λ S \[N/m\], from a first guess; Newton's method.
fn stretched(yarns: &dyn Fabric, mut e: [f64; 2], wanted: [f64; 2]) -> [f64; 2] {
    for _ in 0..MOST {
        let full = [e[0], e[1], 0.0];
        let (s, k) = (yarns.tension(full, &[0.0; 2]), yarns.tangent(full, &[0.0; 2]));
        let lambda = e.map(|e| (1.0 + 2.0 * e).max(0.0).sqrt());
        let off = [0, 1].map(|i| wanted[i] - lambda[i] * s[i]);
        let row = |i: usize| [0, 1].map(|j| lambda[i] * k[i][j] + if i == j { s[i] / lambda[i] } else { 0.0 });
        let [[a, b], [c, d]] = [row(0), row(1)];
        let det = a * d - b * c;
        let step = [(d * off[0] - b * off[1]) / det, (a * off[1] - c * off[0]) / det];
        if !(step[0].is_finite() && step[1].is_finite()) {
            break;
        }
        e = [e[0] + step[0], e[1] + step[1]];
        if step[0].abs() + step[1].abs() < 1e-15 {
            break;
        }
    }
    e
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

    /// A long strip of a woven law, pulled with free edges, gives back the law's shear although its yarns stretch: with the
    /// ratio of moduli of a real nylon, where stiff yarns would be wrong by a fifth.
    #[test]
    fn the_stretch_of_the_yarns_is_taken_out_of_the_shear() {
        use crate::fabrics::{Curve, Pull, Woven, Yarn};
        let yarn = |pa: f64| Yarn::new(Curve::linear(pa), None).unwrap();
        let (slope, t) = (18.4e6, 1.7e-4);
        let law = |shear| Woven::new([yarn(130e6), yarn(360e6)], Curve::linear(shear), 0.1, t).unwrap();
        let mut pull = Pull::new(std::sync::Arc::new(law(slope)), std::f64::consts::FRAC_PI_4).unwrap();
        let strip = BiasExtension { length_m: 1e3, width_m: 1e-3, thickness_m: t };
        let rows: Vec<[f64; 2]> = (0..=40)
            .map(|i| 1e-3 * f64::from(i))
            .map(|e| [e * strip.length_m, pull.stress_pa(e).unwrap() * strip.width_m * t])
            .collect();
        let yarns = law(1.0);
        let found = strip.shear_force(&rows, Some(&yarns)).unwrap();
        for [angle, force] in &found[1..] {
            assert!((force * angle.cos() / t / (slope * angle) - 1.0).abs() < 1e-5, "{angle}: {}", force / angle / t);
        }
        let back = strip.pulled(found[20][0], |angle| t * slope * angle / angle.cos(), Some(&yarns));
        assert!([0, 1].iter().all(|&k| (back[k] / rows[20][k] - 1.0).abs() < 1e-5), "{back:?} {:?}", rows[20]);
        let stiff = strip.shear(&rows).unwrap();
        assert!(stiff[20][1] / (slope * stiff[20][0]) < 0.85);
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
