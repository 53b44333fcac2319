//! Fabrics: strain → energy and tension of one sheet.
//!
//! A fabric is a membrane law in its own axes, 1 = warp, 2 = fill (weft), written per unit *reference* area so that the
//! thickness is part of the fabric:
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e = \[E₁₁, E₂₂, 2E₁₂\] | Green–Lagrange strain, E = ½(FᵀF − 1) | – |
//! | W(e) | recoverable energy per reference area | J/m² |
//! | S(e) = ∂W/∂e | second Piola–Kirchhoff tension | N/m |
//!
//! Law (tested over every entry of [`FABRICS`]): S = ∂W/∂e, W ≥ 0, W(0) = 0 and S(0) = 0.
//! To add a fabric: one new file here and one line in [`FABRICS`].

mod bias_extension;
mod curve;
mod laminate;
mod materials;
mod neo_hookean;
mod orthotropic;
mod pull;
mod recipe;
pub mod specimen;
mod tension_field;
mod woven;
mod wrinkling_film;
mod yarn;

pub use bias_extension::BiasExtension;
pub use curve::Curve;
pub use laminate::{Laminate, Mixed, Ply};
pub use materials::{MATERIALS, Material, material};
pub use neo_hookean::NeoHookean;
pub use orthotropic::{Orthotropic, shear_modulus};
pub use pull::Pull;
pub use recipe::{CurveInput, Law, Need, Parameter, Recipe};
pub use tension_field::TensionField;
pub use woven::Woven;
pub use wrinkling_film::WrinklingFilm;
pub use yarn::Yarn;

use std::fmt::Debug;

/// The list.
pub const FABRICS: &[Law] = &[
    neo_hookean::ENTRY,
    orthotropic::ISOTROPIC,
    orthotropic::ORTHOTROPIC,
    woven::ENTRY,
    laminate::LAMINATE,
    laminate::GLUED,
    tension_field::ENTRY,
    wrinkling_film::ENTRY,
];

/// The law of that name.
pub fn by_name(name: &str) -> Option<&'static Law> {
    FABRICS.iter().find(|law| law.name == name)
}

/// Largest strain each yarn family has seen (warp, fill); what a fabric with different unloading remembers.
pub type Past = [f64; 2];

/// The membrane law of one sheet of fabric, in warp and fill axes.
pub trait Fabric: Send + Sync + Debug {
    /// Reference thickness t \[m\].
    fn thickness_m(&self) -> f64;
    /// Recoverable energy W(e) per reference area \[J/m²\].
    fn energy(&self, e: [f64; 3], past: &Past) -> f64;
    /// Second Piola–Kirchhoff tension S = ∂W/∂e \[N/m\].
    fn tension(&self, e: [f64; 3], past: &Past) -> [f64; 3];

    /// Tangent ∂S/∂e \[N/m\]; by central differences unless a law knows better.
    fn tangent(&self, e: [f64; 3], past: &Past) -> [[f64; 3]; 3] {
        const STEP: f64 = 1e-6;
        let mut columns = [[0.0; 3]; 3];
        for (k, column) in columns.iter_mut().enumerate() {
            let (mut up, mut down) = (e, e);
            up[k] += STEP;
            down[k] -= STEP;
            let (high, low) = (self.tension(up, past), self.tension(down, past));
            for i in 0..3 {
                column[i] = (high[i] - low[i]) / (2.0 * STEP);
            }
        }
        columns
    }

    /// A tangent that none exceeds, in stiffness, at strains within `reach` of `e` and on the way back from them \[N/m\]: what a
    /// time step must bear. The tangent itself unless a law stiffens in between.
    fn steepest(&self, e: [f64; 3], past: &Past, _reach: f64) -> [[f64; 3]; 3] {
        self.tangent(e, past)
    }

    /// True if [`Fabric::remember`] does something.
    fn has_memory(&self) -> bool {
        false
    }
    /// Updates the memory after a strain was reached.
    fn remember(&self, _e: [f64; 3], _past: &mut Past) {}
    /// Energy per reference area lost for good on the way to `past` \[J/m²\].
    fn dissipated(&self, _past: &Past) -> f64 {
        0.0
    }

    /// The laws that the element kernels compile for themselves; others are called sheet by sheet.
    fn kind(&self) -> Kind<'_> {
        Kind::Other
    }
}

/// A fabric whose formula the finite element kernels inline.
#[derive(Debug, Clone, Copy)]
pub enum Kind<'a> {
    /// Incompressible neo-Hookean sheet.
    NeoHookean(&'a NeoHookean),
    /// Linear orthotropic sheet.
    Orthotropic(&'a Orthotropic),
    /// Bonded sheets of these two.
    Mixed(&'a Mixed),
    /// Neo-Hookean sheet that wrinkles.
    WrinklingFilm(&'a WrinklingFilm),
    /// Any other law.
    Other,
}
