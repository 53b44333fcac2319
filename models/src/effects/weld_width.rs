//! Weld width: what the welds take of the pitch neither contracts nor fills.
//!
//! b is the width of the welds between two pouches, and of both side welds together; the volume per pitch L₀ is
//! `V = W' L² (θ − sinθ cosθ)/(2θ²)`.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "weld_width",
    formula: "L = L₀ − b, W' = W − b; ε = (L/L₀)(1 − sinθ/θ)",
    sentence: "Welds have a width: what they take of the strip neither contracts nor fills.",
    differs: "A little of the bend is missing at every pressure, more of it with more and shorter pouches.",
    remedy: "Measure the width of the welds.",
    validity: "welds that keep their length",
    reference: "derived here",
    parameters: &[parameter("width_mm", "b", "mm", 1e-3)
        .usual(3.0, [0.0, 10.0])
        .fitted(Fitted::FromDesign)
        .means("width of the welds")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Pouch) {
            let pitch_m = site.shape.length_m;
            let weld_m = values[0].min(MOST * pitch_m.min(site.shape.width_m));
            site.shape.length_m -= weld_m;
            site.shape.width_m -= weld_m;
            let pouch = site.shape.length_m / pitch_m;
            site.linkage.active_fraction *= pouch;
            site.linkage.stroke_fraction *= pouch;
        }
    },
    ..BALANCE
};

/// Largest share of the pitch that welds may take: wider ones leave no pouch.
const MOST: f64 = 0.9;

#[cfg(test)]
mod tests {
    use crate::{Loads, Model, Scenario};

    #[test]
    fn without_a_wall_the_stroke_falls_by_the_share_of_the_pitch() {
        // Where nothing resists, the pouch is as round as it gets: cosθ = 0, however long it is.
        let bare = crate::shipped("cpam-textbook").unwrap().replace("pressure_kpa = 2 ", "pressure_kpa = 0.5 ");
        let turn = |more: &str| {
            let model = Model::new(&Scenario::parse(&format!("{bare}{more}")).unwrap());
            let mut at = model.prediction();
            model.predict(&Loads::uniform(1.0, 30e3), &mut at).unwrap();
            at.tip.angle_rad
        };
        let share = turn("[effects.weld_width]\nwidth_mm = 6\n") / turn("");
        assert!((share - 0.9).abs() < 1e-4, "{share}");
    }
}
