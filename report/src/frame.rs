//! The common furniture of charts: title, legend, axes, grid.

use crate::axis::Axis;
use crate::palette::Role;
use crate::scene::{Anchor, Scene, Symbol};
use crate::{WIDTH, text};

/// Em size of axis and legend text [design px]: 9 px when the plot is shown 360 px wide.
pub(crate) const TEXT: f64 = 13.0;
/// Em size of a title.
pub(crate) const TITLE: f64 = 15.0;
/// Blank rim around a plot.
pub(crate) const RIM: f64 = 10.0;

/// How a legend shows a series.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Key {
    Line,
    Dashed,
    Symbol(Symbol, bool),
    Measured(Symbol),
    SymbolLine(Symbol, bool),
    Patch,
}

/// One legend entry.
pub(crate) struct Entry {
    pub(crate) key: Key,
    pub(crate) role: Role,
    pub(crate) name: String,
}

/// Draws the title, if there is one, and returns the height used so far.
pub(crate) fn title(scene: &mut Scene, title: &str) -> f64 {
    let mut y = RIM;
    if !title.trim().is_empty() {
        for line in text::wrap(title, TITLE, WIDTH - 2.0 * RIM, 2) {
            scene.text([RIM, y + TITLE], &line, TITLE, Role::Ink, Anchor::Start);
            y += 1.35 * TITLE;
        }
        y += 2.0;
    }
    y
}

/// Draws legend rows from `y` on and returns the height below them.
pub(crate) fn legend(scene: &mut Scene, y: f64, entries: &[Entry]) -> f64 {
    let (mut x, mut row) = (RIM, y + 10.0);
    for entry in entries.iter().filter(|entry| !entry.name.trim().is_empty()) {
        let name = text::fit(&entry.name, TEXT, WIDTH - 2.0 * RIM - 32.0);
        let needed = 32.0 + text::width(&name, TEXT);
        if x > RIM && x + needed > WIDTH - RIM {
            (x, row) = (RIM, row + 20.0);
        }
        swatch(scene, [x, row], entry);
        scene.text_mid([x + 30.0, row], &name, TEXT, Role::Ink, Anchor::Start);
        x += needed + 18.0;
    }
    if entries.is_empty() { y } else { row + 16.0 }
}

fn swatch(scene: &mut Scene, [x, y]: [f64; 2], entry: &Entry) {
    let (line, middle, role) = ([[x, y], [x + 24.0, y]], [x + 12.0, y], entry.role);
    match entry.key {
        Key::Line => scene.line(&line, role, 2.4),
        Key::Dashed => scene.dashed(&line, role, 2.4, [6.0, 4.0]),
        Key::Symbol(symbol, open) => scene.symbol(symbol, middle, 5.0, role, open),
        Key::Measured(symbol) => {
            scene.error_bar(middle, 8.0, true, role);
            scene.symbol(symbol, middle, 3.8, role, false);
        }
        Key::SymbolLine(symbol, open) => {
            scene.line(&line, role, 2.4);
            scene.symbol(symbol, middle, if open { 5.0 } else { 4.2 }, role, open);
        }
        Key::Patch => scene.rect([x + 3.0, y - 6.0], [x + 22.0, y + 6.0], role, 1.0),
    }
}

/// Plot area with two axes; pixel ranges lie in the axes.
pub(crate) struct Frame {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
}

/// Names of the axes, with units.
pub(crate) struct AxisLabels<'a> {
    pub(crate) x: &'a str,
    pub(crate) y: &'a str,
}

/// Wanted plot area: top edge, height, and right margin.
pub(crate) struct Room {
    pub(crate) top: f64,
    pub(crate) height: f64,
    pub(crate) right: f64,
    /// Widen the x range until both axes have the same scale.
    pub(crate) equal: bool,
}

impl Frame {
    /// Lays the axes out from `room.top` down, draws grid, ticks and labels, and sets the height of the scene.
    pub(crate) fn draw(scene: &mut Scene, mut x: Axis, mut y: Axis, labels: &AxisLabels, room: &Room) -> Self {
        let head = if labels.y.trim().is_empty() { 8.0 } else { 26.0 };
        let y_ticks = y.ticks((room.height / 36.0) as usize);
        let widest = y_ticks.iter().map(|(_, label)| text::width(label, TEXT)).fold(0.0, f64::max);
        let left = RIM + widest.max(12.0) + 8.0;
        let (top, bottom) = (room.top + head, room.top + head + room.height);
        x.pixels = [left, WIDTH - room.right];
        y.pixels = [bottom, top];
        if room.equal {
            let wanted = (x.pixels[1] - left) * (y.range[1] - y.range[0]) / room.height;
            let spare = 0.5 * (wanted - (x.range[1] - x.range[0]));
            x.range = [x.range[0] - spare, x.range[1] + spare];
        }
        let name = text::fit(labels.y, TEXT, WIDTH - 2.0 * RIM);
        scene.text([RIM, room.top + 14.0], &name, TEXT, Role::Muted, Anchor::Start);
        for (value, label) in &y_ticks {
            let at = y.at(*value);
            scene.line(&[[left, at], [WIDTH - room.right, at]], Role::Grid, 1.0);
            scene.text_mid([left - 7.0, at], label, TEXT, Role::Muted, Anchor::End);
        }
        let frame = Frame { x, y };
        frame.x_axis(scene, labels.x, [top, bottom]);
        frame
    }

    /// Draws the x axis under a plot area that spans `top` to `bottom`, and sets the height of the scene.
    pub(crate) fn x_axis(&self, scene: &mut Scene, label: &str, [top, bottom]: [f64; 2]) {
        let [left, right] = self.x.pixels;
        let ticks = self.x.ticks(((right - left) / 70.0) as usize);
        for (value, label) in &ticks {
            let at = self.x.at(*value);
            scene.line(&[[at, top], [at, bottom]], Role::Grid, 1.0);
            scene.line(&[[at, bottom], [at, bottom + 5.0]], Role::Axis, 1.2);
            let half = 0.5 * text::width(label, TEXT);
            let inside = at.clamp(left.min(RIM + half), (WIDTH - 3.0 - half).max(RIM + half));
            scene.text([inside, bottom + 20.0], label, TEXT, Role::Muted, Anchor::Middle);
        }
        scene.line(&[[left, bottom], [right, bottom]], Role::Axis, 1.2);
        let label = text::fit(label, TEXT, WIDTH - 2.0 * RIM);
        let half = 0.5 * text::width(&label, TEXT);
        let middle = (0.5 * (left + right)).min(WIDTH - RIM - half).max(RIM + half);
        scene.text([middle, bottom + 40.0], &label, TEXT, Role::Muted, Anchor::Middle);
        scene.height = bottom + if label.trim().is_empty() { 28.0 } else { 50.0 };
    }
}
