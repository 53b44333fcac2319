//! A comparison in x, y and z.

use crate::tables::{Table, lines};
use crate::words::{along, hold_name, misses};
use compare::study::in_space::{InSpace, SpaceErrors, SpaceHold, SpaceMarker, SpaceVariant};
use data::Provenance;
use models::Known;
use serde::Serialize;

/// What is built for planar robots alone.
const LEFT_OUT: &str =
    "Diagnosis, calibration, the paper's accuracy and P/p scaling are of planar robots and were left out.";

/// `ibr.compare.space`: `ibr compare SCENARIO DATA`, a robot with strips round the body, or data with a pressure for every supply channel
#[derive(Serialize)]
pub struct SpaceAnswer<'a> {
    /// Scenario as typed, or `its own`
    pub scenario: &'a str,
    /// Name of the data
    pub data: &'a str,
    /// Actuator kind
    pub actuator: &'a str,
    /// Runs
    pub runs: usize,
    /// Coordinates compared: 3, or 2 where the table has no z
    pub axes: usize,
    /// Largest distance of a measured marker from the straight body
    pub d_max_mm: f64,
    /// How the data came to be; null without about.toml
    pub provenance: Option<Provenance>,
    /// The scenario, then every addition
    pub models: Vec<SpaceModel<'a>>,
    /// Errors of the scenario over all holds
    pub overall: &'a SpaceErrors,
    /// Where it fails, in plain language
    pub where_it_fails: Vec<String>,
    /// Cautions
    pub warnings: &'a [String],
}

/// A model compared with the data in space.
#[derive(Serialize)]
pub struct SpaceModel<'a> {
    /// In words
    pub label: &'a str,
    /// How its values are known
    pub how_known: Known,
    /// Where the values come from
    pub why: &'a str,
    /// Names of effects
    pub effects: Vec<&'a str>,
    /// Errors hold by hold
    pub holds: &'a [SpaceHold],
    /// Errors over all holds
    pub overall: &'a SpaceErrors,
    /// Every marker that was seen, at every hold
    pub markers: &'a [SpaceMarker],
}

impl<'a> SpaceAnswer<'a> {
    /// Of a scenario, as typed, and what was found.
    pub fn of(scenario: &'a str, found: &'a InSpace) -> SpaceAnswer<'a> {
        let model = |v: &'a SpaceVariant| SpaceModel {
            label: &v.label,
            how_known: v.known,
            why: &v.why,
            effects: v.scenario.effects.iter().map(|e| e.name.as_str()).collect(),
            holds: &v.holds,
            overall: &v.overall,
            markers: &v.markers,
        };
        SpaceAnswer {
            scenario,
            data: &found.dataset.name,
            actuator: &found.dataset.actuator,
            runs: found.dataset.runs.len(),
            axes: found.axes,
            d_max_mm: found.d_max_mm,
            provenance: found.about.as_ref().map(|a| a.provenance),
            models: found.variants.iter().map(model).collect(),
            overall: &found.variants[0].overall,
            where_it_fails: misses(&found.variants[0]),
            warnings: &found.warnings,
        }
    }
}

/// For readers.
pub fn text(found: &InSpace) -> String {
    let first = &found.variants[0];
    let noise = match first.overall.noise_floor_mm {
        Some(mm) => format!("noise of one coordinate of the mean {mm:.2} mm"),
        None => "one run: the noise is unknown".into(),
    };
    let mut out = format!(
        "{} held against {} in {}\n{} runs, {noise}; markers up to {:.1} mm from the straight body\n{LEFT_OUT}\n",
        first.scenario.name,
        found.dataset.name,
        if found.axes == 3 { "x, y and z" } else { "x and y" },
        found.dataset.runs.len(),
        found.d_max_mm
    );
    for variant in &found.variants {
        let (label, known, why) = (&variant.label, variant.known.word(), &variant.why);
        out += &format!("\n{label} ({known}): {why}\n{}", holds(variant, found.axes));
    }
    out + "\nWhere the scenario's model fails:\n" + &lines("  - ", misses(first))
}

fn holds(variant: &SpaceVariant, axes: usize) -> String {
    let axes = ["x, y", "x, y, z"][axes - 2];
    let of_hold = |h: &'_ SpaceHold| {
        (hold_name(h), h.errors.clone(), along(&h.tip_error_mm), format!("{:.2}", h.tip_distance_mm))
    };
    let all = ("all".to_string(), variant.overall.clone(), String::new(), String::new());
    Table::of(variant.holds.iter().map(of_hold).chain([all]))
        .words("hold", |(name, ..)| name.clone())
        .number("RMSE mm", 2, |(_, errors, ..)| errors.rmse_mm)
        .number("noise floor mm", 2, |(_, errors, ..)| errors.noise_floor_mm)
        .number("beyond noise mm", 2, |(_, errors, ..)| errors.systematic_mm)
        .number("distance mm", 2, |(_, errors, ..)| errors.rms_distance_mm)
        .right(format!("bias {axes} mm"), |(_, errors, ..)| along(&errors.bias_mm))
        .right(format!("tip error {axes} mm"), |(_, _, tip, _)| tip.clone())
        .right("tip distance mm", |(.., distance)| distance.clone())
        .text()
}
