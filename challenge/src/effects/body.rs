//! Hidden effects that act in the wall of the body.

use super::kind::{HiddenEffect, Law};
use crate::robot::TrueRobot;
use std::f64::consts::TAU;

/// B κ_c of the softest cell \[N·m\]: the wall's moment in a full bend.
fn wall_moment(robot: &TrueRobot) -> f64 {
    robot.cells.iter().map(|cell| cell.wall.bending).fold(f64::INFINITY, f64::min) * robot.scale_per_m
}

/// Hinge moment of a body of 80 mm at 2 kPa, π p R³ \[N·m\].
const HINGE_NM: f64 = 0.402;
/// Length over which a clamp stiffens the wall \[m\].
const CLAMP_M: f64 = 0.12;

/// Largest share of the stiffness that creases take: of more than 8/9 the moment would fall with the bend.
const MOST_CREASED: f64 = 0.85;
/// Largest share of the wall that yields; something must stay elastic.
const MOST_YIELDED: f64 = 0.95;
/// Length of a sleeve on an end, one diameter of a body of 80 mm \[m\].
const SLEEVE_M: f64 = 0.08;

fn clamp(robot: &mut TrueRobot, amount: f64, from_tip: bool) {
    let length = robot.length_m;
    robot.each(|cell, s| {
        let away = if from_tip { length - s } else { s };
        let near = (1.0 - away / CLAMP_M).max(0.0);
        cell.wall.bending *= 1.0 + amount * near * near;
    });
}

fn sleeve(robot: &mut TrueRobot, amount: f64, from_tip: bool) {
    let length = robot.length_m;
    robot.each(|cell, s| {
        let away = if from_tip { length - s } else { s };
        if away < SLEEVE_M {
            cell.wall.bending *= 1.0 + amount;
        }
    });
}

pub(super) const WRINKLING: HiddenEffect = HiddenEffect {
    name: "wrinkling",
    sentence: "The wall wrinkles little by little: small bends meet less of the body's pressure than large ones.",
    family: None,
    laws: &[
        Law {
            words: "M₀ x/(1 + x^1.5)^(2/3), x = κ/κ_w, instead of Comer–Levy's curve",
            unit: "1/m",
            size: |robot| 0.25 * robot.scale_per_m,
            put: |robot, amount| robot.each(|cell, _| cell.wall.wrinkle_per_m[0] += amount),
        },
        Law {
            words: "M₀ x/3 up to x = κ/κ_w = 1, then M₀ (1 − ⅔ x^−½): a rectangular section that bears no compression, as in masonry",
            unit: "1/m",
            size: |robot| 0.1 * robot.scale_per_m,
            put: |robot, amount| robot.each(|cell, _| cell.wall.wrinkle_per_m[1] += amount),
        },
    ],
};

pub(super) const SOFTENING: HiddenEffect = HiddenEffect {
    name: "softening",
    sentence: "Creases that a bend has made take most of the wall's stiffness from it.",
    family: None,
    laws: &[
        Law {
            words: "B (1 − s κ²/(κ² + κ_h²)), κ_h = 0.4 κ_c, instead of B/(1 + a κ)",
            unit: "-",
            size: |_| 0.5,
            put: |robot, amount| {
                robot.each(|cell, _| cell.wall.creased[0] = (cell.wall.creased[0] + amount).min(MOST_CREASED))
            },
        },
        Law {
            words: "M = B ((1 − s) κ + s κ_y tanh κ/κ_y), κ_y = 0.2 κ_c: a share of the wall yields, the rest stays elastic",
            unit: "-",
            size: |_| 0.5,
            put: |robot, amount| {
                robot.each(|cell, _| cell.wall.creased[1] = (cell.wall.creased[1] + amount).min(MOST_YIELDED))
            },
        },
    ],
};

pub(super) const TAIL_TENSION: HiddenEffect = HiddenEffect {
    name: "tail_tension",
    sentence: "The tail inside pulls on the tip with the body's own pressure and drags along the wall.",
    family: None,
    laws: &[
        Law {
            words: "moment ∝ p_b and falling by a quarter from base to tip, instead of one constant",
            unit: "N m at 2 kPa",
            size: |_| 0.45,
            put: |robot, amount| {
                let length = robot.length_m;
                robot.each(|cell, s| cell.wall.tail_m3[0] += amount / 2e3 * (1.125 - 0.25 * s / length));
            },
        },
        Law {
            words: "moment ∝ p_b e^(μ κ (L − s)), μ = 0.3: capstan, the pull grows with every bend that the tail is dragged round (Blumenschein 2017)",
            unit: "N m at 2 kPa",
            size: |_| 0.4,
            put: |robot, amount| {
                let length = robot.length_m;
                robot.each(|cell, s| {
                    cell.wall.tail_m3[1] += amount / 2e3;
                    cell.wall.dragged_m = length - s;
                });
            },
        },
    ],
};

pub(super) const OVALIZATION: HiddenEffect = HiddenEffect {
    name: "ovalization",
    sentence: "The bent body flattens and brings the actuator nearer to the far wall, until it is flat.",
    family: None,
    laws: &[
        Law {
            words: "D (1 − o κ²/(κ² + κ_c²)) instead of D/(1 + o (κ/κ_c)²)",
            unit: "-",
            size: |_| 0.25,
            put: |robot, amount| robot.each(|cell, _| cell.wall.oval[0] += amount),
        },
        Law {
            words: "D (1 − o x/(1 + x)), x = κ/κ_c: a line load dents an inflated tube in proportion at first, and no further than flat",
            unit: "-",
            size: |_| 0.25,
            put: |robot, amount| robot.each(|cell, _| cell.wall.oval[1] += amount),
        },
    ],
};

pub(super) const SELF_CONTACT: HiddenEffect = HiddenEffect {
    name: "self_contact",
    sentence: "Folds on the inside of the bend press on each other ever harder and stop it.",
    family: None,
    laws: &[
        Law {
            words: "m exp((κ/κ_c − 0.7)/0.08) instead of a corner",
            unit: "N m",
            size: |robot| 0.01 * (wall_moment(robot) + HINGE_NM),
            put: |robot, amount| robot.each(|cell, _| cell.wall.stop_nm[0] += amount),
        },
        Law {
            words: "m ((κ/κ_c − 0.6)₊/0.1)^1.5: Hertz, round folds touch at once and press with the power 3/2 of their approach",
            unit: "N m",
            size: |robot| 0.1 * (wall_moment(robot) + HINGE_NM),
            put: |robot, amount| robot.each(|cell, _| cell.wall.stop_nm[1] += amount),
        },
    ],
};

pub(super) const BASE_CLAMP: HiddenEffect = HiddenEffect {
    name: "base_clamp",
    sentence: "The clamp keeps the body near the base from folding.",
    family: None,
    laws: &[
        Law {
            words: "B (1 + b (1 − s/120 mm)²) near the base instead of an exponential",
            unit: "-",
            size: |_| 3.0,
            put: |robot, amount| clamp(robot, amount, false),
        },
        Law {
            words: "B (1 + b) up to 80 mm from the base: a clamped sleeve, and by Saint-Venant an end is felt for one diameter",
            unit: "-",
            size: |_| 1.5,
            put: |robot, amount| sleeve(robot, amount, false),
        },
    ],
};

pub(super) const TIP_CLAMP: HiddenEffect = HiddenEffect {
    name: "tip_clamp",
    sentence: "The closed end keeps the body near the tip from folding.",
    family: None,
    laws: &[
        Law {
            words: "B (1 + b (1 − s/120 mm)²) near the tip instead of an exponential",
            unit: "-",
            size: |_| 3.0,
            put: |robot, amount| clamp(robot, amount, true),
        },
        Law {
            words: "B (1 + b) up to 80 mm from the tip: a clamped sleeve, and by Saint-Venant an end is felt for one diameter",
            unit: "-",
            size: |_| 1.5,
            put: |robot, amount| sleeve(robot, amount, true),
        },
    ],
};

pub(super) const INITIAL_CURVATURE: HiddenEffect = HiddenEffect {
    name: "initial_curvature",
    sentence: "The robot was stored rolled up and wants to bend, more near its ends than in the middle.",
    family: None,
    laws: &[
        Law {
            words: "κ₀ (1 + 0.4 cos 2πs/L) instead of a constant",
            unit: "1/m",
            size: |robot| 0.125 * robot.scale_per_m,
            put: |robot, amount| {
                let length = robot.length_m;
                robot.each(|cell, s| cell.wall.rest_per_m += amount * (1.0 + 0.4 * (TAU * s / length).cos()));
            },
        },
        Law {
            words: "κ₀/√(1 + 3 (1 − s/L)): rolled up from the tip, the radius of a spiral grows as the root of the length wound",
            unit: "1/m",
            size: |robot| 0.2 * robot.scale_per_m,
            put: |robot, amount| {
                let length = robot.length_m;
                robot.each(|cell, s| cell.wall.rest_per_m += amount / (1.0 + 3.0 * (1.0 - s / length)).sqrt());
            },
        },
    ],
};

pub(super) const PLASTIC_SET: HiddenEffect = HiddenEffect {
    name: "plastic_set",
    sentence: "Coating and creases keep part of a bend beyond their yield, and let go of it slowly.",
    family: None,
    laws: &[
        Law {
            words: "s (κ_max − 0.25 κ_c)₊ that fades with 40 s, instead of s κ_max for good",
            unit: "-",
            size: |_| 0.16,
            put: |robot, amount| robot.each(|cell, _| cell.wall.set[0] += amount),
        },
        Law {
            words: "κ_p of κ_max = κ_e + κ_p, κ_p = s κ_e²/κ_c, for good: Ramberg and Osgood 1943, without a yield point",
            unit: "-",
            size: |_| 0.12,
            put: |robot, amount| robot.each(|cell, _| cell.wall.set[1] += amount),
        },
    ],
};

pub(super) const FRICTION: HiddenEffect = HiddenEffect {
    name: "friction",
    sentence: "Layers rub on each other and slide one after another, so up and down differ.",
    family: None,
    laws: &[
        Law {
            words: "four Maxwell-slip layers that start to slide at 2, 6, 15 and 30 % of the scale, instead of Coulomb's corner",
            unit: "N m",
            size: |robot| 0.15 * wall_moment(robot),
            put: |robot, amount| robot.each(|cell, _| cell.wall.friction_nm[0] += amount),
        },
        Law {
            words: "dM/dκ = M_f/κ_d (1 − M sgn(κ̇)/M_f), κ_d = 0.08 κ_c: Dahl 1968, bristles that bend and break off",
            unit: "N m",
            size: |robot| 0.15 * wall_moment(robot),
            put: |robot, amount| robot.each(|cell, _| cell.wall.friction_nm[1] += amount),
        },
    ],
};

pub(super) const CREEP: HiddenEffect = HiddenEffect {
    name: "creep",
    sentence: "The coated fabric goes on yielding while the pressure is held, fast at first and slowly for long.",
    family: None,
    laws: &[
        Law {
            words: "relaxation times of 0.7, 3 and 15 s instead of one",
            unit: "N m²",
            size: |robot| 0.25 * wall_moment(robot) / robot.scale_per_m,
            put: |robot, amount| robot.each(|cell, _| cell.wall.creep_nm2[0] += amount),
        },
        Law {
            words: "stiffness g (1 + t/0.1 s)^−0.2 after a step: the power law of polymers, as eight relaxation times from 0.1 s to half an hour",
            unit: "N m²",
            size: |robot| 0.25 * wall_moment(robot) / robot.scale_per_m,
            put: |robot, amount| robot.each(|cell, _| cell.wall.creep_nm2[1] += amount),
        },
    ],
};
