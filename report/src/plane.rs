//! Marks over two axes of numbers.

use crate::axis::ChartAxis;
use crate::chart::{Chart, Mark, Space, finite};
use crate::palette::Ink;
use crate::paper::{RIM, TEXT, on_paper, x_axis};
use crate::scene::{Anchor, Scene, ScenePoint, Symbol};
use crate::{WIDTH, chart, place, text};

/// Widest label of a tip, and of a point [design px].
const TIP: f64 = 130.0;
const LABEL: f64 = 220.0;
/// Heights of the plot area; a plot of two lengths has a height between two bounds.
const HEIGHT: f64 = 270.0;
const BOUNDS: [f64; 2] = [110.0, 520.0];

/// Draws axes and marks from `top` down, and sets the height of the scene.
pub(crate) fn draw(scene: &mut Scene, chart: &Chart, [x, y]: [ChartAxis; 2], top: f64) {
    let tips = chart.marks.iter().filter_map(|mark| match mark {
        Mark::Tip(_, label, _) => Some(text::width(&text::fit(label, TEXT, TIP), TEXT)),
        _ => None,
    });
    let right = RIM + tips.map(|width| width + 14.0).fold(8.0, f64::max);
    let plane = frame(scene, chart, [x, y], (top, right));
    let zero = plane.y.at(0.0);
    if chart.space == Space::Plane && zero > plane.y.pixels[1] && zero < plane.y.pixels[0] - 1.0 {
        scene.line(&[[plane.x.pixels[0], zero], [plane.x.pixels[1], zero]], Ink::Axis, 1.2);
    }
    let (points, others): (Vec<&Mark>, Vec<&Mark>) = chart.marks.iter().partition(|m| matches!(m, Mark::Point(_)));
    others.into_iter().for_each(|mark| plane.mark(scene, mark));
    labels(scene, &plane, &chart.marks);
    points.into_iter().for_each(|mark| plane.mark(scene, mark));
    plane.tips(scene, &chart.marks);
}

struct Plane {
    x: ChartAxis,
    y: ChartAxis,
}

/// Lays the axes out and draws grid, ticks and labels.
fn frame(scene: &mut Scene, chart: &Chart, [mut x, mut y]: [ChartAxis; 2], (top, right): (f64, f64)) -> Plane {
    let head = if chart.y_label.trim().is_empty() { 8.0 } else { 26.0 };
    let span = |axis: &ChartAxis| axis.range[1] - axis.range[0];
    let height = match chart.space {
        Space::Equal => ((WIDTH - 62.0 - right) * span(&y) / span(&x)).clamp(BOUNDS[0], BOUNDS[1]),
        _ => HEIGHT,
    };
    let ticks = y.ticks((height / 36.0) as usize);
    let widest = ticks.iter().map(|(_, label)| text::width(label, TEXT)).fold(0.0, f64::max);
    let left = RIM + widest.max(12.0) + 8.0;
    let area = [top + head, top + head + height];
    x.pixels = [left, WIDTH - right];
    y.pixels = [area[1], area[0]];
    if chart.space == Space::Equal {
        let spare = 0.5 * ((x.pixels[1] - left) * span(&y) / height - span(&x));
        x.range = [x.range[0] - spare, x.range[1] + spare];
    }
    scene.text([RIM, top + 14.0], &text::fit(&chart.y_label, TEXT, WIDTH - 2.0 * RIM), TEXT, Ink::Muted, Anchor::Start);
    for (value, label) in &ticks {
        let at = y.at(*value);
        scene.line(&[[left, at], [WIDTH - right, at]], Ink::Grid, 1.0);
        scene.text_mid([left - 7.0, at], label, TEXT, Ink::Muted, Anchor::End);
    }
    x_axis(scene, &x, &chart.x_label, area);
    Plane { x, y }
}

impl Plane {
    fn at(&self, point: &[f64; 2]) -> Option<ScenePoint> {
        Some([self.x.at(point[0]), self.y.at(point[1])]).filter(finite)
    }

    fn path(&self, points: &[[f64; 2]]) -> Vec<ScenePoint> {
        points.iter().filter_map(|point| self.at(point)).collect()
    }

    fn mark(&self, scene: &mut Scene, mark: &Mark) {
        match mark {
            Mark::Line(points, ink) | Mark::Dashed(points, ink) => {
                for part in points.split(|point| self.at(point).is_none()) {
                    match (&self.path(part)[..], mark) {
                        ([only], _) => scene.symbol(Symbol::Circle, *only, 2.2, *ink, false),
                        (path, Mark::Dashed(..)) => scene.dashed(path, *ink, 2.2, [7.0, 4.5]),
                        (path, _) => scene.line(path, *ink, 2.2),
                    }
                }
            }
            Mark::Band(outline) => scene.fill(&self.path(outline), Ink::Soft, 1.0),
            Mark::Point(chart::Point { at, error, ink, symbol, open, .. }) => {
                let Some(at) = self.at(at) else { return };
                for (axis, half, vertical) in [(&self.x, error[0], false), (&self.y, error[1], true)] {
                    let half = (axis.at(half) - axis.at(0.0)).abs();
                    if half > 0.5 {
                        scene.error_bar(at, half, vertical, *ink);
                    }
                }
                scene.symbol(*symbol, at, if *open { 5.0 } else { 4.2 }, *ink, *open);
            }
            Mark::Tip(..) | Mark::Bar(_) | Mark::Cell(..) | Mark::Rule(_) => {}
        }
    }

    /// Labels right of the plot, joined to their tips by thin lines.
    fn tips(&self, scene: &mut Scene, marks: &[Mark]) {
        let tips: Vec<(ScenePoint, String, Ink)> = marks
            .iter()
            .filter_map(|mark| match mark {
                Mark::Tip(at, label, ink) => Some((self.at(at)?, text::fit(label, TEXT, TIP), *ink)),
                _ => None,
            })
            .collect();
        let wanted: Vec<f64> = tips.iter().map(|(at, ..)| at[1]).collect();
        let heights = place::stack(&wanted, 1.35 * TEXT, [self.y.pixels[1] + 6.0, self.y.pixels[0] - 8.0]);
        let edge = self.x.pixels[1] + 10.0;
        for ((at, label, ink), y) in tips.iter().zip(heights) {
            if edge - at[0] > 16.0 {
                scene.line(&[[at[0] + 8.0, at[1]], [edge - 12.0, y], [edge - 3.0, y]], Ink::Axis, 1.0);
            }
            scene.text_mid([edge, y], label, TEXT, *ink, Anchor::Start);
        }
    }
}

/// Labels of points, clear of the points and of each other; one that is far from its point is joined to it.
fn labels(scene: &mut Scene, plane: &Plane, marks: &[Mark]) {
    let points: Vec<(ScenePoint, String)> = marks
        .iter()
        .filter_map(|mark| match mark {
            Mark::Point(chart::Point { at, label, .. }) => Some((plane.at(at)?, text::fit(label, TEXT, LABEL))),
            _ => None,
        })
        .collect();
    if points.iter().all(|(_, label)| label.is_empty()) {
        return;
    }
    let dots: Vec<place::Rect> = points.iter().map(|(p, _)| [p[0] - 8.0, p[1] - 8.0, p[0] + 8.0, p[1] + 8.0]).collect();
    let named: Vec<&(ScenePoint, String)> = points.iter().filter(|(_, label)| !label.is_empty()).collect();
    let at: Vec<ScenePoint> = named.iter().map(|(at, _)| *at).collect();
    let sizes: Vec<[f64; 2]> = named.iter().map(|(_, label)| [text::width(label, TEXT), 1.25 * TEXT]).collect();
    let bounds = [plane.x.pixels[0], plane.y.pixels[1] - 8.0, WIDTH - 4.0, plane.y.pixels[0] - 2.0];
    for (i, centre) in place::around(&at, &sizes, bounds, &dots).into_iter().enumerate() {
        let (half, away) = (0.5 * sizes[i][0], centre[1] - at[i][1]);
        if away.abs() > 26.0 {
            let end = [at[i][0].clamp(centre[0] - half, centre[0] + half), centre[1] - away.signum() * 9.0];
            scene.line(&[at[i], end], Ink::Axis, 1.0);
        }
        on_paper(scene, [centre[0], centre[1] + 0.36 * TEXT], &named[i].1, Ink::Ink, Anchor::Middle);
    }
}
