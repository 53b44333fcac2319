//! Charts of reports, drawn once and given out as SVG and PNG.
//!
//! Every chart is a plain struct of finished numbers in display units (mm, kPa, …) and one function that draws it.
//! Plots read reports, never models: nothing here knows a model or a dataset. Non-finite values are left out of lines
//! and shown as "–" in cells and bars; a chart with nothing left is [`ReportError::NothingToDraw`].
//! The drawings are 520 design pixels wide, so that text stays readable at 360 px (9 px) and at 1200 px.

mod axis;
mod bars;
mod breakdown;
#[cfg(test)]
mod chart_tests;
mod frame;
mod ladder;
mod ledger;
mod lines;
mod markup;
pub mod page;
#[cfg(test)]
mod page_tests;
mod paint;
mod palette;
mod place;
mod ranking;
mod residual_map;
mod scene;
mod shapes;
mod svg;
mod text;
mod tornado;
mod tradeoff;
mod view;

pub use bars::{BarSeries, Bars, bars};
pub use breakdown::{Breakdown, BreakdownCell, breakdown};
pub use ladder::{Ladder, LadderStep, LadderTarget, ladder};
pub use ledger::{Ledger, LedgerCase, ledger};
pub use lines::{LineSeries, LineStyle, Lines, lines};
pub use palette::{Theme, css_variables, with_css_variables};
pub use ranking::{RankClass, Ranking, RankingRow, ranking};
pub use residual_map::{MapHold, MapPanel, ResidualMap, residual_map};
pub use shapes::{MeasuredPoint, ShapePose, Shapes, shapes};
pub use tornado::{Tornado, TornadoBar, tornado};
pub use tradeoff::{Tradeoff, TradeoffPoint, tradeoff};

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
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// There is no finite value.
    #[error("nothing to draw in the {chart} plot: give it at least one finite value")]
    NothingToDraw {
        /// Name of the chart.
        chart: &'static str,
    },
    /// A value is too large to be meant.
    #[error("a value of {value:e} in the {chart} plot is beyond 1e15: check its unit")]
    TooLarge {
        /// Name of the chart.
        chart: &'static str,
        /// The largest magnitude found.
        value: f64,
    },
    /// Two lists that belong together differ in length.
    #[error("the {chart} plot has {found} {what} where {expected} are needed: give one per entry")]
    Length {
        /// Name of the chart.
        chart: &'static str,
        /// What is counted.
        what: &'static str,
        /// Needed number.
        expected: usize,
        /// Given number.
        found: usize,
    },
    /// More entries than can be told apart in one plot.
    #[error("the {chart} plot has {found} {what}, at most {most} fit: split it into several plots")]
    TooMany {
        /// Name of the chart.
        chart: &'static str,
        /// What is counted.
        what: &'static str,
        /// Largest number accepted.
        most: usize,
        /// Given number.
        found: usize,
    },
    /// A section's anchor is empty, used twice or has other characters than allowed.
    #[error("section id `{id}` is empty, repeated or has other characters than a-z, 0-9 and -: rename it")]
    Id {
        /// The anchor.
        id: String,
    },
    /// A row does not fit its table.
    #[error("row {row} of table `{caption}` has {found} cells for {expected} columns: give one cell per column")]
    Cells {
        /// Caption of the table.
        caption: String,
        /// Row, counted from 1.
        row: usize,
        /// Number of columns.
        expected: usize,
        /// Number of cells.
        found: usize,
    },
    /// A plot holds something that a plot of this crate cannot hold.
    #[error("figure `{caption}` is not a plot this program draws ({reason}): pass the SVG of a plot unchanged")]
    Svg {
        /// Caption of the figure.
        caption: String,
        /// What was found.
        reason: String,
    },
    /// The page template failed.
    #[error("the report page cannot be filled in: {0}")]
    Template(#[from] minijinja::Error),
    /// The embedded font could not be read.
    #[error("the embedded font cannot be read: rebuild the program")]
    Font,
    /// The drawing library failed.
    #[error("the plot cannot be drawn: {0}")]
    Drawing(String),
}

/// Errors unless `found == expected`.
fn same_length(chart: &'static str, what: &'static str, expected: usize, found: usize) -> Result<(), ReportError> {
    if expected == found { Ok(()) } else { Err(ReportError::Length { chart, what, expected, found }) }
}

/// Errors if `found > most`.
fn at_most(chart: &'static str, what: &'static str, most: usize, found: usize) -> Result<(), ReportError> {
    if found <= most { Ok(()) } else { Err(ReportError::TooMany { chart, what, most, found }) }
}
