//! Effects of loads, supply and camera.

use super::HiddenEffect;

pub(super) const GRAVITY: HiddenEffect = HiddenEffect {
    name: "gravity",
    sentence: "The robot's weight pulls it down: the body, the pouches and, heavier, the end.",
    law: "w (0.7 + 0.6 s/L) instead of w",
    unit: "N/m",
    typical: |_| 1.5,
    family: None,
    put: |robot, amount| {
        let (length, loads) = (robot.length_m, &mut robot.loads);
        for (weight, cell) in loads.weight_n_per_m.iter_mut().zip(&robot.cells) {
            *weight += amount * (0.7 + 0.6 * (cell.start_m + 0.5 * cell.length_m) / length);
        }
    },
};

pub(super) const TIP_LOAD: HiddenEffect = HiddenEffect {
    name: "tip_load",
    sentence: "A cable runs from the tip over a pulley below and pulls.",
    law: "towards (0.8 L, −1.4 L): its direction turns as the tip moves, instead of a dead load",
    unit: "N",
    typical: |_| 0.4,
    family: None,
    put: |robot, amount| {
        robot.loads.cable_n += amount;
        robot.loads.pulley_m = [0.8 * robot.length_m, -1.4 * robot.length_m];
    },
};

pub(super) const PRESSURE_LOSS: HiddenEffect = HiddenEffect {
    name: "pressure_loss",
    sentence: "Air that leaves through a small hole loses pressure in the hose.",
    law: "p − f √(p·20 kPa): orifice and hose in series, instead of a constant share",
    unit: "-",
    typical: |_| 0.15,
    family: None,
    put: |robot, amount| robot.supply.loss += amount,
};

pub(super) const PRESSURE_OFFSET: HiddenEffect = HiddenEffect {
    name: "pressure_offset",
    sentence: "The regulator's valve opens only above a threshold, softly.",
    law: "√(p² + p₀²) − p₀ instead of p − p₀",
    unit: "Pa",
    typical: |_| 2e3,
    family: None,
    put: |robot, amount| robot.supply.dead_band_pa += amount,
};

pub(super) const LEAK: HiddenEffect = HiddenEffect {
    name: "leak",
    sentence: "The actuator leaks and runs down towards what the regulator can hold.",
    law: "p (0.6 + 0.4 e^(−r t/0.4)) instead of p (1 − r t)",
    unit: "1/s",
    typical: |_| 0.02,
    family: None,
    put: |robot, amount| robot.supply.leak_per_s += amount,
};

pub(super) const CAMERA_SCALE: HiddenEffect = HiddenEffect {
    name: "camera_scale",
    sentence: "The camera's millimetre is wrong, and a little more so far from the base.",
    law: "(1 + c)(1 + 0.4 c x/L), with keystone, instead of 1 + c",
    unit: "-",
    typical: |_| 0.021,
    family: None,
    put: |robot, amount| robot.camera.scale += amount,
};

pub(super) const CAMERA_ROTATION: HiddenEffect = HiddenEffect {
    name: "camera_rotation",
    sentence: "The camera is rolled, and its lens bends the image a little.",
    law: "δ (1 + 0.15 x/L) instead of δ",
    unit: "rad",
    typical: |_| 0.019,
    family: None,
    put: |robot, amount| robot.camera.roll_rad += amount,
};

pub(super) const MOUNT_ROTATION: HiddenEffect = HiddenEffect {
    name: "mount_rotation",
    sentence: "The base mount gives way as the actuator is pressurised, less and less.",
    law: "φ 1.4 u/(1 + 0.4 u), u = P/30 kPa, instead of φ u",
    unit: "rad",
    typical: |_| 0.024,
    family: None,
    put: |robot, amount| robot.camera.mount_rad += amount,
};

pub(super) const MARKER_HEIGHT: HiddenEffect = HiddenEffect {
    name: "marker_height",
    sentence: "The markers sit above the robot's axis, near the tip more than near the base.",
    law: "e (1 + 0.3 (s/L − ½)) instead of e",
    unit: "m",
    typical: |_| 0.01,
    family: None,
    put: |robot, amount| robot.camera.height_m += amount,
};
