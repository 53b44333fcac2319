//! The camera's scale is wrong by a constant factor.
//!
//! ```text
//! (x, y) → (1 + s)(x, y)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s | relative scale error | - |
//!
//! Validity: checkerboard not in the plane of the markers, or wrong square size. Geometry.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_scale",
    group: Group::Measurement,
    stage: Stage::Camera,
    formula: "(x, y) → (1 + s)(x, y)",
    sentence: "The camera's millimetre is not a millimetre: all positions are off by the same percentage.",
    differs: "All positions are off by the same percentage, also on the straight robot.",
    remedy: "Photograph a checkerboard in the plane of the markers.",
    validity: "no lens distortion",
    reference: "geometry",
    parameters: &[Parameter {
        key: "scale_error",
        symbol: "s",
        typical: 0.025,
        lower: -0.2,
        upper: 0.2,
        possible: [-1.0, f64::INFINITY],
        meaning: "relative scale error",
        ..PLAIN
    }],
    needs: Needs::Body,
    add: |values, assembly| {
        let factor = 1.0 + values[0];
        assembly.camera.push(Box::new(move |seen| {
            seen.xy[0] *= factor;
            seen.xy[1] *= factor;
        }));
    },
    ..BALANCE
};
