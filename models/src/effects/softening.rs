//! Softening of the wall: creases and buckles that a bend has made take its stiffness from it.
//!
//! `E = B (κ/a − ln(1 + a κ)/a²)`. The moment rises ever more slowly and never falls, up to B/a: from a linear wall (a = 0) to one that yields
//! at a moment.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "softening",
    group: Group::Body,
    formula: "M = B κ/(1 + a κ)",
    sentence: "The wall softens as it bends: creases and buckles, once there, fold more easily.",
    differs: "Small bends meet a stiff wall, large ones a soft one: the curve over pressure stays steep where others flatten.",
    remedy: "Bend the inflated body with known tip forces, small and large: is the second half of the way easier?",
    validity: "no memory; bends towards the actuator; needs B > 0",
    reference: "derived here",
    parameters: &[parameter("softening_m", "a", "m", 1.0)
        .usual(0.3, [0.0, 3.0])
        .means("inverse of the curvature at which half of the stiffness is gone")],
    add: |values, assembly| {
        let a = values[0];
        if a == 0.0 {
            return;
        }
        for site in &mut assembly.sites {
            let stiffness = site.bending.stiffness;
            site.body_terms.push(ENTRY.law(Account::Wall, move |at, force| {
                let kappa = at.q[0].abs();
                force[0] += stiffness * a * kappa * at.q[0] / (1.0 + a * kappa);
                stiffness / (a * a) * lost(a * kappa)
            }));
        }
    },
    ..BALANCE
};

/// x − ln(1 + x) − x²/2; near zero by its series, where the three cancel.
fn lost(x: f64) -> f64 {
    match x < SMALL {
        true => (3..=8).map(|n| (-x).powi(n) / f64::from(n)).sum(),
        false => x - x.ln_1p() - 0.5 * x * x,
    }
}

/// Below it the series is exact to 1e-10.
const SMALL: f64 = 0.02;
