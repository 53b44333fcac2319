//! A stiffer tip: the end cap keeps the section round and the last pouch from folding.
//!
//! ```text
//! B(s) = B (1 + b e^{−((L − s)/λ)ᵐ})      E = ½ B b e^{−((L − s)/λ)ᵐ} κ² per metre      λ = c R
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | b | extra stiffness at the tip as a share of B | - |
//! | L − s | distance from the tip | m |
//! | c | length over which it fades, in body radii; 1.5 is assumed, as for `base_clamp` | - |
//! | m | how suddenly it ends: 1 where it fades, large for a sleeve | - |
//!
//! Acts only where B > 0; divides the body into segments, as transverse loads do. **Validity**: linear. Derived here.

use super::base_clamp::{END, REACH, clamp, share};
use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "tip_clamp",
    group: Group::Body,
    formula: "B(s) = B (1 + b e^{−((L − s)/λ)ᵐ}), λ = c R",
    sentence: "The cap at the tip stiffens the body next to it.",
    differs: "Only the last markers are off: the end of the robot stays straight.",
    remedy: "Mark the body densely near the tip, or leave out the last actuator unit.",
    validity: "a stretch that fades or ends; needs B > 0",
    reference: "derived here",
    parameters: &[share("extra stiffness at the tip as a share of B"), REACH, END],
    needs: Needs::Body,
    add: |values, assembly| clamp(&ENTRY, values, assembly.length_m(), assembly),
    ..BALANCE
};
