//! A known force at the tip, constant in direction.
//!
//! ```text
//! E = −F_x x_tip − F_y y_tip
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | F_x, F_y | force on the tip, y towards the actuator | N |
//!
//! Validity: dead load at the end of the centre line. Statics.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "tip_load",
    group: Group::Load,
    formula: "E = −F·x_tip",
    sentence: "A force pulls or pushes the tip: a payload, a cable, a camera.",
    differs: "The tip is bent at zero pressure already; the error grows from the base as a lever does.",
    remedy: "Hang a known weight on the tip, or take off what hangs there.",
    validity: "dead load at the tip",
    reference: "statics",
    parameters: &[force("force_x_n", "F_x", 0.0, false), force("force_y_n", "F_y", -0.4, true)],
    needs: Needs::Body,
    add,
    ..BALANCE
};

const fn force(key: &'static str, symbol: &'static str, typical: f64, in_room: bool) -> Parameter<'static> {
    Parameter {
        key,
        symbol,
        unit: "N",
        typical,
        lower: -5.0,
        upper: 5.0,
        possible: ANY,
        in_room,
        meaning: "force on the tip",
        ..PLAIN
    }
}

struct TipLoad {
    force: [f64; 2],
}

fn add(values: &[f64], assembly: &mut Assembly) {
    if values[0] != 0.0 || values[1] != 0.0 {
        assembly.node_terms.push(Box::new(TipLoad { force: [values[0], values[1]] }));
    }
}

impl Term for TipLoad {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Load)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let tip = at.q.len() - 2;
        force[tip] += self.force[0];
        force[tip + 1] += self.force[1];
        -self.force[0] * at.q[tip] - self.force[1] * at.q[tip + 1]
    }
}
