//! A stiffer tip: the end cap keeps the section round and the last pouch from folding. As `base_clamp`, from the other end.

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
    add: |values, assembly| clamp(&ENTRY, values, assembly.length_m(), assembly),
    ..BALANCE
};
