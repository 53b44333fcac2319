//! Neighbouring pouches, or folds on the inside of the bend, touch and block each other.
//!
//! The arcs leave a seam at angle θ from their chords; with chords at angle κ₀L₀ to each other, κ₀ = ηε/D, they touch when 2θ + κ₀L₀ = φ, and
//! past that a penalty acts per pouch. Arcs that meet in a line have φ = π, derived here; welds with a stiff rim and ends folded up like a
//! pillow's touch earlier, a gap between the pouches makes it later: such values are to be seen on the robot or fitted. Under a muscle there
//! are no pouches: the inner wall is folded, and the folds have closed when a metre of body has turned by φ; k is of a metre of body.

use super::entry::*;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "self_contact",
    formula: "E = ½ k (2θ + κL₀ − φ)₊²/L₀ per metre; fPAM: E = ½ k (κ·1 m − φ)₊²/1 m",
    sentence: "Neighbouring pouches (under a muscle: the inner wall's folds) press on each other and stop the bend.",
    differs: "The bend stops at a value that no further pressure exceeds.",
    remedy: "Look at the side view at full pressure: do pouches or folds touch?",
    validity: "pouches or folds side by side; k → large is a hard stop",
    reference: "derived here",
    parameters: &[
        parameter("stiffness_nm_per_rad", "k", "N m/rad", 1.0)
            .usual(20.0, [0.0, 1000.0])
            .starts(&[1.0, 20.0, 300.0])
            .means("contact stiffness of one pouch, or of a metre of folds"),
        parameter("touch_rad", "φ", "rad", 1.0)
            .around(PI, [0.5, 4.0])
            .possible([0.5, 4.0])
            .starts(&[1.0, 1.6, 2.2, 2.7, 3.3])
            .means("angle at which neighbours touch; fPAM: turn of a metre of body"),
    ],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let [stiffness, touch] = [values[0], values[1]];
        for site in &mut assembly.sites {
            let Some(actuator) = site.actuator else { continue };
            // Turn per half arc angle: two arcs of pouches, none of a muscle.
            let (length_m, arcs) = match actuator.family {
                Family::Pouch => (site.shape.length_m, 2.0),
                Family::Mckibben => (1.0, 0.0),
            };
            site.actuator_terms.push(ENTRY.law(Account::Contact, move |at, force| {
                let turned = arcs * at.q[actuator_q::COORDINATE] + at.q[actuator_q::CURVATURE] * length_m;
                let overlap = (turned - touch).max(0.0);
                let moment = stiffness * overlap / length_m;
                force[actuator_q::COORDINATE] -= arcs * moment;
                force[actuator_q::CURVATURE] -= length_m * moment;
                0.5 * moment * overlap
            }));
        }
    },
    ..BALANCE
};
