//! Markers sit off the centre line, so they move when the body rotates.
//!
//! ```text
//! x = x_c − e sinψ      y = y_c + e (cosψ − 1)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e | height of the markers above the axis, towards the actuator | m |
//! | ψ | heading of the body at the marker | rad |
//!
//! y is taken relative to the straight robot, where every marker reads 0. Validity: same e for all markers. Geometry.

use super::*;

pub(super) const ENTRY: Effect = Effect {
    name: "marker_height",
    group: Group::Measurement,
    stage: Stage::Camera,
    history: false,
    formula: "x = x_c − e sinψ;  y = y_c + e (cosψ − 1)",
    sentence: "The markers sit above or below the robot's axis, so rotation moves them along the robot.",
    differs: "Markers move along the robot as it turns: x is off by the sine of the local angle.",
    remedy: "Measure how far the markers are from the centre line.",
    validity: "the same height for all markers",
    reference: "geometry",
    parameters: &[Parameter {
        key: "height_mm",
        symbol: "e",
        unit: "mm",
        si: 1e-3,
        typical: 10.0,
        lower: -60.0,
        upper: 60.0,
        possible: ANY,
        meaning: "marker height above the axis",
        ..PLAIN
    }],
    needs: Needs::Body,
    add,
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let height = values[0];
    assembly.camera.push(Box::new(move |seen| {
        let (sin, cos) = seen.heading.sin_cos();
        seen.xy[0] -= height * sin;
        seen.xy[1] += height * (cos - 1.0);
    }));
}
