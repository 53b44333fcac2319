//! The clocks of camera and pressure log differ: a frame shows the robot as it was before.
//!
//! Between two holds the pressures of the second apply. Acts on data with several samples in a hold.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "clock_lag",
    history: true,
    formula: "x(t) → x(t − τ − ρ t)",
    sentence: "The video and the pressure log do not share one clock.",
    differs: "The first samples of a hold still show the pressure before, or the last ones show the next pressure.",
    remedy: "Film the gauge or a light that the log switches, and import with that clock offset.",
    validity: "one lag and one rate for all runs",
    reference: "definition",
    parameters: &[
        parameter("lag_s", "τ", "s", 1.0)
            .usual(0.5, [-10.0, 10.0])
            .possible(ANY)
            .fitted(Fitted::BetweenSamples)
            .means("lag of the camera"),
        shape("rate", "ρ", "-", 1.0)
            .usual(0.0, [-0.05, 0.05])
            .possible([-0.5, 0.5])
            .means("how much slower the camera's clock runs"),
    ],
    add: |values, assembly| {
        assembly.clock = [values[0], values[1]];
        assembly.timed |= assembly.clock != [0.0; 2];
    },
    ..CAMERA
};
