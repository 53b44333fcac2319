//! Softening of the wall: creases and buckles that a bend has made take its stiffness from it.
//!
//! ```text
//! M = B κ/(1 + a κ)         E = B (κ/a − ln(1 + a κ)/a²)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | B | bending stiffness of the straight wall | N·m² |
//! | a | softening: at κ = 1/a half of the stiffness is gone | m |
//!
//! The moment rises ever more slowly and never falls, up to B/a: from a linear wall (a = 0) to one that yields at a moment.
//!
//! Validity: no memory, so folds open again; bends towards the actuator; needs B > 0.

use super::*;

pub(super) const ENTRY: Effect = Effect {
    name: "softening",
    group: Group::Body,
    stage: Stage::Balance,
    history: false,
    formula: "M = B κ/(1 + a κ)",
    sentence: "The wall softens as it bends: creases and buckles, once there, fold more easily.",
    differs: "Small bends meet a stiff wall, large ones a soft one: the curve over pressure stays steep where others flatten.",
    remedy: "Bend the inflated body with known tip forces, small and large: is the second half of the way easier?",
    validity: "no memory; bends towards the actuator; needs B > 0",
    reference: "derived here",
    parameters: &[Parameter {
        key: "softening_m",
        symbol: "a",
        unit: "m",
        typical: 0.3,
        upper: 3.0,
        meaning: "inverse of the curvature at which half of the stiffness is gone",
        ..PLAIN
    }],
    needs: Needs::Body,
    add,
};

struct Softening {
    stiffness: f64,
    softening: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    if values[0] == 0.0 {
        return;
    }
    for site in &mut assembly.sites {
        site.body_terms.push(Box::new(Softening { stiffness: site.bending.stiffness, softening: values[0] }));
    }
}

impl Term for Softening {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (kappa, a) = (at.q[0].abs(), self.softening);
        force[0] += self.stiffness * a * kappa * at.q[0] / (1.0 + a * kappa);
        self.stiffness * (kappa / a - (a * kappa).ln_1p() / (a * a) - 0.5 * kappa * kappa)
    }
}

impl Remembering for Softening {}
