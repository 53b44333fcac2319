//! A drawing as a list of marks in design pixels; charts fill it, `paint` puts it on a backend.

use crate::palette::Ink;
use crate::text;

/// A point in design pixels, x to the right, y downwards.
pub(crate) type ScenePoint = [f64; 2];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Marker shapes, in the order in which series take them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Symbol {
    /// Circle ●, the symbol of the first series.
    #[default]
    Circle,
    /// Square ■, the symbol of the second series.
    Square,
    /// Diamond ◆, the symbol of the third series.
    Diamond,
    /// Triangle ▲, the symbol of the fourth series.
    Triangle,
}

impl Symbol {
    /// Symbol of series `i` from 0; four symbols, then again.
    pub fn of(i: usize) -> Self {
        [Symbol::Circle, Symbol::Square, Symbol::Diamond, Symbol::Triangle][i % 4]
    }
}

/// One thing to draw; lengths in design pixels.
pub(crate) enum SceneMark {
    Line { points: Vec<ScenePoint>, ink: Ink, width: f64 },
    Fill { points: Vec<ScenePoint>, ink: Ink, alpha: f64 },
    Disc { centre: ScenePoint, radius: f64, ink: Ink },
    Text { at: ScenePoint, text: String, size: f64, ink: Ink, anchor: Anchor },
}

pub(crate) struct Scene {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) marks: Vec<SceneMark>,
}

impl Scene {
    /// An empty drawing of the common width; its height is set when the layout is known.
    pub(crate) fn new() -> Self {
        Scene { width: crate::WIDTH, height: 0.0, marks: Vec::new() }
    }

    pub(crate) fn line(&mut self, points: &[ScenePoint], ink: Ink, width: f64) {
        self.marks.push(SceneMark::Line { points: points.to_vec(), ink, width });
    }

    /// A dashed line with dashes of `on` and gaps of `off`.
    pub(crate) fn dashed(&mut self, points: &[ScenePoint], ink: Ink, width: f64, [on, off]: [f64; 2]) {
        let (mut drawing, mut left, mut dash) = (true, on, points.first().copied().into_iter().collect::<Vec<_>>());
        for pair in points.windows(2) {
            let (mut a, b) = (pair[0], pair[1]);
            let mut rest = distance(a, b);
            while rest > left {
                let t = left / rest;
                a = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                rest -= left;
                dash.push(a);
                let done = std::mem::replace(&mut dash, vec![a]);
                if drawing {
                    self.line(&done, ink, width);
                }
                drawing = !drawing;
                left = if drawing { on } else { off };
            }
            left -= rest;
            dash.push(b);
        }
        if drawing {
            self.line(&dash, ink, width);
        }
    }

    pub(crate) fn rect(&mut self, [x0, y0]: ScenePoint, [x1, y1]: ScenePoint, ink: Ink, alpha: f64) {
        self.fill(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], ink, alpha);
    }

    pub(crate) fn fill(&mut self, points: &[ScenePoint], ink: Ink, alpha: f64) {
        self.marks.push(SceneMark::Fill { points: points.to_vec(), ink, alpha });
    }

    /// A marker of half-width `radius`; an open one has a coloured rim on paper.
    pub(crate) fn symbol(&mut self, symbol: Symbol, centre: ScenePoint, radius: f64, ink: Ink, open: bool) {
        self.solid(symbol, centre, radius, ink);
        if open {
            self.solid(symbol, centre, radius - 1.6, Ink::Paper);
        }
    }

    fn solid(&mut self, symbol: Symbol, centre: ScenePoint, radius: f64, ink: Ink) {
        let corner = |x: f64, y: f64| [centre[0] + x * radius, centre[1] + y * radius];
        match symbol {
            Symbol::Circle => self.marks.push(SceneMark::Disc { centre, radius, ink }),
            Symbol::Square => self.rect(corner(-0.9, -0.9), corner(0.9, 0.9), ink, 1.0),
            Symbol::Diamond => {
                self.fill(&[corner(0.0, -1.25), corner(1.25, 0.0), corner(0.0, 1.25), corner(-1.25, 0.0)], ink, 1.0);
            }
            Symbol::Triangle => self.fill(&[corner(0.0, -1.2), corner(1.15, 0.85), corner(-1.15, 0.85)], ink, 1.0),
        }
    }

    /// A horizontal error bar with a rim of paper, to be seen on a filled bar in both themes.
    pub(crate) fn error_bar_on_fill(&mut self, [x, y]: ScenePoint, half: f64) {
        self.line(&[[x - half, y], [x + half, y]], Ink::Paper, 2.9);
        for end in [x - half, x + half] {
            self.line(&[[end, y - 3.3], [end, y + 3.3]], Ink::Paper, 2.9);
        }
        self.error_bar([x, y], half, false, Ink::Ink);
    }

    /// An error bar along y (`vertical`) or x, with caps.
    pub(crate) fn error_bar(&mut self, [x, y]: ScenePoint, half: f64, vertical: bool, ink: Ink) {
        let turn = |along: f64, across: f64| if vertical { [x + across, y + along] } else { [x + along, y + across] };
        self.line(&[turn(-half, 0.0), turn(half, 0.0)], ink, 1.3);
        for end in [-half, half] {
            self.line(&[turn(end, -2.5), turn(end, 2.5)], ink, 1.3);
        }
    }

    pub(crate) fn text(&mut self, at: ScenePoint, text: &str, size: f64, ink: Ink, anchor: Anchor) {
        let text = text::fit(text, size, self.width);
        self.marks.push(SceneMark::Text { at, text, size, ink, anchor });
    }

    /// A text whose capitals are centred on `at[1]`.
    pub(crate) fn text_mid(&mut self, at: ScenePoint, text: &str, size: f64, ink: Ink, anchor: Anchor) {
        self.text([at[0], at[1] + 0.36 * size], text, size, ink, anchor);
    }
}

fn distance(a: ScenePoint, b: ScenePoint) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_cover_the_drawn_share_of_a_line() {
        let mut scene = Scene::new();
        scene.dashed(&[[0.0, 0.0], [50.0, 0.0], [50.0, 50.0]], Ink::Ink, 1.0, [6.0, 4.0]);
        let drawn: f64 = scene
            .marks
            .iter()
            .map(|mark| match mark {
                SceneMark::Line { points, .. } => points.windows(2).map(|p| distance(p[0], p[1])).sum(),
                _ => 0.0,
            })
            .sum();
        assert!((drawn - 60.0).abs() < 1e-9, "{drawn}");
    }
}
