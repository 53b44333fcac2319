//! The camera's scale is wrong by a constant factor: a checkerboard out of the markers' plane, or a wrong square size.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_scale",
    formula: "(x, y) → (1 + s)(x, y)",
    sentence: "The camera's millimetre is not a millimetre: all positions are off by the same percentage.",
    differs: "All positions are off by the same percentage, also on the straight robot.",
    remedy: "Photograph a checkerboard in the plane of the markers.",
    validity: "no lens distortion",
    reference: "geometry",
    parameters: &[parameter("scale_error", "s", "-", 1.0)
        .usual(0.025, [-0.2, 0.2])
        .possible([-1.0, f64::INFINITY])
        .means("relative scale error")],
    add: |values, assembly| {
        let factor = 1.0 + values[0];
        assembly.camera.push(Box::new(move |seen| {
            seen.xy[0] *= factor;
            seen.xy[1] *= factor;
        }));
    },
    ..CAMERA
};
