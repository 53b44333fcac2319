//! The wall's stiffness changes steadily from base to tip.
//!
//! ```text
//! B(s) = B (1 + a (1 − 2 s/L))
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a | extra stiffness at the base as a share of B, missing at the tip | - |
//!
//! Acts only where B > 0; divides the body into segments, as transverse loads do. **Validity**: linear in s. Derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "tapered_wall",
    group: Group::Body,
    formula: "B(s) = B (1 + a (1 − 2 s/L))",
    sentence: "The wall is stiffer at the base than at the tip, or the other way round: glue, a taper, a seam that widens.",
    differs: "The bend grows steadily from one end of the robot to the other.",
    remedy: "Hang a known force on the inflated body's middle and then on its tip: do both give one stiffness?",
    validity: "linear along the body; needs B > 0",
    reference: "derived here",
    parameters: &[Parameter {
        key: "share",
        symbol: "a",
        typical: 0.3,
        lower: -0.95,
        upper: 0.95,
        possible: [-1.0, 1.0],
        meaning: "extra stiffness at the base as a share of B",
        ..PLAIN
    }],
    add,
    ..BALANCE
};

struct Taper {
    stiffness: f64,
    length_m: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    if values[0] == 0.0 {
        return;
    }
    assembly.varies = true;
    let length_m = assembly.length_m();
    for site in &mut assembly.sites {
        site.body_terms.push(Box::new(Taper { stiffness: values[0] * site.bending.stiffness, length_m }));
    }
}

impl Term for Taper {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let moment = self.stiffness * (1.0 - 2.0 * at.s_m / self.length_m) * at.q[0];
        force[0] -= moment;
        0.5 * moment * at.q[0]
    }
}

impl Remembering for Taper {}
