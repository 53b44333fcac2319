//! Pages and files made of results: one report with its plots and tables. Words stand in the templates of `report`.

mod characterize;
mod compare;
mod demo;
mod design;
mod diagnosis;
mod diagnosis_figures;
#[cfg(test)]
mod diagnosis_tests;
mod engine_figures;
mod engines;
mod figures;
mod ladder;
mod moment_figure;
mod one_number;
mod pattern;
mod predicted;
mod residual_figure;
mod run_plots;
mod sweep;
mod tables;
mod tracks;
mod uncertain;

use crate::words::effect;
pub(crate) use characterize::characterized_files;
pub use compare::{compare_files, compare_page};
pub(crate) use demo::demo_page;
pub use demo::demo_plots;
pub(crate) use design::design_files;
pub(crate) use diagnosis::diagnosis_pictures;
pub use diagnosis::{Diagnosed, diagnosis_page, diagnosis_plots};
pub(crate) use engine_figures::parting_plot;
pub(crate) use engines::engines_page;
use fem::session::Maker;
pub use figures::measured;
pub(crate) use figures::tradeoff as tradeoff_plot;
pub use ladder::{Climbed, ladder_page};
pub(crate) use one_number::one_number_files;
pub(crate) use pattern::pattern_sheet;
pub use predicted::predicted_files;
use report::Drawn;
pub(crate) use run_plots::mesh_plot;
pub use run_plots::run_plots;
use serde::Serialize;
use serde_json::{Map, Value};
pub(crate) use sweep::{sweep_picture_names, sweep_pictures};
pub use tables::residuals;
pub(crate) use tracks::{clock_plot, tracks_plot};
pub(crate) use uncertain::{marker_intervals, what_to_measure};

/// Files of one result, in memory until all are done; the report is last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Files {
    /// Name and contents of each file, in the order of writing.
    pub files: Vec<(String, Vec<u8>)>,
    /// File name and table, written as Parquet.
    pub parquet: Vec<(String, data::Table)>,
    /// Files that an earlier result of this kind may have and this one may not; they go with it.
    pub retired: Vec<String>,
}

impl Files {
    /// Adds a plot as `<name>.svg` and `<name>.png`.
    pub fn plot(&mut self, name: &str, drawn: Drawn) {
        self.files.push((format!("{name}.svg"), drawn.svg.into_bytes()));
        self.files.push((format!("{name}.png"), drawn.png));
    }

    pub(crate) fn retire(&mut self, pictures: &[&str]) {
        self.retired = pictures.iter().flat_map(|name| ["svg", "png"].map(|kind| format!("{name}.{kind}"))).collect();
    }

    /// Adds a text file under this name.
    pub fn text(&mut self, name: &str, text: String) {
        self.files.push((name.to_string(), text.into_bytes()));
    }

    fn csv(&mut self, name: &str, table: &data::Table) -> Result<()> {
        let mut csv = Vec::new();
        table.to_csv(&mut csv)?;
        self.files.push((format!("{name}.csv"), csv));
        Ok(())
    }

    /// Adds a table as `<name>.csv` and `<name>.parquet`.
    fn table(&mut self, name: &str, table: data::Table) -> Result<()> {
        self.csv(name, &table)?;
        self.parquet.push((format!("{name}.parquet"), table));
        Ok(())
    }

    /// Adds the page of a template, with the plots that were added before.
    fn page(&mut self, template: &str, values: Values, maker: &Maker) -> Result<()> {
        let Maker { program, date, machine, .. } = maker;
        let values = Values::new().with("program", program).with("date", date).with("machine", machine).and(values);
        let svg = |(name, bytes): &(String, Vec<u8>)| {
            Some((name.strip_suffix(".svg")?.to_string(), String::from_utf8(bytes.clone()).ok()?))
        };
        let page = report::page::render(template, &values, self.files.iter().filter_map(svg).collect())?;
        self.text("report.html", page);
        Ok(())
    }
}

#[derive(Debug, Clone, Default, Serialize)]
#[serde(transparent)]
pub(crate) struct Values(Map<String, Value>);

impl Values {
    fn new() -> Values {
        Values::default()
    }

    fn of(result: &impl Serialize) -> Values {
        match serde_json::to_value(result) {
            Ok(Value::Object(fields)) => Values(fields),
            _ => Values::default(),
        }
    }

    /// One more. Numbers that are not finite are none.
    fn with(mut self, name: &str, value: impl Serialize) -> Values {
        self.0.insert(name.into(), serde_json::to_value(value).unwrap_or_default());
        self
    }

    /// Further ones; those that are there stay.
    fn and(mut self, further: Values) -> Values {
        further.0.into_iter().for_each(|(name, value)| _ = self.0.entry(name).or_insert(value));
        self
    }
}

type Result<T, E = PageError> = std::result::Result<T, E>;

/// What can go wrong when a page is made.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// A model without equilibrium, or data that were refused.
    #[error(transparent)]
    Compare(#[from] ::compare::CompareError),
    /// A chart or a page that cannot be drawn from these results.
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

const PAPER: &str = "du Pasquier, Jeong, Okamura, IEEE RA-L 2023, doi 10.1109/LRA.2023.3320010";
