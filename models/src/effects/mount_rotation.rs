//! The mount turns a little under the actuator's pressure, and the whole robot with it.
//!
//! ```text
//! δ = c P      x → x cosδ − y sinδ      y → x sinδ + y cosδ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | c | rotation per actuator pressure | rad/Pa |
//! | P | largest pressure in any actuator, after the supply stage | Pa |
//!
//! A pure bending moment is balanced inside the robot and does not reach the base; what turns it is the hose, the clamp or
//! the first pouch pressing on it. **Validity**: elastic mount, rotation about the base point. Geometry.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "mount_rotation",
    group: Group::Measurement,
    stage: Stage::Camera,
    formula: "δ = c P; x → x cosδ − y sinδ; y → x sinδ + y cosδ",
    sentence: "The base turns when the actuator is inflated, so the whole robot swings like a stiff arm.",
    differs: "The whole robot swings like a stiff arm as pressure rises: y is off in proportion to x.",
    remedy: "Put two markers on the base plate, or hold it by hand while the pressure rises.",
    validity: "elastic mount, rotation about the base point",
    reference: "geometry",
    parameters: &[Parameter {
        key: "deg_per_kpa",
        symbol: "c",
        unit: "deg/kPa",
        si: std::f64::consts::PI / 180e3,
        typical: 0.05,
        lower: -0.35,
        upper: 0.35,
        possible: ANY,
        meaning: "rotation of the base per actuator pressure",
        ..PLAIN
    }],
    needs: Needs::Body,
    add: |values, assembly| {
        let per_pa = values[0];
        assembly.camera.push(Box::new(move |seen| {
            let (sin, cos) = (per_pa * seen.p_act_pa).sin_cos();
            let [x, y] = seen.xy;
            seen.xy = [x * cos - y * sin, x * sin + y * cos];
        }));
    },
    ..BALANCE
};
