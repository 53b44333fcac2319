//! The catalogue of physical effects: one file each, one line in [`EFFECTS`].
//!
//! An effect is plain data (name, formula, sentence, parameters with units and bounds, reference) and one function
//! that adds it to a model under construction. At its neutral values it changes no bit of any prediction.

mod arm_growth;
mod camera_rotation;
mod camera_scale;
mod creep;
mod end_constraint;
mod fabric_stretch;
mod friction;
mod gravity;
mod initial_curvature;
mod leak;
mod marker_height;
mod mount_rotation;
mod plastic_set;
mod pressure_loss;
mod pressure_offset;
mod seam_stiffness;
mod self_contact;
mod shear_stiffness;
mod tail_tension;
mod tip_load;
mod wrinkling;

use crate::actuators::Family;
use crate::assembly::Assembly;

/// The list, in the order in which effects are added to a model.
pub const EFFECTS: &[Effect] = &[
    end_constraint::ENTRY,
    arm_growth::ENTRY,
    fabric_stretch::ENTRY,
    shear_stiffness::ENTRY,
    seam_stiffness::ENTRY,
    self_contact::ENTRY,
    wrinkling::ENTRY,
    tail_tension::ENTRY,
    initial_curvature::ENTRY,
    plastic_set::ENTRY,
    friction::ENTRY,
    creep::ENTRY,
    gravity::ENTRY,
    tip_load::ENTRY,
    pressure_offset::ENTRY,
    pressure_loss::ENTRY,
    leak::ENTRY,
    marker_height::ENTRY,
    mount_rotation::ENTRY,
    camera_scale::ENTRY,
    camera_rotation::ENTRY,
];

/// Where in a prediction an effect acts; stages always run in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Set pressure → pressure in the actuator.
    Supply,
    /// Pressure → curvature.
    Balance,
    /// Centre line → what the camera sees.
    Camera,
}

impl Stage {
    /// Lower-case word for tables and JSON.
    pub fn word(self) -> &'static str {
        match self {
            Stage::Supply => "supply",
            Stage::Balance => "balance",
            Stage::Camera => "camera",
        }
    }
}

/// One parameter of an effect. Values are in `unit` in scenarios and tables, in SI (`value × si`) inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Key in the scenario, with the unit as suffix.
    pub key: &'static str,
    /// Letter in the formula.
    pub symbol: &'static str,
    /// Unit of the scenario value.
    pub unit: &'static str,
    /// Factor to SI.
    pub si: f64,
    /// Value at which the effect vanishes.
    pub neutral: f64,
    /// Typical size where the effect matters.
    pub typical: f64,
    /// Physical lower bound.
    pub lower: f64,
    /// Physical upper bound.
    pub upper: f64,
    /// What it is.
    pub meaning: &'static str,
}

/// A physical effect as an entry of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Effect {
    /// Name in scenarios.
    pub name: &'static str,
    /// Stage in which it acts.
    pub stage: Stage,
    /// Formula in Unicode.
    pub formula: &'static str,
    /// One plain sentence for a user.
    pub sentence: &'static str,
    /// What to measure or change on the robot.
    pub remedy: &'static str,
    /// When it holds.
    pub validity: &'static str,
    /// Source.
    pub reference: &'static str,
    /// Parameters in the order `add` takes them.
    pub parameters: &'static [Parameter],
    /// Contraction mechanism it needs; `None`: any.
    pub family: Option<Family>,
    /// Adds it to a model under construction; values in SI.
    pub add: fn(&[f64], &mut Assembly),
}

/// The entry of that name.
pub fn by_name(name: &str) -> Option<&'static Effect> {
    EFFECTS.iter().find(|e| e.name == name)
}

impl Effect {
    /// Neutral values of all parameters, SI.
    pub fn neutral(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.neutral * p.si).collect()
    }

    /// Typical values of all parameters, SI.
    pub fn typical(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.typical * p.si).collect()
    }

    /// Whether the effect exists for an actuator of this family.
    pub fn applies_to(&self, family: Family) -> bool {
        self.family.is_none_or(|needed| needed == family)
    }
}
