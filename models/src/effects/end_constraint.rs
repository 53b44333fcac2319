//! Sealed-edge ("pillow") loss: the closed side seams hold the pouch back.
//!
//! A sealed bag cannot take the volume of an open-ended one: η scales its volume, η_ε = 1 − σ (1 − η) its stroke. e is the edge restraint of
//! the actuator: 1 sealed, 0 freed by gussets. Robin's paper-bag volume gives β = 0.142π = 0.446, Kepert's bounds 0.354–0.394 at W = L₀; its
//! short side is L₀. Using a *volume* ratio as a *stroke* ratio (σ = 1) is an assumption of this project. For pouches `sealed_sides` derives
//! both from mechanics; the two together count it twice.

use super::entry::*;
use crate::actuators::{Actuator, ActuatorShape, Family};
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "end_constraint",
    formula: "η = 1 − β e (L₀/W)(1 − 10^(−W/L₀)) on volume, 1 − σ (1 − η) on stroke; fPAM: η = 1 − 4β r₀/L",
    sentence: "The sealed side edges (or tube ends) hold the actuator back, so only part of its volume and stroke is usable.",
    differs: "The same share of the bend is missing at every pressure (σ = 1), or most at low ones (σ = 0), at every place.",
    remedy: "Compare two pouch widths at the same length: the loss shrinks as W/L₀ grows.",
    validity: "W ≥ L₀; η is kept above 0.05",
    reference: "Robin 2004 (paper bag volume); end factor derived here",
    parameters: &[
        parameter("beta", "β", "-", 1.0).usual(0.446, [0.0, 1.0]).possible([0.0, 1.0]).means("edge-loss coefficient"),
        parameter("stroke", "σ", "-", 1.0)
            .around(1.0, [0.0, 1.0])
            .possible([0.0, 1.0])
            .starts(&[0.0, 0.3, 0.7])
            .fitted(Fitted::WithKeptBending)
            .means("share of the loss that stroke has too"),
    ],
    needs: Needs::Actuator,
    add: |values, assembly| {
        for site in &mut assembly.sites {
            if let Some(actuator) = site.actuator {
                let active = active_fraction(actuator, &site.shape, values[0]);
                site.linkage.active_fraction *= active;
                site.linkage.stroke_fraction *=
                    if values[1] == 1.0 { active } else { 1.0 - values[1] * (1.0 - active) };
            }
        }
    },
    ..BALANCE
};

fn active_fraction(actuator: &Actuator, shape: &ActuatorShape, beta: f64) -> f64 {
    let loss = match actuator.family {
        Family::Pouch => {
            let aspect = shape.width_m / shape.length_m;
            (actuator.edge_restraint)(shape) * (1.0 - 10f64.powf(-aspect)) / aspect
        }
        Family::Mckibben => 4.0 * shape.width_m / PI / shape.length_m,
    };
    (1.0 - beta * loss).max(0.05)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::actuators::{BIAS, by_name};

    #[test]
    fn robins_coefficient_gives_the_known_end_factors() {
        let epam = by_name("epam").unwrap();
        for (aspect, eta) in [(1.0, 0.598504459), (2.0, 0.779177452), (46.0 / 17.25, 0.833070606), (5.0, 0.910779661)] {
            let shape =
                ActuatorShape { length_m: 0.06, width_m: 0.06 * aspect, fold_m: 0.0, volume_gain: 1.0, bias_rad: BIAS };
            let computed = active_fraction(epam, &shape, 0.142 * PI);
            assert!((computed - eta).abs() < 1e-9, "{aspect}: {computed}");
        }
    }
}
