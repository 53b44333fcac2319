//! A hose or a cable holds the tip back like a spring.

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
    parameters: &[parameter("stiffness_n_per_m", "k", "N/m", 1.0)
        .usual(3.0, [0.0, 100.0])
        .means("stiffness of what holds the tip")],
    add: |values, assembly| {
        let (stiffness, length_m) = (values[0], assembly.length_m());
        if stiffness == 0.0 {
            return;
        }
        assembly.springs = true;
        assembly.node_terms.push(ENTRY.law(Account::Load, move |at, force| {
            let tip = at.q.len() - 2;
            let away = [at.q[tip] - length_m, at.q[tip + 1]];
            force[tip] -= stiffness * away[0];
            force[tip + 1] -= stiffness * away[1];
            0.5 * stiffness * (away[0] * away[0] + away[1] * away[1])
        }));
    },
    ..BALANCE
};
