//! The camera is rolled: its x axis is not the robot's.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_rotation",
    formula: "x → x_c + (x − x_c) cosδ − y sinδ;  y → (x − x_c) sinδ + y cosδ;  x_c = c L",
    sentence: "The camera is rolled, so a straight robot does not look horizontal.",
    differs: "The straight robot is not horizontal, and the same roll is in every hold.",
    remedy: "Check the markers of the straight robot against the image axis.",
    validity: "rotation about a point of the straight robot, constant over the test",
    reference: "geometry",
    parameters: &[
        parameter("angle_deg", "δ", "deg", std::f64::consts::PI / 180.0)
            .usual(1.2, [-10.0, 10.0])
            .possible([-180.0, 180.0])
            .in_room()
            .means("roll angle of the camera"),
        shape("about", "c", "-", 1.0)
            .possible(ANY)
            .means("where the axis of the roll crosses the straight robot, as a share of its length"),
    ],
    add: |values, assembly| {
        let (sin, cos) = values[0].sin_cos();
        let about_m = values[1] * assembly.length_m();
        assembly.camera.push(Box::new(move |seen| {
            let [x, y] = [seen.xy[0] - about_m, seen.xy[1]];
            seen.xy = [about_m + x * cos - y * sin, x * sin + y * cos];
        }));
    },
    ..CAMERA
};
