//! Somebody touched the camera during the test: from a time on every marker is shifted and turned.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "camera_moved",
    history: true,
    formula: "t ≥ t₀: x → x cosδ − y sinδ + d_x; y → x sinδ + y cosδ + d_y",
    sentence: "The camera or the mount was moved during the test.",
    differs: "From one hold on all markers are shifted alike, the robot without pressure too.",
    remedy: "Compare the robot without pressure at the start and at the end, and put two fiducials into the room.",
    validity: "one move between two holds, the same in every run",
    reference: "geometry",
    parameters: &[
        parameter("from_s", "t₀", "s", 1.0)
            .around(1.0, [0.0, 1e3])
            .fitted(Fitted::BetweenHolds)
            .means("time from which on the image is shifted"),
        shift("x_mm", "d_x"),
        shift("y_mm", "d_y"),
        parameter("turn_deg", "δ", "deg", std::f64::consts::PI / 180.0)
            .usual(0.5, [-10.0, 10.0])
            .possible([-180.0, 180.0])
            .means("turn of the image about the base"),
    ],
    add: |values, assembly| {
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
    },
    ..CAMERA
};

const fn shift(key: Text, symbol: Text) -> Parameter<'static> {
    parameter(key, symbol, "mm", 1e-3).usual(2.0, [-30.0, 30.0]).possible(ANY).means("shift of the image")
}
