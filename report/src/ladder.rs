//! The effect ladder: how one number moves from the bare model towards the measured value as effects are added.

use crate::axis::{Axis, common_decimals, number};
use crate::frame::{AxisLabels, Frame, RIM, TEXT, title};
use crate::palette::Role;
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, text};

const CHART: &str = "ladder";
const ROW: f64 = 50.0;
const BAR: f64 = 17.0;
const MOST: usize = 24;

/// Waterfall of a value over a growing list of effects.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ladder {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Axis label with unit, e.g. `tip displacement [mm]`.
    pub value_label: String,
    /// Steps from the bare model on.
    pub steps: Vec<LadderStep>,
    /// What the steps should reach.
    pub target: Option<LadderTarget>,
}

/// One step of a [`Ladder`].
#[derive(Debug, Clone, PartialEq)]
pub struct LadderStep {
    /// What is added, e.g. `+ sealed-edge loss, η = 0.60`.
    pub label: String,
    /// Value after this step, in the unit of the axis.
    pub value: f64,
    /// Lower and upper end of its range, if one is known.
    pub range: Option<[f64; 2]>,
    /// How this step's parameters came to be known.
    pub known: &'static str,
}

/// Reference line of a [`Ladder`].
#[derive(Debug, Clone, PartialEq)]
pub struct LadderTarget {
    /// Label, e.g. `measured 119.4 mm` or `noise floor`.
    pub label: String,
    /// Position, in the unit of the axis.
    pub value: f64,
    /// Half-width of the band about it; 0 for none.
    pub half_width: f64,
}

/// Draws the ladder, one row per step: label and tag above, bar and change below.
///
/// Errors: no finite value, more than 24 steps, values beyond 1e15.
pub fn ladder(data: &Ladder) -> Result<Drawn, ReportError> {
    at_most(CHART, "steps", MOST, data.steps.len())?;
    if !data.steps.iter().any(|step| step.value.is_finite()) {
        return Err(ReportError::NothingToDraw { chart: CHART });
    }
    let ends = data.steps.iter().flat_map(|step| [step.value].into_iter().chain(step.range.into_iter().flatten()));
    let band = data.target.iter().flat_map(|t| [t.value - half_width(t), t.value + half_width(t)]);
    let mut x = Axis::linear(ends.chain(band).chain([0.0]), CHART)?;
    x.pixels = [RIM + 2.0, WIDTH - RIM - room_for_values(data)];
    let mut scene = Scene::new();
    let mut top = title(&mut scene, &data.title);
    if data.target.is_some() {
        top += 20.0;
    }
    let frame = Frame { x, y: Axis::exact([0.0, 1.0]) };
    let bottom = top + ROW * data.steps.len() as f64 + 6.0;
    let label = AxisLabels { x: &data.value_label, y: "" };
    frame.x_axis(&mut scene, label.x, [top, bottom]);
    target(&mut scene, &frame, data, [top, bottom]);
    let mut previous = None;
    for (i, step) in data.steps.iter().enumerate() {
        let top = top + ROW * i as f64;
        head(&mut scene, step, top + 19.0);
        bar(&mut scene, &frame, step, (previous, decimals(data)), top + 26.0);
        previous = Some(step.value).filter(|v| v.is_finite()).or(previous);
    }
    paint::paint(&scene)
}

fn half_width(target: &LadderTarget) -> f64 {
    if target.half_width.is_finite() { target.half_width.abs() } else { 0.0 }
}

/// Decimals that suit the largest value, the same for every step.
fn decimals(data: &Ladder) -> usize {
    let values = data.steps.iter().map(|step| step.value.abs());
    common_decimals(values.filter(|v| v.is_finite()).fold(0.0, f64::max))
}

fn value_text(value: f64, previous: Option<f64>, digits: usize) -> String {
    let change = previous.map(|from| value - from).filter(|change| change.is_finite());
    let sign = |change: f64| if change > 0.0 { "+" } else { "" };
    let change = change.map_or(String::new(), |c| format!("\u{a0}\u{a0}({}{})", sign(c), number(c, digits)));
    format!("{}{change}", number(value, digits))
}

fn room_for_values(data: &Ladder) -> f64 {
    let mut previous = None;
    let mut widest: f64 = 0.0;
    for step in &data.steps {
        widest = widest.max(text::width(&value_text(step.value, previous, decimals(data)), TEXT));
        previous = Some(step.value);
    }
    widest.min(200.0)
}

fn target(scene: &mut Scene, frame: &Frame, data: &Ladder, [top, bottom]: [f64; 2]) {
    let Some(target) = data.target.as_ref().filter(|target| target.value.is_finite()) else { return };
    let (at, half) = (frame.x.at(target.value), half_width(target));
    if half > 0.0 {
        let ends = [frame.x.at(target.value - half), frame.x.at(target.value + half)];
        scene.rect([ends[0], top], [ends[1], bottom], Role::Soft, 1.0);
    }
    scene.dashed(&[[at, top - 4.0], [at, bottom]], Role::Ink, 1.6, [6.0, 3.5]);
    let label = text::fit(&target.label, TEXT, WIDTH - 2.0 * RIM);
    let room = 0.5 * text::width(&label, TEXT);
    let middle = at.min(WIDTH - RIM - room).max(RIM + room);
    scene.text([middle, top - 9.0], &label, TEXT, Role::Ink, Anchor::Middle);
}

/// Bar from zero with the change since `previous` in pale, its range and its number.
fn bar(scene: &mut Scene, frame: &Frame, step: &LadderStep, (previous, digits): (Option<f64>, usize), y0: f64) {
    let y1 = y0 + BAR;
    let zero = frame.x.at(0.0);
    if !step.value.is_finite() {
        return scene.text_mid([zero + 6.0, y0 + 0.5 * BAR], "–", TEXT, Role::Muted, Anchor::Start);
    }
    let at = frame.x.at(step.value);
    scene.rect([zero, y0], [at, y1], role(step.known), 1.0);
    let mut right = at.max(zero);
    if let Some(from) = previous {
        let from = frame.x.at(from);
        scene.rect([at, y0], [from, y1], role(step.known), 0.22);
        scene.line(&[[from, y0 - 3.0], [from, y1]], Role::Muted, 1.2);
        right = right.max(from);
    }
    if let Some([low, high]) = step.range.filter(|range| range.iter().all(|v| v.is_finite())) {
        let (low, high) = (frame.x.at(low), frame.x.at(high));
        scene.error_bar_on_fill([0.5 * (low + high), 0.5 * (y0 + y1)], 0.5 * (high - low).abs());
        right = right.max(high).max(low);
    }
    let value = value_text(step.value, previous, digits);
    let (x, y) = (right + 7.0, 0.5 * (y0 + y1));
    scene.rect([x - 2.0, y0], [x + text::width(&value, TEXT) + 2.0, y1], Role::Paper, 1.0);
    scene.text_mid([x, y], &value, TEXT, Role::Ink, Anchor::Start);
}

/// Label on the left and tag on the right, on paper so that the target line does not cross them.
fn head(scene: &mut Scene, step: &LadderStep, baseline: f64) {
    let tag = step.known;
    let tag_width = text::width(tag, TEXT);
    let right = WIDTH - RIM;
    scene.text([right, baseline], tag, TEXT, role(step.known), Anchor::End);
    scene.rect([right - tag_width - 15.0, baseline - 9.0], [right - tag_width - 6.0, baseline], role(step.known), 1.0);
    let label = text::fit(&step.label, TEXT, right - RIM - tag_width - 28.0);
    let end = RIM + 2.0 + text::width(&label, TEXT);
    scene.rect([RIM, baseline - TEXT], [end + 3.0, baseline + 4.0], Role::Paper, 1.0);
    scene.text([RIM + 2.0, baseline], &label, TEXT, Role::Ink, Anchor::Start);
}

/// The colour of a word that says how a number is known.
fn role(known: &str) -> Role {
    match known {
        "published" => Role::Series(5),
        "assumed" => Role::Series(4),
        "calibrated" => Role::Series(3),
        "predicted" => Role::Series(0),
        _ => Role::Ink,
    }
}
