//! What each of several uncertain numbers does to one result, the strongest first.

use crate::axis::{Axis, extent, number};
use crate::frame::{Frame, RIM, TEXT, title};
use crate::palette::Role;
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, text};

const CHART: &str = "tornado";
const ROW: f64 = 40.0;
const BAR: f64 = 16.0;

/// Horizontal bars from the result with every number at its own value.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tornado {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Axis label with unit.
    pub value_label: String,
    /// The result that the bars start from.
    pub base: f64,
    /// One bar per number; sorted by length here.
    pub bars: Vec<TornadoBar>,
}

/// One bar of a [`Tornado`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TornadoBar {
    /// Name of the number, with unit.
    pub name: String,
    /// Its lower and upper value, as text.
    pub ends: [String; 2],
    /// The result at these.
    pub values: [f64; 2],
}

impl TornadoBar {
    fn reach(&self, base: f64) -> f64 {
        self.values.iter().filter(|v| v.is_finite()).map(|v| (v - base).abs()).fold(0.0, f64::max)
    }
}

/// Draws the bars: blue at the lower, orange at the upper end of each number.
///
/// Errors: no finite value, over 40 bars.
pub fn tornado(data: &Tornado) -> Result<Drawn, ReportError> {
    at_most(CHART, "bars", 40, data.bars.len())?;
    extent([data.base].into_iter(), CHART)?;
    let values = data.bars.iter().flat_map(|bar| bar.values).chain([data.base]);
    let mut x = Axis::linear(values, CHART)?;
    x.pixels = [RIM + 2.0, WIDTH - RIM - 2.0];
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title) + 4.0;
    let frame = Frame { x, y: Axis::exact([0.0, 1.0]) };
    let bottom = top + ROW * data.bars.len() as f64;
    frame.x_axis(&mut scene, &data.value_label, [top, bottom]);
    let mut order: Vec<&TornadoBar> = data.bars.iter().collect();
    order.sort_by(|a, b| b.reach(data.base).total_cmp(&a.reach(data.base)));
    for (i, bar) in order.into_iter().enumerate() {
        row(&mut scene, &frame, bar, data.base, top + ROW * i as f64);
    }
    let base = frame.x.at(data.base);
    scene.line(&[[base, top], [base, bottom]], Role::Ink, 1.4);
    paint::paint(&scene)
}

fn row(scene: &mut Scene, frame: &Frame, bar: &TornadoBar, base: f64, top: f64) {
    let words = match bar.reach(base) {
        reach if reach > 0.0 => format!(
            "{}: {} → {}, {} → {}",
            bar.name,
            bar.ends[0],
            number(bar.values[0], 1),
            bar.ends[1],
            number(bar.values[1], 1)
        ),
        _ => format!("{}: no effect here", bar.name),
    };
    let words = text::fit(&words, TEXT, WIDTH - 2.0 * RIM);
    scene.rect([RIM, top + 4.0], [RIM + 5.0 + text::width(&words, TEXT), top + 20.0], Role::Paper, 1.0);
    scene.text([RIM + 2.0, top + 17.0], &words, TEXT, Role::Ink, Anchor::Start);
    for (value, role) in bar.values.into_iter().zip([Role::HeatNegative, Role::HeatPositive]) {
        if value.is_finite() && value != base {
            let (from, to) = (frame.x.at(base), frame.x.at(value));
            scene.rect([from.min(to), top + 21.0], [from.max(to), top + 21.0 + BAR], role, 0.75);
        }
    }
}
