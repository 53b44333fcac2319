//! Fabrics of the paper as ready recipes.
//!
//! Published: printed by du Pasquier, Jeong, Okamura 2023 (doi 10.1109/LRA.2023.3320010), Table I and Section III. Its Table I
//! and its C₁₀ are not the same number: 6 C₁₀ = 302 MPa against 215 and 201 MPa pulled along the yarns; C₁₀ is printed
//! without a unit, MPa is assumed. Neither density nor Poisson's ratio is printed.

use super::{Law, Recipe, by_name};

/// Fabric that cases and patterns call by name.
#[derive(Debug, Clone, Copy)]
pub struct Material {
    /// Name by which cases, patterns and scenarios call it.
    pub name: &'static str,
    /// Name of its law in [`super::FABRICS`].
    pub law: &'static str,
    /// Numbers by key of the law, as written.
    pub numbers: &'static [(&'static str, f64)],
}

/// Materials that cases may name, each with its law and numbers.
pub const MATERIALS: &[Material] = &[
    // TPU-coated 70D ripstop nylon as the paper simulated it, isotropic; body, sPAM, ePAM and cPAM.
    Material { name: "tpu-nylon", law: "neo-hookean", numbers: &[("c10_MPa", 50.3), ("thickness_mm", 0.2)] },
    // Silicone-coated ripstop nylon by its three published moduli, linear; the fPAM.
    Material { name: "silicone-nylon", law: "orthotropic", numbers: SILICONE_NYLON },
    // Silicone-coated ripstop nylon by its three published moduli, with yarns that turn; the fPAM.
    Material { name: "silicone-nylon-woven", law: "woven", numbers: SILICONE_NYLON },
];

const SILICONE_NYLON: &[(&str, f64)] = &[
    ("e0_MPa", 96.5),
    ("e90_MPa", 120.0),
    ("e45_MPa", 4.05),
    // Not printed, and matters by some ten per cent.
    ("nu12", 0.0),
    ("thickness_mm", 0.05),
];

/// Finds a material of [`MATERIALS`] by its name; `None` if there is none.
pub fn material(name: &str) -> Option<&'static Material> {
    MATERIALS.iter().find(|m| m.name == name)
}

impl Material {
    /// Its recipe, to be used or changed number by number.
    pub fn recipe(&self) -> Recipe {
        Recipe::of(self.numbers)
    }

    /// Finds the entry of its law in [`super::FABRICS`].
    pub fn law(&self) -> Option<&'static Law> {
        by_name(self.law)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_can_be_made() {
        for m in MATERIALS {
            let sheet = (m.law().unwrap().make)(&m.recipe()).unwrap();
            let thickness = m.numbers.iter().find(|n| n.0 == "thickness_mm").unwrap().1 * 1e-3;
            assert!((sheet.thickness_m() - thickness).abs() < 1e-15, "{}", m.name);
        }
    }
}
