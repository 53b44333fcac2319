//! Hidden effects that act in the actuator and its fabric.

use super::kind::{HiddenEffect, Law};
use crate::drive::Drive;
use crate::robot::TrueRobot;
use models::actuators::Family;

fn drives(robot: &mut TrueRobot, change: impl Fn(&mut Drive)) {
    robot.each(|cell, _| {
        if let Some(drive) = &mut cell.drive {
            change(drive);
        }
    });
}

pub(super) const END_CONSTRAINT: HiddenEffect = HiddenEffect {
    name: "end_constraint",
    sentence: "Closed side edges pinch the pouch, so it holds less air the higher its lens.",
    family: None,
    laws: &[
        Law {
            words: "volume (1 − β h/W) with the lens's height h; fPAM (1 − 4β r/L): stroke and end angle are lost, not a share of both",
            unit: "-",
            // The ends of a long tube take a smaller share of its volume.
            size: |robot| if robot.cells[0].is(Family::Mckibben) { 0.2 } else { 0.5 },
            put: |robot, amount| drives(robot, |drive| drive.edge_loss[0] += amount),
        },
        Law {
            words: "volume (1 − β (h/W)²), fPAM (1 − β (4r/L)²): an inextensible sheet that bows by f over a span S draws its ends in by 8f²/3S",
            unit: "-",
            size: |_| 1.0,
            put: |robot, amount| drives(robot, |drive| drive.edge_loss[1] += amount),
        },
    ],
};

pub(super) const ARM_GROWTH: HiddenEffect = HiddenEffect {
    name: "arm_growth",
    sentence: "The swelling pouch pushes its line of action off the body, late and then no further.",
    family: None,
    laws: &[
        Law {
            words: "arm + s h²/(h² + (0.35 L₀)²), a Hill curve instead of a straight line",
            unit: "m",
            size: |_| 0.016,
            put: |robot, amount| drives(robot, |drive| drive.swell_m[0] += amount),
        },
        Law {
            words: "arm + s (sinθ/θ − cosθ)/2θ: half of the tension runs in the bulged wall, and pulls through the centroid of that arc",
            unit: "m",
            size: |_| 0.02,
            put: |robot, amount| drives(robot, |drive| drive.swell_m[1] += amount),
        },
    ],
};

pub(super) const FABRIC_STRETCH: HiddenEffect = HiddenEffect {
    name: "fabric_stretch",
    sentence: "The yarns of the actuator's fabric straighten first and stretch then, and eat part of the stroke.",
    family: None,
    laws: &[
        Law {
            words: "strain c (0.4 T + 300 (1 − e^(−T/500))): soft at first, then stiffer, instead of linear",
            unit: "m/N",
            size: |_| 1e-4,
            put: |robot, amount| drives(robot, |drive| drive.stretch_m_per_n[0] += amount),
        },
        Law {
            words: "strain c T₀ ln(1 + T/T₀), T₀ = 300 N/m: Fung 1967, tension grows exponentially once crimp is pulled out",
            unit: "m/N",
            size: |_| 1e-4,
            put: |robot, amount| drives(robot, |drive| drive.stretch_m_per_n[1] += amount),
        },
    ],
};

pub(super) const SEAM_STIFFNESS: HiddenEffect = HiddenEffect {
    name: "seam_stiffness",
    sentence: "Welds and creases resist rolling up until they yield like a folded sheet.",
    family: Some(Family::Pouch),
    laws: &[
        Law {
            words: "m tanh(θ/0.6) per pouch, an elastic-plastic hinge instead of a spring",
            unit: "N m",
            size: |_| 0.5,
            put: |robot, amount| drives(robot, |drive| drive.crease_nm[0] += amount),
        },
        Law {
            words: "m θ^0.4 per pouch: Hollomon, a sheet whose stress is K εⁿ bends by a moment that grows as κⁿ",
            unit: "N m",
            size: |_| 0.5,
            put: |robot, amount| drives(robot, |drive| drive.crease_nm[1] += amount),
        },
    ],
};

pub(super) const SHEAR_STIFFNESS: HiddenEffect = HiddenEffect {
    name: "shear_stiffness",
    sentence: "The coated weave resists shearing, and the more the further it is sheared.",
    family: Some(Family::Mckibben),
    laws: &[
        Law {
            words: "τ = G γ (1 + (γ/0.3)²) instead of G γ",
            unit: "N/m",
            size: |_| 35.0,
            put: |robot, amount| drives(robot, |drive| drive.shear_n_per_m[0] += amount),
        },
        Law {
            words: "τ = G γ/(1 + γ/0.15): Kondner 1963, crossings of yarns let go of each other one by one, so that it gets softer",
            unit: "N/m",
            size: |_| 50.0,
            put: |robot, amount| drives(robot, |drive| drive.shear_n_per_m[1] += amount),
        },
    ],
};

pub(super) const SHEAR_LOCK: HiddenEffect = HiddenEffect {
    name: "shear_lock",
    sentence: "Neighbouring yarns press on each other ever harder, and the weave stops shearing.",
    family: Some(Family::Mckibben),
    laws: &[
        Law {
            words: "τ_L exp((γ − 0.22)/0.035) instead of a corner",
            unit: "N/m",
            size: |_| 20.0,
            put: |robot, amount| drives(robot, |drive| drive.lock_n_per_m[0] += amount),
        },
        Law {
            words: "τ_L ((1 − γ/0.36)⁻³ − 1): van Wyk 1946, fibres that are pressed together push back by the cube of their density",
            unit: "N/m",
            size: |_| 5.0,
            put: |robot, amount| drives(robot, |drive| drive.lock_n_per_m[1] += amount),
        },
    ],
};
