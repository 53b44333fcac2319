//! A stiffer base: the clamp holds the wall round and keeps the folds from forming next to it.
//!
//! s is the distance from the base, taken in the middle of a segment. c = 1.5 is assumed (end effects of tubes fade within one to two
//! radii), a fit finds it. m is 1 where the stretch fades and large for a sleeve. Divides the body into segments, as transverse loads do.

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
    add: |values, assembly| clamp(&ENTRY, values, 0.0, assembly),
    ..BALANCE
};

pub(super) const fn share(meaning: Text) -> Parameter<'static> {
    parameter("share", "b", "-", 1.0).usual(2.0, [0.0, 8.0]).means(meaning)
}

pub(super) const REACH: Parameter = parameter("reach_radii", "c", "-", 1.0)
    .around(1.5, [0.5, 3.0])
    .possible([0.5, 3.0])
    .starts(&[0.8, 1.5, 2.2])
    .means("length over which the extra stiffness fades, in body radii");

/// Exponent m of the clamp's end: how suddenly the clamped stretch ends.
pub(super) const END: Parameter = shape("end_exponent", "m", "-", 1.0)
    .around(1.0, [1.0, 5.0])
    .possible(ABOVE_ZERO)
    .starts(&[3.0])
    .means("how suddenly the stiffer stretch ends");

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
