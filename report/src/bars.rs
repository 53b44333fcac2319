//! Grouped bars, e.g. predicted beside published displacement for each actuator.

use crate::axis::{Axis, common_decimals, extent, number};
use crate::frame::{Entry, Frame, Key, RIM, TEXT, legend, title};
use crate::ladder::LadderTarget;
use crate::palette::Role;
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, same_length, text};

const CHART: &str = "bars";
const BAR: f64 = 17.0;
const MOST: usize = 120;

/// Horizontal bars in groups, with the number at the end of each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bars {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Axis label with unit, e.g. `largest displacement [mm]`.
    pub value_label: String,
    /// Names of the groups.
    pub groups: Vec<String>,
    /// One bar per group and series.
    pub series: Vec<BarSeries>,
    /// A value to compare with, as a dashed line.
    pub target: Option<LadderTarget>,
}

/// One series of [`Bars`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BarSeries {
    /// Name in the legend.
    pub name: String,
    /// One value per group, in the unit of the axis; non-finite values show "–".
    pub values: Vec<f64>,
    /// Half-widths of error bars, one per group, or empty for none.
    pub half_width: Vec<f64>,
    /// Draw in grey, for what was measured or published.
    pub reference: bool,
}

/// Draws grouped horizontal bars from zero.
///
/// Errors: no finite value, a series whose length differs from the groups, over 120 bars, values beyond 1e15.
pub fn bars(data: &Bars) -> Result<Drawn, ReportError> {
    at_most(CHART, "bars", MOST, data.groups.len().saturating_mul(data.series.len()))?;
    for series in &data.series {
        same_length(CHART, "values in a series", data.groups.len(), series.values.len())?;
        if !series.half_width.is_empty() {
            same_length(CHART, "error bars in a series", data.groups.len(), series.half_width.len())?;
        }
    }
    let mut x = axis(data)?;
    x.pixels = [RIM + 2.0, WIDTH - RIM - room_for_values(data)];
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title);
    let top = legend(&mut scene, top, &keys(data)) + 2.0;
    let group = 26.0 + BAR * data.series.len() as f64 + 8.0;
    let frame = Frame { x, y: Axis::exact([0.0, 1.0]) };
    frame.x_axis(&mut scene, &data.value_label, [top, top + group * data.groups.len() as f64]);
    if let Some(value) = target(data) {
        let at = frame.x.at(value);
        let bottom = top + group * data.groups.len() as f64;
        scene.dashed(&[[at, top], [at, bottom]], Role::Ink, 1.6, [6.0, 3.5]);
    }
    for (i, name) in data.groups.iter().enumerate() {
        draw_group(&mut scene, &frame, data, (i, name), top + group * i as f64);
    }
    paint::paint(&scene)
}

fn half_width(series: &BarSeries, group: usize) -> f64 {
    series.half_width.get(group).copied().filter(|half| half.is_finite()).map_or(0.0, f64::abs)
}

fn axis(data: &Bars) -> Result<Axis, ReportError> {
    extent(all_values(data), CHART)?;
    let ends = data.series.iter().flat_map(|series| {
        series.values.iter().enumerate().flat_map(|(i, v)| [v - half_width(series, i), v + half_width(series, i)])
    });
    Axis::linear(ends.chain(target(data)).chain([0.0]), CHART)
}

fn target(data: &Bars) -> Option<f64> {
    data.target.as_ref().map(|t| t.value).filter(|v| v.is_finite())
}

fn all_values(data: &Bars) -> impl Iterator<Item = f64> + '_ {
    data.series.iter().flat_map(|series| series.values.iter().copied())
}

/// Decimals that suit the largest value, the same for every bar.
fn decimals(data: &Bars) -> usize {
    common_decimals(all_values(data).filter(|v| v.is_finite()).fold(0.0, |a, b| f64::max(a, b.abs())))
}

fn room_for_values(data: &Bars) -> f64 {
    let digits = decimals(data);
    all_values(data).map(|v| text::width(&number(v, digits), TEXT)).fold(0.0, f64::max) + 6.0
}

/// Colour of a series: grey for references, else the next series colour.
fn role(data: &Bars, series: usize) -> Role {
    if data.series[series].reference {
        return Role::Muted;
    }
    Role::Series(data.series[..series].iter().filter(|other| !other.reference).count())
}

fn keys(data: &Bars) -> Vec<Entry> {
    let entry =
        |(i, series): (usize, &BarSeries)| Entry { key: Key::Patch, role: role(data, i), name: series.name.clone() };
    let line = data.target.iter().filter(|t| t.value.is_finite());
    let line = line.map(|t| Entry { key: Key::Dashed, role: Role::Ink, name: t.label.clone() });
    data.series.iter().enumerate().map(entry).chain(line).collect()
}

fn draw_group(scene: &mut Scene, frame: &Frame, data: &Bars, (group, name): (usize, &String), top: f64) {
    let name = text::fit(name, TEXT, WIDTH - 2.0 * RIM);
    scene.rect([RIM, top + 5.0], [RIM + 5.0 + text::width(&name, TEXT), top + 23.0], Role::Paper, 1.0);
    scene.text([RIM + 2.0, top + 19.0], &name, TEXT, Role::Ink, Anchor::Start);
    let zero = frame.x.at(0.0);
    for (i, series) in data.series.iter().enumerate() {
        let (y0, y1) = (top + 26.0 + BAR * i as f64, top + 24.0 + BAR * (i + 1) as f64);
        let (value, middle) = (series.values[group], 0.5 * (y0 + y1));
        let mut right = zero;
        if value.is_finite() {
            let at = frame.x.at(value);
            scene.rect([zero, y0], [at, y1], role(data, i), 1.0);
            right = right.max(at);
            let half = (frame.x.at(half_width(series, group)) - zero).abs();
            if half > 0.5 {
                scene.error_bar_on_fill([at, middle], half);
                right = right.max(at + half);
            }
        }
        let shown = number(value, decimals(data));
        scene.rect([right + 3.0, y0], [right + 8.0 + text::width(&shown, TEXT), y1], Role::Paper, 1.0);
        scene.text_mid([right + 6.0, middle], &shown, TEXT, Role::Ink, Anchor::Start);
    }
}
