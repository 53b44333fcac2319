//! End fittings: a muscle clamped on round plugs cannot widen near its ends, so short ones pull less.
//!
//! φ is the share of a long muscle's force at 620 kPa: 0.70 at L/2r₀ = 11.2, 0.46 at 5.4. σ is 1 for plugs, 0 for ends sealed flat. A
//! **prior**: published of another muscle, the 10 mm Festo one, as its author's fit, made without dimension by its diameter; the single
//! force printed at L/2r₀ = 5.4 (103 N) is half of this fit (220 N), so there it may claim too much.

use super::entry::*;
use std::f64::consts::{FRAC_PI_2, PI};

pub(super) const ENTRY: Effect = Effect {
    name: "end_fittings",
    formula: "η = 1 − σ (1 − φ), φ = (2/π) arctan(0.1903 (L/2r₀ − 0.75))",
    sentence: "A muscle that is clamped on plugs stays narrow near them, so a short one pulls less.",
    differs: "The same share of the force is missing at every pressure, more in short muscles.",
    remedy: "Pull muscles of two lengths at the same pressure.",
    validity: "L/2r₀ from 4 to 60; ends on plugs; a prior from another muscle",
    reference: "Bolen 2026 (Festo muscle of 10 mm); scaling with the diameter assumed",
    parameters: &[SHARE.means("share of the loss of plugs")],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Mckibben) {
            let slenderness = site.shape.length_m * PI / (2.0 * site.shape.width_m);
            site.linkage.active_fraction *= 1.0 - values[0] * (1.0 - share_of_force(slenderness));
        }
    },
    ..BALANCE
};

/// Diameter of the muscle of that fit \[m\], growth of its force with length \[1/m\], length lost at the ends \[m\].
const FESTO_M: f64 = 0.01;
const GROWTH_PER_M: f64 = 19.03;
const LOST_M: f64 = 0.0075;
const LEAST: f64 = 0.05;

/// Force over a long muscle's, by length over diameter.
fn share_of_force(slenderness: f64) -> f64 {
    ((GROWTH_PER_M * (slenderness * FESTO_M - LOST_M)).atan() / FRAC_PI_2).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plugs_cost_what_was_published() {
        // Measured 350.9 N at 112 mm, where the fitted limit of a long muscle is 470 N.
        assert!((share_of_force(11.2) / (350.9 / 470.0) - 1.0).abs() < 0.06);
        assert!((share_of_force(11.2) - 0.704).abs() < 1e-3 && (share_of_force(5.4) - 0.461).abs() < 1e-3);
        assert!(share_of_force(0.1) == LEAST && share_of_force(1e4) > 0.999);
    }
}
