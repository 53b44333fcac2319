//! Effects that no entry of the catalogue describes: local, or of the measurement.

use super::kind::{HiddenEffect, Law};

pub(super) const KINK: HiddenEffect = HiddenEffect {
    name: "kink",
    sentence: "The body has a crease at 40 % of its length, where it folds easily.",
    family: None,
    laws: &[Law {
        words: "B and hinge × (1 − a) over 22 mm",
        unit: "-",
        size: |_| 0.8,
        put: |robot, amount| {
            let length = robot.length_m;
            robot.each(|cell, s| {
                if (s - 0.4 * length).abs() < 0.0115 {
                    cell.wall.bending *= (1.0 - amount).max(0.02);
                    cell.wall.hinge_m3 *= (1.0 - amount).max(0.02);
                }
            });
        },
    }],
};

pub(super) const OBSTACLE: HiddenEffect = HiddenEffect {
    name: "obstacle",
    sentence: "Something soft is in the tip's way.",
    family: None,
    laws: &[Law {
        words: "force a (y − 0.3 κ_c L²)₊ on the tip",
        unit: "N/m",
        size: |robot| 0.5 * robot.cells[0].wall.bending.max(0.3) / robot.length_m.powi(3) * 6.0,
        put: |robot, amount| {
            robot.loads.obstacle_n_per_m += amount;
            robot.loads.obstacle_y_m = 0.3 * robot.scale_per_m * robot.length_m * robot.length_m;
        },
    }],
};

pub(super) const STUCK_REGULATOR: HiddenEffect = HiddenEffect {
    name: "stuck_regulator",
    sentence: "The regulator does not reach one of its set points, 20 kPa, in any run.",
    family: None,
    laws: &[Law {
        words: "pressure × (1 − a) at that set point",
        unit: "-",
        size: |_| 0.15,
        put: |robot, amount| {
            robot.supply.stuck += amount;
            robot.supply.stuck_at_pa = 20e3;
        },
    }],
};

pub(super) const SHIFTED_MARKER: HiddenEffect = HiddenEffect {
    name: "shifted_marker",
    sentence: "The fourth marker sits elsewhere than was written down.",
    family: None,
    laws: &[Law {
        words: "station + a",
        unit: "m",
        size: |_| 0.008,
        put: |robot, amount| {
            let index = 3.min(robot.markers_m.len().saturating_sub(1));
            let length = robot.length_m;
            if let Some(station) = robot.markers_m.get_mut(index) {
                *station = (*station + amount).clamp(0.0, length);
            }
        },
    }],
};

pub(super) const SWAPPED_MARKERS: HiddenEffect = HiddenEffect {
    name: "swapped_markers",
    sentence: "The tracking confused the third and the fourth marker while their paths were close.",
    family: None,
    laws: &[Law {
        words: "each recorded at a share a of the way to the other",
        unit: "-",
        size: |_| 1.0,
        put: |robot, amount| {
            if robot.markers_m.len() > 3 {
                let (third, fourth) = (robot.markers_m[2], robot.markers_m[3]);
                let share = amount.min(1.0);
                robot.markers_m[2] = third + share * (fourth - third);
                robot.markers_m[3] = fourth - share * (fourth - third);
            }
        },
    }],
};

pub(super) const DRIFTING_CAMERA: HiddenEffect = HiddenEffect {
    name: "drifting_camera",
    sentence: "The camera's stand gives way when the robot is pressurised: all markers shift together.",
    family: None,
    laws: &[Law {
        words: "y + d (P/30 kPa)²",
        unit: "m",
        size: |_| 0.004,
        put: |robot, amount| robot.camera.drift_m += amount,
    }],
};
