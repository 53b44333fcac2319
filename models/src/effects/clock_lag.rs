//! The clocks of camera and pressure log differ: a frame shows the robot as it was before.
//!
//! ```text
//! x(t) → x(t − τ − ρ t)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | τ | lag of the camera at the start | s |
//! | ρ | how much slower its clock runs | - |
//!
//! Between two holds the pressures of the second apply. Acts on data with several samples in a hold. **Validity**: one lag and
//! one rate for all runs. Definition.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "clock_lag",
    group: Group::Measurement,
    stage: Stage::Camera,
    history: true,
    formula: "x(t) → x(t − τ − ρ t)",
    sentence: "The video and the pressure log do not share one clock.",
    differs: "The first samples of a hold still show the pressure before, or the last ones show the next pressure.",
    remedy: "Film the gauge or a light that the log switches, and import with that clock offset.",
    validity: "one lag and one rate for all runs",
    reference: "definition",
    parameters: &[
        Parameter {
            key: "lag_s",
            symbol: "τ",
            unit: "s",
            typical: 0.5,
            lower: -10.0,
            upper: 10.0,
            possible: ANY,
            fitted: Fitted::BetweenSamples,
            meaning: "lag of the camera",
            ..PLAIN
        },
        Parameter {
            key: "rate",
            symbol: "ρ",
            lower: -0.05,
            upper: 0.05,
            possible: [-0.5, 0.5],
            meaning: "how much slower the camera's clock runs",
            ..SHAPE
        },
    ],
    add,
    ..BALANCE
};

fn add(values: &[f64], assembly: &mut Assembly) {
    assembly.clock = [values[0], values[1]];
    assembly.timed |= assembly.clock != [0.0; 2];
}
