//! cPAM: pouches with lateral gusset folds that let the sides open freely.
//!
//! Law of [`super::pouch`]. The lens needs a side opening of its height h(θ) ≤ 2L₀/π; two folds of depth f supply 2f.
//! Where they supply it all the sealed-edge loss vanishes:
//!
//! ```text
//! edge restraint = max(0, 1 − 2f / (2L₀/π)) = max(0, 1 − π f / L₀)
//! ```
//!
//! For L₀ = 60 mm, f = 24 mm it is 0: the ideal pouch. Derived here from the published inner-area factor 2.60 =
//! (W + 4f)/W, so the folds are at the two lateral sides (inferred, not printed).

use super::actuator::Actuator;
use super::pattern::{ChamberBottom, Pattern, flat, panel};
use super::pouch::POUCH;
use super::shape::ActuatorShape;
use std::f64::consts::PI;

pub(super) const ENTRY: Actuator = Actuator {
    name: "cpam",
    title: "compression (cylindrical) pneumatic artificial muscle",
    sentence: "Folded pouches in the wall: side gussets unfold, so that the edges do not hold the pouch back.",
    formula: "ε = 1 − sinθ/θ;  N = P W L₀ cosθ/θ;  arm = 2R;  edge restraint = max(0, 1 − πf/L₀)",
    reference: "Kübler et al. 2023 (cPAM; equations not available here); gusset reading derived here",
    validity: "Textbook: folds that open at once and weigh nothing; how far they open is the effect `gussets`.",
    edge_restraint,
    pattern,
    ..POUCH
};

fn edge_restraint(shape: &ActuatorShape) -> f64 {
    (1.0 - PI * shape.fold_m / shape.length_m).max(0.0)
}

/// Two lateral Z-folds: four layers (wall, gusset 1, gusset 2, top) at the seams.
fn pattern(shape: &ActuatorShape) -> Pattern {
    let (half, fold) = (0.5 * shape.width_m, shape.fold_m);
    let plain = flat(shape, ChamberBottom::Wall);
    if fold == 0.0 {
        return plain;
    }
    let panels = vec![
        panel("gusset_1_left", 1, -half, fold - half),
        panel("gusset_2_left", 2, fold - half, -half),
        panel("top", 3, -half, half),
        panel("gusset_2_right", 2, half, half - fold),
        panel("gusset_1_right", 1, half - fold, half),
    ];
    Pattern { panels, ..plain }
}

#[cfg(test)]
mod tests {
    use super::super::BIAS;
    use super::*;

    #[test]
    fn the_published_fold_frees_the_edges_and_no_fold_does_not() {
        let shape = |fold_m| ActuatorShape { length_m: 0.06, width_m: 0.06, fold_m, volume_gain: 1.0, bias_rad: BIAS };
        assert_eq!(edge_restraint(&shape(0.024)), 0.0);
        assert_eq!(edge_restraint(&shape(0.0)), 1.0);
    }
}
