//! The TOML text as it stands: keys with units, every value with its place.

use crate::error::ScenarioError;
use serde::Deserialize;
use spelling::Exactly;
use std::collections::BTreeMap;
use toml::Spanned;

type Num = Spanned<f64>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Raw {
    #[serde(default)]
    pub name: String,
    /// Free text; read by people.
    #[serde(default, rename = "notes")]
    pub _notes: String,
    pub body: Spanned<Body>,
    pub actuator: Option<Spanned<RawActuator>>,
    #[serde(default)]
    pub strip: Vec<Spanned<RawStrip>>,
    #[serde(default)]
    pub zone: Vec<Spanned<RawZone>>,
    #[serde(default)]
    pub markers: Markers,
    #[serde(default)]
    pub predict: Predict,
    pub supply: Option<Spanned<RawSupply>>,
    #[serde(default)]
    pub formula: Vec<Spanned<RawFormula>>,
    #[serde(default)]
    pub effects: BTreeMap<Spanned<String>, BTreeMap<Spanned<String>, Spanned<toml::Value>>>,
    /// Settings of the finite element run; read by the engine, which is not known here.
    #[serde(default, rename = "fem")]
    pub _fem: Option<serde::de::IgnoredAny>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    pub radius_mm: Num,
    pub length_mm: Num,
    pub pressure_kpa: Num,
    pub bending_stiffness_nm2: Option<Num>,
    pub hinge_curvature_per_m: Option<Num>,
    pub hinge_moment_share: Option<Num>,
    pub wall_stiffness_n_per_m: Option<Num>,
    pub wall_shear_n_per_m: Option<Num>,
    pub wall_basis: Option<Spanned<toml::Value>>,
    pub centre_line_mm: Option<Num>,
    pub gravity: Option<Spanned<Exactly<2>>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawActuator {
    pub kind: Spanned<String>,
    pub length_mm: Num,
    pub width_mm: Num,
    pub count: Spanned<i64>,
    pub start_mm: Option<Num>,
    pub arm_mm: Option<Num>,
    pub fold_mm: Option<Num>,
    pub volume_gain: Option<Num>,
    pub bias_deg: Option<Num>,
    pub channel: Option<Spanned<i64>>,
    pub max_pressure_kpa: Option<Num>,
    pub azimuth_deg: Option<Num>,
    pub turns: Option<Num>,
}

/// A further strip: keys left out are those of `[actuator]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawStrip {
    pub azimuth_deg: Num,
    pub turns: Option<Num>,
    pub length_mm: Option<Num>,
    pub width_mm: Option<Num>,
    pub count: Option<Spanned<i64>>,
    pub start_mm: Option<Num>,
    pub arm_mm: Option<Num>,
    pub fold_mm: Option<Num>,
    pub volume_gain: Option<Num>,
    pub channel: Option<Spanned<i64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawZone {
    pub from_mm: Num,
    pub to_mm: Num,
    pub radius_mm: Option<Num>,
    pub bending_stiffness_nm2: Option<Num>,
    pub passive: Option<bool>,
    pub length_mm: Option<Num>,
    pub width_mm: Option<Num>,
    pub fold_mm: Option<Num>,
    pub arm_mm: Option<Num>,
    pub channel: Option<Spanned<i64>>,
}

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
pub(super) struct RawSupply {
    pub valve_time_s: Option<Num>,
    pub conductance_l_per_s_bar: Option<Num>,
    pub critical_ratio: Option<Num>,
    pub volume_ml: Option<Num>,
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
