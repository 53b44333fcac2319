//! The one grammar of charts: marks over two axes, and a legend. A figure is data; [`Chart::draw`] is its one painter.

use crate::palette::Ink;
use crate::scene::Symbol;

/// Chart as marks over two axes, with labels and legend.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Label of the horizontal axis, with unit.
    pub x_label: String,
    /// Label of the vertical axis or of the rows' names, with unit.
    pub y_label: String,
    /// Kind of the two axes, and the names of rows and columns.
    pub space: Space,
    /// Marks in the order of drawing; later ones cover earlier ones.
    pub marks: Vec<Mark>,
    /// Entries of the legend; empty for a chart without one.
    pub keys: Vec<LegendEntry>,
    /// What the colours of cells say, and the value of the strongest.
    pub heat: Option<(String, f64)>,
    /// A line below the plot; empty for none.
    pub note: String,
}

/// The two axes of a [`Chart`].
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Space {
    /// Two linear axes of numbers, each to its own scale.
    #[default]
    Plane,
    /// Two lengths to the same scale.
    Equal,
    /// Seconds and a positive number, both logarithmic.
    Log,
    /// Rows over an axis of numbers.
    Rows(Vec<ChartRow>),
    /// Rows and columns of cells, without an axis of numbers.
    Grid(Vec<ChartRow>, Vec<ChartColumn>),
}

/// A row of bars or cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChartRow {
    /// Name of the row, above its bars or next to them.
    pub name: String,
    /// Position of the name relative to the row's bars.
    pub place: RowPlace,
    /// Number of bars below each other in the row.
    pub lanes: usize,
    /// A remark about it, at the right.
    pub aside: String,
    /// Colour of the text at the right of the row.
    pub ink: Ink,
}

/// Where the name of a [`ChartRow`] is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RowPlace {
    /// In a separate line above the bars.
    #[default]
    Above,
    /// At the left of the bars, in the margin.
    Beside,
    /// Above the rows that follow; it has no marks.
    Heading,
}

impl ChartRow {
    /// A row of so many bars, with its name above them.
    pub fn above(name: &str, lanes: usize) -> ChartRow {
        ChartRow { name: name.into(), lanes, ..ChartRow::default() }
    }

    /// A row with its name on the left.
    pub fn beside(name: &str) -> ChartRow {
        ChartRow { place: RowPlace::Beside, ..ChartRow::above(name, 1) }
    }
}

/// Column of cells in a grid, with its groups.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChartColumn {
    /// Name of the column, at the top of its cells.
    pub name: String,
    /// What it and its neighbours have in common, from narrow to wide; empty for nothing.
    pub groups: [String; 2],
}

/// One mark of a [`Chart`]; numbers in the units of the axes. Values that are not finite are left out, and lift the pen of a line.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// Solid line through points, broken where one is not finite.
    Line(Vec<[f64; 2]>, Ink),
    /// Dashed line through points, broken where one is not finite.
    Dashed(Vec<[f64; 2]>, Ink),
    /// Filled outline through points, in the soft colour.
    Band(Vec<[f64; 2]>),
    /// A symbol with error bars and a label next to it.
    Point(Point),
    /// A label at the right edge, joined to its point.
    Tip([f64; 2], String, Ink),
    /// Horizontal bar in a lane of one row.
    Bar(Bar),
    /// A cell: row, column, strength of its colour from −1 to 1 (not finite: nothing is known), its text, and small words below.
    Cell([usize; 2], f64, String, String),
    /// A dashed line across all rows.
    Rule(f64),
}

/// One symbol of a [`Chart`] with error bars and a label.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Point {
    /// Position of its centre, in the units of the axes.
    pub at: [f64; 2],
    /// Half-widths of its error bars along x and y; 0 for none.
    pub error: [f64; 2],
    /// Colour of the symbol, its error bars and label.
    pub ink: Ink,
    /// Shape of the symbol, drawn open or filled.
    pub symbol: Symbol,
    /// Whether only its rim is drawn.
    pub open: bool,
    /// Text next to the symbol; empty for none.
    pub label: String,
}

/// One horizontal bar of a [`Chart`] with rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bar {
    /// Index of its row in [`Space::Rows`].
    pub row: usize,
    /// Which of the row's bars below each other.
    pub lane: usize,
    /// Start and end of the bar, in the unit of the axis.
    pub span: [f64; 2],
    /// Colour of the bar, before its opacity.
    pub ink: Ink,
    /// Opacity, 0 to 1; the one of a change, e.g., is pale.
    pub alpha: f64,
    /// Lower and upper end of its range, if one is known.
    pub range: Option<[f64; 2]>,
    /// The text at its end, or in it.
    pub text: String,
    /// Whether the text is drawn in the bar, where there is room.
    pub inside: bool,
}

impl Bar {
    /// A solid bar from zero in its row.
    pub fn to(row: usize, value: f64, ink: Ink, text: String) -> Bar {
        Bar { row, ink, text, ..Bar::over(row, [0.0, value]) }
    }

    /// A solid bar over a span.
    pub fn over(row: usize, span: [f64; 2]) -> Bar {
        Bar { row, span, alpha: 1.0, ..Bar::default() }
    }
}

/// One entry of the legend: a sample and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry {
    /// Kind of sample that the legend shows.
    pub look: KeyLook,
    /// Colour of the sample, the one of the series.
    pub ink: Ink,
    /// Name of the series in the legend.
    pub name: String,
}

/// How a [`LegendEntry`] shows a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyLook {
    /// Solid line, the sample of [`Mark::Line`].
    Line,
    /// Dashed line, the sample of [`Mark::Dashed`].
    Dashed,
    /// Symbol alone; `true` where only its rim is drawn.
    Symbol(Symbol, bool),
    /// Filled symbol with error bars, for measured values.
    Measured(Symbol),
    /// A symbol, open or filled, on a line.
    SymbolLine(Symbol, bool),
    /// Filled rectangle, the sample of bars and bands.
    Patch,
}

impl LegendEntry {
    /// Makes an entry of the legend from sample, colour and name.
    pub fn new(look: KeyLook, ink: Ink, name: &str) -> LegendEntry {
        LegendEntry { look, ink, name: name.into() }
    }
}

impl Chart {
    /// An empty chart with a title and the labels of its axes.
    pub fn new(title: impl Into<String>, x_label: impl Into<String>, y_label: impl Into<String>) -> Chart {
        Chart { title: title.into(), x_label: x_label.into(), y_label: y_label.into(), ..Chart::default() }
    }
}

impl Mark {
    /// Numbers without which there is nothing to draw.
    pub(crate) fn own(&self) -> Vec<f64> {
        match self {
            Mark::Bar(bar) => vec![bar.span[1]],
            Mark::Cell(_, strength, ..) => vec![*strength],
            Mark::Rule(_) => Vec::new(),
            other => [0, 1].map(|k| other.reach(k)).concat(),
        }
    }

    pub(crate) fn reach(&self, k: usize) -> Vec<f64> {
        match self {
            Mark::Line(points, _) | Mark::Dashed(points, _) | Mark::Band(points) => {
                points.iter().filter(|p| finite(p)).map(|p| p[k]).collect()
            }
            Mark::Point(Point { at, error, .. }) if finite(at) => {
                let half = if error[k].is_finite() { error[k] } else { 0.0 };
                vec![at[k] - half, at[k] + half]
            }
            Mark::Bar(bar) => bar.span.into_iter().chain(bar.range.into_iter().flatten()).collect(),
            Mark::Rule(value) => vec![*value],
            Mark::Point(_) | Mark::Tip(..) | Mark::Cell(..) => Vec::new(),
        }
    }
}

pub(crate) fn finite(point: &[f64; 2]) -> bool {
    point.iter().all(|v| v.is_finite())
}
