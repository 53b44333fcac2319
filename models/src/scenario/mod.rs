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
mod dials;
mod formulas;
pub mod quantity;
mod raw;
mod spans;
mod strips;
mod supply;

pub use dials::Dial;
pub use spans::Span;

use crate::actuators::pattern::Joint;
use crate::actuators::{Actuator, ActuatorShape, BEAM};
use crate::assembly::Assembly;
use crate::catalogue::Catalogue;
use crate::effects::{EFFECTS, Effect, Fitted};
use crate::error::ScenarioError;
use crate::formula::Formula;
use crate::line::Line;
use crate::space::IN_SPACE;
use std::sync::Arc;

/// A scenario in SI units, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Free name.
    pub name: String,
    /// Body radius R \[m\].
    pub radius_m: f64,
    /// Body length L \[m\].
    pub length_m: f64,
    /// Body gauge pressure \[Pa\].
    pub p_body_pa: f64,
    /// Effective bending stiffness B \[N·m²\]; 0 in a bare model.
    pub bending_stiffness: f64,
    /// Hinge curvature k₀ of the base law \[1/m\].
    pub hinge_curvature: f64,
    /// Restoring moment of the base law as a share of πp_bR³ \[-\].
    pub hinge_share: f64,
    /// The fabric of the body, where it is known.
    pub wall: Wall,
    /// Distance of the centre line from the taut generator \[m\]; `None`: the radius, 0: it does not shorten.
    pub centre_line_m: Option<f64>,
    /// Unit vector of gravity in the x–y plane.
    pub gravity_direction: [f64; 2],
    /// The actuator.
    pub actuator: ActuatorChoice,
    /// Further strips of it round the body.
    pub more_strips: Vec<ActuatorChoice>,
    /// Stretches that differ.
    pub zones: Vec<Zone>,
    /// Marker stations along the undeformed body \[m\].
    pub markers_m: Vec<f64>,
    /// Actuator pressures to predict at when none are asked for \[Pa\].
    pub pressures_pa: Vec<f64>,
    /// Segments of a model with transverse loads.
    pub segments: usize,
    /// Largest actuator pressure an inverse may ask for \[Pa\].
    pub p_max_pa: f64,
    /// How fast a set pressure arrives, for what happens in time; `None`: at once.
    pub line: Option<Line>,
    /// Effects, in catalogue order.
    pub effects: Vec<EffectChoice>,
    /// The scenario's own effects, in the order of the text: they follow those of the catalogue.
    pub formulas: Vec<Arc<Formula>>,
}

/// What is known of the body's fabric.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wall {
    /// Membrane stiffness E t along the body \[N/m\]: the body is then a [`crate::body::BodyWall`].
    pub stiffness_n_per_m: Option<f64>,
    /// In-plane shear stiffness G t \[N/m\]: transverse loads then shear the body by V/(πR²p_b + πR G t).
    pub shear_n_per_m: Option<f64>,
    /// How they are known: a word of `basis`; empty without either.
    pub basis: String,
}

/// The actuator of a scenario.
#[derive(Debug, Clone, Copy)]
pub struct ActuatorChoice {
    /// Kind.
    pub kind: &'static Actuator,
    /// Dimensions of one unit.
    pub shape: ActuatorShape,
    /// Units in series.
    pub count: usize,
    /// Where the first unit starts \[m\].
    pub start_m: f64,
    /// Arm from the taut generator \[m\]; `None`: the kind's own.
    pub arm_m: Option<f64>,
    /// Supply channel.
    pub channel: usize,
    /// Azimuth of its first unit's start, from y towards z \[rad\].
    pub azimuth_rad: f64,
    /// Turns round the body from its start to its end, in the same sense; not 0: a helix.
    pub turns: f64,
}

impl ActuatorChoice {
    /// A scenario without `[actuator]`: a passive beam.
    pub const NONE: ActuatorChoice = ActuatorChoice {
        kind: &BEAM,
        shape: ActuatorShape {
            length_m: 0.0,
            width_m: 0.0,
            fold_m: 0.0,
            volume_gain: 1.0,
            bias_rad: crate::actuators::BIAS,
        },
        count: 0,
        start_m: 0.0,
        arm_m: None,
        channel: 0,
        azimuth_rad: 0.0,
        turns: 0.0,
    };

    /// Whether there is an actuator.
    pub fn exists(&self) -> bool {
        self.count > 0
    }

    /// Whether the body's wall is the bottom of its pouches.
    pub fn in_wall(&self) -> bool {
        matches!((self.kind.pattern)(&self.shape).joint, Joint::Wall)
    }

    /// Whether an effect can act on this robot: those of a family, and all that act in an actuator, need one.
    pub fn takes(&self, effect: &Effect) -> bool {
        effect.applies_to(self.kind.family) && (self.exists() || !effect.needs_actuator())
    }
}

impl PartialEq for ActuatorChoice {
    fn eq(&self, other: &Self) -> bool {
        self.kind.name == other.kind.name
            && (self.shape, self.count, self.start_m, self.arm_m, self.channel)
                == (other.shape, other.count, other.start_m, other.arm_m, other.channel)
            && (self.azimuth_rad, self.turns) == (other.azimuth_rad, other.turns)
    }
}

/// A stretch of the body where something differs from the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Start \[m\].
    pub from_m: f64,
    /// End \[m\].
    pub to_m: f64,
    /// Body radius \[m\].
    pub radius_m: Option<f64>,
    /// Effective bending stiffness \[N·m²\].
    pub bending_stiffness: Option<f64>,
    /// Without actuator.
    pub passive: Option<bool>,
    /// Unit length \[m\].
    pub unit_length_m: Option<f64>,
    /// Unit width \[m\].
    pub width_m: Option<f64>,
    /// Fold depth \[m\].
    pub fold_m: Option<f64>,
    /// Arm \[m\].
    pub arm_m: Option<f64>,
    /// Supply channel.
    pub channel: Option<usize>,
}

/// An effect switched on, with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectChoice {
    /// Name in the catalogue.
    pub name: String,
    /// Parameter values in catalogue order, SI.
    pub values: Vec<f64>,
    /// How the values are known: a word of [`BASES`], or empty.
    pub basis: String,
}

/// The words of `basis`, which say how a value is known.
pub const BASES: &[&str] = &["assumed", "calibrated", "measured", "predicted", "published"];

/// The scenarios that come with the library: the four robots of du Pasquier 2023, by actuator name.
///
/// `epam-textbook` is the same robot without the mechanics that textbook models lack.
pub fn shipped(name: &str) -> Option<&'static str> {
    let of = |name: &str| SHIPPED.iter().find(|(key, _)| *key == name).map(|s| s.1);
    let textbook = |full: &'static str| MECHANICS.iter().find_map(|more| full.strip_suffix(more)).unwrap_or(full);
    of(name).or_else(|| of(name.strip_suffix("-textbook")?).map(textbook))
}

/// A scenario and the mechanics of a pouch or a muscle in a pressurised wall.
macro_rules! in_the_wall {
    ($file:literal, $mechanics:literal) => {
        concat!(include_str!($file), include_str!($mechanics))
    };
}

/// Names and texts of the shipped scenarios.
pub const SHIPPED: &[(&str, &str)] = &[
    ("spam", in_the_wall!("../../scenarios/spam.toml", "../../scenarios/pouch-mechanics.toml")),
    ("cpam", in_the_wall!("../../scenarios/cpam.toml", "../../scenarios/pouch-mechanics.toml")),
    ("epam", in_the_wall!("../../scenarios/epam.toml", "../../scenarios/pouch-mechanics.toml")),
    ("fpam", in_the_wall!("../../scenarios/fpam.toml", "../../scenarios/muscle-mechanics.toml")),
];

/// What textbooks leave out.
const MECHANICS: [&str; 2] =
    [include_str!("../../scenarios/pouch-mechanics.toml"), include_str!("../../scenarios/muscle-mechanics.toml")];

impl Scenario {
    /// Reads a scenario from TOML text.
    ///
    /// # Errors
    /// Syntax errors, unknown keys and values that cannot be, each with its place in the text.
    pub fn parse(text: &str) -> Result<Scenario, ScenarioError> {
        let raw: raw::Raw = toml::from_str(text).map_err(raw::syntax)?;
        check::scenario(&raw, text)
    }

    /// The same robot without any effect and with B = 0.
    pub fn bare(&self) -> Scenario {
        Scenario { bending_stiffness: 0.0, effects: Vec::new(), ..self.clone() }
    }

    /// The same with an effect set (added, or its values replaced); values in SI, catalogue order is kept. What shapes its
    /// law stands last and may be left out: the law then has its usual form.
    ///
    /// # Panics
    /// The catalogue has no effect of that name, or it has another number of parameters: a slip in the calling code, which
    /// must not pass as a model without the effect. Look names typed by a user up in [`Scenario::catalogue`] first.
    pub fn with_effect(&self, name: &str, values: &[f64]) -> Scenario {
        let catalogue = self.catalogue();
        let given = values.len();
        let takes =
            |e: &Effect| given <= e.parameters.len() && e.parameters[given..].iter().all(|p| p.fitted == Fitted::Shape);
        let effect = catalogue.by_name(name).filter(takes);
        let neutral = effect.map(|e| e.neutral());
        assert!(neutral.is_some(), "no effect `{name}` with {given} parameters");
        let usual = neutral.into_iter().flatten().skip(given);
        let values = values.iter().copied().chain(usual).collect();
        let mut changed = self.clone();
        changed.effects.retain(|e| e.name != name);
        let choice = EffectChoice { name: name.to_string(), values, basis: String::new() };
        changed.effects.push(choice);
        changed.effects.sort_by_key(|e| order(&e.name, &self.formulas));
        changed
    }

    /// Every effect this scenario may use: those of all, and its own formulas.
    pub fn catalogue(&self) -> Catalogue<'_> {
        Catalogue::new(&self.formulas)
    }

    /// Names of its effects after which a state depends on those before it.
    pub fn remembering(&self) -> Vec<&str> {
        let remembers = |name: &str| crate::effects::by_name(name).is_some_and(|effect| effect.history);
        self.effects.iter().map(|effect| effect.name.as_str()).filter(|name| remembers(name)).collect()
    }

    fn formula(&self, name: &str) -> Option<&Formula> {
        self.formulas.iter().find(|formula| formula.name == name).map(|formula| &**formula)
    }

    /// Adds what is switched on to a model under construction.
    pub(crate) fn add_effects(&self, assembly: &mut Assembly) {
        for chosen in &self.effects {
            match (crate::effects::by_name(&chosen.name), self.formula(&chosen.name)) {
                (Some(effect), _) => (effect.add)(&chosen.values, assembly),
                (None, Some(formula)) => formula.add(&chosen.values, assembly),
                (None, None) => {}
            }
        }
    }

    /// The same with another effective bending stiffness \[N·m²\].
    pub fn with_bending(&self, stiffness: f64) -> Scenario {
        Scenario { bending_stiffness: stiffness, ..self.clone() }
    }

    /// The same with other marker stations \[m\].
    pub fn with_markers(&self, stations_m: &[f64]) -> Scenario {
        Scenario { markers_m: stations_m.to_vec(), ..self.clone() }
    }

    /// The actuator and its further strips.
    pub fn strips(&self) -> impl Iterator<Item = &ActuatorChoice> {
        std::iter::once(&self.actuator).chain(&self.more_strips)
    }

    /// Whether strips lie elsewhere than along azimuth 0: the robot then leaves the x–y plane, and [`crate::space`] has its balance.
    pub fn is_spatial(&self) -> bool {
        !self.more_strips.is_empty() || self.actuator.azimuth_rad != 0.0 || self.actuator.turns != 0.0
    }

    /// Whether an effect can act on this robot: as [`ActuatorChoice::takes`], and those of [`IN_SPACE`] where strips lie round the body.
    pub fn takes(&self, effect: &Effect) -> bool {
        self.actuator.takes(effect) && (!self.is_spatial() || IN_SPACE.contains(&effect.name))
    }

    /// Stretches of equal design, base to tip.
    pub fn spans(&self) -> Vec<Span> {
        spans::spans(self)
    }
}

/// Place of an effect in the catalogue.
fn order(name: &str, formulas: &[Arc<Formula>]) -> usize {
    let listed = EFFECTS.iter().position(|e| e.name == name);
    listed.unwrap_or_else(|| EFFECTS.len() + formulas.iter().take_while(|formula| formula.name != name).count())
}

#[cfg(test)]
mod tests;
