//! A known force at the end of the centre line, constant in direction, y towards azimuth 0; z acts with strips round the body.

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
    parameters: &[
        force("force_x_n", "F_x", 0.0, false),
        force("force_y_n", "F_y", -0.4, true),
        Parameter { fitted: Fitted::FromDesign, ..force("force_z_n", "F_z", 0.0, true) },
    ],
    add: |values, assembly| {
        let (axes, [x, y, z]) = (assembly.axes, [values[0], values[1], values[2]]);
        if [x, y, z][..axes].iter().any(|f| *f != 0.0) {
            assembly.node_terms.push(ENTRY.law(Account::Load, move |at, force| {
                let tip = at.q.len() - axes;
                for (f, own) in force[tip..].iter_mut().zip([x, y, z]) {
                    *f += own;
                }
                let in_plane = -x * at.q[tip] - y * at.q[tip + 1];
                at.q.get(tip + 2).map_or(in_plane, |q| in_plane - z * q)
            }));
        }
    },
    ..BALANCE
};

const fn force(key: Text, symbol: Text, typical: f64, in_room: bool) -> Parameter<'static> {
    Parameter {
        in_room,
        ..parameter(key, symbol, "N", 1.0).usual(typical, [-5.0, 5.0]).possible(ANY).means("force on the tip")
    }
}
