//! Incompressible neo-Hookean sheet in plane stress: the paper's fit of coated nylon.
//!
//! ```text
//! W = t C₁₀ (C₁₁ + C₂₂ + 1/det C − 3),      C = 1 + 2E
//! S = 2 t C₁₀ (1 − adj(C)/det² C)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C₁₀ | neo-Hookean constant; small-strain modulus E = 6 C₁₀ | Pa |
//! | t | thickness | m |
//!
//! Valid for an isotropic film. **Do not use it for a woven fabric loaded off its yarns**: it has no warp and fill.
//! Reference: du Pasquier, Jeong, Okamura 2023; plane stress by eliminating the thickness stretch 1/√det C.

use std::sync::Arc;

use super::fabric::{Fabric, InlinedFabric, NeoHookean, Past, matrix};
use super::recipe::*;

pub(super) const ENTRY: Law = Law {
    name: "neo-hookean",
    parameters: &[modulus("c10_MPa").required("neo-Hookean constant, a sixth of Young's modulus"), THICKNESS],
    strain_limit: 0.4,
    example: || Recipe::of(&[("c10_MPa", 50.3), ("thickness_mm", 0.2)]),
    make: |recipe| {
        let v = ENTRY.read(recipe)?;
        Ok(Arc::new(NeoHookean::new(v.get("c10_MPa")?, v.get("thickness_mm")?)))
    },
    ..SHEET
};

impl Fabric for NeoHookean {
    fn thickness_m(&self) -> f64 {
        self.thickness_m
    }

    fn energy(&self, e: [f64; 3], _past: &Past) -> f64 {
        // C₁₁ + C₂₂ + 1/det − 3 loses ten digits at a strain of 1e-5; in terms of E: 1/(1+d) − 1 = −d/(1+d).
        let d = det_minus_one(e);
        let excess = 2.0 * (e[0] + e[1]) - d / (1.0 + d);
        self.thickness_m * self.c10_pa * excess
    }

    #[inline(always)]
    fn tension(&self, e: [f64; 3], _past: &Past) -> [f64; 3] {
        let d = det_minus_one(e);
        let inverse = 1.0 / (1.0 + d);
        let squared = inverse * inverse;
        let k = 2.0 * self.thickness_m * self.c10_pa;
        // 1 − C₂₂/det², with det² − 1 = d(2 + d): no cancellation at small strain.
        let spare = d * (2.0 + d);
        [k * squared * (spare - 2.0 * e[1]), k * squared * (spare - 2.0 * e[0]), k * squared * e[2]]
    }

    /// With a = [C₂₂, C₁₁, −C₁₂], d = det C and ∂d/∂eⱼ = 2aⱼ: ∂Sᵢ/∂eⱼ = k (4 aᵢaⱼ/d − ∂aᵢ/∂eⱼ)/d².
    #[inline(always)]
    fn tangent(&self, e: [f64; 3], _past: &Past) -> [[f64; 3]; 3] {
        let inverse = 1.0 / (1.0 + det_minus_one(e));
        let k = 2.0 * self.thickness_m * self.c10_pa * inverse * inverse;
        let a = [1.0 + 2.0 * e[1], 1.0 + 2.0 * e[0], -e[2]];
        let slopes = [[0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
        matrix(|i, j| k * (4.0 * a[i] * a[j] * inverse - slopes[i][j]))
    }

    fn kind(&self) -> InlinedFabric<'_> {
        InlinedFabric::NeoHookean(self)
    }
}

/// det C − 1 = 2(E₁₁ + E₂₂) + 4E₁₁E₂₂ − (2E₁₂)².
#[inline(always)]
fn det_minus_one(e: [f64; 3]) -> f64 {
    2.0 * (e[0] + e[1]) + 4.0 * e[0] * e[1] - e[2] * e[2]
}
