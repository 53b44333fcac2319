//! Yarn stretch: the yarns of a fabric muscle give way under its pressure, which lengthens it again at high pressure.
//!
//! ```text
//! m = c P r₀ (1 − ε)/(2 sin²α₀)      Green strain of both yarn families, free to take its value at every contraction
//! ```
//!
//! E is the potential at given pressure: the wider tube takes P Δv from the supply and stores half of it in its yarns, hence the sign. ν is
//! the contraction along one family per stretch along the other, at equal tension. (96.5 + 120)/2 MPa × 50 µm and ν = 0.2 give 1.48e-4 m/N;
//! [`crate::muscle`] has the derivation. Yarns are linear in Green strain, equal in both families (unequal ones twist:
//! `verification::exact::tube`).

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "yarn_stretch",
    formula: "E = −π P² r₀³ c (1 − ε)²/(2 sin⁴α₀) per metre",
    sentence: "The yarns of the muscle stretch under its pressure, so it widens and grows longer instead of pulling.",
    differs: "At high pressure the bend rises no further, or falls.",
    remedy: "Take E t along warp and fill from tensile tests, and ν from the width of a strip under load.",
    validity: "yarns linear and alike in both families; ν of a coated weave is unpublished, and c is proportional to 1 − ν",
    reference: "derived here",
    parameters: &[parameter("compliance_m_per_n", "c", "m/N", 1.0)
        .usual(1.5e-4, [0.0, 3e-4])
        .fitted(Fitted::FromDesign)
        .means("compliance of the yarns, (1 − ν)/(E t)")],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Mckibben) {
            site.weave.compliance_m_per_n = values[0];
        }
    },
    ..BALANCE
};
