//! Errors on the way to an extended scenario.

use crate::prelude::*;
use compare::CompareError;
use compare::diagnosis::ParameterValue;
use compare::diagnosis::words::three;
use compare::extension::{Addition, ErrorStep, Extension, today};
use compare::ladder::Climb;
use fem::session::FileHash;
use std::collections::BTreeMap;

/// Errors on the way as a text table.
pub fn steps_text(steps: &[ErrorStep], noise_floor_mm: Option<f64>) -> String {
    let floor = noise_floor_mm.map_or("noise unknown with one run: root-mean-square errors".to_string(), |n| {
        format!("noise of the mean {n:.2} mm, already subtracted")
    });
    let steps = TextTable::of(steps)
        .words("model", |step| &step.model)
        .words("how known", |step| step.how_known)
        .number("training mm", 2, |step| step.training_mm)
        .number("left-out pressures mm", 2, |step| step.heldout_pressure_mm)
        .number("left-out runs mm", 2, |step| step.heldout_run_mm)
        .right("B N m²", |step| three(step.bending_nm2));
    format!("Error beyond noise ({floor})\n{}", steps.text())
}

/// Text of a climb: its steps, sentences, and warnings about their meaning.
pub fn climb_text(climb: &Climb) -> String {
    let mut out = steps_text(&climb.rungs, climb.noise_floor_mm);
    out += &lines("  - ", &climb.told);
    if climb.steps.len() > 1 {
        out += "Effects of earlier steps keep the values of their step; B is fitted again on each.\n";
    }
    if !climb.steps.is_empty() {
        out += "A smaller error does not prove a name: `ibr validate` tries it on data it was not fitted to.\n";
    }
    out
}

/// `ibr.ladder`: `ibr ladder SCENARIO DATA`
#[derive(Serialize)]
pub struct LadderAnswer<'a> {
    /// What was found
    #[serde(flatten)]
    pub climb: &'a Climb,
    /// Scenario as typed
    pub scenario_file: &'a str,
    /// Data as typed
    pub data: &'a str,
    /// Data that were fitted along, as typed
    pub also: &'a [String],
}

/// `ibr.add`: `ibr add SCENARIO EFFECT [DATA]`
#[derive(Serialize)]
pub struct AddAnswer<'a> {
    /// Path or name of the scenario as typed
    pub scenario_file: &'a str,
    /// SHA-256 of the scenario that was extended
    pub scenario_sha256: String,
    /// File to which the extended scenario was written
    pub written: &'a str,
    /// Effects that were added, with values and source
    pub effects: Vec<AddedEffect<'a>>,
    /// B that was written; null if it was kept
    pub bending_nm2: Option<f64>,
    /// Errors without the effect, with B calibrated
    pub before: Option<&'a ErrorStep>,
    /// Errors with the effect on the same data
    pub after: Option<&'a ErrorStep>,
    /// Errors on the way, as given first
    pub rungs: &'a [ErrorStep],
    /// Noise of the mean over runs of the data
    pub noise_floor_mm: Option<f64>,
    /// Data of the fit; null without
    pub data: Option<FileHash>,
    /// Further data to which the values were fitted
    pub also: Vec<FileHash>,
    /// Date on which the scenario was written
    pub date: String,
    /// Reasons to doubt the values or the effect
    pub warnings: &'a [String],
}

/// Effect that a scenario has gained, with its values and their source.
#[derive(Serialize)]
pub struct AddedEffect<'a> {
    /// Name of the effect in the catalogue
    pub effect: &'a str,
    /// How the values are known: `assumed` or `calibrated`
    pub how_known: &'static str,
    /// Values that were written, by their keys
    pub values: BTreeMap<&'a str, f64>,
    /// Fitted values; null for a value that was given
    pub parameters: Option<&'a [ParameterValue]>,
}

impl<'a> AddAnswer<'a> {
    /// Of an extension of a scenario, written to a file.
    ///
    /// # Errors
    /// A table that cannot be written.
    pub fn of(
        file: &'a ScenarioFile,
        evidence: &'a [Evidence],
        found: &'a Extension,
        written: &'a str,
    ) -> Result<AddAnswer<'a>, CompareError> {
        let effect = |a: &'a Addition| AddedEffect {
            effect: &a.name,
            how_known: a.basis,
            values: a.values.iter().map(|(key, value)| (key.as_str(), *value)).collect(),
            parameters: found.fitted.iter().find(|f| f.effect == a.name).map(|f| &f.parameters[..]),
        };
        let data = evidence.iter().map(|e| Ok(FileHash { name: e.name.clone(), sha256: e.sha256()? }));
        let mut data = data.collect::<Result<Vec<_>, CompareError>>()?.into_iter();
        Ok(AddAnswer {
            scenario_file: &file.name,
            scenario_sha256: file.sha256(),
            written,
            effects: found.additions.iter().map(effect).collect(),
            bending_nm2: found.bending.as_ref().map(|b| b.value),
            before: found.steps.iter().rev().nth(1),
            after: found.steps.last(),
            rungs: &found.steps,
            noise_floor_mm: found.noise_floor_mm,
            data: data.next(),
            also: data.collect(),
            date: today(),
            warnings: &found.warnings,
        })
    }
}
