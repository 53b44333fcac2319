//! The lens bulges or pinches the image: radial distortion of the first order, barrel below zero, pincushion above.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_lens",
    formula: "(x, y) → (x, y) + k r² (x − c L, y − h L), r² = (x − c L)² + (y − h L)²",
    sentence: "The lens bends straight lines, so positions are off by more the farther they are from the middle of the image.",
    differs: "Positions are off by the cube of their distance from the middle of the image, also on the straight robot.",
    remedy: "Calibrate the lens with a checkerboard, or photograph a ruler along the edge of the image.",
    validity: "one radial coefficient",
    reference: "Brown 1971, first radial term",
    parameters: &[
        parameter("distortion_per_m2", "k", "1/m2", 1.0)
            .usual(0.4, [-4.0, 4.0])
            .possible(ANY)
            .means("radial distortion"),
        shape("about", "c", "-", 1.0)
            .around(0.5, [0.0, 1.0])
            .possible(ANY)
            .means("where the optical axis is along the robot, as a share of its length"),
        shape("across", "h", "-", 1.0)
            .usual(0.0, [-0.5, 0.5])
            .possible(ANY)
            .means("how far the optical axis is from the straight robot, as a share of its length"),
    ],
    add: |values, assembly| {
        let length_m = assembly.length_m();
        let (k, axis) = (values[0], [values[1] * length_m, values[2] * length_m]);
        assembly.camera.push(Box::new(move |seen| {
            let [x, y] = [seen.xy[0] - axis[0], seen.xy[1] - axis[1]];
            let grows = k * (x * x + y * y);
            seen.xy = [seen.xy[0] + grows * x, seen.xy[1] + grows * y];
        }));
    },
    ..CAMERA
};
