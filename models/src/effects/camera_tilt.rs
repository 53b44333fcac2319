//! The image plane is not parallel to the plane of the robot; the order of two small tilts does not matter.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_tilt",
    formula: "(x, y) → (x cosα, y cosβ)/(1 + (x sinα + y sinβ)/d)",
    sentence: "The camera does not look at right angles onto the plane of the robot.",
    differs: "Parts farther from the camera look smaller: positions are off by the square of their distance from the base.",
    remedy: "Photograph a checkerboard in the plane of the robot: all its squares must have one size.",
    validity: "pinhole camera, scale right at the base",
    reference: "geometry",
    parameters: &[
        tilt("along_deg", "α", "tilt along the straight robot"),
        tilt("across_deg", "β", "tilt across the straight robot"),
        shape("distance_m", "d", "m", 1.0)
            .around(1.0, [0.4, 3.0])
            .possible(ABOVE_ZERO)
            .means("distance from the camera to the base"),
    ],
    add: |values, assembly| {
        let [(sin_a, cos_a), (sin_b, cos_b)] = [values[0].sin_cos(), values[1].sin_cos()];
        let distance_m = values[2];
        assembly.camera.push(Box::new(move |seen| {
            let [x, y] = seen.xy;
            let farther = 1.0 + (x * sin_a + y * sin_b) / distance_m;
            seen.xy = [x * cos_a / farther, y * cos_b / farther];
        }));
    },
    ..CAMERA
};

const fn tilt(key: Text, symbol: Text, meaning: Text) -> Parameter<'static> {
    parameter(key, symbol, "deg", std::f64::consts::PI / 180.0)
        .usual(5.0, [-25.0, 25.0])
        .possible([-89.0, 89.0])
        .means(meaning)
}
