//! A stiffer base: the clamp holds the wall round and keeps the folds from forming next to it.
//!
//! ```text
//! B(s) = B (1 + b e^{−(s/λ)ᵐ})      E = ½ B b e^{−(s/λ)ᵐ} κ² per metre      λ = c R
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | b | extra stiffness at the base as a share of B | - |
//! | s | distance from the base | m |
//! | c | length over which it fades, in body radii; 1.5 is assumed (end effects of tubes fade within one to two), a fit finds it | - |
//! | m | how suddenly it ends: 1 where it fades, large for a sleeve | - |
//!
//! Acts only where B > 0; divides the body into segments, as transverse loads do. **Validity**: linear; s is taken in the middle of
//! a segment. Derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "base_clamp",
    group: Group::Body,
    formula: "B(s) = B (1 + b e^{−(s/λ)ᵐ}), λ = c R",
    sentence: "The clamp at the base stiffens the body next to it.",
    differs: "The first markers bend too little and the others only follow: the missing angle is gained near the base.",
    remedy: "Mark the body densely near the base, or clamp a longer stretch and see the bend move on.",
    validity: "a stretch that fades or ends; needs B > 0",
    reference: "derived here",
    parameters: &[share("extra stiffness at the base as a share of B"), REACH, END],
    needs: Needs::Body,
    add: |values, assembly| clamp(&ENTRY, values, 0.0, assembly),
    ..BALANCE
};

/// How much stiffer either end is.
pub(super) const fn share(meaning: &'static str) -> Parameter<'static> {
    Parameter { key: "share", symbol: "b", typical: 2.0, upper: 8.0, meaning, ..PLAIN }
}

/// How far the stiffer stretch reaches, of either end.
pub(super) const REACH: Parameter = Parameter {
    key: "reach_radii",
    symbol: "c",
    neutral: 1.5,
    typical: 1.5,
    lower: 0.5,
    upper: 3.0,
    possible: [0.5, 3.0],
    starts: &[0.8, 1.5, 2.2],
    meaning: "length over which the extra stiffness fades, in body radii",
    ..PLAIN
};

/// Exponent m of the clamp's end: how suddenly the clamped stretch ends.
pub(super) const END: Parameter = Parameter {
    key: "end_exponent",
    symbol: "m",
    neutral: 1.0,
    typical: 1.0,
    lower: 1.0,
    upper: 5.0,
    possible: ABOVE_ZERO,
    starts: &[3.0],
    meaning: "how suddenly the stiffer stretch ends",
    ..SHAPE
};

/// Stiffens the wall around station `at_m` by a share of its B, which fades over so many radii, and how suddenly.
pub(super) fn clamp(effect: &Effect<'static>, values: &[f64], at_m: f64, assembly: &mut Assembly) {
    let [share, reach, end] = [values[0], values[1], values[2]];
    if share == 0.0 {
        return;
    }
    assembly.varies = true;
    for site in &mut assembly.sites {
        let (stiffness, length_m) = (share * site.bending.stiffness, reach * site.radius_m);
        site.body_terms.push(effect.law(Account::Wall, move |at, force| {
            let away = (at.s_m - at_m).abs() / length_m;
            let away = if end == 1.0 { away } else { away.powf(end) };
            let moment = stiffness * (-away).exp() * at.q[0];
            force[0] -= moment;
            0.5 * moment * at.q[0]
        }));
    }
}
