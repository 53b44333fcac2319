//! Charts of reports, drawn once and given out as SVG and PNG.
//!
//! Every chart is a plain struct of finished numbers in display units (mm, kPa, …) and one function that draws it.
//! Plots read reports, never models: nothing here knows a model or a dataset. Non-finite values are left out of lines
//! and shown as "–" in cells and bars; a chart with nothing left is [`PlotError::NothingToDraw`].
//! The drawings are 520 design pixels wide, so that text stays readable at 360 px (9 px) and at 1200 px.

mod axis;
mod bars;
mod breakdown;
mod frame;
mod ladder;
mod ledger;
mod lines;
mod paint;
mod palette;
mod place;
mod ranking;
mod residual_map;
mod scene;
mod shapes;
#[cfg(test)]
mod tests;
mod text;
mod tornado;
mod tradeoff;

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

/// How a number came to be known; every report keeps these apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// Measured by the user or in the named dataset.
    Measured,
    /// Printed in a publication.
    Published,
    /// Taken as likely, without a measurement.
    Assumed,
    /// Fitted to named data.
    Calibrated,
    /// Computed from inputs that were not fitted to what it is compared with.
    Predicted,
}

impl Known {
    /// The word used in tables and plots.
    pub fn word(self) -> &'static str {
        match self {
            Known::Measured => "measured",
            Known::Published => "published",
            Known::Assumed => "assumed",
            Known::Calibrated => "calibrated",
            Known::Predicted => "predicted",
        }
    }

    fn role(self) -> palette::Role {
        match self {
            Known::Measured => palette::Role::Ink,
            Known::Published => palette::Role::Series(5),
            Known::Assumed => palette::Role::Series(4),
            Known::Calibrated => palette::Role::Series(3),
            Known::Predicted => palette::Role::Series(0),
        }
    }
}

/// What can go wrong when drawing.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
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
    /// The embedded font could not be read.
    #[error("the embedded font cannot be read: rebuild the program")]
    Font,
    /// The drawing library failed.
    #[error("the plot cannot be drawn: {0}")]
    Drawing(String),
}

/// Errors unless `found == expected`.
fn same_length(chart: &'static str, what: &'static str, expected: usize, found: usize) -> Result<(), PlotError> {
    if expected == found { Ok(()) } else { Err(PlotError::Length { chart, what, expected, found }) }
}

/// Errors if `found > most`.
fn at_most(chart: &'static str, what: &'static str, most: usize, found: usize) -> Result<(), PlotError> {
    if found <= most { Ok(()) } else { Err(PlotError::TooMany { chart, what, most, found }) }
}
