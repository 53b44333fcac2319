//! Neo-Hookean film whose wrinkles are shorter than an element: compressed across, it folds instead of pushing back.
//!
//! With the eigenvalues L₁ ≥ L₂ of C = 1 + 2E, stretches λ = √L, and the film's own energy W of [`NeoHookean`],
//!
//! ```text
//! slack     L₁ ≤ 1                         W_r = 0
//! wrinkled  L₁ > 1 and L₂ √L₁ < 1          W_r = t C₁₀ (λ₁² + 2/λ₁ − 3),   S = 2 t C₁₀ (1 − λ₁⁻³) n₁⊗n₁
//! taut      otherwise                      W_r = W
//! W_η = η W + (1 − η) W_r
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | η | share of the film that carries compression | – |
//! | n₁ | direction of the larger stretch, along the wrinkles | – |
//!
//! Pulled by λ₁ alone the film is λ₁^(−1/2) wide; where it is narrower than that it wrinkles, and W_r, the least energy over all
//! folds, no longer depends on the width. With W_r = W beyond it the law is one energy with a continuous slope.
//!
//! **For sheets whose wrinkles the mesh cannot show.** A mesh that shows them needs η = 1; then bending chooses their width.
//! With a small η and mass damping alone it flutters: give viscosity, or a share of some per cent.
//! Reference: Pipkin 1986, IMA J. Appl. Math. 36, 85 (relaxed energy); the film is that of du Pasquier, Jeong, Okamura 2023.

use std::sync::Arc;

use super::recipe::{Law, Need, Recipe, THICKNESS, modulus, ratio};
use super::{Fabric, Kind, NeoHookean, Past};

pub(super) const ENTRY: Law = Law {
    name: "wrinkling-film",
    parameters: &[
        modulus("c10_MPa", Need::Required, "neo-Hookean constant, a sixth of Young's modulus"),
        ratio("compression_share", [0.0, 1.0], Need::Default(0.01), "share of the film that carries compression"),
        THICKNESS,
    ],
    curves: &[],
    plies: [0, 0],
    strain_limit: 0.4,
    example: || Recipe::of(&[("c10_MPa", 50.3), ("thickness_mm", 0.2)]),
    make: |recipe| {
        let v = ENTRY.read(recipe)?;
        let film = NeoHookean { c10_pa: v.get("c10_MPa")?, thickness_m: v.get("thickness_mm")? };
        Ok(Arc::new(WrinklingFilm { film, share: v.get("compression_share")? }))
    },
};

/// A film that carries a share of compression only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrinklingFilm {
    /// The film, which carries all tension.
    pub film: NeoHookean,
    /// Share of it that carries compression, 0 to 1.
    pub share: f64,
}

/// Where the film is slack or wrinkled.
struct Folded {
    /// Half difference of C₁₁ and C₂₂, C₁₂, and half difference of the eigenvalues.
    d: f64,
    c: f64,
    r: f64,
    /// Larger stretch λ₁ − 1, not below 0.
    z: f64,
}

impl WrinklingFilm {
    /// `None` where the film is taut.
    fn folded(e: [f64; 3]) -> Option<Folded> {
        let (mean, d, c) = (e[0] + e[1], e[0] - e[1], e[2]);
        let r = d.hypot(c);
        // L₁ − 1 = x, L₂ − 1 = y; (1 + y)(1 + z) − 1 has no cancellation at small strain.
        let (x, y) = (mean + r, mean - r);
        let z = x / ((1.0 + x).max(0.0).sqrt() + 1.0);
        (y + z + y * z < 0.0).then_some(Folded { d, c, r, z: z.max(0.0) })
    }

    /// Strain of the film without its folds: eigenvalues of C raised to L₁ ≥ 1 and L₂ ≥ L₁^(−1/2), the least that is taut.
    pub fn unfolded(e: [f64; 3]) -> [f64; 3] {
        let (mean, d, c) = (1.0 + e[0] + e[1], e[0] - e[1], e[2]);
        let r = d.hypot(c);
        let large = (mean + r).max(1.0);
        let small = (mean - r).max(1.0 / large.sqrt());
        // The directions stay; without a difference there are none, and both are 1.
        let (mean, share) = (0.5 * (large + small), 0.5 * (large - small) / r.max(f64::MIN_POSITIVE));
        [0.5 * (mean + share * d - 1.0), 0.5 * (mean - share * d - 1.0), share * c]
    }

    /// 2 t C₁₀ \[N/m\].
    fn k(&self) -> f64 {
        2.0 * self.film.thickness_m * self.film.c10_pa
    }
}

impl Folded {
    /// n₁⊗n₁ as (11, 22, 12).
    fn along(&self) -> [f64; 3] {
        let r = self.r.max(f64::MIN_POSITIVE);
        [0.5 + 0.5 * self.d / r, 0.5 - 0.5 * self.d / r, 0.5 * self.c / r]
    }

    /// (λ₁² + 2/λ₁ − 3)/2 and 1 − λ₁⁻³.
    fn pull(&self) -> [f64; 2] {
        let (z, a) = (self.z, 1.0 + self.z);
        [0.5 * z * z * (a + 2.0) / a, z * (a * a + a + 1.0) / (a * a * a)]
    }
}

impl Fabric for WrinklingFilm {
    fn thickness_m(&self) -> f64 {
        self.film.thickness_m
    }

    fn energy(&self, e: [f64; 3], past: &Past) -> f64 {
        let full = self.film.energy(e, past);
        let relaxed = Self::folded(e).map_or(full, |folded| self.k() * folded.pull()[0]);
        full + (1.0 - self.share) * (relaxed - full)
    }

    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3] {
        let full = self.film.tension(e, past);
        let Some(folded) = Self::folded(e) else { return full };
        let (sigma, along) = (self.k() * folded.pull()[1], folded.along());
        std::array::from_fn(|i| full[i] + (1.0 - self.share) * (sigma * along[i] - full[i]))
    }

    /// With σ = k (1 − L₁^(−3/2)) and N = n₁⊗n₁: ∂(σN)ᵢ/∂eⱼ = 2σ′ NᵢNⱼ + σ ∂Nᵢ/∂eⱼ.
    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        let full = self.film.tangent(e, past);
        let Some(folded) = Self::folded(e) else { return full };
        let Folded { d, c, z, .. } = folded;
        let r = folded.r.max(f64::MIN_POSITIVE);
        let (sigma, n) = (self.k() * folded.pull()[1], folded.along());
        let slope = if z > 0.0 { self.k() * 3.0 * (1.0 + z).powi(-5) } else { 0.0 };
        let turn = [c / r * (c / r), -c / r * (c / r), -d / r * (c / r)].map(|v| 0.5 * sigma * v / r);
        let shear = [-c / r * (d / r), c / r * (d / r), d / r * (d / r)].map(|v| 0.5 * sigma * v / r);
        let rows = [turn, turn.map(|v| -v), shear];
        let own = |i: usize, j: usize| slope * n[i] * n[j] + rows[i][j];
        let share = self.share;
        std::array::from_fn(|i| std::array::from_fn(|j| full[i][j] + (1.0 - share) * (own(i, j) - full[i][j])))
    }

    fn kind(&self) -> Kind<'_> {
        Kind::WrinklingFilm(self)
    }
}
