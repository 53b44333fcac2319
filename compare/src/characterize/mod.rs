//! From pulled specimens to the numbers and curves of a fabric law, each with its scatter and how it is known.
//!
//! One specimen at a time ([`specimen`]: stress over strain, modulus, C₁₀, shear curve of a bias extension), then over
//! specimens ([`reduce`]: the specimen is the unit, mean ± t s/√n at 95 %), then every test by the law that came of them
//! ([`mod@replay`]), then out ([`mod@write`]). Formulas are
//! in `models::fabrics::specimen` and `models::fabrics::BiasExtension`.

pub mod example;
mod input;
pub mod reduce;
pub mod replay;
mod result;
pub mod scatter;
pub mod specimen;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod toe_tests;
mod warn;
pub mod write;

pub use input::FabricTests;
pub use reduce::characterize;
pub use result::{BiasStrip, Characterized, MeanCurve, Replay, ShearCurve, Specimen, directions};
pub use scatter::{FabricNumber, Scatter};

/// Shear angle of the paper's validity limit \[rad\]: 24 % strain of its strip of 250 mm by 20 mm.
pub const PAPER_LIMIT_RAD: f64 = 0.630_801_3;
/// Shear angle up to which optical angles agree within 5° with the kinematics (Cao et al. 2008) \[rad\].
pub const OPTICAL_LIMIT_RAD: f64 = std::f64::consts::PI / 6.0;

/// How tests are reduced: name of the fabric, range of the modulus, checks.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// Name of the fabric in the TOML fragment.
    pub name: String,
    /// Strain up to which a modulus is the slope.
    pub modulus_strain: f64,
    /// Accept moduli that no coated fabric has.
    pub any_modulus: bool,
}

impl Default for Reduction {
    /// Moduli to 1 % strain: above the slack of a hand-clamped specimen, below where coated fabrics bend. Assumed.
    fn default() -> Reduction {
        Reduction { name: "fabric".into(), modulus_strain: 0.01, any_modulus: false }
    }
}
