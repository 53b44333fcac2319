//! The pressure sensor drifts during the test; the supply is open at pressure zero.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "gauge_drift",
    history: true,
    formula: "P = P_set − r t while P_set > 0",
    sentence: "The pressure sensor drifts during the test, so the same reading is another pressure later.",
    differs: "A pressure that is taken twice gives two bends, and the later hold is off by more.",
    remedy: "Take the first pressure again at the end of a run, and zero the sensor after it.",
    validity: "steady drift, zeroed before every run",
    reference: "definition",
    parameters: &[parameter("kpa_per_min", "r", "kPa/min", 1e3 / 60.0)
        .usual(1.0, [-10.0, 10.0])
        .possible(ANY)
        .means("pressure that is read and not there, per time")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let rate = values[0];
        if rate != 0.0 {
            assembly.timed = true;
            assembly.supply.push(Box::new(move |p, at| if p > 0.0 { (p - rate * at.t_s).max(0.0) } else { p }));
        }
    },
    ..SUPPLY
};
