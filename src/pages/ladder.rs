//! The page of a climb: one effect after the other until what is left is noise.

use super::diagnosis_figures::waterfall;
use super::{Files, Imprint, PageError};
use ::compare::extension::ErrorStep;
use ::compare::ladder::Climb;
use serde_json::{Value, json};

/// A climb from bare to extended, and what it was made of.
pub struct Climbed<'a> {
    /// What was found.
    pub climb: &'a Climb,
    /// Names of robot and dataset.
    pub names: [&'a str; 2],
    /// Scenario and data as typed.
    pub typed: [&'a str; 2],
    /// Data that were fitted along, as typed.
    pub also: &'a [String],
}

/// The page of a ladder with its waterfall, and the scenario of every step.
///
/// # Errors
/// What cannot be drawn.
pub fn ladder_page(page: &Climbed, imprint: &Imprint) -> Result<Files, PageError> {
    let Climbed { climb, names: [robot, data], typed, also } = page;
    let mut files = Files::default();
    climb.files.iter().for_each(|(name, text)| files.text(name, text.clone()));
    let title = "From the model as given to the extended one";
    files.plot("waterfall", waterfall(title, &climb.rungs, climb.noise_floor_mm)?);
    let mut provenance = vec![["scenario", typed[0]], ["data", typed[1]]];
    provenance.extend(also.iter().map(|data| ["fitted along", data]));
    let rung = |step: &ErrorStep| json!({"label": step.label(), "of": step});
    let values = json!({
        "title": format!("{robot}: one effect after the other, on {data}"), "lead": climb.ending, "told": climb.told,
        "rungs": climb.rungs.iter().map(rung).collect::<Vec<Value>>(), "provenance": provenance,
    });
    files.page("ladder.html", values, imprint)?;
    Ok(files)
}
