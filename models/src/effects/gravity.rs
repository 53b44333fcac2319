//! Weight of the robot.
//!
//! xᵢ and hᵢ are the place of a node and its share of the length, ĝ the direction of gravity: −y unless scenario or data set state another;
//! z acts with strips round the body. Needs a fine enough division (12 segments give 0.1 % of the droop of a 360 mm robot); kept as dead load
//! on the deformed shape.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "gravity",
    group: Group::Load,
    formula: "E = −Σ w hᵢ ĝ·xᵢ",
    sentence: "The robot's weight bends it: most at the base, and the other way when the robot is turned over.",
    differs: "The error is largest near the base, and changes its sign when the robot is turned over.",
    remedy: "Weigh the robot; repeat the test with the robot rolled by 180°.",
    validity: "bending plane vertical, or strips round the body; dead load",
    reference: "statics",
    parameters: &[parameter("weight_n_per_m", "w", "N/m", 1.0).usual(1.5, [0.0, 8.0]).means("weight per length")],
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        let direction = &assembly.gravity_direction[..assembly.axes];
        // Of each node, x, y and in space z [N].
        let weights: Vec<f64> =
            assembly.node_lengths().iter().flat_map(|h| direction.iter().map(move |g| values[0] * h * g)).collect();
        assembly.node_terms.push(ENTRY.law(Account::Load, move |at, force| {
            let mut energy = 0.0;
            for ((f, q), w) in force.iter_mut().zip(at.q).zip(&weights) {
                *f += w;
                energy -= w * q;
            }
            energy
        }));
    },
    ..BALANCE
};
