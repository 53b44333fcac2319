//! A chart as a drawing: title, legend and caption. `plane` and `rows` draw the marks.

use crate::axis::{ChartAxis, extent};
use crate::chart::{Chart, KeyLook, LegendEntry, Mark, Space};
use crate::palette::Ink;
use crate::paper::{RIM, TEXT};
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, paint, plane, rows, text};

const TITLE: f64 = 15.0;

impl Chart {
    /// Draws it; `name` is what errors call it.
    ///
    /// # Errors
    /// No finite value, values beyond 1e15, more marks than a reader can separate.
    pub fn draw(&self, name: &'static str) -> Result<Drawn, ReportError> {
        const MOST: usize = 20_000;
        crate::at_most(name, "marks", MOST, self.marks.len())?;
        extent(self.marks.iter().flat_map(Mark::own), name)?;
        let reach = |k: usize| self.marks.iter().flat_map(move |mark| mark.reach(k));
        let axes = match &self.space {
            Space::Plane => [ChartAxis::linear(reach(0), name)?, ChartAxis::linear(reach(1), name)?],
            Space::Equal => [ChartAxis::padded(reach(0), name)?, ChartAxis::padded(reach(1), name)?],
            Space::Log => {
                [ChartAxis { seconds: true, ..ChartAxis::log(reach(0), name)? }, ChartAxis::log(reach(1), name)?]
            }
            Space::Rows(_) => [ChartAxis::linear(reach(0), name)?, ChartAxis::exact([0.0, 1.0])],
            Space::Grid(..) => [ChartAxis::exact([0.0, 1.0]), ChartAxis::exact([0.0, 1.0])],
        };
        paint::paint(&scene(self, axes))
    }
}

fn scene(chart: &Chart, axes: [ChartAxis; 2]) -> Scene {
    let mut scene = Scene::new();
    let top = title(&mut scene, &chart.title);
    let top = legend(&mut scene, top, &chart.keys);
    match &chart.space {
        Space::Rows(rows) => rows::bars(&mut scene, chart, rows, axes, top),
        Space::Grid(rows, columns) => rows::cells(&mut scene, chart, (rows, columns), top),
        Space::Plane | Space::Equal | Space::Log => plane::draw(&mut scene, chart, axes, top),
    }
    if !chart.note.is_empty() {
        scene.text([RIM, scene.height + 8.0], &chart.note, TEXT, Ink::Muted, Anchor::Start);
        scene.height += 18.0;
    }
    scene
}

/// Draws the title, if there is one, and returns the height used so far.
fn title(scene: &mut Scene, title: &str) -> f64 {
    let mut y = RIM;
    if !title.trim().is_empty() {
        for line in text::wrap(title, TITLE, WIDTH - 2.0 * RIM, 2) {
            scene.text([RIM, y + TITLE], &line, TITLE, Ink::Ink, Anchor::Start);
            y += 1.35 * TITLE;
        }
        y += 2.0;
    }
    y
}

/// Draws legend rows from `y` on and returns the height below them.
fn legend(scene: &mut Scene, y: f64, keys: &[LegendEntry]) -> f64 {
    let (mut x, mut row) = (RIM, y + 10.0);
    for key in keys.iter().filter(|key| !key.name.trim().is_empty()) {
        let name = text::fit(&key.name, TEXT, WIDTH - 2.0 * RIM - 32.0);
        let needed = 32.0 + text::width(&name, TEXT);
        if x > RIM && x + needed > WIDTH - RIM {
            (x, row) = (RIM, row + 20.0);
        }
        swatch(scene, [x, row], key);
        scene.text_mid([x + 30.0, row], &name, TEXT, Ink::Ink, Anchor::Start);
        x += needed + 18.0;
    }
    if keys.is_empty() { y } else { row + 16.0 }
}

fn swatch(scene: &mut Scene, [x, y]: [f64; 2], key: &LegendEntry) {
    let (line, middle, ink) = ([[x, y], [x + 24.0, y]], [x + 12.0, y], key.ink);
    match key.look {
        KeyLook::Line => scene.line(&line, ink, 2.4),
        KeyLook::Dashed => scene.dashed(&line, ink, 2.4, [6.0, 4.0]),
        KeyLook::Symbol(symbol, open) => scene.symbol(symbol, middle, 5.0, ink, open),
        KeyLook::Measured(symbol) => {
            scene.error_bar(middle, 8.0, true, ink);
            scene.symbol(symbol, middle, 3.8, ink, false);
        }
        KeyLook::SymbolLine(symbol, open) => {
            scene.line(&line, ink, 2.4);
            scene.symbol(symbol, middle, if open { 5.0 } else { 4.2 }, ink, open);
        }
        KeyLook::Patch => scene.rect([x + 3.0, y - 6.0], [x + 22.0, y + 6.0], ink, 1.0),
    }
}
