//! Presets of everything that a robot's scenario leaves open, by name: `[fem] model = "paper"`.

use super::RobotSettings;

/// Where the settings come from that `[fem]` does not name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Model {
    /// [`RobotSettings::compressed`]: the recommended set.
    #[default]
    Recommended,
    /// [`RobotSettings::paper`]: the modelling choices of du Pasquier et al. 2023.
    Paper,
}

impl Model {
    /// All of them.
    pub const ALL: [Model; 2] = [Model::Recommended, Model::Paper];

    /// As in the file.
    pub fn name(self) -> &'static str {
        match self {
            Model::Recommended => "recommended",
            Model::Paper => "paper",
        }
    }

    /// The model of that name.
    pub fn named(name: &str) -> Option<Model> {
        Model::ALL.into_iter().find(|model| model.name() == name)
    }

    /// What it sets.
    pub fn settings(self) -> RobotSettings {
        match self {
            Model::Recommended => RobotSettings::compressed(),
            Model::Paper => RobotSettings::paper(),
        }
    }

    /// Whether every pressure is a run of its own, from the flat robot.
    pub fn separate(self) -> bool {
        self == Model::Paper
    }
}
