//! The page of a climb: one effect after the other until what is left is noise.

use super::diagnosis_figures::waterfall;
use super::{Files, Imprint, PageError};
use ::compare::diagnosis::ErrorRung;
use serde_json::json;

/// A climb from bare to extended, and what was found on each step.
pub struct LadderPage<'a> {
    /// Title.
    pub title: String,
    /// The answer in a paragraph.
    pub lead: String,
    /// Errors.
    pub rungs: &'a [ErrorRung],
    /// Noise of the mean \[mm\].
    pub floor_mm: Option<f64>,
    /// What was found on each step, in words.
    pub told: Vec<String>,
    /// Scenario and data as typed.
    pub typed: [&'a str; 2],
    /// Data that were fitted along, as typed.
    pub also: &'a [String],
}

/// The page of a ladder with its waterfall.
///
/// # Errors
/// What cannot be drawn.
pub fn ladder_page(page: &LadderPage, imprint: &Imprint) -> Result<Files, PageError> {
    let mut files = Files::default();
    let title = "From the model as given to the extended one";
    files.plot("waterfall", waterfall(title, page.rungs, page.floor_mm)?);
    let mut provenance = vec![["scenario", page.typed[0]], ["data", page.typed[1]]];
    provenance.extend(page.also.iter().map(|data| ["fitted along", data]));
    let values = json!({
        "title": page.title, "lead": page.lead, "rungs": page.rungs, "told": page.told, "provenance": provenance,
    });
    files.page("ladder.html", values, imprint)?;
    Ok(files)
}
