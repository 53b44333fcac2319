//! Flat ends: where a muscle is sealed flat, its tube climbs from a line to a circle and is shorter than its fabric.
//!
//! δ is the shortening of one end, (√2 − 1) r without a pull. Two ends of a muscle of L/2r = 8 add 5 % to its contraction, as much as its
//! weave does in the wall of a body. Over πr/4 at each end the tube is not yet in the wall and does not bend it. [`crate::muscle`] has the
//! derivation and the energy. Finite elements of the shipped robot: 7.5 mm per end, 7.9 here. The fabric between the generators folds
//! freely; the paper-bag volume (Robin 2004) loses 0.45 W at two ends where this has 0.39 W.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "flat_ends",
    formula: "δ = r (√m − √(m − 1)) per end, m = 2 + 2N/(P π r²)",
    sentence: "A muscle that is sealed flat shortens at its ends as well, where it changes from flat to round.",
    differs: "More bend than the weave can make, from low pressure on; most in short muscles.",
    remedy: "Compare muscles of two lengths: the part of the stroke that does not grow with length comes from the ends.",
    validity: "L above 6 r; ends sealed flat, not clamped on plugs",
    reference: "derived here",
    parameters: &[parameter("ends", "n", "-", 1.0)
        .usual(2.0, [0.0, 2.0])
        .possible([0.0, 2.0])
        .fitted(Fitted::FromDesign)
        .means("ends that are sealed flat")],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Mckibben) {
            site.weave.flat_ends = values[0];
        }
    },
    ..BALANCE
};
