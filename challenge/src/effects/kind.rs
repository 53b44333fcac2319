//! One hidden effect and its laws.

use crate::laws::Laws;
use crate::robot::TrueRobot;
use models::Scenario;
use models::actuators::Family;

/// One equation of a mechanism, and how to put it into a robot.
#[derive(Clone, Copy)]
pub struct Law {
    /// Its equation; how it differs from the catalogue's, or whose it is.
    pub words: &'static str,
    /// Unit of the amount that `put` takes.
    pub unit: &'static str,
    /// Amount of a typical size, SI; of a second law where the search for it begins.
    pub(super) size: fn(&TrueRobot) -> f64,
    /// Puts an amount of it into a robot.
    pub put: fn(&mut TrueRobot, f64),
}

/// A physical effect in a robot.
#[derive(Clone, Copy)]
pub struct HiddenEffect {
    /// Name; the catalogue's for the effect of the same cause.
    pub name: &'static str,
    /// What the effect does to a robot, in plain words.
    pub sentence: &'static str,
    /// Contraction mechanism it needs; `None`: any.
    pub family: Option<Family>,
    /// Its first law and its second; effects outside the catalogue have one.
    pub(super) laws: &'static [Law],
}

impl HiddenEffect {
    /// Its law; the only one, where it has no second.
    pub fn law(&self, laws: Laws) -> &'static Law {
        &self.laws[(laws as usize).min(self.laws.len() - 1)]
    }

    /// Whether no entry of the catalogue describes it.
    pub fn is_outside(&self) -> bool {
        models::effects::by_name(self.name).is_none()
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
