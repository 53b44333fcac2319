//! What the plane and rows share: sizes, texts on paper, the x axis.

use crate::axis::ChartAxis;
use crate::palette::Ink;
use crate::scene::{Anchor, Scene};
use crate::{WIDTH, text};

/// Em size of axis and legend text [design px]: 9 px when the plot is shown 360 px wide.
pub(crate) const TEXT: f64 = 13.0;
pub(crate) const RIM: f64 = 10.0;

/// A text on a patch of paper, so that no line crosses it.
pub(crate) fn on_paper(scene: &mut Scene, at: [f64; 2], words: &str, ink: Ink, anchor: Anchor) {
    let width = text::width(words, TEXT);
    let left = at[0] - width * [0.0, 0.5, 1.0][anchor as usize];
    scene.rect([left - 2.0, at[1] - TEXT], [left + width + 3.0, at[1] + 4.0], Ink::Paper, 1.0);
    scene.text(at, words, TEXT, ink, anchor);
}

/// Draws the x axis under a plot area that spans `top` to `bottom`, and sets the height of the scene.
pub(crate) fn x_axis(scene: &mut Scene, x: &ChartAxis, label: &str, [top, bottom]: [f64; 2]) {
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
