//! Effects of the body.

use super::HiddenEffect;
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

fn clamp(robot: &mut TrueRobot, amount: f64, from_tip: bool) {
    let length = robot.length_m;
    robot.each(|cell, s| {
        let away = if from_tip { length - s } else { s };
        let near = (1.0 - away / CLAMP_M).max(0.0);
        cell.wall.bending *= 1.0 + amount * near * near;
    });
}

pub(super) const WRINKLING: HiddenEffect = HiddenEffect {
    name: "wrinkling",
    sentence: "The wall wrinkles little by little: small bends meet less of the body's pressure than large ones.",
    law: "M₀ x/(1 + x^1.5)^(2/3), x = κ/κ_w, instead of Comer–Levy's curve",
    unit: "1/m",
    typical: |robot| 0.25 * robot.scale_per_m,
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.wrinkle_per_m += amount),
};

pub(super) const SOFTENING: HiddenEffect = HiddenEffect {
    name: "softening",
    sentence: "Creases that a bend has made take most of the wall's stiffness from it.",
    law: "B (1 − s κ²/(κ² + κ_h²)), κ_h = 0.4 κ_c, instead of B/(1 + a κ)",
    unit: "-",
    typical: |_| 0.5,
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.creased = (cell.wall.creased + amount).min(MOST_CREASED)),
};

pub(super) const TAIL_TENSION: HiddenEffect = HiddenEffect {
    name: "tail_tension",
    sentence: "The tail inside pulls on the tip with the body's own pressure and drags along the wall.",
    law: "moment ∝ p_b and falling by a quarter from base to tip, instead of one constant",
    unit: "N m at 2 kPa",
    typical: |_| 0.45,
    family: None,
    put: |robot, amount| {
        let length = robot.length_m;
        robot.each(|cell, s| cell.wall.tail_m3 += amount / 2e3 * (1.125 - 0.25 * s / length));
    },
};

pub(super) const OVALIZATION: HiddenEffect = HiddenEffect {
    name: "ovalization",
    sentence: "The bent body flattens and brings the actuator nearer to the far wall, until it is flat.",
    law: "D (1 − o κ²/(κ² + κ_c²)) instead of D/(1 + o (κ/κ_c)²)",
    unit: "-",
    typical: |_| 0.25,
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.oval += amount),
};

pub(super) const SELF_CONTACT: HiddenEffect = HiddenEffect {
    name: "self_contact",
    sentence: "Folds on the inside of the bend press on each other ever harder and stop it.",
    law: "m exp((κ/κ_c − 0.7)/0.08) instead of a corner",
    unit: "N m",
    typical: |robot| 0.01 * (wall_moment(robot) + HINGE_NM),
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.stop_nm += amount),
};

pub(super) const BASE_CLAMP: HiddenEffect = HiddenEffect {
    name: "base_clamp",
    sentence: "The clamp keeps the body near the base from folding.",
    law: "B (1 + b (1 − s/120 mm)²) near the base instead of an exponential",
    unit: "-",
    typical: |_| 3.0,
    family: None,
    put: |robot, amount| clamp(robot, amount, false),
};

pub(super) const TIP_CLAMP: HiddenEffect = HiddenEffect {
    name: "tip_clamp",
    sentence: "The closed end keeps the body near the tip from folding.",
    law: "B (1 + b (1 − s/120 mm)²) near the tip instead of an exponential",
    unit: "-",
    typical: |_| 3.0,
    family: None,
    put: |robot, amount| clamp(robot, amount, true),
};

pub(super) const INITIAL_CURVATURE: HiddenEffect = HiddenEffect {
    name: "initial_curvature",
    sentence: "The robot was stored rolled up and wants to bend, more near its ends than in the middle.",
    law: "κ₀ (1 + 0.4 cos 2πs/L) instead of a constant",
    unit: "1/m",
    typical: |robot| 0.125 * robot.scale_per_m,
    family: None,
    put: |robot, amount| {
        let length = robot.length_m;
        robot.each(|cell, s| cell.wall.rest_per_m += amount * (1.0 + 0.4 * (TAU * s / length).cos()));
    },
};

pub(super) const PLASTIC_SET: HiddenEffect = HiddenEffect {
    name: "plastic_set",
    sentence: "Coating and creases keep part of a bend beyond their yield, and let go of it slowly.",
    law: "s (κ_max − 0.25 κ_c)₊ that fades with 40 s, instead of s κ_max for good",
    unit: "-",
    typical: |_| 0.16,
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.set += amount),
};

pub(super) const FRICTION: HiddenEffect = HiddenEffect {
    name: "friction",
    sentence: "Layers rub on each other and slide one after another, so up and down differ.",
    law: "four Maxwell-slip layers that start to slide at 2, 6, 15 and 30 % of the scale, instead of Coulomb's corner",
    unit: "N m",
    typical: |robot| 0.15 * wall_moment(robot),
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.friction_nm += amount),
};

pub(super) const CREEP: HiddenEffect = HiddenEffect {
    name: "creep",
    sentence: "The coated fabric goes on yielding while the pressure is held, fast at first and slowly for long.",
    law: "relaxation times of 0.7, 3 and 15 s instead of one",
    unit: "N m²",
    typical: |robot| 0.25 * wall_moment(robot) / robot.scale_per_m,
    family: None,
    put: |robot, amount| robot.each(|cell, _| cell.wall.creep_nm2 += amount),
};
