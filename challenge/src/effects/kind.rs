//! One hidden effect and its laws.

use crate::drive::Drive;
use crate::laws::Laws;
use crate::robot::TrueRobot;
use crate::wall::CellWall;
use models::Scenario;
use models::actuators::Family;

/// A physical effect in a robot.
#[derive(Clone, Copy)]
pub struct HiddenEffect {
    /// Name; the catalogue's for the effect of the same cause.
    pub name: &'static str,
    /// What the effect does to a robot, in plain words.
    pub sentence: &'static str,
    /// Contraction mechanism it needs; `None`: any.
    pub family: Option<Family>,
    /// Equation of its first law and of its second, and how it differs from the catalogue's or whose it is; effects outside the
    /// catalogue have one law.
    pub(super) equations: &'static [&'static str],
    /// Amounts of a typical size by law, SI; of the second law where the search for it begins.
    pub(super) sizes: fn(&TrueRobot) -> [f64; 2],
    /// Puts an amount of the law of that number into a robot.
    pub(super) put: fn(&mut TrueRobot, usize, f64),
}

impl HiddenEffect {
    /// Number of its law; of the only one, where it has no second.
    fn number(&self, laws: Laws) -> usize {
        (laws as usize).min(self.equations.len() - 1)
    }

    /// Equation of its law.
    pub fn equation(&self, laws: Laws) -> &'static str {
        self.equations[self.number(laws)]
    }

    pub(super) fn size(&self, laws: Laws, robot: &TrueRobot) -> f64 {
        (self.sizes)(robot)[self.number(laws)]
    }

    pub(crate) fn put(&self, laws: Laws, robot: &mut TrueRobot, amount: f64) {
        (self.put)(robot, self.number(laws), amount);
    }

    /// Whether no entry of the catalogue describes it.
    pub fn is_outside(&self) -> bool {
        models::effects::by_name(self.name).is_none()
    }

    /// Whether a robot of this scenario can have it: its mechanism exists there, the scenario does not already have it, and
    /// a robot whose edges are free has no sealed edges.
    pub(crate) fn applies_to(&self, scenario: &Scenario) -> bool {
        let kind = scenario.actuator.kind;
        let sealed = self.name != "end_constraint" || (kind.edge_restraint)(&scenario.actuator.shape) > 0.0;
        let absent = scenario.effects.iter().all(|effect| effect.name != self.name);
        self.family.is_none_or(|family| family == kind.family) && sealed && absent
    }
}

impl TrueRobot {
    pub(super) fn drives(&mut self, change: impl Fn(&mut Drive)) {
        self.each(|cell, _| cell.drive.iter_mut().for_each(&change));
    }

    /// Changes the wall of every cell, whose middle is at a station \[m\].
    pub(super) fn walls(&mut self, change: impl Fn(&mut CellWall, f64)) {
        self.each(|cell, s_m| change(&mut cell.wall, s_m));
    }

    /// B κ_c of the softest cell \[N·m\]: the wall's moment in a full bend.
    pub(super) fn wall_moment(&self) -> f64 {
        self.cells.iter().map(|cell| cell.wall.bending).fold(f64::INFINITY, f64::min) * self.scale_per_m
    }
}
