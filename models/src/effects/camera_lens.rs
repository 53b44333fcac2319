//! The lens bulges or pinches the image: radial distortion of the first order.
//!
//! ```text
//! (x, y) → (x, y) + k r² (x − c L, y − h L)      r² = (x − c L)² + (y − h L)²
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | radial distortion: barrel below zero, pincushion above | 1/m² |
//! | c, h | where the optical axis is along and across the straight robot, as a share of its length | - |
//!
//! **Validity**: one radial coefficient. Reference: Brown 1971, first radial term.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_lens",
    group: Group::Measurement,
    stage: Stage::Camera,
    formula: "(x, y) → (x, y) + k r² (x − c L, y − h L), r² = (x − c L)² + (y − h L)²",
    sentence: "The lens bends straight lines, so positions are off by more the farther they are from the middle of the image.",
    differs: "Positions are off by the cube of their distance from the middle of the image, also on the straight robot.",
    remedy: "Calibrate the lens with a checkerboard, or photograph a ruler along the edge of the image.",
    validity: "one radial coefficient",
    reference: "Brown 1971, first radial term",
    parameters: &[
        Parameter {
            key: "distortion_per_m2",
            symbol: "k",
            unit: "1/m2",
            typical: 0.4,
            lower: -4.0,
            upper: 4.0,
            possible: ANY,
            meaning: "radial distortion",
            ..PLAIN
        },
        Parameter {
            key: "about",
            symbol: "c",
            neutral: 0.5,
            typical: 0.5,
            possible: ANY,
            meaning: "where the optical axis is along the robot, as a share of its length",
            ..SHAPE
        },
        Parameter {
            key: "across",
            symbol: "h",
            lower: -0.5,
            upper: 0.5,
            possible: ANY,
            meaning: "how far the optical axis is from the straight robot, as a share of its length",
            ..SHAPE
        },
    ],
    add,
    ..BALANCE
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let length_m = assembly.length_m();
    let (k, axis) = (values[0], [values[1] * length_m, values[2] * length_m]);
    assembly.camera.push(Box::new(move |seen| {
        let [x, y] = [seen.xy[0] - axis[0], seen.xy[1] - axis[1]];
        let grows = k * (x * x + y * y);
        seen.xy = [seen.xy[0] + grows * x, seen.xy[1] + grows * y];
    }));
}
