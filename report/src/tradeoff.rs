//! Run time against error, both logarithmic.

use crate::axis::Axis;
use crate::frame::{AxisLabels, Entry, Frame, Key, RIM, Room, TEXT, legend, title};
use crate::palette::Role;
use crate::scene::{Anchor, Point, Scene, Symbol};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, place, text};

const CHART: &str = "trade-off";
const MOST: usize = 40;

/// Scatter of run time and error of several models.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tradeoff {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Label of the error axis with unit, e.g. `tip error [mm]`.
    pub error_label: String,
    /// Up to 40 points; those without a positive run time and error cannot be shown on logarithmic axes and are
    /// counted in a note under the plot.
    pub points: Vec<TradeoffPoint>,
}

/// One point of a [`Tradeoff`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TradeoffPoint {
    /// Direct label, e.g. `cPAM + wrinkling`; empty for none.
    pub label: String,
    /// Colour and symbol group, e.g. `reduced model` or `finite elements`.
    pub group: String,
    /// Run time of one prediction, in seconds.
    pub run_time_s: f64,
    /// Error, in the unit of the axis.
    pub error: f64,
}

/// Draws the scatter with direct labels; a thin line joins the points that no other beats in both.
///
/// Errors: no positive point, over 40 points, values beyond 1e15.
pub fn tradeoff(data: &Tradeoff) -> Result<Drawn, ReportError> {
    at_most(CHART, "points", MOST, data.points.len())?;
    let shown: Vec<&TradeoffPoint> = data.points.iter().filter(|p| showable(p)).collect();
    let x = Axis::log(shown.iter().map(|p| p.run_time_s), CHART)?.in_seconds();
    let y = Axis::log(shown.iter().map(|p| p.error), CHART)?;
    let groups = groups(&shown);
    let mut scene = Scene::new();
    let mut top = title(&mut scene, &data.title);
    if groups.len() > 1 {
        top = legend(&mut scene, top, &keys(&groups));
    }
    let room = Room { top, height: 290.0, right: RIM + 6.0, equal: false };
    let labels = AxisLabels { x: "run time of one prediction", y: &data.error_label };
    let frame = Frame::draw(&mut scene, x, y, &labels, &room);
    front(&mut scene, &frame, &shown);
    scatter(&mut scene, &frame, &shown, &groups);
    let hidden = data.points.len() - shown.len();
    if hidden > 0 {
        let note = format!("{hidden} not shown: run time or error is not a positive number");
        scene.text([RIM, scene.height + 8.0], &note, TEXT, Role::Muted, Anchor::Start);
        scene.height += 18.0;
    }
    paint::paint(&scene)
}

fn showable(point: &TradeoffPoint) -> bool {
    [point.run_time_s, point.error].iter().all(|v| v.is_finite() && *v > 0.0)
}

fn groups(points: &[&TradeoffPoint]) -> Vec<String> {
    let mut groups: Vec<String> = Vec::new();
    for point in points {
        if !groups.contains(&point.group) {
            groups.push(point.group.clone());
        }
    }
    groups
}

fn keys(groups: &[String]) -> Vec<Entry> {
    let entry = |(i, name): (usize, &String)| Entry {
        key: Key::Symbol(Symbol::of(i), false),
        role: Role::Series(i),
        name: if name.trim().is_empty() { "other".to_owned() } else { name.clone() },
    };
    groups.iter().enumerate().map(entry).collect()
}

/// Staircase through the points that are the most accurate at their run time or less.
fn front(scene: &mut Scene, frame: &Frame, points: &[&TradeoffPoint]) {
    let mut order = points.to_vec();
    order.sort_by(|a, b| a.run_time_s.total_cmp(&b.run_time_s).then(a.error.total_cmp(&b.error)));
    let mut path: Vec<Point> = Vec::new();
    let mut best = f64::INFINITY;
    for point in order.into_iter().filter(|point| point.error > 0.0) {
        if point.error < best {
            let at = [frame.x.at(point.run_time_s), frame.y.at(point.error)];
            path.extend(path.last().copied().map(|last| [at[0], last[1]]));
            path.push(at);
            best = point.error;
        }
    }
    path.extend(path.last().copied().map(|last| [frame.x.pixels[1], last[1]]));
    scene.dashed(&path, Role::Axis, 1.4, [5.0, 4.0]);
}

fn scatter(scene: &mut Scene, frame: &Frame, points: &[&TradeoffPoint], groups: &[String]) {
    let at: Vec<Point> = points.iter().map(|p| [frame.x.at(p.run_time_s), frame.y.at(p.error)]).collect();
    let labels: Vec<String> = points.iter().map(|p| text::fit(&p.label, TEXT, 220.0)).collect();
    let sizes: Vec<[f64; 2]> = labels.iter().map(|label| [text::width(label, TEXT), 1.25 * TEXT]).collect();
    let dots: Vec<place::Rect> = at.iter().map(|p| [p[0] - 8.0, p[1] - 8.0, p[0] + 8.0, p[1] + 8.0]).collect();
    let bounds = [frame.x.pixels[0], frame.y.pixels[1] - 8.0, WIDTH - 4.0, frame.y.pixels[0] - 2.0];
    let places = place::around(&at, &sizes, bounds, &dots);
    for (i, centre) in places.iter().enumerate() {
        if labels[i].is_empty() {
            continue;
        }
        let (half, away) = (0.5 * sizes[i][0], (centre[1] - at[i][1]).abs());
        if away > 26.0 {
            let end =
                [at[i][0].clamp(centre[0] - half, centre[0] + half), centre[1] - (centre[1] - at[i][1]).signum() * 9.0];
            scene.line(&[at[i], end], Role::Axis, 1.0);
        }
        scene.rect(
            [centre[0] - half - 2.0, centre[1] - 8.0],
            [centre[0] + half + 2.0, centre[1] + 8.0],
            Role::Paper,
            0.8,
        );
        scene.text_mid(*centre, &labels[i], TEXT, Role::Ink, Anchor::Middle);
    }
    for (point, at) in points.iter().zip(&at) {
        let group = groups.iter().position(|name| *name == point.group).unwrap_or(0);
        scene.symbol(Symbol::of(group), *at, 6.0, Role::Series(group), false);
    }
}
