//! The energy ledger: where the actuator's work went, term by term.

use crate::axis::{Axis, extent, number, short_number};
use crate::frame::{Entry, Frame, Key, RIM, TEXT, legend, title};
use crate::palette::{Role, SERIES};
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, same_length, text};

const CHART: &str = "ledger";
const ROW: f64 = 54.0;
const BAR: f64 = 22.0;

/// Stacked bars of signed energies, one bar per case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ledger {
    /// Title above the plot; empty for none.
    pub title: String,
    /// Axis label with unit, e.g. `energy [mJ], stored or spent → positive`.
    pub value_label: String,
    /// Names of up to eight terms; more cannot be told apart by colour, so join the small ones.
    pub terms: Vec<String>,
    /// One bar per case, e.g. per pressure or per engine.
    pub cases: Vec<LedgerCase>,
}

/// One bar of a [`Ledger`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LedgerCase {
    /// Label above the bar, e.g. `30 kPa`.
    pub label: String,
    /// Energy of each term, in mJ; positive values stack to the right, negative ones to the left.
    pub energies_mj: Vec<f64>,
}

/// Draws the ledger with the sum of each case at the right, which is zero when the balance closes.
///
/// Errors: no finite value, a case whose length differs from the terms, over 8 terms or 24 cases.
pub fn ledger(data: &Ledger) -> Result<Drawn, ReportError> {
    at_most(CHART, "terms", SERIES, data.terms.len())?;
    at_most(CHART, "cases", 24, data.cases.len())?;
    for case in &data.cases {
        same_length(CHART, "energies in a case", data.terms.len(), case.energies_mj.len())?;
    }
    extent(data.cases.iter().flat_map(|case| case.energies_mj.iter().copied()), CHART)?;
    let mut x = Axis::linear(data.cases.iter().flat_map(ends).chain([0.0]), CHART)?;
    // Half a tick label beyond each end.
    x.pixels = [RIM + 16.0, WIDTH - RIM - 16.0];
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title);
    let top = legend(&mut scene, top, &keys(data)) + 2.0;
    let bottom = top + ROW * data.cases.len() as f64;
    let frame = Frame { x, y: Axis::exact([0.0, 1.0]) };
    frame.x_axis(&mut scene, &data.value_label, [top, bottom]);
    for (i, case) in data.cases.iter().enumerate() {
        row(&mut scene, &frame, case, top + ROW * i as f64);
    }
    paint::paint(&scene)
}

fn finite(case: &LedgerCase) -> impl Iterator<Item = (usize, f64)> + '_ {
    case.energies_mj.iter().copied().enumerate().filter(|(_, energy)| energy.is_finite())
}

/// Lower and upper end of the stack.
fn ends(case: &LedgerCase) -> [f64; 2] {
    finite(case).fold([0.0, 0.0], |[low, high], (_, energy)| [low + energy.min(0.0), high + energy.max(0.0)])
}

fn keys(data: &Ledger) -> Vec<Entry> {
    let entry = |(i, name): (usize, &String)| Entry { key: Key::Patch, role: Role::Series(i), name: name.clone() };
    data.terms.iter().enumerate().map(entry).collect()
}

fn row(scene: &mut Scene, frame: &Frame, case: &LedgerCase, top: f64) {
    head(scene, case, top + 18.0);
    let (y0, y1) = (top + 25.0, top + 25.0 + BAR);
    let mut reached = [0.0, 0.0];
    for (i, energy) in finite(case).filter(|(_, energy)| *energy != 0.0) {
        let side = usize::from(energy > 0.0);
        let (from, to) = (frame.x.at(reached[side]), frame.x.at(reached[side] + energy));
        reached[side] += energy;
        let (left, right) = (from.min(to), from.max(to));
        let gap = if right - left > 3.0 { 0.75 } else { 0.0 };
        scene.rect([left + gap, y0], [right - gap, y1], Role::Series(i), 1.0);
        let shown = short_number(energy);
        if text::width(&shown, TEXT) + 8.0 < right - left {
            scene.text_mid([0.5 * (left + right), 0.5 * (y0 + y1)], &shown, TEXT, Role::Paper, Anchor::Middle);
        }
    }
    // Beside its own bar only: a line through all rows would cross names and sums.
    let zero = frame.x.at(0.0);
    scene.line(&[[zero, y0 - 3.0], [zero, y1 + 3.0]], Role::Ink, 1.4);
}

/// Case label on the left and its sum on the right, both on paper above the grid.
fn head(scene: &mut Scene, case: &LedgerCase, baseline: f64) {
    let sum: f64 = finite(case).map(|(_, energy)| energy).sum();
    let largest = finite(case).map(|(_, energy)| energy.abs()).fold(0.0, f64::max);
    let shown = if sum.abs() < 1e-4 * largest { number(0.0, 0) } else { short_number(sum) };
    let sum = format!("sum {shown}");
    let sum_width = text::width(&sum, TEXT);
    let label = text::fit(&case.label, TEXT, WIDTH - 2.0 * RIM - sum_width - 20.0);
    let (left, right) = (RIM + 2.0, WIDTH - RIM);
    for [x0, x1] in [[left - 2.0, left + text::width(&label, TEXT) + 3.0], [right - sum_width - 3.0, right]] {
        scene.rect([x0, baseline - TEXT], [x1, baseline + 4.0], Role::Paper, 1.0);
    }
    scene.text([left, baseline], &label, TEXT, Role::Ink, Anchor::Start);
    scene.text([right, baseline], &sum, TEXT, Role::Muted, Anchor::End);
}
