//! Somebody touched the camera during the test: from a time on every marker is shifted and turned.
//!
//! ```text
//! t ≥ t₀:  x → x cosδ − y sinδ + d_x      y → x sinδ + y cosδ + d_y
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | t₀ | time of the protocol from which on | s |
//! | d_x, d_y | shift of the image | m |
//! | δ | turn of the image about the base | rad |
//!
//! **Validity**: one move between two holds, the same in every run. Geometry.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_moved",
    group: Group::Measurement,
    stage: Stage::Camera,
    history: true,
    formula: "t ≥ t₀: x → x cosδ − y sinδ + d_x; y → x sinδ + y cosδ + d_y",
    sentence: "The camera or the mount was moved during the test.",
    differs: "From one hold on all markers are shifted alike, the robot without pressure too.",
    remedy: "Compare the robot without pressure at the start and at the end, and put two fiducials into the room.",
    validity: "one move between two holds, the same in every run",
    reference: "geometry",
    parameters: &[
        Parameter {
            key: "from_s",
            symbol: "t₀",
            unit: "s",
            neutral: 1.0,
            typical: 1.0,
            upper: 1e3,
            possible: POSITIVE,
            fitted: Fitted::BetweenHolds,
            meaning: "time from which on the image is shifted",
            ..PLAIN
        },
        shift("x_mm", "d_x"),
        shift("y_mm", "d_y"),
        Parameter {
            key: "turn_deg",
            symbol: "δ",
            unit: "deg",
            si: std::f64::consts::PI / 180.0,
            typical: 0.5,
            lower: -10.0,
            upper: 10.0,
            possible: [-180.0, 180.0],
            meaning: "turn of the image about the base",
            ..PLAIN
        },
    ],
    add,
    ..BALANCE
};

const fn shift(key: &'static str, symbol: &'static str) -> Parameter<'static> {
    Parameter {
        key,
        symbol,
        unit: "mm",
        si: 1e-3,
        typical: 2.0,
        lower: -30.0,
        upper: 30.0,
        possible: ANY,
        meaning: "shift of the image",
        ..PLAIN
    }
}

fn add(values: &[f64], assembly: &mut Assembly) {
    let [from_s, dx_m, dy_m, turn_rad] = [values[0], values[1], values[2], values[3]];
    if [dx_m, dy_m, turn_rad] == [0.0; 3] {
        return;
    }
    let (sin, cos) = turn_rad.sin_cos();
    assembly.timed = true;
    assembly.camera.push(Box::new(move |seen| {
        if seen.t_s >= from_s {
            let [x, y] = seen.xy;
            seen.xy = [x * cos - y * sin + dx_m, x * sin + y * cos + dy_m];
        }
    }));
}
