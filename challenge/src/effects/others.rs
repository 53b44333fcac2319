//! Effects of sets of their own: a wall that softens, places that bend otherwise, a lens and a hose; and what no entry of the catalogue
//! describes, local or of the measurement.

use super::kind::HiddenEffect;
use crate::robot::TrueRobot;

/// Largest share of the stiffness that creases take, of more than 8/9 the moment would fall with the bend; and of the wall that yields,
/// something must stay elastic.
const MOST_SOFTENED: [f64; 2] = [0.85, 0.95];

/// Stiffness that matters at the tip \[N/m\].
fn at_the_tip(robot: &TrueRobot) -> f64 {
    1.5 * robot.cells[0].wall.bending.max(0.3) / robot.length_m.powi(3)
}

/// Effects that are hidden in separate sets, in addition to the effects that the generator draws from [`super::HIDDEN`].
pub const ALSO: &[HiddenEffect] = &[
    HiddenEffect {
        name: "softening",
        sentence: "Creases that a bend has made take most of the wall's stiffness from it.",
        family: None,
        equations: &[
            "B (1 − s κ²/(κ² + κ_h²)), κ_h = 0.4 κ_c, instead of B/(1 + a κ)",
            "M = B ((1 − s) κ + s κ_y tanh κ/κ_y), κ_y = 0.2 κ_c: a share of the wall yields, the rest stays elastic",
        ],
        sizes: |_| [0.5, 0.5],
        put: |robot, law, amount| {
            let soft = |share: f64| (share + amount).min(MOST_SOFTENED[law]);
            robot.walls(|wall, _| wall.creased[law] = soft(wall.creased[law]));
        },
    },
    HiddenEffect {
        name: "weak_place",
        sentence: "A sixth of the actuator gets less air.",
        family: None,
        equations: &[
            "pressure × (1 − a) between L/2 and 2L/3: a pinched hose",
            "pressure × (1 − a) between L/3 and L/2: a pouch without hose",
        ],
        sizes: |_| [0.5, 0.5],
        put: |robot, law, amount| {
            let [from, to] = [[0.5, 2.0 / 3.0], [1.0 / 3.0, 0.5]][law].map(|share| share * robot.length_m);
            robot.each(|cell, s| {
                if let Some(drive) = cell.drive.as_mut().filter(|_| s > from && s < to) {
                    drive.strength *= (1.0 - amount).max(0.0);
                }
            });
        },
    },
    HiddenEffect {
        name: "tapered_wall",
        sentence: "The wall is stiffer at the base than at the tip.",
        family: None,
        equations: &[
            "B (1 + a (1 − 2s/L)): the glue got thinner on the way",
            "B (1 + a) before L/2 and B (1 − a) beyond it: two sheets of different fabric",
        ],
        sizes: |_| [0.6, 0.4],
        put: |robot, law, amount| {
            let length = robot.length_m;
            robot.walls(|wall, s| {
                let factor = match law {
                    0 => 1.0 + amount * (1.0 - 2.0 * s / length),
                    _ if s < 0.5 * length => 1.0 + amount,
                    _ => 1.0 - amount,
                };
                wall.bending *= factor.max(0.02);
            });
        },
    },
    HiddenEffect {
        name: "camera_lens",
        sentence: "The lens bulges the image about its centre.",
        family: None,
        equations: &[
            "1 + k r² about (L/2, L/6)",
            "1 + k r⁴ about (L/2, L/6): a wide lens that was calibrated in its middle",
        ],
        sizes: |_| [0.8, 20.0],
        put: |robot, law, amount| robot.camera.lens[law] += amount,
    },
    HiddenEffect {
        name: "tip_spring",
        sentence: "A stiff hose at the tip pulls it back across the robot.",
        family: None,
        equations: &[
            "force −a y on the tip, across the straight robot only",
            "force −a (y − L/20)₊ on the tip: a hose that has some slack",
        ],
        sizes: |robot| [at_the_tip(robot); 2],
        put: |robot, law, amount| {
            robot.loads.obstacle_n_per_m += amount;
            if law == 1 {
                robot.loads.obstacle_y_m = 0.05 * robot.length_m;
            }
        },
    },
];

/// Effects that no entry of the catalogue describes.
pub const OUTSIDE: &[HiddenEffect] = &[
    HiddenEffect {
        name: "kink",
        sentence: "The body has a crease at 40 % of its length, where it folds easily.",
        family: None,
        equations: &["B and hinge × (1 − a) over 22 mm"],
        sizes: |_| [0.8; 2],
        put: |robot, _, amount| {
            let place = 0.4 * robot.length_m;
            robot.walls(|wall, s| {
                if (s - place).abs() < 0.0115 {
                    wall.bending *= (1.0 - amount).max(0.02);
                    wall.hinge_m3 *= (1.0 - amount).max(0.02);
                }
            });
        },
    },
    HiddenEffect {
        name: "obstacle",
        sentence: "Something soft is in the tip's way.",
        family: None,
        equations: &["force a (y − 0.3 κ_c L²)₊ on the tip"],
        sizes: |robot| [0.5 * robot.cells[0].wall.bending.max(0.3) / robot.length_m.powi(3) * 6.0; 2],
        put: |robot, _, amount| {
            robot.loads.obstacle_n_per_m += amount;
            robot.loads.obstacle_y_m = 0.3 * robot.scale_per_m * robot.length_m * robot.length_m;
        },
    },
    HiddenEffect {
        name: "stuck_regulator",
        sentence: "The regulator does not reach one of its set points, 20 kPa, in any run.",
        family: None,
        equations: &["pressure × (1 − a) at that set point"],
        sizes: |_| [0.15; 2],
        put: |robot, _, amount| {
            robot.supply.stuck += amount;
            robot.supply.stuck_at_pa = 20e3;
        },
    },
    HiddenEffect {
        name: "shifted_marker",
        sentence: "The fourth marker sits elsewhere than was written down.",
        family: None,
        equations: &["station + a"],
        sizes: |_| [0.008; 2],
        put: |robot, _, amount| {
            let index = 3.min(robot.markers_m.len().saturating_sub(1));
            if let Some(station) = robot.markers_m.get_mut(index) {
                *station = (*station + amount).clamp(0.0, robot.length_m);
            }
        },
    },
    HiddenEffect {
        name: "swapped_markers",
        sentence: "The tracking confused the third and the fourth marker while their paths were close.",
        family: None,
        equations: &["each recorded at a share a of the way to the other"],
        sizes: |_| [1.0; 2],
        put: |robot, _, amount| {
            if let [_, _, third, fourth, ..] = &mut robot.markers_m[..] {
                let way = amount.min(1.0) * (*fourth - *third);
                (*third, *fourth) = (*third + way, *fourth - way);
            }
        },
    },
    HiddenEffect {
        name: "drifting_camera",
        sentence: "The camera's stand gives way when the robot is pressurised: all markers shift together.",
        family: None,
        equations: &["y + d (P/30 kPa)²"],
        sizes: |_| [0.004; 2],
        put: |robot, _, amount| robot.camera.drift_m += amount,
    },
];
