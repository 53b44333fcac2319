//! Presets of everything that a robot's scenario leaves open, by name: `[fem] model = "paper"`.

use super::RobotSettings;

/// Where the settings come from that `[fem]` does not name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// [`RobotSettings::compressed`]: the recommended set.
    #[default]
    Recommended,
    /// [`RobotSettings::paper`]: the modelling choices of du Pasquier et al. 2023.
    Paper,
}

impl Preset {
    /// All of them.
    pub const ALL: [Preset; 2] = [Preset::Recommended, Preset::Paper];

    /// As in the file.
    pub fn name(self) -> &'static str {
        match self {
            Preset::Recommended => "recommended",
            Preset::Paper => "paper",
        }
    }

    /// The model of that name.
    pub fn named(name: &str) -> Option<Preset> {
        Preset::ALL.into_iter().find(|model| model.name() == name)
    }

    /// What it sets.
    pub fn settings(self) -> RobotSettings {
        match self {
            Preset::Recommended => RobotSettings::compressed(),
            Preset::Paper => RobotSettings::paper(),
        }
    }

    /// Whether every pressure is a run of its own, from the flat robot.
    pub fn separate(self) -> bool {
        self == Preset::Paper
    }
}
