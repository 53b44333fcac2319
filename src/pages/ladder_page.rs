//! The page of a climb: one effect after the other until what is left is noise.

use super::PageError;
use super::diagnosis_figures::waterfall;
use super::diagnosis_page::{line, section};
use super::tables::{column, number, words};
use super::{Files, Imprint};
use compare::diagnosis::ErrorRung;
use report::page::{Block, Report, Table};

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
    let drawn = waterfall("From the model as given to the extended one", page.rungs, page.floor_mm)?;
    files.plot("waterfall", &drawn);
    let caption = "Left-out data were not in the fit of the newest values; effects of earlier steps keep theirs.";
    let blocks = vec![
        Block::Figure { caption: caption.into(), alt: "bars of error per model".into(), svg: drawn.svg },
        errors_table(page.rungs),
    ];
    let mut provenance = vec![line("scenario", page.typed[0]), line("data", page.typed[1])];
    provenance.extend(page.also.iter().map(|data| line("fitted along", data)));
    let report = Report {
        title: page.title.clone(),
        lead: page.lead.clone(),
        generated_by: imprint.program.clone(),
        generated_on: imprint.date.clone(),
        sections: vec![
            section("", "waterfall", "The fall of the error", blocks),
            section("", "steps", "Step by step", vec![Block::List(page.told.clone())]),
        ],
        provenance,
    };
    files.report(&report)?;
    Ok(files)
}

fn errors_table(rungs: &[ErrorRung]) -> Block {
    let row = |r: &ErrorRung| {
        vec![
            r.label.clone(),
            number(Some(r.training_mm), 2),
            number(r.heldout_pressure_mm, 2),
            number(r.heldout_run_mm, 2),
        ]
    };
    Block::Table(Table {
        caption: "Error beyond noise".into(),
        columns: vec![
            words("model"),
            column("data of the fit", "mm"),
            column("pressures left out", "mm"),
            column("runs left out", "mm"),
        ],
        rows: rungs.iter().map(row).collect(),
        how_column: None,
    })
}
