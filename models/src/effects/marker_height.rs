//! Markers sit off the centre line, so they move when the body rotates.
//!
//! ```text
//! x = x_c − e sinψ + a (cosψ − 1)      y = y_c + e (cosψ − 1) + a sinψ      a = e tanβ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e | height of the markers above the axis, towards the actuator | m |
//! | β | lean of the markers towards the tip: they are off by a along the body too | rad |
//! | ψ | heading of the body at the marker | rad |
//!
//! Both are taken relative to the straight robot, whose markers are where they were said to be. Validity: same e for all markers. Geometry.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "marker_height",
    group: Group::Measurement,
    stage: Stage::Camera,
    formula: "x = x_c − e sinψ + a (cosψ − 1);  y = y_c + e (cosψ − 1) + a sinψ;  a = e tanβ",
    sentence: "The markers sit above or below the robot's axis, so rotation moves them along the robot.",
    differs: "Markers move along the robot as it turns: x is off by the sine of the local angle.",
    remedy: "Measure how far the markers are from the centre line.",
    validity: "the same height for all markers",
    reference: "geometry",
    parameters: &[
        Parameter {
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
        },
        Parameter {
            key: "lean_deg",
            symbol: "β",
            unit: "deg",
            si: std::f64::consts::PI / 180.0,
            lower: -45.0,
            upper: 45.0,
            possible: [-89.0, 89.0],
            meaning: "lean of the markers towards the tip",
            ..SHAPE
        },
    ],
    needs: Needs::Body,
    add: |values, assembly| {
        let height = values[0];
        let along = height * values[1].tan();
        assembly.camera.push(Box::new(move |seen| {
            let (sin, cos) = seen.heading.sin_cos();
            seen.xy[0] += along * (cos - 1.0) - height * sin;
            seen.xy[1] += height * (cos - 1.0) + along * sin;
        }));
    },
    ..BALANCE
};
