//! Pages and files made of results: one report and the plots and tables beside it.

mod characterize;
mod compare_page;
mod demo_page;
mod diagnosis_figures;
mod diagnosis_page;
#[cfg(test)]
mod diagnosis_tests;
mod diagnosis_words;
mod engine_figures;
mod engines_page;
mod figures;
mod ladder_page;
mod residual_figure;
mod run_plots;
mod tables;
mod uncertain;

pub use characterize::pictures;
pub use compare_page::compare_page;
pub use demo_page::demo_page;
pub use diagnosis_page::{DIAGNOSIS_PICTURES, Diagnosed, diagnosis_page, diagnosis_sections};
pub use engine_figures::parting_plot;
pub use engines_page::{engine_sections, engines_page};
pub use figures::tradeoff as tradeoff_plot;
pub use ladder_page::{LadderPage, ladder_page};
pub use run_plots::{mesh_plot, run_plots};
pub use uncertain::{marker_intervals, what_to_measure};

use report::Drawn;
use report::page::{Report, render};

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
    fn table(&mut self, name: &str, table: data::Table) -> Result<(), PageError> {
        let mut csv = Vec::new();
        table.to_csv(&mut csv)?;
        self.files.push((format!("{name}.csv"), csv));
        self.parquet.push((format!("{name}.parquet"), table));
        Ok(())
    }

    fn report(&mut self, report: &Report) -> Result<(), PageError> {
        let page = render(report).map_err(PageError::from)?;
        self.text("report.html", page);
        Ok(())
    }
}

/// What can go wrong when a page is made.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// A model without equilibrium, or data that were refused.
    #[error(transparent)]
    Compare(#[from] compare::CompareError),
    /// What cannot be drawn.
    #[error(transparent)]
    Report(#[from] report::ReportError),
}

impl From<data::DataError> for PageError {
    fn from(error: data::DataError) -> PageError {
        PageError::Compare(error.into())
    }
}

impl From<models::Unsolved> for PageError {
    fn from(error: models::Unsolved) -> PageError {
        PageError::Compare(error.into())
    }
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
