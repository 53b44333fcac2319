//! Charts and pages from plain structs: nothing here knows a model, a dataset or a diagnosis.
//!
//! A figure is data: a [`chart::Chart`] is marks over two axes and a legend in display units (mm, kPa, …), and one painter gives it
//! out as SVG and PNG. Non-finite values are left out of lines and shown as "–" in cells and bars; a chart with nothing left is
//! [`ReportError::NothingToDraw`]. The drawings are 520 design pixels wide, so that text stays readable at 360 px and at 1200 px.
//! A page is a template of `templates/`, which has its words, filled with plain values ([`page::render`]).

mod axis;
pub mod chart;
mod draw;
mod figures;
mod labelled;
mod markup;
pub mod page;
mod paint;
mod palette;
mod paper;
mod place;
mod plane;
mod rows;
mod scene;
pub mod sheet;
#[cfg(test)]
mod tests;
mod text;

pub use axis::{number, short_number};
pub use figures::*;
pub use labelled::labelled;
pub use palette::{Ink, colours};
pub use scene::Symbol;

/// Width of every drawing [design px].
const WIDTH: f64 = 520.0;

/// A finished plot in both formats; the caller writes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// Standalone SVG document in light colours.
    pub svg: String,
    /// PNG file, three pixels per design pixel (1560 px wide).
    pub png: Vec<u8>,
}

/// What can go wrong when drawing.
#[expect(missing_docs, reason = "fields have the words of their message")]
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// No value of the chart is finite, so it has no range.
    #[error("nothing to draw in the {chart} plot: give it at least one finite value")]
    NothingToDraw { chart: &'static str },
    /// A value is too large to be meant.
    #[error("a value of {value:e} in the {chart} plot is beyond 1e15: check its unit")]
    TooLarge { chart: &'static str, value: f64 },
    /// Two lists that belong together differ in length.
    #[error("the {chart} plot has {found} {what} where {expected} are needed: give one per entry")]
    Length { chart: &'static str, what: &'static str, expected: usize, found: usize },
    /// More entries than a reader can distinguish in one plot.
    #[error("the {chart} plot has {found} {what}, at most {most} fit: split it into several plots")]
    TooMany { chart: &'static str, what: &'static str, most: usize, found: usize },
    /// The template of the page cannot be filled in.
    #[error("the report page cannot be filled in: {0}")]
    Template(#[from] minijinja::Error),
    /// The embedded font could not be read.
    #[error("the embedded font cannot be read: rebuild the program")]
    Font,
    /// The drawing library returned an error, given here as text.
    #[error("the plot cannot be drawn: {0}")]
    Drawing(String),
}

fn same_length(chart: &'static str, what: &'static str, expected: usize, found: usize) -> Result<(), ReportError> {
    if expected == found { Ok(()) } else { Err(ReportError::Length { chart, what, expected, found }) }
}

fn at_most(chart: &'static str, what: &'static str, most: usize, found: usize) -> Result<(), ReportError> {
    if found <= most { Ok(()) } else { Err(ReportError::TooMany { chart, what, most, found }) }
}
