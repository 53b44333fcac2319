//! A chart as a drawing: what is around the marks. `plane` and `rows` draw the marks.

use crate::axis::Axis;
use crate::chart::{Chart, Key, KeyLook, Space};
use crate::palette::Ink;
use crate::scene::{Anchor, Scene};
use crate::{WIDTH, plane, rows, text};

/// Em size of axis and legend text [design px]: 9 px when the plot is shown 360 px wide.
pub(crate) const TEXT: f64 = 13.0;
/// Em size of a title.
const TITLE: f64 = 15.0;
/// Blank rim around a plot.
pub(crate) const RIM: f64 = 10.0;

/// The chart over axes that hold its marks.
pub(crate) fn scene(chart: &Chart, axes: [Axis; 2]) -> Scene {
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
fn legend(scene: &mut Scene, y: f64, keys: &[Key]) -> f64 {
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

fn swatch(scene: &mut Scene, [x, y]: [f64; 2], key: &Key) {
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

/// A text on a patch of paper, so that no line crosses it.
pub(crate) fn on_paper(scene: &mut Scene, at: [f64; 2], words: &str, ink: Ink, anchor: Anchor) {
    let width = text::width(words, TEXT);
    let left = at[0] - width * [0.0, 0.5, 1.0][anchor as usize];
    scene.rect([left - 2.0, at[1] - TEXT], [left + width + 3.0, at[1] + 4.0], Ink::Paper, 1.0);
    scene.text(at, words, TEXT, ink, anchor);
}

/// Draws the x axis under a plot area that spans `top` to `bottom`, and sets the height of the scene.
pub(crate) fn x_axis(scene: &mut Scene, x: &Axis, label: &str, [top, bottom]: [f64; 2]) {
    let [left, right] = x.pixels;
    for (value, label) in x.ticks(((right - left) / 70.0) as usize) {
        let at = x.at(value);
        scene.line(&[[at, top], [at, bottom]], Ink::Grid, 1.0);
        scene.line(&[[at, bottom], [at, bottom + 5.0]], Ink::Axis, 1.2);
        let half = 0.5 * text::width(&label, TEXT);
        let inside = at.clamp(left.min(RIM + half), (WIDTH - 3.0 - half).max(RIM + half));
        scene.text([inside, bottom + 20.0], &label, TEXT, Ink::Muted, Anchor::Middle);
    }
    scene.line(&[[left, bottom], [right, bottom]], Ink::Axis, 1.2);
    centred(scene, label, [0.5 * (left + right), bottom + 40.0]);
    scene.height = bottom + if label.trim().is_empty() { 28.0 } else { 50.0 };
}

/// A label of an axis, moved inside the drawing.
pub(crate) fn centred(scene: &mut Scene, label: &str, [middle, y]: [f64; 2]) {
    let label = text::fit(label, TEXT, WIDTH - 2.0 * RIM);
    let half = 0.5 * text::width(&label, TEXT);
    let middle = middle.min(WIDTH - RIM - half).max(RIM + half);
    scene.text([middle, y], &label, TEXT, Ink::Muted, Anchor::Middle);
}
