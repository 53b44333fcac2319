//! Pages and files made of results: one report and the plots and tables beside it.

mod compare_page;
mod demo_page;
mod diagnosis_figures;
mod diagnosis_page;
#[cfg(test)]
mod diagnosis_tests;
mod diagnosis_words;
mod engine_figures;
mod engine_lines;
mod engines_page;
mod figures;
mod ladder_page;
mod residual_figure;
mod tables;

pub use compare_page::{Candidate, Study, Variant, compare_page, study};
pub use demo_page::{Demo, Story, demo, demo_page};
pub use diagnosis_figures::ErrorRung;
pub use diagnosis_page::{DIAGNOSIS_PICTURES, Diagnosed, diagnosis_page, diagnosis_sections};
pub use engine_figures::parting_plot;
pub use engine_lines::{EngineLine, HEADS, SUMMARY, VOLUMES, VOLUMES_CAPTION, cells, lines, summary, volume_cells};
pub use engines_page::{EngineRobot, Engines, PartingMap, engine_sections, engines, engines_page, varied};
pub use figures::tradeoff as tradeoff_plot;
pub use ladder_page::{LadderPage, ladder_page};

use crate::error::CompareError;
use crate::plots::Drawn;
use crate::report::{Report, render};

/// Files of one result, in memory until all are done; the report is last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Files {
    /// File name and contents.
    pub files: Vec<(String, Vec<u8>)>,
    /// File name and table, written as Parquet.
    pub parquet: Vec<(String, data::Table)>,
}

impl Files {
    /// Adds a plot as `<name>.svg` and `<name>.png`.
    pub fn plot(&mut self, name: &str, drawn: &Drawn) {
        self.files.push((format!("{name}.svg"), drawn.svg.clone().into_bytes()));
        self.files.push((format!("{name}.png"), drawn.png.clone()));
    }

    /// Adds a text.
    pub fn text(&mut self, name: &str, text: String) {
        self.files.push((name.to_string(), text.into_bytes()));
    }

    /// Adds a table as `<name>.csv` and `<name>.parquet`.
    fn table(&mut self, name: &str, table: data::Table) -> Result<(), CompareError> {
        let mut csv = Vec::new();
        table.to_csv(&mut csv)?;
        self.files.push((format!("{name}.csv"), csv));
        self.parquet.push((format!("{name}.parquet"), table));
        Ok(())
    }

    fn report(&mut self, report: &Report) -> Result<(), CompareError> {
        let page = render(report).map_err(|e| drawing("the report", e))?;
        self.text("report.html", page);
        Ok(())
    }
}

fn drawing(what: &str, problem: impl std::fmt::Display) -> CompareError {
    CompareError::Drawing { what: what.to_string(), problem: problem.to_string() }
}

/// What every page says about its origin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Imprint {
    /// Program and version.
    pub program: String,
    /// Date.
    pub date: String,
    /// Machine in words, for timings.
    pub machine: String,
}
