//! The camera is rolled: its x axis is not the robot's.
//!
//! ```text
//! x → x cosδ − y sinδ      y → x sinδ + y cosδ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | δ | roll angle of the camera, constant over the test | rad |
//!
//! Validity: rotation about the base point. Geometry.

use super::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_rotation",
    group: Group::Measurement,
    stage: Stage::Camera,
    history: false,
    formula: "x → x cosδ − y sinδ;  y → x sinδ + y cosδ",
    sentence: "The camera is rolled, so a straight robot does not look horizontal.",
    differs: "The straight robot is not horizontal, and the same roll is in every hold.",
    remedy: "Check the markers of the straight robot against the image axis.",
    validity: "rotation about the base point, constant over the test",
    reference: "geometry",
    parameters: &[Parameter {
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
    }],
    needs: Needs::Body,
    add,
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let (sin, cos) = values[0].sin_cos();
    assembly.camera.push(Box::new(move |seen| {
        let [x, y] = seen.xy;
        seen.xy = [x * cos - y * sin, x * sin + y * cos];
    }));
}
