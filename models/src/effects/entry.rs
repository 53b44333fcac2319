//! An effect as plain data: its words, its parameters, and the function that adds it. Each effect sees this through `use super::entry::*`.

pub(super) use crate::Text;
pub(super) use crate::actuators::Family;
pub(super) use crate::assembly::Assembly;
pub(super) use crate::section::CutSection;
pub(super) use crate::site::{SideEffects, Site};
pub(super) use crate::term::{Account, LedgerLine, Memory, Pose, Remembering, Term, actuator_q};

/// Where in a prediction an effect acts; stages always run in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Set pressure → pressure in the actuator.
    Supply,
    /// From the pressure in the actuator to the curvature of the body.
    Balance,
    /// Centre line → what the camera sees.
    Camera,
}

impl Stage {
    /// Lower-case word for tables and JSON.
    pub fn word(self) -> &'static str {
        ["supply", "balance", "camera"][self as usize]
    }
}

/// What an effect belongs to: where to look for it on the robot. Supply and measurement are to be ruled out before physics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// The actuator, its fabric, folds and welds.
    Actuator,
    /// The body's wall, and friction or history in it.
    Body,
    /// What pulls on the robot from outside.
    Load,
    /// The air on its way to the actuator.
    Supply,
    /// Camera, markers and mount: to be ruled out before any physics.
    Measurement,
}

impl Group {
    /// Whether it is checked on the bench before physics is blamed.
    pub fn is_nuisance(self) -> bool {
        matches!(self, Group::Supply | Group::Measurement)
    }

    /// Lower-case word for tables and JSON.
    pub fn word(self) -> &'static str {
        ["actuator", "body", "load", "supply", "measurement"][self as usize]
    }
}

/// One parameter of an effect. Values are in `unit` in scenarios and tables, in SI (`value × si`) inside.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Parameter<'a> {
    /// Key in the scenario, with the unit as suffix.
    pub key: &'a str,
    /// Letter of the parameter in the formula of the effect.
    pub symbol: &'a str,
    /// Unit of the value in a scenario.
    pub unit: &'a str,
    /// Factor from the value in a scenario to SI.
    #[serde(skip)]
    pub si: f64,
    /// Value at which the effect vanishes.
    pub neutral: f64,
    /// Typical size where the effect matters.
    pub typical: f64,
    /// Least value that a fit tries, and that is accepted without a known source.
    pub lower: f64,
    /// Largest value that a fit tries, and that is accepted without a known source.
    pub upper: f64,
    /// Physically possible values: a separate test may find that much.
    #[serde(skip)]
    pub possible: [f64; 2],
    /// Where a fit starts if one start is not enough: thresholds and time scales; empty: at the typical size.
    pub starts: &'a [f64],
    /// Typical size for single actuators, where it depends on their curvature and stiffness.
    #[serde(skip)]
    pub by_actuator: &'a [(&'a str, f64)],
    /// When a fit may change it; otherwise it stays neutral.
    #[serde(skip)]
    pub fitted: Fitted,
    /// It belongs to the room: a robot rolled by 180° sees it with the other sign.
    #[serde(skip)]
    pub in_room: bool,
    /// Meaning in a few words, for reports and messages.
    pub meaning: &'a str,
}

/// What most effects are; entries say how they differ.
pub(super) const BALANCE: Effect<'static> = Effect {
    name: "",
    group: Group::Actuator,
    stage: Stage::Balance,
    history: false,
    formula: "",
    sentence: "",
    differs: "",
    remedy: "",
    validity: "",
    reference: "",
    parameters: &[],
    needs: Needs::Body,
    add: |_, _| {},
};

/// The same for the air on its way to the actuator.
pub(super) const SUPPLY: Effect<'static> = Effect { group: Group::Supply, stage: Stage::Supply, ..BALANCE };

/// The same for camera, markers and mount.
pub(super) const CAMERA: Effect<'static> = Effect { group: Group::Measurement, stage: Stage::Camera, ..BALANCE };

/// What most parameters are; entries say how they differ.
pub(crate) const PLAIN: Parameter<'static> = Parameter {
    key: "",
    symbol: "",
    unit: "-",
    si: 1.0,
    neutral: 0.0,
    typical: 1.0,
    lower: 0.0,
    upper: 1.0,
    possible: POSITIVE,
    starts: &[],
    by_actuator: &[],
    fitted: Fitted::Always,
    in_room: false,
    meaning: "",
};

/// A parameter: key, symbol, unit and its factor to SI. Unless stated it is neutral at 0, usually 1 of 0 to 1, and not negative.
pub(super) const fn parameter(key: Text, symbol: Text, unit: Text, si: f64) -> Parameter<'static> {
    Parameter { key, symbol, unit, si, ..PLAIN }
}

/// A number that shapes a law, neutral where the law has its usual form.
pub(super) const fn shape(key: Text, symbol: Text, unit: Text, si: f64) -> Parameter<'static> {
    Parameter { typical: 0.0, fitted: Fitted::Shape, ..parameter(key, symbol, unit, si) }
}

impl Parameter<'static> {
    pub(super) const fn usual(self, typical: f64, [lower, upper]: [f64; 2]) -> Self {
        Parameter { typical, lower, upper, ..self }
    }

    /// The same where the typical size is neutral: another parameter decides whether the effect acts.
    pub(super) const fn around(self, neutral: f64, bounds: [f64; 2]) -> Self {
        self.usual(neutral, bounds).neutral(neutral)
    }

    pub(super) const fn neutral(self, neutral: f64) -> Self {
        Parameter { neutral, ..self }
    }

    pub(super) const fn possible(self, possible: [f64; 2]) -> Self {
        Parameter { possible, ..self }
    }

    pub(super) const fn starts(self, starts: &'static [f64]) -> Self {
        Parameter { starts, ..self }
    }

    pub(super) const fn by_actuator(self, by_actuator: &'static [(&'static str, f64)]) -> Self {
        Parameter { by_actuator, ..self }
    }

    pub(super) const fn fitted(self, fitted: Fitted) -> Self {
        Parameter { fitted, ..self }
    }

    pub(super) const fn in_room(self) -> Self {
        Parameter { in_room: true, ..self }
    }

    pub(super) const fn means(self, meaning: Text) -> Self {
        Parameter { meaning, ..self }
    }
}

/// Whether a mechanism is there, from 0 to 1, by design.
pub(super) const SHARE: Parameter<'static> =
    Parameter { key: "share", symbol: "σ", possible: [0.0, 1.0], fitted: Fitted::FromDesign, ..PLAIN };

/// Possible values of a stiffness, a weight, a friction.
pub(super) const POSITIVE: [f64; 2] = [0.0, f64::INFINITY];
/// Of a time, or of a stiffness that is never nothing.
pub(super) const ABOVE_ZERO: [f64; 2] = [f64::MIN_POSITIVE, f64::INFINITY];
/// Possible values of a quantity that has a direction or a sign.
pub(super) const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Which data can determine a parameter, and so whether a diagnosis fits it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fitted {
    /// All data, without a condition on the robot or its pressures.
    Always,
    /// All, about its neutral value: it shapes a law whose exact form is not known, and has no effect alone.
    Shape,
    /// Only data of a robot whose bending stiffness is not fitted: both together cannot be separated.
    WithKeptBending,
    /// Only data at several body pressures, or a separate test: at one pressure it has the curve of another effect.
    WithBodyPressures,
    /// All; it is a time of the protocol, tried in the middle between two holds.
    BetweenHolds,
    /// All; it is a lag, tried in the middle between two samples.
    BetweenSamples,
    /// None: it follows from how the robot is cut and joined, or from a test of its fabric.
    FromDesign,
}

/// What an effect acts in: without it there is nothing to change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Needs {
    /// Any body, a passive beam too.
    Body,
    /// Any actuator, or the supply that fills it.
    Actuator,
    /// An actuator of this contraction mechanism.
    Family(Family),
}

/// A physical effect as an entry of the catalogue, or of a scenario's own ([`crate::Catalogue`]).
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct Effect<'a> {
    /// Name of the effect in scenarios and commands.
    pub name: &'a str,
    /// Part of robot or test that it belongs to.
    pub group: Group,
    /// Stage of a prediction in which it acts.
    pub stage: Stage,
    /// Whether a state depends on those before it or on the time in a hold: needs data with an unloading branch or with
    /// several samples in a hold.
    pub history: bool,
    /// Law of the effect as a formula in Unicode.
    pub formula: &'a str,
    /// One plain sentence for a user.
    pub sentence: &'a str,
    /// What measurements show where it acts and the model lacks it.
    pub differs: &'a str,
    /// What to measure or change on the robot.
    pub remedy: &'a str,
    /// Conditions under which the law may be used.
    pub validity: &'a str,
    /// Literature of the law, or `derived here`.
    pub reference: &'a str,
    /// Parameters in the order `add` takes them.
    pub parameters: &'a [Parameter<'a>],
    /// Part of the robot without which there is nothing to change.
    #[serde(skip)]
    pub needs: Needs,
    /// Adds it to a model under construction; values in SI. A formula adds itself.
    #[serde(skip)]
    pub(crate) add: fn(&[f64], &mut Assembly),
}

impl Parameter<'_> {
    /// Whether a value is where a fit looks.
    pub fn is_usual(&self, value: f64) -> bool {
        (self.lower..=self.upper).contains(&value)
    }

    /// Whether there can be such a value.
    pub fn is_possible(&self, value: f64) -> bool {
        value.is_finite() && (self.possible[0]..=self.possible[1]).contains(&value)
    }

    /// `0 to 8 N/m`: where a fit looks.
    pub fn usual_words(&self) -> String {
        self.words(self.lower, self.upper)
    }

    /// `0 to 1`, `0 N/m and above`: the possible values.
    pub fn possible_words(&self) -> String {
        let [low, high] = self.possible;
        match (low.is_finite(), high.is_finite()) {
            (true, true) => self.words(low, high),
            (true, false) if low == f64::MIN_POSITIVE => format!("above 0{}", self.after()),
            (true, false) => format!("{low}{} and above", self.after()),
            _ => "any number".into(),
        }
    }

    fn words(&self, low: f64, high: f64) -> String {
        format!("{low} to {high}{}", self.after())
    }

    fn after(&self) -> String {
        if self.unit == "-" { String::new() } else { format!(" {}", self.unit) }
    }

    /// Typical size on an actuator, in `unit`.
    pub fn typical_for(&self, actuator: &str) -> f64 {
        self.by_actuator.iter().find(|(name, _)| *name == actuator).map_or(self.typical, |(_, typical)| *typical)
    }
}

impl Effect<'static> {
    pub(super) const fn line(&self, account: Account) -> LedgerLine {
        LedgerLine::new(self.name, account)
    }

    /// Its term without memory: a law that adds its force and returns its energy.
    pub(super) fn law<F: Fn(&Pose, &mut [f64]) -> f64 + Send + Sync>(
        &self,
        account: Account,
        law: F,
    ) -> Box<LawTerm<F>> {
        Box::new(LawTerm(self.line(account), law))
    }
}

/// A term that is a law alone, with its line in the ledger.
pub(super) struct LawTerm<F>(pub LedgerLine, pub F);

impl<F: Fn(&Pose, &mut [f64]) -> f64 + Send + Sync> Term for LawTerm<F> {
    fn line(&self) -> LedgerLine {
        self.0
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        (self.1)(at, force)
    }
}

impl<F: Fn(&Pose, &mut [f64]) -> f64 + Send + Sync> Remembering for LawTerm<F> {}

impl Effect<'_> {
    /// Neutral values of all parameters, SI.
    pub fn neutral(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.neutral * p.si).collect()
    }

    /// Typical values of all parameters, SI.
    pub fn typical(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.typical * p.si).collect()
    }

    /// Typical values of all parameters on an actuator, SI.
    pub fn typical_for(&self, actuator: &str) -> Vec<f64> {
        self.parameters.iter().map(|p| p.typical_for(actuator) * p.si).collect()
    }

    /// Whether a fit may change one of its parameters.
    pub fn is_fitted(&self) -> bool {
        self.parameters.iter().any(|p| p.fitted != Fitted::FromDesign)
    }

    /// Whether it acts in an actuator or on its supply: a passive beam has neither.
    pub fn needs_actuator(&self) -> bool {
        self.needs != Needs::Body
    }

    /// Whether the effect exists for an actuator of this family.
    pub fn applies_to(&self, family: Family) -> bool {
        !matches!(self.needs, Needs::Family(needed) if needed != family)
    }
}
