//! The hidden effects: one entry each; the laws stand in `drive`, `wall`, `loads`, `supply` and `camera`.
//!
//! Names are those of the catalogue of `models`, so that a diagnosis can be scored; the laws are others on purpose. A
//! *typical size* is set by what the effect does to the markers under the standard protocol (`ibr bench discovery --sizes`
//! prints it beside the catalogue's typical size); it was set before any diagnosis of these data and is not tuned on one.

mod actuator;
mod body;
mod outside;
mod setup;

use super::robot::TrueRobot;
use models::Scenario;
use models::actuators::Family;

/// A physical effect in a robot.
#[derive(Clone, Copy)]
pub struct HiddenEffect {
    /// Name; the catalogue's for the effect of the same cause.
    pub name: &'static str,
    /// What happens, in plain words.
    pub sentence: &'static str,
    /// The law, and how it differs from the catalogue's.
    pub law: &'static str,
    /// Unit of the amount.
    pub unit: &'static str,
    /// Amount of a typical size, SI.
    pub typical: fn(&TrueRobot) -> f64,
    /// Contraction mechanism it needs; `None`: any.
    pub family: Option<Family>,
    /// Puts an amount of it into a robot.
    pub put: fn(&mut TrueRobot, f64),
}

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

/// Effects that are hidden in sets of their own, beside those that the generator draws from [`HIDDEN`].
pub const ALSO: &[HiddenEffect] = &[body::SOFTENING];

/// Effects that no entry of the catalogue describes.
pub const OUTSIDE: &[HiddenEffect] = &[
    outside::DEAD_POUCH,
    outside::WEAK_POUCH,
    outside::STIFFNESS_TAPER,
    outside::KINK,
    outside::OBSTACLE,
    outside::STUCK_REGULATOR,
    outside::SHIFTED_MARKER,
    outside::SWAPPED_MARKERS,
    outside::LENS_DISTORTION,
    outside::DRIFTING_CAMERA,
];

/// The entry of that name, from any list.
pub fn by_name(name: &str) -> Option<&'static HiddenEffect> {
    HIDDEN.iter().chain(ALSO).chain(OUTSIDE).find(|effect| effect.name == name)
}

impl HiddenEffect {
    /// Whether this effect is one of [`OUTSIDE`].
    pub fn is_outside(&self) -> bool {
        OUTSIDE.iter().any(|effect| effect.name == self.name)
    }

    /// Whether a robot of this scenario can have it: its mechanism exists there, the scenario does not already have it, and
    /// a robot whose edges are free has no sealed edges.
    pub fn applies_to(&self, scenario: &Scenario) -> bool {
        let kind = scenario.actuator.kind;
        let sealed = self.name != "end_constraint" || (kind.edge_restraint)(&scenario.actuator.shape) > 0.0;
        let absent = scenario.effects.iter().all(|effect| effect.name != self.name);
        self.family.is_none_or(|family| family == kind.family) && sealed && absent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_every_entry_says_what_it_is() {
        let all: Vec<&HiddenEffect> = HIDDEN.iter().chain(ALSO).chain(OUTSIDE).collect();
        assert_eq!((HIDDEN.len(), ALSO.len(), OUTSIDE.len()), (25, 1, 10));
        for (i, effect) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|other| other.name != effect.name), "{}", effect.name);
            assert!(effect.sentence.ends_with('.') && !effect.law.is_empty() && !effect.unit.is_empty());
            assert_eq!(by_name(effect.name).map(|found| found.name), Some(effect.name));
        }
    }
}
