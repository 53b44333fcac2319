//! Centre lines of a robot at several pressures, predicted against measured.

use crate::axis::{Axis, extent};
use crate::frame::{AxisLabels, Entry, Frame, Key, RIM, Room, TEXT, legend, title};
use crate::palette::Role;
use crate::scene::{Anchor, Point, Scene, Symbol};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, place, text};

const CHART: &str = "shapes";
/// Most poses in one plot: more centre lines cannot be told apart.
const MOST: usize = 6;
/// Series colours in the order of rising pressure, from cool to warm.
const ORDER: [usize; MOST] = [0, 2, 4, 1, 3, 5];
const TALLEST: f64 = 520.0;

/// Shapes of one robot in the x–y plane, x along the robot at rest. All lengths in mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shapes {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Centre line at rest.
    pub rest_mm: Vec<[f64; 2]>,
    /// Body radius, drawn as a soft band about the line at rest; 0 for none.
    pub body_radius_mm: f64,
    /// One to six poses in the order of rising pressure.
    pub poses: Vec<ShapePose>,
}

/// One pose of [`Shapes`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShapePose {
    /// Direct label at the tip, e.g. `30 kPa`.
    pub label: String,
    /// Predicted centre line; may be empty.
    pub curve_mm: Vec<[f64; 2]>,
    /// Predicted markers; may be empty.
    pub predicted_mm: Vec<[f64; 2]>,
    /// Measured markers; may be empty.
    pub measured: Vec<MeasuredPoint>,
}

/// A measured marker of [`ShapePose`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeasuredPoint {
    /// Position.
    pub at_mm: [f64; 2],
    /// Half-widths of the error bars along x and y; 0 for none.
    pub half_width_mm: [f64; 2],
}

/// Draws centre lines with measured and predicted markers, both axes to the same scale.
///
/// Errors: nothing finite to draw, more than six poses, values beyond 1e15.
pub fn shapes(data: &Shapes) -> Result<Drawn, ReportError> {
    at_most(CHART, "poses", MOST, data.poses.len())?;
    let radius = if data.body_radius_mm.is_finite() { data.body_radius_mm.max(0.0) } else { 0.0 };
    let points = all_points(data, radius);
    let ranges =
        [padded(extent(points.iter().map(|p| p[0]), CHART)?), padded(extent(points.iter().map(|p| p[1]), CHART)?)];
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title);
    let top = legend(&mut scene, top, &keys(data));
    let widest = data.poses.iter().map(|pose| text::width(&label(pose), TEXT)).fold(0.0, f64::max);
    let room = Room { top, height: height(ranges, widest), right: RIM + widest + 14.0, equal: true };
    let labels = AxisLabels { x: "x along the robot at rest [mm]", y: "y sideways [mm]" };
    let frame = Frame::draw(&mut scene, Axis::exact(ranges[0]), Axis::exact(ranges[1]), &labels, &room);
    draw_rest(&mut scene, &frame, data, radius);
    for (i, pose) in data.poses.iter().enumerate() {
        draw_curve(&mut scene, &frame, pose, Role::Series(ORDER[i]));
    }
    for (i, pose) in data.poses.iter().enumerate() {
        draw_markers(&mut scene, &frame, pose, Role::Series(ORDER[i]));
    }
    tip_labels(&mut scene, &frame, data);
    paint::paint(&scene)
}

fn finite(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().copied().filter(|p| p[0].is_finite() && p[1].is_finite()).collect()
}

fn measured(pose: &ShapePose) -> Vec<MeasuredPoint> {
    let keep = |m: &&MeasuredPoint| m.at_mm.iter().all(|v| v.is_finite());
    let half = |h: f64| if h.is_finite() { h.abs() } else { 0.0 };
    let clean = |m: &MeasuredPoint| MeasuredPoint { half_width_mm: m.half_width_mm.map(half), ..*m };
    pose.measured.iter().filter(keep).map(clean).collect()
}

/// Every point that must be inside the axes.
fn all_points(data: &Shapes, radius: f64) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> =
        finite(&data.rest_mm).into_iter().flat_map(|p| [[p[0], p[1] - radius], [p[0], p[1] + radius]]).collect();
    for pose in &data.poses {
        points.extend(finite(&pose.curve_mm));
        points.extend(finite(&pose.predicted_mm));
        for m in measured(pose) {
            let ([x, y], [dx, dy]) = (m.at_mm, m.half_width_mm);
            points.extend([[x - dx, y - dy], [x + dx, y + dy]]);
        }
    }
    points
}

fn padded([low, high]: [f64; 2]) -> [f64; 2] {
    let pad = if high > low { 0.04 * (high - low) } else { 0.1 * high.abs().max(1.0) };
    [low - pad, high + pad]
}

/// Height of the plot area that gives equal scales across the full width, within bounds.
fn height([x, y]: [[f64; 2]; 2], label_width: f64) -> f64 {
    let width = WIDTH - 62.0 - RIM - label_width - 14.0;
    (width * (y[1] - y[0]) / (x[1] - x[0])).clamp(110.0, TALLEST)
}

fn keys(data: &Shapes) -> Vec<Entry> {
    let entry = |key, name: &str| Entry { key, role: Role::Muted, name: name.to_owned() };
    let mut keys = Vec::new();
    if data.poses.iter().any(|pose| !pose.measured.is_empty()) {
        keys.push(entry(Key::Measured(Symbol::Circle), "measured"));
    }
    let markers = data.poses.iter().any(|pose| !pose.predicted_mm.is_empty());
    let curves = data.poses.iter().any(|pose| !pose.curve_mm.is_empty());
    match (markers, curves) {
        (true, true) => keys.push(entry(Key::SymbolLine(Symbol::Circle, true), "predicted centre line and markers")),
        (true, false) => keys.push(entry(Key::Symbol(Symbol::Circle, true), "predicted")),
        (false, true) => keys.push(entry(Key::Line, "predicted centre line")),
        (false, false) => {}
    }
    if !data.rest_mm.is_empty() {
        keys.push(entry(Key::Dashed, "at rest"));
    }
    keys
}

fn pixels(frame: &Frame, points: &[[f64; 2]]) -> Vec<Point> {
    finite(points).iter().map(|p| [frame.x.at(p[0]), frame.y.at(p[1])]).collect()
}

fn draw_rest(scene: &mut Scene, frame: &Frame, data: &Shapes, radius: f64) {
    let line = finite(&data.rest_mm);
    if radius > 0.0 && line.len() > 1 {
        let side = |sign: f64| line.iter().map(move |p| [p[0], p[1] + sign * radius]);
        let outline: Vec<[f64; 2]> = side(1.0).chain(side(-1.0).rev()).collect();
        scene.fill(&pixels(frame, &outline), Role::Soft, 1.0);
    }
    let line = pixels(frame, &line);
    scene.dashed(&line, Role::Muted, 1.5, [6.0, 4.0]);
    if let [[x, y], _, ..] = line[..] {
        let half = (frame.y.at(0.0) - frame.y.at(radius)).max(12.0);
        scene.line(&[[x, y - half], [x, y + half]], Role::Muted, 4.0);
    }
}

fn draw_curve(scene: &mut Scene, frame: &Frame, pose: &ShapePose, role: Role) {
    scene.line(&pixels(frame, &pose.curve_mm), role, 2.4);
}

fn draw_markers(scene: &mut Scene, frame: &Frame, pose: &ShapePose, role: Role) {
    for at in pixels(frame, &pose.predicted_mm) {
        scene.symbol(Symbol::Circle, at, 5.0, role, true);
    }
    for m in measured(pose) {
        let at = [frame.x.at(m.at_mm[0]), frame.y.at(m.at_mm[1])];
        for (i, vertical) in [false, true].into_iter().enumerate() {
            let axis = if vertical { &frame.y } else { &frame.x };
            let half = (axis.at(m.half_width_mm[i]) - axis.at(0.0)).abs();
            if half > 3.6 {
                scene.error_bar(at, half, vertical, role);
            }
        }
        scene.symbol(Symbol::Circle, at, 3.4, role, false);
    }
}

fn label(pose: &ShapePose) -> String {
    text::fit(&pose.label, TEXT, 110.0)
}

/// The tip of a pose: end of its centre line, else its last marker.
fn tip(pose: &ShapePose) -> Option<[f64; 2]> {
    let last = |points: &[[f64; 2]]| finite(points).last().copied();
    last(&pose.curve_mm).or_else(|| last(&pose.predicted_mm)).or_else(|| measured(pose).last().map(|m| m.at_mm))
}

/// Labels right of the plot, joined to their tips by thin lines.
fn tip_labels(scene: &mut Scene, frame: &Frame, data: &Shapes) {
    let tips: Vec<(usize, Point)> = data
        .poses
        .iter()
        .enumerate()
        .filter_map(|(i, pose)| tip(pose).map(|t| (i, [frame.x.at(t[0]), frame.y.at(t[1])])))
        .collect();
    let wanted: Vec<f64> = tips.iter().map(|(_, at)| at[1]).collect();
    let heights = place::stack(&wanted, 1.35 * TEXT, [frame.y.pixels[1] + 6.0, frame.y.pixels[0] - 8.0]);
    let edge = frame.x.pixels[1] + 10.0;
    for ((i, at), y) in tips.iter().zip(heights) {
        let role = Role::Series(ORDER[*i]);
        if edge - at[0] > 16.0 {
            scene.line(&[[at[0] + 8.0, at[1]], [edge - 12.0, y], [edge - 3.0, y]], Role::Axis, 1.0);
        }
        scene.text_mid([edge, y], &label(&data.poses[*i]), TEXT, role, Anchor::Start);
    }
}
