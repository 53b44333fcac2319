//! The mount turns a little under the actuator's pressure, and the whole robot with it.
//!
//! P is the largest pressure in any actuator, after the supply stage. A pure bending moment is balanced inside the robot and does not reach
//! the base; what turns it is the hose, the clamp or the first pouch pressing on it.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "mount_rotation",
    formula: "δ = c P; x → x cosδ − y sinδ; y → x sinδ + y cosδ",
    sentence: "The base turns when the actuator is inflated, so the whole robot swings like a stiff arm.",
    differs: "The whole robot swings like a stiff arm as pressure rises: y is off in proportion to x.",
    remedy: "Put two markers on the base plate, or hold it by hand while the pressure rises.",
    validity: "elastic mount, rotation about the base point",
    reference: "geometry",
    parameters: &[parameter("deg_per_kpa", "c", "deg/kPa", std::f64::consts::PI / 180e3)
        .usual(0.05, [-0.35, 0.35])
        .possible(ANY)
        .means("rotation of the base per actuator pressure")],
    add: |values, assembly| {
        let per_pa = values[0];
        assembly.camera.push(Box::new(move |seen| {
            let (sin, cos) = (per_pa * seen.p_act_pa).sin_cos();
            let [x, y] = seen.xy;
            seen.xy = [x * cos - y * sin, x * sin + y * cos];
        }));
    },
    ..CAMERA
};
