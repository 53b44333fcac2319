//! The catalogue of physical effects: one file each, one line in [`EFFECTS`].
//!
//! An effect is plain data (name, formula, sentence, parameters with units and bounds, reference) and one function
//! that adds it to a model under construction. At its neutral values it changes no bit of any prediction.

mod arm_growth;
mod base_clamp;
mod body_leak;
mod body_pressure_offset;
mod camera_lens;
mod camera_moved;
mod camera_rotation;
mod camera_scale;
mod camera_tilt;
mod chord_arm;
mod clock_lag;
mod creep;
mod crimped_sides;
mod displaced_gas;
mod end_constraint;
mod end_fittings;
mod entry;
mod fabric_stretch;
mod flat_ends;
mod fold_energy;
mod friction;
mod gauge_curve;
mod gauge_drift;
mod glued_face;
mod gravity;
mod gussets;
mod initial_curvature;
mod leak;
mod marker_height;
mod mount_rotation;
mod ovalization;
mod plastic_set;
mod pressure_loss;
mod pressure_offset;
mod regulator_hysteresis;
mod roofed_welds;
mod sealed_body;
mod sealed_sides;
mod seam_stiffness;
mod self_contact;
mod shear_lock;
mod shear_stiffness;
mod softening;
mod stuck_face;
mod sunk_muscle;
mod tail_tension;
mod tapered_wall;
mod tip_clamp;
mod tip_load;
mod tip_spring;
mod weak_place;
mod weld_width;
mod wrinkled_sheets;
mod wrinkling;
mod yarn_stretch;

pub(crate) use entry::PLAIN;
pub use entry::{Effect, Fitted, Group, Needs, Parameter, Stage};

/// The list, in the order in which effects are added to a model.
pub const EFFECTS: &[Effect] = &[
    chord_arm::ENTRY,
    weld_width::ENTRY,
    end_constraint::ENTRY,
    end_fittings::ENTRY,
    arm_growth::ENTRY,
    sunk_muscle::ENTRY,
    yarn_stretch::ENTRY,
    glued_face::ENTRY,
    flat_ends::ENTRY,
    fabric_stretch::ENTRY,
    ovalization::ENTRY,
    shear_stiffness::ENTRY,
    shear_lock::ENTRY,
    seam_stiffness::ENTRY,
    displaced_gas::ENTRY,
    gussets::ENTRY,
    sealed_sides::ENTRY,
    roofed_welds::ENTRY,
    fold_energy::ENTRY,
    crimped_sides::ENTRY,
    stuck_face::ENTRY,
    wrinkled_sheets::ENTRY,
    self_contact::ENTRY,
    weak_place::ENTRY,
    wrinkling::ENTRY,
    softening::ENTRY,
    tail_tension::ENTRY,
    base_clamp::ENTRY,
    tip_clamp::ENTRY,
    tapered_wall::ENTRY,
    initial_curvature::ENTRY,
    plastic_set::ENTRY,
    friction::ENTRY,
    creep::ENTRY,
    gravity::ENTRY,
    tip_load::ENTRY,
    tip_spring::ENTRY,
    pressure_offset::ENTRY,
    pressure_loss::ENTRY,
    body_pressure_offset::ENTRY,
    leak::ENTRY,
    gauge_drift::ENTRY,
    gauge_curve::ENTRY,
    regulator_hysteresis::ENTRY,
    body_leak::ENTRY,
    sealed_body::ENTRY,
    marker_height::ENTRY,
    mount_rotation::ENTRY,
    camera_scale::ENTRY,
    camera_rotation::ENTRY,
    camera_tilt::ENTRY,
    camera_lens::ENTRY,
    camera_moved::ENTRY,
    clock_lag::ENTRY,
];

/// Effects that act with strips round the body: those inside an actuator, on its supply, and dead loads. Others are refused.
pub const IN_SPACE: &[&str] = &[
    "chord_arm",
    "weld_width",
    "end_constraint",
    "arm_growth",
    "fabric_stretch",
    "shear_stiffness",
    "shear_lock",
    "seam_stiffness",
    "displaced_gas",
    "gussets",
    "sealed_sides",
    "roofed_welds",
    "fold_energy",
    "crimped_sides",
    "stuck_face",
    "wrinkled_sheets",
    "pressure_offset",
    "pressure_loss",
    "body_pressure_offset",
    "gravity",
    "tip_load",
];

/// Finds an effect of [`EFFECTS`] by its key in scenarios; `None` if there is none.
pub fn by_name(name: &str) -> Option<&'static Effect<'static>> {
    EFFECTS.iter().find(|e| e.name == name)
}
