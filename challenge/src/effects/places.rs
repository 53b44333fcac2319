//! Places that bend otherwise, a lens and a hose: what a laboratory finds next to physics.

use super::kind::{HiddenEffect, Law};
use crate::robot::TrueRobot;

/// Factor on the actuator's pressure between two shares of the body length.
fn weaken(robot: &mut TrueRobot, from: f64, to: f64, strength: f64) {
    let length = robot.length_m;
    robot.each(|cell, s| {
        if let Some(drive) = cell.drive.as_mut().filter(|_| s > from * length && s < to * length) {
            drive.strength *= strength;
        }
    });
}

pub(super) const WEAK_PLACE: HiddenEffect = HiddenEffect {
    name: "weak_place",
    sentence: "A sixth of the actuator gets less air.",
    family: None,
    laws: &[
        Law {
            words: "pressure × (1 − a) between L/2 and 2L/3: a pinched hose",
            unit: "-",
            size: |_| 0.5,
            put: |robot, amount| weaken(robot, 0.5, 2.0 / 3.0, (1.0 - amount).max(0.0)),
        },
        Law {
            words: "pressure × (1 − a) between L/3 and L/2: a pouch without hose",
            unit: "-",
            size: |_| 0.5,
            put: |robot, amount| weaken(robot, 1.0 / 3.0, 0.5, (1.0 - amount).max(0.0)),
        },
    ],
};

pub(super) const TAPERED_WALL: HiddenEffect = HiddenEffect {
    name: "tapered_wall",
    sentence: "The wall is stiffer at the base than at the tip.",
    family: None,
    laws: &[
        Law {
            words: "B (1 + a (1 − 2s/L)): the glue got thinner on the way",
            unit: "-",
            size: |_| 0.6,
            put: |robot, amount| {
                let length = robot.length_m;
                robot.each(|cell, s| cell.wall.bending *= (1.0 + amount * (1.0 - 2.0 * s / length)).max(0.02));
            },
        },
        Law {
            words: "B (1 + a) before L/2 and B (1 − a) beyond it: two sheets of different fabric",
            unit: "-",
            size: |_| 0.4,
            put: |robot, amount| {
                let length = robot.length_m;
                robot.each(|cell, s| {
                    cell.wall.bending *= (if s < 0.5 * length { 1.0 + amount } else { 1.0 - amount }).max(0.02);
                });
            },
        },
    ],
};

pub(super) const CAMERA_LENS: HiddenEffect = HiddenEffect {
    name: "camera_lens",
    sentence: "The lens bulges the image about its centre.",
    family: None,
    laws: &[
        Law {
            words: "1 + k r² about (L/2, L/6)",
            unit: "1/m²",
            size: |_| 0.8,
            put: |robot, amount| robot.camera.lens[0] += amount,
        },
        Law {
            words: "1 + k r⁴ about (L/2, L/6): a wide lens that was calibrated in its middle",
            unit: "1/m⁴",
            size: |_| 20.0,
            put: |robot, amount| robot.camera.lens[1] += amount,
        },
    ],
};

/// Stiffness that matters at the tip \[N/m\].
fn at_the_tip(robot: &TrueRobot) -> f64 {
    1.5 * robot.cells[0].wall.bending.max(0.3) / robot.length_m.powi(3)
}

pub(super) const TIP_SPRING: HiddenEffect = HiddenEffect {
    name: "tip_spring",
    sentence: "A stiff hose at the tip pulls it back across the robot.",
    family: None,
    laws: &[
        Law {
            words: "force −a y on the tip, across the straight robot only",
            unit: "N/m",
            size: at_the_tip,
            put: |robot, amount| robot.loads.obstacle_n_per_m += amount,
        },
        Law {
            words: "force −a (y − L/20)₊ on the tip: a hose that has some slack",
            unit: "N/m",
            size: at_the_tip,
            put: |robot, amount| {
                robot.loads.obstacle_n_per_m += amount;
                robot.loads.obstacle_y_m = 0.05 * robot.length_m;
            },
        },
    ],
};
