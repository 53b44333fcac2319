//! The regulator holds another pressure on the way down than on the way up; the supply is open at zero.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "regulator_hysteresis",
    history: true,
    formula: "P = P_set + h where the pressure was lowered",
    sentence: "The regulator lets more pressure stand when its set point is lowered than when it is raised.",
    differs: "The robot bends more on the way down than on the way up, and is straight again without pressure.",
    remedy: "Put a gauge on the actuator and read it at the same set point on both ways.",
    validity: "one value at all pressures above zero",
    reference: "definition",
    parameters: &[parameter("offset_kpa", "h", "kPa", 1e3)
        .usual(0.5, [-5.0, 5.0])
        .possible(ANY)
        .means("pressure that stays when the set point is lowered")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let stays_pa = values[0];
        if stays_pa != 0.0 {
            assembly.timed = true;
            let law = move |p: f64, falling: bool| if p > 0.0 && falling { (p + stays_pa).max(0.0) } else { p };
            assembly.supply.push(Box::new(move |p, at| law(p, at.falling)));
        }
    },
    ..SUPPLY
};
