//! Neo-Hookean film with wrinkles shorter than an element: under compression it carries the load of its wrinkles and no more.
//!
//! With the eigenvalues L₁ ≥ L₂ of C = 1 + 2E, stretches λ = √L, and the film's own energy W of [`NeoHookean`],
//!
//! ```text
//! slack     L₁ ≤ 1                         W_r = 0
//! wrinkled  L₁ > 1 and L₂ √L₁ < 1          W_r = t C₁₀ (λ₁² + 2/λ₁ − 3),   S_r = 2 t C₁₀ (1 − λ₁⁻³) n₁⊗n₁
//! taut      otherwise                      W_r = W
//! X = W − W_r       W_N = W_r + X = W                  √X ≤ c = N/√(2K)      flat: K resists
//!                   W_N = W_r + c (2√X − c)            beyond                wrinkled: N resists
//! S_N = S_r + (c/√X)(S − S_r) beyond
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | N | load of the wrinkles, constant in strain | N/m |
//! | K | 8 t C₁₀, stiffness of the film against compression across a fixed stretch | N/m |
//! | n₁ | direction of the larger stretch, along the wrinkles | – |
//!
//! A film pulled by λ₁ alone has the width λ₁^(−1/2); a narrower one is compressed by δ, and X = ½ K δ² at small strain. It stays flat up
//! to Kδ = N, then wrinkles, and the compressive load stays at N (11 % above at δ = 0.1, where X exceeds ½ K δ²). W_N is one energy with a
//! continuous slope. N = 0 is Pipkin's relaxed energy, N = ∞ the film itself.
//!
//! **The load follows from bending.** Wrinkles of wavelength Λ across a tension T over a length ℓ cost N(Λ) = 4π² D/Λ² + T Λ²/4ℓ² per
//! compression. The least is
//!
//! ```text
//! N_w = 2π √(D T)/ℓ     at   Λ_w = 2 √π (D/T)^¼ √ℓ                        D bending stiffness [N m]
//! ```
//!
//! **Validity**: wrinkles that the mesh cannot show. Where it can, it makes them with its own bending stiffness.
//! Give N = 0 viscosity: with mass damping alone it flutters.
//! References: Pipkin 1986, IMA J. Appl. Math. 36, 85 (relaxed energy); Cerda and Mahadevan 2003, Phys. Rev. Lett. 90, 074302 (wrinkles);
//! du Pasquier, Jeong, Okamura 2023 (the film).

use std::f64::consts::PI;
use std::sync::Arc;

use super::fabric::{Fabric, InlinedFabric, NeoHookean, Past, WrinklingFilm, matrix};
use super::recipe::*;

pub(super) const ENTRY: Law = Law {
    name: "wrinkling-film",
    parameters: &[
        modulus("c10_MPa").required("neo-Hookean constant, a sixth of Young's modulus"),
        number("wrinkling_load_n_per_m", "N/m", 1.0, [0.0, 1e6])
            .required("compressive load of the wrinkled film, 2π √(D T)/ℓ"),
        THICKNESS,
    ],
    strain_limit: 0.4,
    example: || Recipe::of(&[("c10_MPa", 50.3), ("wrinkling_load_n_per_m", 5.0), ("thickness_mm", 0.2)]),
    make: |recipe| {
        let v = ENTRY.read(recipe)?;
        let film = NeoHookean::new(v.get("c10_MPa")?, v.get("thickness_mm")?);
        Ok(Arc::new(WrinklingFilm { film, load_n_per_m: v.get("wrinkling_load_n_per_m")? }))
    },
    ..SHEET
};

/// Load of wrinkles across a tension \[N/m\] over a length \[m\], for a bending stiffness \[N m\]: N_w of the module \[N/m\].
pub fn wrinkling_load_n_per_m(bending_nm: f64, tension_n_per_m: f64, length_m: f64) -> f64 {
    2.0 * PI * (bending_nm * tension_n_per_m).sqrt() / length_m
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

    /// Shear modulus times thickness at rest, 2 t C₁₀ \[N/m\].
    fn k(&self) -> f64 {
        2.0 * self.film.thickness_m * self.film.c10_pa
    }

    /// c² \[N/m\]: X at which the film wrinkles.
    pub fn flat_n_per_m(&self) -> f64 {
        self.load_n_per_m * self.load_n_per_m / (8.0 * self.k())
    }

    /// Part of the energy that compression stores: W_N − W_r \[J/m²\].
    pub fn compressed_j_per_m2(&self, e: [f64; 3]) -> f64 {
        let relaxed = |folded: Folded| self.k() * folded.pull()[0];
        Self::folded(e).map_or(0.0, |folded| self.energy(e, &[0.0; 2]) - relaxed(folded))
    }

    /// c and √X; `None` where the film is flat.
    fn beyond(&self, full: f64, relaxed: f64) -> Option<[f64; 2]> {
        let (root, c) = ((full - relaxed).max(0.0).sqrt(), self.flat_n_per_m().sqrt());
        (root > c).then_some([c, root])
    }
}

impl Folded {
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
        let Some(folded) = Self::folded(e) else { return full };
        let relaxed = self.k() * folded.pull()[0];
        self.beyond(full, relaxed).map_or(full, |[c, root]| relaxed + c * (2.0 * root - c))
    }

    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3] {
        let full = self.film.tension(e, past);
        let Some(folded) = Self::folded(e) else { return full };
        let pull = folded.pull();
        let Some([c, root]) = self.beyond(self.film.energy(e, past), self.k() * pull[0]) else { return full };
        let (sigma, along) = (self.k() * pull[1], folded.along());
        std::array::from_fn(|i| sigma * along[i] + c / root * (full[i] - sigma * along[i]))
    }

    /// With σ = k (1 − L₁^(−3/2)), N = n₁⊗n₁ and η = c/√X: ∂(σN)ᵢ/∂eⱼ = 2σ′ NᵢNⱼ + σ ∂Nᵢ/∂eⱼ and ∂η/∂X = −η/2X.
    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        let full = self.film.tangent(e, past);
        let Some(folded) = Self::folded(e) else { return full };
        let pull = folded.pull();
        let Some([flat, root]) = self.beyond(self.film.energy(e, past), self.k() * pull[0]) else { return full };
        let Folded { d, c, z, .. } = folded;
        let r = folded.r.max(f64::MIN_POSITIVE);
        let (sigma, n) = (self.k() * pull[1], folded.along());
        let slope = if z > 0.0 { self.k() * 3.0 * (1.0 + z).powi(-5) } else { 0.0 };
        let turn = [c / r * (c / r), -c / r * (c / r), -d / r * (c / r)].map(|v| 0.5 * sigma * v / r);
        let shear = [-c / r * (d / r), c / r * (d / r), d / r * (d / r)].map(|v| 0.5 * sigma * v / r);
        let rows = [turn, turn.map(|v| -v), shear];
        let own = |i: usize, j: usize| slope * n[i] * n[j] + rows[i][j];
        let (carried, tension) = (flat / root, self.film.tension(e, past));
        let excess: [f64; 3] = std::array::from_fn(|i| tension[i] - sigma * n[i]);
        let fall = 0.5 * carried / (root * root);
        matrix(|i, j| own(i, j) + carried * (full[i][j] - own(i, j)) - fall * excess[i] * excess[j])
    }

    fn kind(&self) -> InlinedFabric<'_> {
        InlinedFabric::WrinklingFilm(self)
    }
}
