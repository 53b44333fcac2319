//! Figures that several pages have, as charts.

use crate::axis::{common_decimals, number, short_number};
use crate::chart::{Bar, Chart, ChartRow, KeyLook, LegendEntry, Mark, Point, Space, finite};
use crate::palette::{Ink, SERIES};
use crate::scene::Symbol;
use crate::{Drawn, ReportError, at_most, same_length};

/// Most series, poses, bars and cases of a figure: a reader cannot distinguish more.
const MOST_SERIES: usize = 24;
const MOST_POSES: usize = 6;
const MOST_BARS: usize = 120;
/// Series colours in the order of rising pressure, from cool to warm.
const WARMER: [usize; MOST_POSES] = [0, 2, 4, 1, 3, 5];

/// Several series over common axes, e.g. tip against pressure on loading and unloading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lines {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Label of the x axis with unit, e.g. `actuator pressure [kPa]`.
    pub x_label: String,
    /// Label of the y axis with unit, e.g. `tip displacement [mm]`.
    pub y_label: String,
    /// Series of the chart, at most 24.
    pub series: Vec<LineSeries>,
}

/// One series of [`Lines`]: points, error bars, style and colour.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineSeries {
    /// Name in the legend; empty for none.
    pub name: String,
    /// Points x, y in the units of the axes; a non-finite point breaks the line.
    pub points: Vec<[f64; 2]>,
    /// Half-widths of error bars along y, one per point, or empty for none.
    pub half_width: Vec<f64>,
    /// Style of its line and symbols.
    pub style: LineStyle,
    /// Colour number, so that related series (load and unload) can share one; the default is its place in the list.
    pub colour: Option<usize>,
}

impl Lines {
    /// Series over two axes with their labels.
    pub fn new(title: impl Into<String>, x_label: &str, y_label: &str, series: Vec<LineSeries>) -> Lines {
        Lines { title: title.into(), x_label: x_label.into(), y_label: y_label.into(), series }
    }
}

impl LineSeries {
    /// A series in the colour of its place in the list.
    pub fn new(name: impl Into<String>, style: LineStyle, points: Vec<[f64; 2]>) -> LineSeries {
        LineSeries { name: name.into(), points, style, ..LineSeries::default() }
    }

    /// Gives the series this colour number, which others may share.
    pub fn coloured(self, colour: usize) -> LineSeries {
        LineSeries { colour: Some(colour), ..self }
    }

    /// With error bars of these half-widths.
    pub fn with_errors(self, half_width: Vec<f64>) -> LineSeries {
        LineSeries { half_width, ..self }
    }
}

/// Style of the line and symbols of a [`LineSeries`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LineStyle {
    /// Solid line without symbols at its points.
    #[default]
    Line,
    /// Dashed line without symbols at its points.
    Dashed,
    /// Filled symbols at the points, without a line.
    Points,
    /// Open symbols at the points, without a line.
    OpenPoints,
    /// Solid line with a filled symbol at every point.
    LinePoints,
}

/// Draws the series.
///
/// # Errors
/// No finite point, error bars that do not match the points, over 24 series, values beyond 1e15.
pub fn lines(data: &Lines) -> Result<Drawn, ReportError> {
    at_most("lines", "series", MOST_SERIES, data.series.len())?;
    let (mut marks, mut points, mut keys) = (Vec::new(), Vec::new(), Vec::new());
    for (i, series) in data.series.iter().enumerate() {
        if !series.half_width.is_empty() {
            same_length("lines", "error bars in a series", series.points.len(), series.half_width.len())?;
        }
        // Colours come again after a while, then with other symbols.
        let colour = series.colour.unwrap_or(i);
        let (ink, symbol) = (Ink::Series(colour), Symbol::of(colour + colour / SERIES));
        let half = |k: usize| series.half_width.get(k).copied().filter(|h| h.is_finite()).map_or(0.0, f64::abs);
        let measured = !series.half_width.is_empty();
        let (line, open, look): (Option<fn(_, _) -> _>, _, _) = match series.style {
            LineStyle::Line => (Some(Mark::Line), None, KeyLook::Line),
            LineStyle::Dashed => (Some(Mark::Dashed), None, KeyLook::Dashed),
            LineStyle::Points if measured => (None, Some(false), KeyLook::Measured(symbol)),
            LineStyle::Points => (None, Some(false), KeyLook::Symbol(symbol, false)),
            LineStyle::OpenPoints => (None, Some(true), KeyLook::Symbol(symbol, true)),
            LineStyle::LinePoints => (Some(Mark::Line), Some(false), KeyLook::SymbolLine(symbol, false)),
        };
        marks.extend(line.map(|line| line(series.points.clone(), ink)));
        for (k, at) in series.points.iter().enumerate().filter(|_| open.is_some()) {
            let (at, error, open) = (*at, [0.0, half(k)], open == Some(true));
            points.push(Mark::Point(Point { at, error, ink, symbol, open, ..Point::default() }));
        }
        keys.push(LegendEntry::new(look, ink, series.name.trim()));
    }
    keys.retain(|key| !key.name.is_empty());
    marks.extend(points);
    let mut chart = Chart::new(&data.title, &data.x_label, &data.y_label);
    (chart.marks, chart.keys) = (marks, keys);
    chart.draw("lines")
}

/// Shapes of one robot in the x–y plane, x along the robot at rest. All lengths in mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shapes {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Name of the axis across the robot; empty: `y sideways [mm]`.
    pub across: String,
    /// Centre line of the unpressurised robot \[mm\].
    pub rest_mm: Vec<[f64; 2]>,
    /// Body radius, drawn as a soft band about the line at rest; 0 for none.
    pub body_radius_mm: f64,
    /// One to six poses in the order of rising pressure.
    pub poses: Vec<ShapePose>,
}

/// One pose of [`Shapes`]: centre line and markers at one pressure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShapePose {
    /// Direct label at the tip, e.g. `30 kPa`.
    pub label: String,
    /// Predicted centre line; may be empty.
    pub curve_mm: Vec<[f64; 2]>,
    /// Predicted marker positions \[mm\]; may be empty.
    pub predicted_mm: Vec<[f64; 2]>,
    /// Measured markers, each with the half-widths of its error bars along x and y, 0 for none; may be empty.
    pub measured: Vec<[[f64; 2]; 2]>,
}

/// Draws centre lines with measured and predicted markers, both axes to the same scale.
///
/// # Errors
/// Nothing finite to draw, more than six poses, values beyond 1e15.
pub fn shapes(data: &Shapes) -> Result<Drawn, ReportError> {
    at_most("shapes", "poses", MOST_POSES, data.poses.len())?;
    let mut marks = rest(data);
    let inked = || data.poses.iter().zip(WARMER.map(Ink::Series));
    marks.extend(inked().map(|(pose, ink)| Mark::Line(pose.curve_mm.clone(), ink)));
    for (pose, ink) in inked() {
        let point = |at, error, open| Mark::Point(Point { at, error, ink, open, ..Point::default() });
        marks.extend(pose.predicted_mm.iter().map(|at| point(*at, [0.0; 2], true)));
        marks.extend(pose.measured.iter().map(|[at, half]| point(*at, half.map(f64::abs), false)));
        marks.extend(tip(pose).map(|at| Mark::Tip(at, pose.label.clone(), ink)));
    }
    let some = |of: fn(&ShapePose) -> bool| data.poses.iter().any(of);
    let predicted = match (some(|p| !p.predicted_mm.is_empty()), some(|p| !p.curve_mm.is_empty())) {
        (true, true) => Some((KeyLook::SymbolLine(Symbol::Circle, true), "predicted centre line and markers")),
        (true, false) => Some((KeyLook::Symbol(Symbol::Circle, true), "predicted")),
        (false, true) => Some((KeyLook::Line, "predicted centre line")),
        (false, false) => None,
    };
    let measured = some(|p| !p.measured.is_empty()).then_some((KeyLook::Measured(Symbol::Circle), "measured"));
    let at_rest = (!data.rest_mm.is_empty()).then_some((KeyLook::Dashed, "at rest"));
    let keys = [measured, predicted, at_rest].into_iter().flatten();
    let keys = keys.map(|(look, name)| LegendEntry::new(look, Ink::Muted, name)).collect();
    let across = if data.across.is_empty() { "y sideways [mm]" } else { &data.across };
    let mut chart = Chart::new(&data.title, "x along the robot at rest [mm]", across);
    (chart.space, chart.marks, chart.keys) = (Space::Equal, marks, keys);
    chart.draw("shapes")
}

/// The body at rest and the clamp at its base.
fn rest(data: &Shapes) -> Vec<Mark> {
    let radius = if data.body_radius_mm.is_finite() { data.body_radius_mm.max(0.0) } else { 0.0 };
    let line: Vec<[f64; 2]> = data.rest_mm.iter().copied().filter(finite).collect();
    let side = |sign: f64| line.iter().map(move |p| [p[0], p[1] + sign * radius]);
    let mut marks = vec![Mark::Band(side(1.0).chain(side(-1.0).rev()).collect())];
    marks.push(Mark::Dashed(line.clone(), Ink::Muted));
    if let [[x, y], _, ..] = line[..] {
        let half = 1.15 * radius.max(1.0);
        marks.push(Mark::Line(vec![[x, y - half], [x, y + half]], Ink::Muted));
    }
    marks
}

/// The tip of a pose: end of its centre line, else its last marker.
fn tip(pose: &ShapePose) -> Option<[f64; 2]> {
    let last = |points: &[[f64; 2]]| points.iter().copied().rfind(finite);
    last(&pose.curve_mm).or_else(|| last(&pose.predicted_mm)).or_else(|| pose.measured.last().map(|m| m[0]))
}

/// Draws grouped horizontal bars from zero, e.g. predicted next to published displacement for each actuator. A series has a name, a value per
/// group (non-finite ones show "–"), and is grey if it was measured or published; the target, a name and a value, is a dashed line.
///
/// # Errors
/// No finite value, a series whose length differs from the groups, over 120 bars, values beyond 1e15.
pub fn bars(
    title: &str,
    value_label: &str,
    groups: &[String],
    series: &[(String, Vec<f64>, bool)],
    target: Option<(String, f64)>,
) -> Result<Drawn, ReportError> {
    at_most("bars", "bars", MOST_BARS, groups.len().saturating_mul(series.len()))?;
    let digits = decimals(series.iter().flat_map(|(_, values, _)| values.iter().copied()));
    let (mut marks, mut keys, mut colour) = (Vec::new(), Vec::new(), 0);
    for (lane, (name, values, grey)) in series.iter().enumerate() {
        same_length("bars", "values in a series", groups.len(), values.len())?;
        let ink = if *grey { Ink::Muted } else { Ink::Series(colour) };
        colour += usize::from(!grey);
        keys.push(LegendEntry::new(KeyLook::Patch, ink, name));
        for (row, value) in values.iter().enumerate() {
            marks.push(Mark::Bar(Bar { lane, ..Bar::to(row, *value, ink, number(*value, digits)) }));
        }
    }
    rule(target, &mut marks, &mut keys);
    let row = |name: &String| ChartRow::above(name, series.len());
    rows(title, value_label, groups.iter().map(row).collect(), marks, keys).draw("bars")
}

/// One step of a [`ladder`]: its label, value and range.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LadderStep {
    /// The added effect, e.g. `+ sealed-edge loss, η = 0.60`.
    pub label: String,
    /// Value after this step, in the unit of the axis.
    pub value: f64,
    /// Lower and upper end of its range, if one is known.
    pub range: Option<[f64; 2]>,
    /// How it is known, in a word, and the colour of that.
    pub known: (&'static str, Ink),
}

/// Draws a waterfall of a value over a growing list of effects, one row per step from the bare model on: its bar, and in pale what it
/// changes. The target, a name and a value, is a dashed line.
///
/// # Errors
/// No finite value, more than 120 steps, values beyond 1e15.
pub fn ladder(
    title: &str,
    value_label: &str,
    steps: &[LadderStep],
    target: Option<(String, f64)>,
) -> Result<Drawn, ReportError> {
    at_most("ladder", "steps", MOST_BARS, steps.len())?;
    let digits = decimals(steps.iter().map(|step| step.value));
    let (mut marks, mut keys, mut rungs, mut before) = (Vec::new(), Vec::new(), Vec::new(), None);
    for (row, step) in steps.iter().enumerate() {
        let (word, ink) = step.known;
        let change = before.map(|from: f64| step.value - from).filter(|change| change.is_finite());
        let sign = |change: f64| if change > 0.0 { "+" } else { "" };
        let change = change.map_or(String::new(), |c| format!("\u{a0}\u{a0}({}{})", sign(c), number(c, digits)));
        let text = format!("{}{change}", number(step.value, digits));
        marks.push(Mark::Bar(Bar { range: step.range, ..Bar::to(row, step.value, ink, text) }));
        if let (Some(from), true) = (before, step.value.is_finite()) {
            marks.push(Mark::Bar(Bar { ink, alpha: 0.22, ..Bar::over(row, [step.value, from]) }));
        }
        rungs.push(ChartRow { aside: word.into(), ink, ..ChartRow::above(&step.label, 1) });
        before = Some(step.value).filter(|v| v.is_finite()).or(before);
    }
    rule(target, &mut marks, &mut keys);
    rows(title, value_label, rungs, marks, keys).draw("ladder")
}

/// One bar of a [`ledger`]: the label above it, e.g. `30 kPa`, and the energy of each term \[mJ\]. Positive energies stack to the right,
/// negative ones to the left.
pub type LedgerCase = (String, Vec<f64>);

/// Draws the energy ledger: stacked bars of signed energies of up to eight terms, one bar per case, e.g. per pressure or per engine, with
/// the sum of each case at the right, which is zero when the balance closes.
///
/// # Errors
/// No finite value, a case whose length differs from the terms, over 8 terms or 24 cases.
pub fn ledger(title: &str, value_label: &str, terms: &[String], bars: &[LedgerCase]) -> Result<Drawn, ReportError> {
    at_most("ledger", "terms", SERIES, terms.len())?;
    at_most("ledger", "cases", MOST_SERIES, bars.len())?;
    let (mut marks, mut cases) = (Vec::new(), Vec::new());
    for (row, (name, energies_mj)) in bars.iter().enumerate() {
        same_length("ledger", "energies in a case", terms.len(), energies_mj.len())?;
        let mut reached = [0.0, 0.0];
        let own = energies_mj.iter().copied().enumerate().filter(|(_, energy)| energy.is_finite());
        let (mut sum, mut largest) = (0.0, 0.0_f64);
        for (term, energy) in own {
            let from = &mut reached[usize::from(energy > 0.0)];
            let (span, ink) = ([*from, *from + energy], Ink::Series(term));
            *from += energy;
            (sum, largest) = (sum + energy, largest.max(energy.abs()));
            let text = short_number(energy);
            marks.push(Mark::Bar(Bar { ink, text, inside: true, ..Bar::over(row, span) }));
        }
        let shown = if sum.abs() < 1e-4 * largest { number(0.0, 0) } else { short_number(sum) };
        cases.push(ChartRow { aside: format!("sum {shown}"), ink: Ink::Muted, ..ChartRow::above(name, 1) });
    }
    let key = |(i, name): (usize, &String)| LegendEntry::new(KeyLook::Patch, Ink::Series(i), name);
    let keys = terms.iter().enumerate().map(key).collect();
    rows(title, value_label, cases, marks, keys).draw("ledger")
}

/// Makes a chart of rows over one axis of numbers.
pub fn rows(title: &str, value_label: &str, rows: Vec<ChartRow>, marks: Vec<Mark>, keys: Vec<LegendEntry>) -> Chart {
    let mut chart = Chart::new(title, value_label, "");
    (chart.space, chart.marks, chart.keys) = (Space::Rows(rows), marks, keys);
    chart
}

/// Decimals that suit the largest of some values, the same for all.
pub fn decimals(values: impl Iterator<Item = f64>) -> usize {
    common_decimals(values.filter(|v| v.is_finite()).fold(0.0, |a, b| f64::max(a, b.abs())))
}

fn rule(target: Option<(String, f64)>, marks: &mut Vec<Mark>, keys: &mut Vec<LegendEntry>) {
    if let Some((name, value)) = target.filter(|(_, value)| value.is_finite()) {
        marks.push(Mark::Rule(value));
        keys.push(LegendEntry::new(KeyLook::Dashed, Ink::Ink, &name));
    }
}
