//! Homogeneous states of an incompressible neo-Hookean sheet.
//!
//! ```text
//! uniaxial    P = 2 C₁₀t (λ − λ⁻²)        equal biaxial    P = 2 C₁₀t (λ − λ⁻⁵)
//! width kept  P = 2 C₁₀t (λ − λ⁻³)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P | tension per unstressed width (force over original width) | N/m |
//! | λ | stretch along the pull | – |
//! | C₁₀ t | neo-Hookean constant times thickness, E t/6 | N/m |
//!
//! Standard (Treloar, The Physics of Rubber Elasticity, recalled); each is the slope of W at the stretch of the free sides.

use super::KnownSections;

/// How the sides of the sheet are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SideSupport {
    /// Free to shrink, so that the pull is uniaxial.
    Free,
    /// Kept at their length (pure shear).
    Kept,
    /// Pulled as much as the sheet itself, equal biaxial.
    Pulled,
}

/// Tension per unstressed width at a stretch \[N/m\].
pub fn tension_n_per_m(c10_t: f64, stretch: f64, sides: SideSupport) -> f64 {
    let power = match sides {
        SideSupport::Free => -2,
        SideSupport::Kept => -3,
        SideSupport::Pulled => -5,
    };
    2.0 * c10_t * (stretch - stretch.powi(power))
}

/// See `known.txt`; C10 t = 1 N/m.
pub(super) fn known() -> KnownSections {
    let pulls =
        [SideSupport::Free, SideSupport::Kept, SideSupport::Pulled].map(|sides| tension_n_per_m(1.0, 2.0, sides));
    vec![("neo-Hookean sheet", pulls.to_vec())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use models::fabrics::{Fabric, NeoHookean};

    #[test]
    fn tensions_are_those_of_the_fabric_law() {
        let (c10_pa, thickness_m) = (35e6, 2e-4);
        let law = NeoHookean::new(c10_pa, thickness_m);
        let green = |stretch: f64| 0.5 * (stretch * stretch - 1.0);
        for stretch in [0.9, 1.05, 1.4_f64] {
            for (sides, across) in
                [(SideSupport::Free, stretch.powf(-0.5)), (SideSupport::Kept, 1.0), (SideSupport::Pulled, stretch)]
            {
                let s = law.tension([green(stretch), green(across), 0.0], &[0.0; 2]);
                let pull = tension_n_per_m(c10_pa * thickness_m, stretch, sides);
                assert!((stretch * s[0] - pull).abs() < 1e-9 * c10_pa * thickness_m, "{sides:?}");
                assert!(sides != SideSupport::Free || s[1].abs() < 1e-9 * c10_pa * thickness_m);
            }
        }
    }
}
