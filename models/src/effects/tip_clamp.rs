//! A stiffer tip: the end cap keeps the section round and the last pouch from folding.
//!
//! ```text
//! B(s) = B (1 + b e^{−(L − s)/λ})      E = ½ B b e^{−(L − s)/λ} κ² per metre      λ = 1.5 R
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | b | extra stiffness at the tip as a share of B | - |
//! | L − s | distance from the tip | m |
//! | λ | length over which it fades, 1.5 body radii (assumed, as for `base_clamp`) | m |
//!
//! Acts only where B > 0; divides the body into segments, as transverse loads do. **Validity**: linear. Derived here.

use super::base_clamp::clamp;
use super::{Effect, Group, Parameter, Stage};
use crate::assembly::Assembly;

pub(super) const ENTRY: Effect = Effect {
    name: "tip_clamp",
    group: Group::Body,
    stage: Stage::Balance,
    history: false,
    formula: "B(s) = B (1 + b e^{−(L − s)/λ}), λ = 1.5 R",
    sentence: "The cap at the tip stiffens the body next to it.",
    differs: "Only the last markers are off: the end of the robot stays straight.",
    remedy: "Mark the body densely near the tip, or leave out the last actuator unit.",
    validity: "fades over 1.5 radii; needs B > 0",
    reference: "derived here",
    parameters: &[Parameter {
        key: "share",
        symbol: "b",
        unit: "-",
        si: 1.0,
        neutral: 0.0,
        typical: 2.0,
        lower: 0.0,
        upper: 8.0,
        starts: &[],
        by_actuator: &[],
        meaning: "extra stiffness at the tip as a share of B",
    }],
    family: None,
    add,
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let tip_m = assembly.length_m();
    clamp(ENTRY.name, values[0], tip_m, assembly);
}
