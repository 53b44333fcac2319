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

use std::sync::Arc;

use super::fabric::{Fabric, InlinedFabric, Orthotropic, Past};
use super::recipe::*;

/// A linear fabric: stiff along warp and fill, soft in between, with contraction across the pull.
pub(super) const ORTHOTROPIC: Law = Law {
    name: "orthotropic",
    parameters: &MODULI,
    example: || {
        Recipe::of(&[("e0_MPa", 96.5), ("e90_MPa", 120.0), ("e45_MPa", 4.05), ("nu12", 0.3), ("thickness_mm", 0.05)])
    },
    make: |recipe| Ok(Arc::new(from_values(&ORTHOTROPIC.read(recipe)?)?)),
    ..SHEET
};

/// A linear film that is equally stiff in every direction.
pub(super) const ISOTROPIC: Law = Law {
    name: "isotropic",
    parameters: &[
        modulus("e_MPa").required("Young's modulus"),
        ratio("nu", [0.0, 0.5]).required("Poisson's ratio"),
        THICKNESS,
    ],
    example: || Recipe::of(&[("e_MPa", 588.0), ("nu", 0.4), ("thickness_mm", 0.6)]),
    make: |recipe| {
        let v = ISOTROPIC.read(recipe)?;
        Ok(Arc::new(Orthotropic::isotropic(v.get("e_MPa")?, v.get("nu")?, v.get("thickness_mm")?)))
    },
    ..SHEET
};

/// Keys of a linear fabric: moduli, contraction ratio and thickness.
pub(super) const MODULI: [LawParameter; 6] = [
    modulus("e0_MPa").required("modulus pulled along warp"),
    modulus("e90_MPa").required("modulus pulled along fill"),
    modulus("e45_MPa").optional("modulus pulled at 45 degrees to the yarns; in place of g_MPa"),
    modulus("g_MPa").optional("shear modulus between warp and fill; in place of e45_MPa"),
    ratio("nu12", [0.0, 2.0]).or(0.0, "contraction along fill per stretch along warp, pulled along warp"),
    THICKNESS,
];

pub(super) fn from_values(v: &RecipeValues) -> Result<Orthotropic, String> {
    v.exactly_one(&["e45_MPa", "g_MPa"])?;
    let (e0, e90, nu12, t) = (v.get("e0_MPa")?, v.get("e90_MPa")?, v.get("nu12")?, v.get("thickness_mm")?);
    match v.optional("e45_MPa") {
        Some(e45) => Orthotropic::from_bias(e0, e90, e45, nu12, t),
        None => Orthotropic::checked(e0, e90, nu12, v.get("g_MPa")?, t),
    }
    .map_err(|m| v.says(m))
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

    /// Like [`Orthotropic::new`], for unchecked numbers.
    ///
    /// # Errors
    /// A modulus or thickness that is not positive; ν₁₂² ≥ E₁/E₂, with which some strains would give energy away.
    pub fn checked(e1_pa: f64, e2_pa: f64, nu12: f64, g_pa: f64, thickness_m: f64) -> Result<Orthotropic, String> {
        let positive = [("modulus along warp", e1_pa), ("modulus along fill", e2_pa), ("shear modulus", g_pa)];
        for (name, value) in positive.into_iter().chain([("thickness", thickness_m)]) {
            if !(value > 0.0 && value.is_finite()) {
                return Err(format!("the {name} is {value}; write a positive number"));
            }
        }
        coupling_fits(e1_pa, e2_pa, nu12)?;
        Ok(Orthotropic::new(e1_pa, e2_pa, nu12, g_pa, thickness_m))
    }

    /// From the moduli pulled along warp, fill and at 45° between them \[Pa\].
    ///
    /// # Errors
    /// Like [`Orthotropic::checked`]; also an E₄₅ too large for any shear modulus.
    ///
    /// ```
    /// let silicone_nylon = models::fabrics::Orthotropic::from_bias(96.5e6, 120e6, 4.05e6, 0.0, 5e-5).unwrap();
    /// assert!((silicone_nylon.a66 - 51.602).abs() < 1e-3); // G t [N/m]
    /// ```
    pub fn from_bias(e0_pa: f64, e90_pa: f64, e45_pa: f64, nu12: f64, thickness_m: f64) -> Result<Orthotropic, String> {
        Orthotropic::checked(e0_pa, e90_pa, nu12, shear_modulus(e0_pa, e90_pa, e45_pa, nu12)?, thickness_m)
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

    #[inline(always)]
    fn tangent(&self, _e: [f64; 3], _past: &Past) -> [[f64; 3]; 3] {
        [[self.a11, self.a12, 0.0], [self.a12, self.a22, 0.0], [0.0, 0.0, self.a66]]
    }

    fn kind(&self) -> InlinedFabric<'_> {
        InlinedFabric::Orthotropic(self)
    }
}

/// G \[Pa\] from the moduli along warp, fill and at 45°: 1/G = 4/E₄₅ − 1/E₁ − 1/E₂ + 2ν₁₂/E₁.
pub fn shear_modulus(e1_pa: f64, e2_pa: f64, e45_pa: f64, nu12: f64) -> Result<f64, String> {
    let rest = 1.0 / e1_pa + 1.0 / e2_pa - 2.0 * nu12 / e1_pa;
    let compliance = 4.0 / e45_pa - rest;
    if compliance.is_finite() && compliance > 0.0 {
        return Ok(1.0 / compliance);
    }
    Err(format!(
        "e45 = {:.4} MPa leaves no positive shear modulus: 4/e45 must exceed 1/e0 + 1/e90 - 2 nu12/e0; \
         write an e45 below {:.4} MPa",
        e45_pa * 1e-6,
        4e-6 / rest
    ))
}

/// Rejects ν₁₂² ≥ E₁/E₂, for which the stiffness matrix is not positive.
pub(super) fn coupling_fits(e1_pa: f64, e2_pa: f64, nu12: f64) -> Result<(), String> {
    if nu12 >= 0.0 && nu12 * nu12 < e1_pa / e2_pa {
        return Ok(());
    }
    let limit = (e1_pa / e2_pa).sqrt();
    Err(format!("nu12 is {nu12}, which these moduli do not allow; write a number from 0 to below {limit:.3}"))
}
