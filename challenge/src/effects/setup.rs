//! Effects of loads, supply and camera.

use super::kind::{HiddenEffect, Law};

pub(super) const GRAVITY: HiddenEffect = HiddenEffect {
    name: "gravity",
    sentence: "The robot's weight pulls it down: the body, the pouches and, heavier, the end.",
    family: None,
    laws: &[
        Law {
            words: "w (0.7 + 0.6 s/L) instead of w",
            unit: "N/m",
            size: |_| 1.5,
            put: |robot, amount| {
                let (length, loads) = (robot.length_m, &mut robot.loads);
                for (weight, cell) in loads.weight_n_per_m.iter_mut().zip(&robot.cells) {
                    *weight += amount * (0.7 + 0.6 * (cell.start_m + 0.5 * cell.length_m) / length);
                }
            },
        },
        Law {
            words: "⅔ w along the body and w L/3 at the tip: a uniform tube with an end cap and its fitting",
            unit: "N/m",
            size: |_| 1.2,
            put: |robot, amount| {
                let (length, loads) = (robot.length_m, &mut robot.loads);
                loads.weight_n_per_m.iter_mut().for_each(|weight| *weight += amount * 2.0 / 3.0);
                loads.cap_n += amount * length / 3.0;
            },
        },
    ],
};

pub(super) const TIP_LOAD: HiddenEffect = HiddenEffect {
    name: "tip_load",
    sentence: "A cable runs from the tip over a pulley below and pulls.",
    family: None,
    laws: &[
        Law {
            words: "towards (0.8 L, −1.4 L): its direction turns as the tip moves, instead of a dead load",
            unit: "N",
            size: |_| 0.4,
            put: |robot, amount| {
                robot.loads.cable_n += amount;
                robot.loads.pulley_m = [0.8 * robot.length_m, -1.4 * robot.length_m];
            },
        },
        Law {
            words: "w (h + 0.3 m)₊ down, h the tip's height: a hose hangs from the tip and rests on the table, and its lifted part weighs",
            unit: "N/m",
            size: |_| 1.0,
            put: |robot, amount| robot.loads.hose_n_per_m += amount,
        },
    ],
};

pub(super) const PRESSURE_LOSS: HiddenEffect = HiddenEffect {
    name: "pressure_loss",
    sentence: "Air that leaves through a small hole loses pressure in the hose.",
    family: None,
    laws: &[
        Law {
            words: "p − f √(p·20 kPa): orifice and hose in series, instead of a constant share",
            unit: "-",
            size: |_| 0.15,
            put: |robot, amount| robot.supply.loss[0] += amount,
        },
        Law {
            words: "p − f p^1.5/√(30 kPa): a seam gapes in proportion to p and leaks by gap and √p, through a laminar hose",
            unit: "-",
            size: |_| 0.15,
            put: |robot, amount| robot.supply.loss[1] += amount,
        },
    ],
};

pub(super) const PRESSURE_OFFSET: HiddenEffect = HiddenEffect {
    name: "pressure_offset",
    sentence: "The regulator's valve opens only above a threshold, softly.",
    family: None,
    laws: &[
        Law {
            words: "√(p² + p₀²) − p₀ instead of p − p₀",
            unit: "Pa",
            size: |_| 2e3,
            put: |robot, amount| robot.supply.dead_band_pa[0] += amount,
        },
        Law {
            words: "p − p₀ (1 − e^(−p/p₀)): a diaphragm whose spring is taken up bit by bit as the rubber seat lifts",
            unit: "Pa",
            size: |_| 2e3,
            put: |robot, amount| robot.supply.dead_band_pa[1] += amount,
        },
    ],
};

pub(super) const LEAK: HiddenEffect = HiddenEffect {
    name: "leak",
    sentence: "The actuator leaks and runs down towards what the regulator can hold.",
    family: None,
    laws: &[
        Law {
            words: "p (0.6 + 0.4 e^(−r t/0.4)) instead of p (1 − r t)",
            unit: "1/s",
            size: |_| 0.02,
            put: |robot, amount| robot.supply.leak_per_s[0] += amount,
        },
        Law {
            words: "p (1 − ½ r t √(20 kPa/p))²: Torricelli, a closed volume that empties through a hole",
            unit: "1/s",
            size: |_| 0.02,
            put: |robot, amount| robot.supply.leak_per_s[1] += amount,
        },
    ],
};

pub(super) const CAMERA_SCALE: HiddenEffect = HiddenEffect {
    name: "camera_scale",
    sentence: "The camera's millimetre is wrong, and a little more so far from the base.",
    family: None,
    laws: &[
        Law {
            words: "(1 + c)(1 + 0.4 c x/L), with keystone, instead of 1 + c",
            unit: "-",
            size: |_| 0.021,
            put: |robot, amount| robot.camera.scale[0] += amount,
        },
        Law {
            words: "x (1 + c), y (1 + c/2): pixels that are not square, or a calibration board that was tilted",
            unit: "-",
            size: |_| 0.02,
            put: |robot, amount| robot.camera.scale[1] += amount,
        },
    ],
};

pub(super) const CAMERA_ROTATION: HiddenEffect = HiddenEffect {
    name: "camera_rotation",
    sentence: "The camera is rolled, and its lens bends the image a little.",
    family: None,
    laws: &[
        Law {
            words: "δ (1 + 0.15 x/L) instead of δ",
            unit: "rad",
            size: |_| 0.019,
            put: |robot, amount| robot.camera.roll_rad[0] += amount,
        },
        Law {
            words: "δ about the middle of the picture (L/2, 0): the camera was knocked after it was calibrated, and turns about its own axis",
            unit: "rad",
            size: |_| 0.02,
            put: |robot, amount| robot.camera.roll_rad[1] += amount,
        },
    ],
};

pub(super) const MOUNT_ROTATION: HiddenEffect = HiddenEffect {
    name: "mount_rotation",
    sentence: "The base mount gives way as the actuator is pressurised, less and less.",
    family: None,
    laws: &[
        Law {
            words: "φ 1.4 u/(1 + 0.4 u), u = P/30 kPa, instead of φ u",
            unit: "rad",
            size: |_| 0.024,
            put: |robot, amount| robot.camera.mount_rad[0] += amount,
        },
        Law {
            words: "φ (u − ¼)₊/¾, u = P/30 kPa: a gripped base holds by friction, and gives way in proportion beyond that",
            unit: "rad",
            size: |_| 0.024,
            put: |robot, amount| robot.camera.mount_rad[1] += amount,
        },
    ],
};

pub(super) const MARKER_HEIGHT: HiddenEffect = HiddenEffect {
    name: "marker_height",
    sentence: "The markers sit above the robot's axis, near the tip more than near the base.",
    family: None,
    laws: &[
        Law {
            words: "e (1 + 0.3 (s/L − ½)) instead of e",
            unit: "m",
            size: |_| 0.01,
            put: |robot, amount| robot.camera.height_m[0] += amount,
        },
        Law {
            words: "pins of length e that lean by 20° towards the tip: a rigid offset along the body as well as across it",
            unit: "m",
            size: |_| 0.01,
            put: |robot, amount| robot.camera.height_m[1] += amount,
        },
    ],
};
