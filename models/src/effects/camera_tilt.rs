//! The image plane is not parallel to the plane of the robot.
//!
//! ```text
//! (x, y) → (x cosα, y cosβ)/(1 + (x sinα + y sinβ)/d)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α, β | tilt along the straight robot and across it | rad |
//! | d | distance from the camera to the base | m |
//!
//! **Validity**: pinhole camera that was scaled at the base; the order of two small tilts does not matter. Geometry.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_tilt",
    group: Group::Measurement,
    stage: Stage::Camera,
    formula: "(x, y) → (x cosα, y cosβ)/(1 + (x sinα + y sinβ)/d)",
    sentence: "The camera does not look at right angles onto the plane of the robot.",
    differs: "Parts farther from the camera look smaller: positions are off by the square of their distance from the base.",
    remedy: "Photograph a checkerboard in the plane of the robot: all its squares must have one size.",
    validity: "pinhole camera, scale right at the base",
    reference: "geometry",
    parameters: &[
        tilt("along_deg", "α", "tilt along the straight robot"),
        tilt("across_deg", "β", "tilt across the straight robot"),
        Parameter {
            key: "distance_m",
            symbol: "d",
            unit: "m",
            neutral: 1.0,
            typical: 1.0,
            lower: 0.4,
            upper: 3.0,
            possible: ABOVE_ZERO,
            meaning: "distance from the camera to the base",
            ..SHAPE
        },
    ],
    add,
    ..BALANCE
};

const fn tilt(key: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter<'static> {
    Parameter {
        key,
        symbol,
        unit: "deg",
        si: std::f64::consts::PI / 180.0,
        typical: 5.0,
        lower: -25.0,
        upper: 25.0,
        possible: [-89.0, 89.0],
        meaning,
        ..PLAIN
    }
}

fn add(values: &[f64], assembly: &mut Assembly) {
    let [(sin_a, cos_a), (sin_b, cos_b)] = [values[0].sin_cos(), values[1].sin_cos()];
    let distance_m = values[2];
    assembly.camera.push(Box::new(move |seen| {
        let [x, y] = seen.xy;
        let farther = 1.0 + (x * sin_a + y * sin_b) / distance_m;
        seen.xy = [x * cos_a / farther, y * cos_b / farther];
    }));
}
