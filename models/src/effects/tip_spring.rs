//! A hose or a cable holds the tip back like a spring.
//!
//! ```text
//! E = ½ k (y_tip² + (x_tip − L)²)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | stiffness of what holds the tip | N/m |
//!
//! **Validity**: slack at the tip of the straight robot, alike in all directions. Statics.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "tip_spring",
    group: Group::Load,
    formula: "E = ½ k (y_tip² + (x_tip − L)²)",
    sentence: "A hose or a cable holds the tip back the more, the further it has moved.",
    differs: "The bend near the base is missing, more so at high pressures; the tip's own bend is as predicted.",
    remedy: "Take the hose off the tip, or support it, and repeat one hold.",
    validity: "slack at the tip of the straight robot, alike in all directions",
    reference: "statics",
    parameters: &[Parameter {
        key: "stiffness_n_per_m",
        symbol: "k",
        unit: "N/m",
        typical: 3.0,
        upper: 100.0,
        meaning: "stiffness of what holds the tip",
        ..PLAIN
    }],
    add,
    ..BALANCE
};

struct TipSpring {
    stiffness: f64,
    length_m: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    if values[0] != 0.0 {
        let length_m = assembly.length_m();
        assembly.springs = true;
        assembly.node_terms.push(Box::new(TipSpring { stiffness: values[0], length_m }));
    }
}

impl Term for TipSpring {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Load)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let tip = at.q.len() - 2;
        let away = [at.q[tip] - self.length_m, at.q[tip + 1]];
        force[tip] -= self.stiffness * away[0];
        force[tip + 1] -= self.stiffness * away[1];
        0.5 * self.stiffness * (away[0] * away[0] + away[1] * away[1])
    }
}
