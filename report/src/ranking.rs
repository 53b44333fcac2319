//! Ranking: one bar per hypothesis, in the order given; those that cannot be told apart in one colour.

use crate::axis::{Axis, common_decimals, extent, number};
use crate::frame::{Entry, Frame, Key, RIM, TEXT, legend, title};
use crate::palette::Role;
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, text};

const CHART: &str = "ranking";
const ROW: f64 = 21.0;
const MOST: usize = 60;
/// Widest column of names [design px].
const NAMES: f64 = 240.0;

/// Horizontal bars.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ranking {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Axis label with unit, e.g. `error left [mm]`.
    pub value_label: String,
    /// Rows from top to bottom.
    pub rows: Vec<RankingRow>,
}

/// One row of a [`Ranking`].
#[derive(Debug, Clone, PartialEq)]
pub struct RankingRow {
    /// Name.
    pub label: String,
    /// Value in the unit of the axis; a non-finite one shows "–".
    pub value: f64,
    /// Colour.
    pub class: RankClass,
}

/// What the colour of a [`RankingRow`] says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum RankClass {
    /// One of those that cannot be told apart.
    Alike,
    /// The nearest, which does not explain enough.
    Attempt,
    /// Fits worse than those that cannot be told apart.
    Worse,
    /// What is there beside, where nothing is said to be the best.
    Other,
    /// Rejected for its value.
    Rejected,
}

impl RankClass {
    fn role(self) -> Role {
        match self {
            RankClass::Alike => Role::Series(2),
            RankClass::Attempt => Role::Series(1),
            RankClass::Worse | RankClass::Other => Role::Muted,
            RankClass::Rejected => Role::Grid,
        }
    }

    fn words(self) -> &'static str {
        match self {
            RankClass::Alike => "cannot be told apart",
            RankClass::Attempt => "attempt",
            RankClass::Worse => "fits worse",
            RankClass::Other => "others",
            RankClass::Rejected => "on a physical bound, rejected",
        }
    }
}

/// Draws the rows with their names on the left.
///
/// Errors: no finite value, over 60 rows, values beyond 1e15.
pub fn ranking(data: &Ranking) -> Result<Drawn, ReportError> {
    at_most(CHART, "rows", MOST, data.rows.len())?;
    let values = || data.rows.iter().map(|row| row.value);
    extent(values(), CHART)?;
    let mut x = Axis::linear(values().chain([0.0]), CHART)?;
    let digits = common_decimals(values().filter(|v| v.is_finite()).fold(0.0, |a, b| f64::max(a, b.abs())));
    let widest = |texts: &mut dyn Iterator<Item = f64>| texts.fold(0.0, f64::max);
    let names = widest(&mut data.rows.iter().map(|row| text::width(&row.label, TEXT))).min(NAMES);
    let room = widest(&mut values().map(|v| text::width(&number(v, digits), TEXT))) + 8.0;
    x.pixels = [RIM + names + 8.0, WIDTH - RIM - room];
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title);
    let top = legend(&mut scene, top, &keys(data)) + 4.0;
    let frame = Frame { x, y: Axis::exact([0.0, 1.0]) };
    let bottom = top + ROW * data.rows.len() as f64 + 4.0;
    frame.x_axis(&mut scene, &data.value_label, [top, bottom]);
    for (i, row) in data.rows.iter().enumerate() {
        draw(&mut scene, &frame, row, (names, digits), top + 4.0 + ROW * i as f64);
    }
    paint::paint(&scene)
}

fn keys(data: &Ranking) -> Vec<Entry> {
    let classes = [RankClass::Alike, RankClass::Attempt, RankClass::Worse, RankClass::Other, RankClass::Rejected];
    let present = classes.into_iter().filter(|class| data.rows.iter().any(|row| row.class == *class));
    present.map(|c| Entry { key: Key::Patch, role: c.role(), name: c.words().into() }).collect()
}

fn draw(scene: &mut Scene, frame: &Frame, row: &RankingRow, (names, digits): (f64, usize), top: f64) {
    let (bottom, middle) = (top + ROW - 5.0, top + 0.5 * (ROW - 5.0));
    let label = text::fit(&row.label, TEXT, names);
    scene.text_mid([RIM + names, middle], &label, TEXT, Role::Ink, Anchor::End);
    let zero = frame.x.at(0.0);
    let mut right = zero;
    if row.value.is_finite() {
        right = frame.x.at(row.value).max(zero);
        scene.rect([zero, top], [frame.x.at(row.value), bottom], row.class.role(), 1.0);
    }
    let shown = number(row.value, digits);
    scene.rect([right + 2.0, top], [right + 6.0 + text::width(&shown, TEXT), bottom], Role::Paper, 1.0);
    scene.text_mid([right + 4.0, middle], &shown, TEXT, Role::Ink, Anchor::Start);
}
