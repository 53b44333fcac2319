//! The pressure sensor drifts during the test.
//!
//! ```text
//! P = P_set − r t      while P_set > 0
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r | drift per time of the protocol | Pa/s |
//! | t | time since the start of the run | s |
//!
//! **Validity**: steady drift, zeroed before every run; supply open at pressure zero. Definition.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "gauge_drift",
    group: Group::Supply,
    stage: Stage::Supply,
    history: true,
    formula: "P = P_set − r t while P_set > 0",
    sentence: "The pressure sensor drifts during the test, so the same reading is another pressure later.",
    differs: "A pressure that is taken twice gives two bends, and the later hold is off by more.",
    remedy: "Take the first pressure again at the end of a run, and zero the sensor after it.",
    validity: "steady drift, zeroed before every run",
    reference: "definition",
    parameters: &[Parameter {
        key: "kpa_per_min",
        symbol: "r",
        unit: "kPa/min",
        si: 1e3 / 60.0,
        typical: 1.0,
        lower: -10.0,
        upper: 10.0,
        possible: ANY,
        meaning: "pressure that is read and not there, per time",
        ..PLAIN
    }],
    needs: Needs::Actuator,
    add,
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let rate = values[0];
    if rate != 0.0 {
        assembly.timed = true;
        assembly.supply.push(Box::new(move |p, at| if p > 0.0 { (p - rate * at.t_s).max(0.0) } else { p }));
    }
}
