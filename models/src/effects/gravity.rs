//! Weight of the robot in the bending plane.
//!
//! ```text
//! E = −Σ w hᵢ ĝ·xᵢ      w [N/m] per length, ĝ unit vector of gravity in the plane
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | w | weight per length of body | N/m |
//! | ĝ | direction: against the bend, −y, unless the data set says otherwise | - |
//! | xᵢ, hᵢ | node position and its share of the length | m |
//!
//! Validity: needs a fine enough division (12 segments give 0.1 % of the droop of a 360 mm robot). Vanishes when the
//! robot bends in a horizontal plane. Derived here; kept as dead load on the deformed shape.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "gravity",
    group: Group::Load,
    formula: "E = −Σ w hᵢ ĝ·xᵢ",
    sentence: "The robot's weight bends it: most at the base, and the other way when the robot is turned over.",
    differs: "The error is largest near the base, and changes its sign when the robot is turned over.",
    remedy: "Weigh the robot; repeat the test with the robot rolled by 180°.",
    validity: "bending plane vertical; dead load",
    reference: "statics",
    parameters: &[Parameter {
        key: "weight_n_per_m",
        symbol: "w",
        unit: "N/m",
        typical: 1.5,
        upper: 8.0,
        meaning: "weight per length",
        ..PLAIN
    }],
    needs: Needs::Body,
    add,
    ..BALANCE
};

struct Gravity {
    /// Weight of each node, x then y \[N\].
    forces: Vec<f64>,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    if values[0] == 0.0 {
        return;
    }
    let [gx, gy] = assembly.gravity_direction;
    let forces = assembly.node_lengths().iter().flat_map(|h| [values[0] * h * gx, values[0] * h * gy]).collect();
    assembly.node_terms.push(Box::new(Gravity { forces }));
}

impl Term for Gravity {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Load)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let mut energy = 0.0;
        for ((f, q), w) in force.iter_mut().zip(at.q).zip(&self.forces) {
            *f += w;
            energy -= w * q;
        }
        energy
    }
}
