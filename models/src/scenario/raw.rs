//! The TOML text as written: keys with units, every value with its place.

use crate::error::ScenarioError;
use serde::Deserialize;
use spelling::Exactly;
use std::collections::BTreeMap;
use toml::Spanned;

type Num = Spanned<f64>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawScenario {
    #[serde(default)]
    pub name: String,
    /// Free text for people; no model reads it.
    #[serde(default, rename = "notes")]
    pub _notes: String,
    pub body: Spanned<Entries>,
    pub actuator: Option<Spanned<Entries>>,
    #[serde(default)]
    pub strip: Vec<Spanned<Entries>>,
    #[serde(default)]
    pub zone: Vec<Spanned<Entries>>,
    #[serde(default)]
    pub markers: Markers,
    #[serde(default)]
    pub predict: Predict,
    pub supply: Option<Spanned<Entries>>,
    pub growth: Option<Spanned<Entries>>,
    #[serde(default)]
    pub formula: Vec<Spanned<RawFormula>>,
    #[serde(default)]
    pub effects: BTreeMap<Spanned<String>, Entries>,
    /// Settings of the finite element run; read by the engine, which is not known here.
    #[serde(default, rename = "fem")]
    pub _fem: Option<serde::de::IgnoredAny>,
}

/// A table whose keys are in [`super::keys`].
pub(super) type Entries = BTreeMap<Spanned<String>, Spanned<toml::Value>>;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Markers {
    #[serde(default)]
    pub s_mm: Vec<Num>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Predict {
    #[serde(default)]
    pub pressures_kpa: Vec<Num>,
    pub segments: Option<Spanned<i64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFormula {
    pub name: Spanned<String>,
    pub moment: Spanned<String>,
    pub sentence: Option<String>,
    pub differs: Option<String>,
    pub remedy: Option<String>,
    #[serde(default)]
    pub parameters: BTreeMap<Spanned<String>, RawParameter>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawParameter {
    pub unit: Spanned<String>,
    pub neutral: Option<Num>,
    pub typical: Num,
    pub bounds: Spanned<Exactly<2>>,
    pub meaning: Option<String>,
}

/// A TOML or type error with its place, its first line only.
pub(super) fn syntax(error: toml::de::Error) -> ScenarioError {
    let message = error.message().lines().next().unwrap_or("not valid TOML").to_string();
    let help = message.contains("unknown field").then(|| "every key carries its unit, for example length_mm".into());
    ScenarioError { message, help, span: error.span().map(|s| (s.start, s.end)) }
}
