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
mod fabric;
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
pub use fabric::{Fabric, InlinedFabric, Mixed, NeoHookean, Orthotropic, Past, Ply, WrinklingFilm};
pub use laminate::Laminate;
pub use materials::{MATERIALS, Material, material};
pub use orthotropic::shear_modulus;
pub use pull::Pull;
pub use recipe::{CurveInput, Law, LawParameter, Need, Recipe};
pub use tension_field::TensionField;
pub use woven::Woven;
pub use wrinkling_film::wrinkling_load_n_per_m;
pub use yarn::Yarn;

/// Fabric laws that recipes may name, in the order of the documents.
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

/// Finds a law of [`FABRICS`] by its name in recipes; `None` if there is none.
pub fn by_name(name: &str) -> Option<&'static Law> {
    FABRICS.iter().find(|law| law.name == name)
}
