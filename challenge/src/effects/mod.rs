//! The hidden effects: one entry each; the laws stand in `drive`, `wall`, `loads`, `supply` and `camera`.
//!
//! The catalogue of `models` gives the names, so that a diagnosis can be scored; the laws are others on purpose. Each
//! mechanism has two, and [`Laws`] selects one for a robot. A *typical size* is set by what the effect does to the
//! markers under the standard protocol; it was set before any diagnosis of these data and is not tuned on one. The typical
//! size of a second law follows from the first's: it moves the markers as far ([`HiddenEffect::typical`]).

mod actuator;
mod body;
mod kind;
mod outside;
mod places;
mod setup;
mod size;
#[cfg(test)]
mod tests;

pub use crate::laws::Laws;
pub use kind::{HiddenEffect, Law};

/// Effects that the catalogue of `models` also knows, by another law.
pub const HIDDEN: &[HiddenEffect] = &[
    actuator::END_CONSTRAINT,
    actuator::ARM_GROWTH,
    actuator::FABRIC_STRETCH,
    actuator::SEAM_STIFFNESS,
    actuator::SHEAR_STIFFNESS,
    actuator::SHEAR_LOCK,
    body::WRINKLING,
    body::TAIL_TENSION,
    body::OVALIZATION,
    body::SELF_CONTACT,
    body::BASE_CLAMP,
    body::TIP_CLAMP,
    body::INITIAL_CURVATURE,
    body::PLASTIC_SET,
    body::FRICTION,
    body::CREEP,
    setup::GRAVITY,
    setup::TIP_LOAD,
    setup::PRESSURE_LOSS,
    setup::PRESSURE_OFFSET,
    setup::LEAK,
    setup::CAMERA_SCALE,
    setup::CAMERA_ROTATION,
    setup::MOUNT_ROTATION,
    setup::MARKER_HEIGHT,
];

/// Effects that are hidden in separate sets, in addition to the effects that the generator draws from [`HIDDEN`].
pub const ALSO: &[HiddenEffect] =
    &[body::SOFTENING, places::WEAK_PLACE, places::TAPERED_WALL, places::CAMERA_LENS, places::TIP_SPRING];

/// Effects that no entry of the catalogue describes.
pub const OUTSIDE: &[HiddenEffect] = &[
    outside::KINK,
    outside::OBSTACLE,
    outside::STUCK_REGULATOR,
    outside::SHIFTED_MARKER,
    outside::SWAPPED_MARKERS,
    outside::DRIFTING_CAMERA,
];

/// The entry of that name, from any list.
pub fn by_name(name: &str) -> Option<&'static HiddenEffect> {
    HIDDEN.iter().chain(ALSO).chain(OUTSIDE).find(|effect| effect.name == name)
}
