//! Effects of the actuator.

use super::HiddenEffect;
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
    law: "volume (1 − β h/W) with the lens's height h; fPAM (1 − 4β r/L): stroke and end angle are lost, not a share of both",
    unit: "-",
    // The ends of a long tube take a smaller share of its volume.
    typical: |robot| if robot.cells[0].is(Family::Mckibben) { 0.2 } else { 0.5 },
    family: None,
    put: |robot, amount| drives(robot, |drive| drive.edge_loss += amount),
};

pub(super) const ARM_GROWTH: HiddenEffect = HiddenEffect {
    name: "arm_growth",
    sentence: "The swelling pouch pushes its line of action off the body, late and then no further.",
    law: "arm + s h²/(h² + (0.35 L₀)²), a Hill curve instead of a straight line",
    unit: "m",
    typical: |_| 0.016,
    family: None,
    put: |robot, amount| drives(robot, |drive| drive.swell_m += amount),
};

pub(super) const FABRIC_STRETCH: HiddenEffect = HiddenEffect {
    name: "fabric_stretch",
    sentence: "The yarns of the actuator's fabric straighten first and stretch then, and eat part of the stroke.",
    law: "strain c (0.4 T + 300 (1 − e^(−T/500))): soft at first, then stiffer, instead of linear",
    unit: "m/N",
    typical: |_| 1e-4,
    family: None,
    put: |robot, amount| drives(robot, |drive| drive.stretch_m_per_n += amount),
};

pub(super) const SEAM_STIFFNESS: HiddenEffect = HiddenEffect {
    name: "seam_stiffness",
    sentence: "Welds and creases resist rolling up until they yield like a folded sheet.",
    law: "m tanh(θ/0.6) per pouch, an elastic-plastic hinge instead of a spring",
    unit: "N m",
    typical: |_| 0.5,
    family: Some(Family::Pouch),
    put: |robot, amount| drives(robot, |drive| drive.crease_nm += amount),
};

pub(super) const SHEAR_STIFFNESS: HiddenEffect = HiddenEffect {
    name: "shear_stiffness",
    sentence: "The coated weave resists shearing, and the more the further it is sheared.",
    law: "τ = G γ (1 + (γ/0.3)²) instead of G γ",
    unit: "N/m",
    typical: |_| 35.0,
    family: Some(Family::Mckibben),
    put: |robot, amount| drives(robot, |drive| drive.shear_n_per_m += amount),
};

pub(super) const SHEAR_LOCK: HiddenEffect = HiddenEffect {
    name: "shear_lock",
    sentence: "Neighbouring yarns press on each other ever harder, and the weave stops shearing.",
    law: "τ_L exp((γ − 0.22)/0.035) instead of a corner",
    unit: "N/m",
    typical: |_| 20.0,
    family: Some(Family::Mckibben),
    put: |robot, amount| drives(robot, |drive| drive.lock_n_per_m += amount),
};
