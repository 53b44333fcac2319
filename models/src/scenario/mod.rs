//! A scenario: the robot and its model as the user writes it, in TOML with the unit in every key.
//!
//! ```toml
//! name = "ePAM, du Pasquier 2023"
//! [body]
//! radius_mm = 40
//! length_mm = 360
//! pressure_kpa = 2
//! [actuator]
//! kind = "epam"
//! length_mm = 60            # one pouch
//! width_mm = 60
//! count = 6
//! [markers]
//! s_mm = [30, 90, 150, 210, 270, 330]
//! [effects.end_constraint]
//! beta = 0.446
//! basis = "assumed"
//! ```

mod built;
mod check;
mod choice;
mod dials;
mod formulas;
mod given;
mod growth;
mod keys;
pub mod quantity;
mod raw;
mod set;
mod spans;
mod stated;
mod strips;

pub use choice::ActuatorChoice;
pub use dials::Dial;
pub use keys::{KEYS, Key, key, moves_nothing};
pub use set::Setting;
pub use spans::Span;
pub use stated::{BASES, EffectChoice, Effects, Growth, Scenario, Wall, Zone};

use crate::error::ScenarioError;

/// The scenarios that come with the library: the four robots of du Pasquier 2023, by actuator name.
///
/// `epam-textbook` is the same robot without the mechanics that textbook models lack.
pub fn shipped(name: &str) -> Option<&'static str> {
    let of = |name: &str| SHIPPED.iter().find(|(key, _)| *key == name).map(|s| s.1);
    let textbook = |full: &'static str| MECHANICS.iter().find_map(|more| full.strip_suffix(more)).unwrap_or(full);
    of(name).or_else(|| of(name.strip_suffix("-textbook")?).map(textbook))
}

macro_rules! toml {
    ($($name:literal),+) => { concat!("../../scenarios/", $($name,)+ ".toml") };
}

/// Name and text of a robot: its scenario, and the mechanics of a pouch or a muscle in a pressurised wall.
macro_rules! robot {
    ($name:literal, $kind:literal) => {
        ($name, concat!(include_str!(toml!($name)), include_str!(toml!($kind, "-mechanics"))))
    };
}

/// Names and texts of the shipped scenarios.
pub const SHIPPED: &[(&str, &str)] =
    &[robot!("spam", "pouch"), robot!("cpam", "pouch"), robot!("epam", "pouch"), robot!("fpam", "muscle")];

/// Names that [`shipped`] knows: the four robots, and each without the mechanics that textbook models lack.
pub const ROBOTS: [&str; 8] =
    ["spam", "cpam", "epam", "fpam", "spam-textbook", "cpam-textbook", "epam-textbook", "fpam-textbook"];

const MECHANICS: [&str; 2] = [include_str!(toml!("pouch-mechanics")), include_str!(toml!("muscle-mechanics"))];

impl Scenario {
    /// Reads a scenario from TOML text.
    ///
    /// # Errors
    /// Syntax errors, unknown keys and values that cannot be, each with its place in the text.
    pub fn parse(text: &str) -> Result<Scenario, ScenarioError> {
        let raw: raw::RawScenario = toml::from_str(text).map_err(raw::syntax)?;
        check::scenario(&raw, text)
    }
}

#[cfg(test)]
mod tests;
