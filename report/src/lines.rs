//! General x–y lines and points, e.g. tip against pressure on loading and unloading.

use crate::axis::Axis;
use crate::frame::{AxisLabels, Entry, Frame, Key, RIM, Room, legend, title};
use crate::palette::{Role, SERIES};
use crate::scene::{Point, Scene, Symbol};
use crate::{Drawn, ReportError, at_most, paint, same_length};

const CHART: &str = "lines";
const MOST: usize = 24;

/// Several series over common axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lines {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Label of the x axis with unit, e.g. `actuator pressure [kPa]`.
    pub x_label: String,
    /// Label of the y axis with unit, e.g. `tip displacement [mm]`.
    pub y_label: String,
    /// Up to 24 series.
    pub series: Vec<LineSeries>,
}

/// One series of [`Lines`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineSeries {
    /// Name in the legend; empty for none.
    pub name: String,
    /// Points x, y in the units of the axes; a non-finite point breaks the line.
    pub points: Vec<[f64; 2]>,
    /// Half-widths of error bars along y, one per point, or empty for none.
    pub half_width: Vec<f64>,
    /// How it is drawn.
    pub style: LineStyle,
    /// Colour number, so that related series (load and unload) can share one; the default is its place in the list.
    pub colour: Option<usize>,
}

/// How a [`LineSeries`] is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LineStyle {
    /// Solid line.
    #[default]
    Line,
    /// Dashed line.
    Dashed,
    /// Filled symbols.
    Points,
    /// Open symbols.
    OpenPoints,
    /// Solid line with filled symbols.
    LinePoints,
}

/// Draws the series under a legend.
///
/// Errors: no finite point, error bars that do not match the points, over 24 series, values beyond 1e15.
pub fn lines(data: &Lines) -> Result<Drawn, ReportError> {
    at_most(CHART, "series", MOST, data.series.len())?;
    for series in data.series.iter().filter(|series| !series.half_width.is_empty()) {
        same_length(CHART, "error bars in a series", series.points.len(), series.half_width.len())?;
    }
    let (x, y) = axes(data)?;
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title);
    let top = legend(&mut scene, top, &keys(data));
    let room = Room { top, height: 270.0, right: RIM + 8.0, equal: false };
    let labels = AxisLabels { x: &data.x_label, y: &data.y_label };
    let frame = Frame::draw(&mut scene, x, y, &labels, &room);
    let zero = frame.y.at(0.0);
    if zero > frame.y.pixels[1] && zero < frame.y.pixels[0] - 1.0 {
        scene.line(&[[frame.x.pixels[0], zero], [frame.x.pixels[1], zero]], Role::Axis, 1.2);
    }
    for (i, series) in data.series.iter().enumerate() {
        draw_lines(&mut scene, &frame, series, role(series, i));
    }
    for (i, series) in data.series.iter().enumerate() {
        draw_points(&mut scene, &frame, series, (role(series, i), symbol(series, i)));
    }
    paint::paint(&scene)
}

fn finite(point: &[f64; 2]) -> bool {
    point[0].is_finite() && point[1].is_finite()
}

fn half_width(series: &LineSeries, i: usize) -> f64 {
    series.half_width.get(i).copied().filter(|half| half.is_finite()).map_or(0.0, f64::abs)
}

fn axes(data: &Lines) -> Result<(Axis, Axis), ReportError> {
    let points = || data.series.iter().flat_map(|series| series.points.iter().enumerate().map(move |p| (series, p)));
    let shown = || points().filter(|(_, (_, point))| finite(point));
    let x = Axis::linear(shown().map(|(_, (_, point))| point[0]), CHART)?;
    let ends = shown().flat_map(|(series, (i, p))| [p[1] - half_width(series, i), p[1] + half_width(series, i)]);
    Ok((x, Axis::linear(ends, CHART)?))
}

fn role(series: &LineSeries, i: usize) -> Role {
    Role::Series(series.colour.unwrap_or(i))
}

fn symbol(series: &LineSeries, i: usize) -> Symbol {
    // Colours come again after a while, then with other symbols.
    let colour = series.colour.unwrap_or(i);
    Symbol::of(colour + colour / SERIES)
}

fn keys(data: &Lines) -> Vec<Entry> {
    let key = |series: &LineSeries, i: usize| match series.style {
        LineStyle::Line => Key::Line,
        LineStyle::Dashed => Key::Dashed,
        LineStyle::Points if !series.half_width.is_empty() => Key::Measured(symbol(series, i)),
        LineStyle::Points => Key::Symbol(symbol(series, i), false),
        LineStyle::OpenPoints => Key::Symbol(symbol(series, i), true),
        LineStyle::LinePoints => Key::SymbolLine(symbol(series, i), false),
    };
    let named = data.series.iter().enumerate().filter(|(_, series)| !series.name.trim().is_empty());
    named.map(|(i, series)| Entry { key: key(series, i), role: role(series, i), name: series.name.clone() }).collect()
}

fn draw_lines(scene: &mut Scene, frame: &Frame, series: &LineSeries, role: Role) {
    if matches!(series.style, LineStyle::Points | LineStyle::OpenPoints) {
        return;
    }
    for part in series.points.split(|point| !finite(point)) {
        let path: Vec<Point> = part.iter().map(|p| [frame.x.at(p[0]), frame.y.at(p[1])]).collect();
        match series.style {
            LineStyle::Dashed => scene.dashed(&path, role, 2.2, [7.0, 4.5]),
            _ => scene.line(&path, role, 2.2),
        }
        if let ([only], true) = (&path[..], series.style != LineStyle::LinePoints) {
            scene.symbol(Symbol::Circle, *only, 2.2, role, false);
        }
    }
}

fn draw_points(scene: &mut Scene, frame: &Frame, series: &LineSeries, (role, symbol): (Role, Symbol)) {
    for (i, point) in series.points.iter().enumerate().filter(|(_, point)| finite(point)) {
        let at = [frame.x.at(point[0]), frame.y.at(point[1])];
        let half = (frame.y.at(half_width(series, i)) - frame.y.at(0.0)).abs();
        if half > 0.5 {
            scene.error_bar(at, half, true, role);
        }
        match series.style {
            LineStyle::Points | LineStyle::LinePoints => scene.symbol(symbol, at, 4.2, role, false),
            LineStyle::OpenPoints => scene.symbol(symbol, at, 5.0, role, true),
            LineStyle::Line | LineStyle::Dashed => {}
        }
    }
}
