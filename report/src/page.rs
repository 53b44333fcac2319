//! The self-contained HTML report: inline plots, no external resource, no script, light and dark.
//!
//! A report is plain data; [`render`] turns it into one page. Every text is escaped. The only markup in a text is
//! `` `code` `` and `**bold**`. Plots given as SVG are rewritten so that they follow the colours of the page.

use crate::{ReportError, view};

/// A report, from its answer to its provenance.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// Title of the page.
    pub title: String,
    /// The answer in one paragraph.
    pub lead: String,
    /// Program and version, for example `ibr 0.2.0`.
    pub generated_by: String,
    /// Date or date and time, as it should be read.
    pub generated_on: String,
    /// The body, in order.
    pub sections: Vec<Section>,
    /// Inputs, versions, machine: shown as a list of names and values at the end.
    pub provenance: Vec<Provenance>,
}

/// One line of the provenance of a [`Report`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Provenance {
    /// What, e.g. `scenario`.
    pub name: String,
    /// Which, e.g. `cpam.toml`.
    pub value: String,
}

/// A part of a [`Report`] with its own heading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Anchor: lower-case letters, digits and hyphens, unique in the report.
    pub id: String,
    /// Heading.
    pub heading: String,
    /// Contents, in order.
    pub blocks: Vec<Block>,
}

/// A piece of a [`Section`].
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A paragraph.
    Paragraph(String),
    /// A paragraph that stands out.
    Callout {
        /// What it is.
        kind: Callout,
        /// Its text.
        text: String,
    },
    /// A table.
    Table(Table),
    /// A plot.
    Figure {
        /// Text under the plot.
        caption: String,
        /// What the plot shows, for those who cannot see it.
        alt: String,
        /// The plot, as given by [`crate::Drawn::svg`].
        svg: String,
    },
    /// A list with bullets.
    List(Vec<String>),
    /// Commands or other preformatted text.
    Code(String),
}

/// Kind of a [`Block::Callout`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Callout {
    /// What was found.
    Result,
    /// Something to know.
    Note,
    /// Something that limits what may be concluded.
    Warning,
}

/// A table; the first column names the rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Text above the table.
    pub caption: String,
    /// Columns from left to right.
    pub columns: Vec<Column>,
    /// Cells by row; each row has one cell per column.
    pub rows: Vec<Vec<String>>,
    /// Index of the column "how do we know", whose words measured, published, assumed, calibrated and predicted are
    /// shown as coloured tags.
    pub how_column: Option<usize>,
}

/// Head of a column of a [`Table`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Column {
    /// Name of the quantity.
    pub heading: String,
    /// Unit, without brackets; empty for none.
    pub unit: String,
    /// Side to which cells are flush.
    pub align: Align,
}

/// Alignment of a [`Column`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Align {
    /// Words.
    #[default]
    Left,
    /// Numbers.
    Right,
    /// Marks.
    Centre,
}

const TEMPLATE: &str = include_str!("../templates/page.html");

/// The report as one HTML page.
///
/// Errors: a bad section id, a row of the wrong length, an SVG that is not one of this crate's plots.
pub fn render(report: &Report) -> Result<String, ReportError> {
    let page = minijinja::value::Serde(view::page(report)?);
    Ok(minijinja::Environment::new().render_named_str("report.html", TEMPLATE, page)?)
}
