//! Linear orthotropic sheet (St. Venant–Kirchhoff in warp and fill axes) with biaxial coupling.
//!
//! ```text
//! W = ½ (A₁₁ e₁² + 2 A₁₂ e₁ e₂ + A₂₂ e₂² + A₆₆ e₃²)        S = A e
//! A₁₁ = E₁t/(1 − ν₁₂ν₂₁)   A₂₂ = E₂t/(1 − ν₁₂ν₂₁)   A₁₂ = ν₁₂A₂₂ = ν₂₁A₁₁   A₆₆ = Gt
//! 1/G = 4/E₄₅ − 1/E₁ − 1/E₂ + 2ν₁₂/E₁
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E₁, E₂ | moduli along warp and fill | Pa |
//! | ν₁₂ | contraction along fill per stretch along warp, pulled along warp; ν₂₁ = ν₁₂E₂/E₁ | – |
//! | G | shear modulus between warp and fill | Pa |
//! | t | thickness | m |
//!
//! Valid for strains of a few per cent. **Do not use it in strong compression**: linear in E, it softens and then
//! collapses below a stretch of 1/√3; nor where yarns lock or reorient by tens of degrees (see the woven fabric).
//! Reference: Jones, Mechanics of Composite Materials, ch. 2.

use super::{Fabric, Kind, Past};

/// Linear orthotropic sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orthotropic {
    /// A₁₁ \[N/m\].
    pub a11: f64,
    /// A₂₂ \[N/m\].
    pub a22: f64,
    /// A₁₂ \[N/m\].
    pub a12: f64,
    /// A₆₆ = Gt \[N/m\].
    pub a66: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
}

impl Orthotropic {
    /// From moduli \[Pa\] and thickness \[m\]. Positive definite if ν₁₂² < E₁/E₂.
    pub fn new(e1_pa: f64, e2_pa: f64, nu12: f64, g_pa: f64, thickness_m: f64) -> Orthotropic {
        let nu21 = nu12 * e2_pa / e1_pa;
        let scale = thickness_m / (1.0 - nu12 * nu21);
        Orthotropic {
            a11: e1_pa * scale,
            a22: e2_pa * scale,
            a12: nu12 * e2_pa * scale,
            a66: g_pa * thickness_m,
            thickness_m,
        }
    }

    /// An isotropic sheet: E₁ = E₂ = E, G = E/(2(1 + ν)).
    pub fn isotropic(e_pa: f64, nu: f64, thickness_m: f64) -> Orthotropic {
        Orthotropic::new(e_pa, e_pa, nu, e_pa / (2.0 * (1.0 + nu)), thickness_m)
    }
}

impl Fabric for Orthotropic {
    fn thickness_m(&self) -> f64 {
        self.thickness_m
    }

    fn energy(&self, e: [f64; 3], past: &Past) -> f64 {
        let s = self.tension(e, past);
        0.5 * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2])
    }

    #[inline(always)]
    fn tension(&self, e: [f64; 3], _past: &Past) -> [f64; 3] {
        [self.a11 * e[0] + self.a12 * e[1], self.a12 * e[0] + self.a22 * e[1], self.a66 * e[2]]
    }

    fn kind(&self) -> Kind<'_> {
        Kind::Orthotropic(self)
    }
}
