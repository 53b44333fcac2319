//! The hidden effects: one entry each; the laws stand in `drive`, `wall`, `loads`, `supply` and `camera`.
//!
//! Names are those of the catalogue of `models`, so that a diagnosis can be scored; the laws are others on purpose. Each
//! mechanism has two, and [`Laws`] says which of them a robot has. A *typical size* is set by what the effect does to the
//! markers under the standard protocol; it was set before any diagnosis of these data and is not tuned on one. That of a
//! second law follows from the first's: it moves the markers as far ([`HiddenEffect::typical`]).

mod actuator;
mod body;
mod outside;
mod setup;
mod size;
#[cfg(test)]
mod tests;

use super::robot::TrueRobot;
use models::Scenario;
use models::actuators::Family;
use serde::{Deserialize, Serialize};

/// Which law of every mechanism a robot has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Laws {
    /// Written beside the catalogue, each another one than its entry.
    #[default]
    First,
    /// Taken from the literature or derived, without the diagnosis in view.
    Second,
}

impl Laws {
    /// Whether these are the first ones, which need no mention.
    pub fn are_first(&self) -> bool {
        *self == Laws::First
    }
}

/// Amounts of one mechanism by law, first and second; both off at 0.
pub type ByLaw = [f64; 2];

/// One form of a mechanism.
#[derive(Clone, Copy)]
pub struct Law {
    /// Its equation; how it differs from the catalogue's, or whose it is.
    pub words: &'static str,
    /// Unit of the amount.
    pub unit: &'static str,
    /// Amount of a typical size, SI; of a second law where the search for it begins.
    size: fn(&TrueRobot) -> f64,
    /// Puts an amount of it into a robot.
    pub put: fn(&mut TrueRobot, f64),
}

/// A physical effect in a robot.
#[derive(Clone, Copy)]
pub struct HiddenEffect {
    /// Name; the catalogue's for the effect of the same cause.
    pub name: &'static str,
    /// What happens, in plain words.
    pub sentence: &'static str,
    /// Contraction mechanism it needs; `None`: any.
    pub family: Option<Family>,
    /// Its first law and its second; what is outside the catalogue has one.
    laws: &'static [Law],
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
    /// Its law; the only one, where it has no second.
    pub fn law(&self, laws: Laws) -> &'static Law {
        &self.laws[(laws as usize).min(self.laws.len() - 1)]
    }

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
