//! Markers sit off the centre line, so they move when the body rotates.
//!
//! ψ is the heading of the body at the marker. Both are taken relative to the straight robot, whose markers are where they were said to be.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "marker_height",
    formula: "x = x_c − e sinψ + a (cosψ − 1);  y = y_c + e (cosψ − 1) + a sinψ;  a = e tanβ",
    sentence: "The markers sit above or below the robot's axis, so rotation moves them along the robot.",
    differs: "Markers move along the robot as it turns: x is off by the sine of the local angle.",
    remedy: "Measure how far the markers are from the centre line.",
    validity: "the same height for all markers",
    reference: "geometry",
    parameters: &[
        parameter("height_mm", "e", "mm", 1e-3)
            .usual(10.0, [-60.0, 60.0])
            .possible(ANY)
            .means("marker height above the axis"),
        shape("lean_deg", "β", "deg", std::f64::consts::PI / 180.0)
            .usual(0.0, [-45.0, 45.0])
            .possible([-89.0, 89.0])
            .means("lean of the markers towards the tip"),
    ],
    add: |values, assembly| {
        let height = values[0];
        let along = height * values[1].tan();
        assembly.camera.push(Box::new(move |seen| {
            let (sin, cos) = seen.heading.sin_cos();
            seen.xy[0] += along * (cos - 1.0) - height * sin;
            seen.xy[1] += height * (cos - 1.0) + along * sin;
        }));
    },
    ..CAMERA
};
