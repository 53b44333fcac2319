//! The TOML text as written: keys with units, every value with its place.

use super::range::{Checked, FreeTable, Num, Text, TimeRows, unknown};
use crate::FemError;
use serde::Deserialize;
use spelling::Exactly;
use std::collections::BTreeMap;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCase {
    pub kind: Text,
    #[serde(default)]
    pub name: String,
    #[serde(default, rename = "notes")]
    pub _notes: String,
    pub mesh: Spanned<FreeTable>,
    #[serde(default)]
    pub fabric: BTreeMap<Text, Spanned<FreeTable>>,
    #[serde(default)]
    pub part: BTreeMap<Text, Spanned<RawPart>>,
    #[serde(default)]
    pub chamber: BTreeMap<Text, Spanned<RawChamber>>,
    #[serde(default)]
    pub support: Vec<Spanned<RawSupport>>,
    #[serde(default)]
    pub rigid: Vec<RawRigid>,
    #[serde(default)]
    pub force: Vec<RawForce>,
    pub gravity: Option<RawGravity>,
    #[serde(default)]
    pub obstacle: Vec<Spanned<RawObstacle>>,
    pub contact: Option<RawContact>,
    #[serde(default)]
    pub settings: FreeTable,
    #[serde(default)]
    pub output: RawOutput,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPart {
    pub fabric: Option<Text>,
    pub angle_deg: Option<Num>,
    pub plies: Option<Spanned<Vec<RawPly>>>,
    pub bonded: Option<bool>,
    pub density_kg_m3: Num,
    pub bending_factor: Option<Num>,
    pub rest_curvature: Option<bool>,
    pub warp: Option<Spanned<toml::Value>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPly {
    pub fabric: Text,
    pub angle_deg: Option<Num>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawChamber {
    #[serde(rename = "pressure_kPa", alias = "pressure_kpa")]
    pub pressure_kpa: Option<Num>,
    pub preset: Option<Text>,
    #[serde(rename = "smooth_s_kPa", alias = "smooth_s_kpa")]
    pub(crate) smooth_s_kpa: TimeRows<2>,
    #[serde(rename = "linear_s_kPa", alias = "linear_s_kpa")]
    pub(crate) linear_s_kpa: TimeRows<2>,
    pub sealed_at_s: Option<Num>,
    #[serde(rename = "atmosphere_kPa", alias = "atmosphere_kpa")]
    pub(crate) atmosphere_kpa: Option<Num>,
    pub dead_volume_cm3: Option<Num>,
    pub(crate) polytropic_exponent: Option<Num>,
    #[serde(rename = "leak_l_min_kPa", alias = "leak_l_min_kpa")]
    pub(crate) leak_l_min_kpa: Option<Num>,
    pub inflow_l_min: Option<Num>,
    pub(crate) inflow_smooth_s_l_min: TimeRows<2>,
    pub(crate) inflow_linear_s_l_min: TimeRows<2>,
    pub open_axis: Option<Text>,
    pub parts: Option<Spanned<Vec<Text>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSupport {
    pub set: Text,
    pub axes: Option<Text>,
    pub encastre: Option<bool>,
    pub smooth_s_mm: TimeRows<4>,
    pub(crate) linear_s_mm: TimeRows<4>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawRigid {
    pub set: Text,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawForce {
    pub set: Text,
    pub total_n: Spanned<Exactly<3>>,
    pub(crate) smooth_s: TimeRows<2>,
    pub(crate) linear_s: TimeRows<2>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGravity {
    pub g_m_s2: Spanned<Exactly<3>>,
    pub(crate) smooth_s: TimeRows<2>,
    pub(crate) linear_s: TimeRows<2>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawObstacle {
    pub shape: Text,
    pub(crate) point_mm: Spanned<Exactly<3>>,
    pub normal: Option<Spanned<Exactly<3>>>,
    pub axis: Option<Spanned<Exactly<3>>>,
    pub radius_mm: Option<Num>,
    pub friction: Option<Num>,
    pub smooth_s_mm: TimeRows<4>,
    pub(crate) linear_s_mm: TimeRows<4>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawContact {
    pub friction: Option<Num>,
    pub edges: Option<bool>,
    pub(crate) gap_mm: Option<Num>,
    pub thickness_mm: Option<Num>,
    #[serde(default)]
    pub parts: Vec<Text>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct RawOutput {
    pub probes: Vec<Text>,
    pub stations_mm: Vec<Num>,
    pub(crate) station_parts: Vec<Text>,
    pub(crate) station_axis: Option<Spanned<Exactly<3>>>,
    pub frames: Option<bool>,
    pub pictures: Option<bool>,
    pub view: Option<Text>,
}

/// Reads the text; a TOML or type error keeps its place.
pub(super) fn read(text: &str) -> Checked<RawCase> {
    toml::from_str(text).map_err(|error| {
        let first = error.message().lines().next().unwrap_or("not valid TOML");
        FemError::Case { message: explain(first), span: error.span() }
    })
}

/// The message of the TOML reader, and what to type.
fn explain(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    if message.starts_with("unknown field")
        && let Some(wrong) = quoted.next()
    {
        let known: Vec<&str> = quoted.collect();
        return unknown("key", wrong, &known);
    }
    let help = if message.contains("expected f64") {
        "write a plain number without quotation marks; the unit is in the name of the key"
    } else if message.contains("expected i64") {
        "write a whole number without quotation marks"
    } else if message.contains("an array of length") {
        "a row of a curve is time and value, one of a motion time, x, y, z, a vector x, y, z"
    } else if message.contains("missing field `kind`") {
        "a finite element case begins with kind = \"fem\""
    } else {
        "`ibr new pillow` prints a complete case to compare with"
    };
    format!("{message}\n{help}")
}
