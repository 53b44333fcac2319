//! The camera is rolled: its x axis is not the robot's.
//!
//! ```text
//! x → x_c + (x − x_c) cosδ − y sinδ      y → (x − x_c) sinδ + y cosδ      x_c = c L
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | δ | roll angle of the camera, constant over the test | rad |
//! | c | where the straight robot is crossed by the axis of the roll, as a share of its length L; 0: at its base | - |
//!
//! Validity: the axis is on the line of the straight robot. Geometry.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_rotation",
    group: Group::Measurement,
    stage: Stage::Camera,
    formula: "x → x_c + (x − x_c) cosδ − y sinδ;  y → (x − x_c) sinδ + y cosδ;  x_c = c L",
    sentence: "The camera is rolled, so a straight robot does not look horizontal.",
    differs: "The straight robot is not horizontal, and the same roll is in every hold.",
    remedy: "Check the markers of the straight robot against the image axis.",
    validity: "rotation about a point of the straight robot, constant over the test",
    reference: "geometry",
    parameters: &[
        Parameter {
            key: "angle_deg",
            symbol: "δ",
            unit: "deg",
            si: std::f64::consts::PI / 180.0,
            typical: 1.2,
            lower: -10.0,
            upper: 10.0,
            possible: [-180.0, 180.0],
            in_room: true,
            meaning: "roll angle of the camera",
            ..PLAIN
        },
        Parameter {
            key: "about",
            symbol: "c",
            possible: ANY,
            meaning: "where the axis of the roll crosses the straight robot, as a share of its length",
            ..SHAPE
        },
    ],
    needs: Needs::Body,
    add: |values, assembly| {
        let (sin, cos) = values[0].sin_cos();
        let about_m = values[1] * assembly.length_m();
        assembly.camera.push(Box::new(move |seen| {
            let [x, y] = [seen.xy[0] - about_m, seen.xy[1]];
            seen.xy = [about_m + x * cos - y * sin, x * sin + y * cos];
        }));
    },
    ..BALANCE
};
