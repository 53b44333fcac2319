//! Marks in rows: bars over an axis of numbers, and cells under heads of columns.

use crate::axis::{ChartAxis, number};
use crate::chart::{Bar, Chart, ChartColumn, ChartRow, Mark, RowPlace};
use crate::palette::Ink;
use crate::paper::{RIM, TEXT, centred, on_paper, x_axis};
use crate::scene::{Anchor, Scene};
use crate::{WIDTH, text};

/// Heights of a bar with the blank below it, of a line of words, of a cell and of one with words below [design px].
const LANE: f64 = 19.0;
const HEAD: f64 = 24.0;
const CELL: f64 = 30.0;
const TALL: f64 = 44.0;
const BELOW: f64 = 8.0;
/// Widest column of names, and widest cell.
const NAMES: f64 = 240.0;
const WIDEST: f64 = 90.0;
/// Smallest text that can be read in a cell, and words below its number.
const SMALLEST: f64 = 8.5;
const SMALL: f64 = 10.0;

/// Widest name at the left of its row, with the blank behind it.
fn names(rows: &[ChartRow]) -> f64 {
    let beside = rows.iter().filter(|row| row.place == RowPlace::Beside);
    let widest = beside.map(|row| text::width(&row.name, TEXT)).fold(0.0, f64::max);
    if widest > 0.0 { widest.clamp(24.0, NAMES) + 8.0 } else { 2.0 }
}

/// Draws bars from `top` down, and sets the height of the scene.
pub(crate) fn bars(scene: &mut Scene, chart: &Chart, rows: &[ChartRow], [mut x, _]: [ChartAxis; 2], top: f64) {
    let bars: Vec<&Bar> =
        chart.marks.iter().filter_map(|m| if let Mark::Bar(bar) = m { Some(bar) } else { None }).collect();
    let outside = bars.iter().filter(|bar| !bar.inside).map(|bar| text::width(&bar.text, TEXT));
    let room = outside.fold(0.0, f64::max).min(200.0) + 8.0;
    x.pixels = [RIM + names(rows), WIDTH - RIM - room.max(if names(rows) > 2.0 { 8.0 } else { 16.0 })];
    let mut tops = vec![top + 2.0];
    for row in rows {
        let (head, below) = if row.place == RowPlace::Beside { (0.0, 2.0) } else { (HEAD, BELOW) };
        tops.push(tops[tops.len() - 1] + head + LANE * row.lanes.max(1) as f64 + below);
    }
    let bottom = tops[rows.len()];
    x_axis(scene, &x, &chart.x_label, [top + 2.0, bottom]);
    for value in chart.marks.iter().filter_map(|m| if let Mark::Rule(v) = m { Some(*v) } else { None }) {
        let at = x.at(value);
        if at.is_finite() {
            scene.dashed(&[[at, top - 2.0], [at, bottom]], Ink::Ink, 1.6, [6.0, 3.5]);
        }
    }
    for (i, row) in rows.iter().enumerate() {
        let first = match row.place {
            RowPlace::Beside => tops[i],
            RowPlace::Above | RowPlace::Heading => tops[i] + HEAD,
        };
        name(scene, row, tops[i]);
        for k in 0..row.lanes {
            let own: Vec<&Bar> = bars.iter().copied().filter(|bar| (bar.row, bar.lane) == (i, k)).collect();
            lane(scene, &x, &own, first + LANE * k as f64);
        }
    }
}

/// Name of a row, and the remark about it at the right.
fn name(scene: &mut Scene, row: &ChartRow, top: f64) {
    let right = WIDTH - RIM;
    let aside = text::width(&row.aside, TEXT);
    if row.place == RowPlace::Beside {
        let name = text::fit(&row.name, TEXT, NAMES);
        let room = text::width(&name, TEXT);
        return scene.text_mid([RIM + room, top + 0.5 * (LANE - 2.0)], &name, TEXT, Ink::Ink, Anchor::End);
    }
    let baseline = top + 18.0;
    let spare = if aside > 0.0 { aside + 28.0 } else { 0.0 };
    on_paper(scene, [RIM + 2.0, baseline], &text::fit(&row.name, TEXT, right - RIM - spare), Ink::Ink, Anchor::Start);
    if aside > 0.0 {
        on_paper(scene, [right, baseline], &row.aside, row.ink, Anchor::End);
        if row.ink != Ink::Muted {
            scene.rect([right - aside - 15.0, baseline - 9.0], [right - aside - 6.0, baseline], row.ink, 1.0);
        }
    }
}

/// Bars next to each other, and the text at their end.
fn lane(scene: &mut Scene, x: &ChartAxis, bars: &[&Bar], top: f64) {
    let (bottom, middle) = (top + LANE - 2.0, top + 0.5 * (LANE - 2.0));
    let mut end = x.at(bars.first().map_or(0.0, |bar| bar.span[0]).max(x.range[0]));
    for bar in bars {
        let ends = bar.span.map(|v| x.at(v));
        if !ends.iter().all(|v| v.is_finite()) {
            continue;
        }
        let (left, right) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let gap = if bar.inside && right - left > 3.0 { 0.75 } else { 0.0 };
        scene.rect([left + gap, top], [right - gap, bottom], bar.ink, bar.alpha);
        end = end.max(right);
        if bar.inside && text::width(&bar.text, TEXT) + 8.0 < right - left {
            scene.text_mid([0.5 * (left + right), middle], &bar.text, TEXT, Ink::Paper, Anchor::Middle);
        }
        if let Some(range) = bar.range.map(|range| range.map(|v| x.at(v))).filter(|r| r.iter().all(|v| v.is_finite())) {
            let half = 0.5 * (range[1] - range[0]).abs();
            if half > 0.5 {
                scene.error_bar_on_fill([0.5 * (range[0] + range[1]), middle], half);
                end = end.max(range[0]).max(range[1]);
            }
        }
    }
    let zero = x.at(0.0);
    if bars.iter().any(|bar| bar.span[1] < 0.0) && zero > x.pixels[0] {
        scene.line(&[[zero, top], [zero, bottom + 3.0]], Ink::Ink, 1.4);
    }
    for bar in bars.iter().filter(|bar| !bar.inside && !bar.text.is_empty()) {
        on_paper(scene, [end + 5.0, middle + 0.36 * TEXT], &bar.text, Ink::Ink, Anchor::Start);
    }
}

struct RowGrid {
    left: f64,
    tops: Vec<f64>,
    width: f64,
    height: f64,
}

/// Draws cells from `top` down, with the heads of columns below them, and sets the height of the scene.
pub(crate) fn cells(scene: &mut Scene, chart: &Chart, (rows, columns): (&[ChartRow], &[ChartColumn]), top: f64) {
    scene.text([RIM, top + 14.0], &chart.y_label, TEXT, Ink::Muted, Anchor::Start);
    let tall = chart.marks.iter().any(|mark| matches!(mark, Mark::Cell(.., words) if !words.is_empty()));
    let height = if tall { TALL } else { CELL };
    let left = RIM + names(rows).max(34.0);
    let width = ((WIDTH - RIM - left) / columns.len().max(1) as f64).min(WIDEST.max((WIDTH - left) / 6.0));
    let mut tops = vec![top + 22.0];
    for (i, row) in rows.iter().enumerate() {
        let between = if i > 0 { BELOW } else { 0.0 };
        let own = if row.place == RowPlace::Heading { HEAD + between } else { height };
        tops.push(tops[i] + own);
    }
    let bottom = tops[rows.len()];
    for (i, row) in rows.iter().enumerate() {
        match row.place {
            RowPlace::Heading => scene.text([left, tops[i + 1] - 7.0], &row.name, TEXT, Ink::Ink, Anchor::Start),
            RowPlace::Above | RowPlace::Beside => {
                let at = [left - 7.0, tops[i] + 0.5 * height];
                scene.text_mid(at, &text::fit(&row.name, TEXT, NAMES), TEXT, Ink::Muted, Anchor::End);
            }
        }
    }
    let grid = RowGrid { left, tops, width, height };
    grid.cells(scene, &chart.marks);
    let below = grid.heads(scene, columns, bottom);
    centred(scene, &chart.x_label, [left + 0.5 * width * columns.len() as f64, below + 18.0]);
    scene.height = below + 28.0;
    if let Some((label, limit)) = &chart.heat {
        colour_bar(scene, (label, *limit), left, below + 24.0);
    }
}

impl RowGrid {
    fn x(&self, column: usize) -> f64 {
        self.left + column as f64 * self.width
    }

    fn cells(&self, scene: &mut Scene, marks: &[Mark]) {
        let gap = if self.width > 14.0 { 2.0 } else { 0.5 };
        let texts = marks.iter().filter_map(|m| if let Mark::Cell(_, _, text, _) = m { Some(text) } else { None });
        let widest = texts.map(|words| text::width(words, 1.0)).fold(1.0, f64::max);
        let size = ((self.width - 5.0) / widest).min(TEXT);
        for mark in marks {
            let Mark::Cell([row, column], strength, words, below) = mark else { continue };
            let Some(top) = self.tops.get(*row) else { continue };
            let corner = [self.x(*column) + 0.5 * gap, top + 0.5 * gap];
            let end = [corner[0] + self.width - gap, corner[1] + self.height - gap];
            scene.rect(corner, end, Ink::Soft, 1.0);
            if strength.is_finite() {
                scene.rect(corner, end, Ink::Paper, 0.6);
                heat(scene, corner, end, *strength);
            }
            let lift = if below.is_empty() { 0.0 } else { 8.0 };
            let middle = [self.x(*column) + 0.5 * self.width, top + 0.5 * self.height];
            if size >= SMALLEST {
                let ink = if strength.is_finite() { Ink::Ink } else { Ink::Muted };
                scene.text_mid([middle[0], middle[1] - lift], words, size, ink, Anchor::Middle);
            }
            let below = text::fit(below, SMALL, self.width - 2.0);
            scene.text_mid([middle[0], middle[1] + 10.0], &below, SMALL, Ink::Ink, Anchor::Middle);
        }
    }

    /// Heads of columns and a bracket under each run of columns of one group; returns the height below.
    fn heads(&self, scene: &mut Scene, columns: &[ChartColumn], bottom: f64) -> f64 {
        let widest = columns.iter().map(|column| text::width(&column.name, TEXT)).fold(1.0, f64::max);
        let every = ((widest + 6.0) / self.width).ceil().max(1.0) as usize;
        for (i, column) in columns.iter().enumerate().step_by(every) {
            let at = [self.x(i) + 0.5 * self.width, bottom + 17.0];
            scene.text(at, &column.name, TEXT, Ink::Muted, Anchor::Middle);
        }
        let mut y = bottom + 18.0;
        for level in 0..2 {
            let mut start = 0;
            let runs: Vec<&[ChartColumn]> = columns.chunk_by(|a, b| a.groups[level..] == b.groups[level..]).collect();
            let named = columns.iter().any(|column| !column.groups[level].is_empty());
            if !named || level == 1 && runs.len() < 2 {
                continue;
            }
            y += if level == 0 { 8.0 } else { 24.0 };
            for run in runs {
                let (x0, x1) = (self.x(start) + 3.0, self.x(start + run.len()) - 3.0);
                scene.line(&[[x0, y - 3.0], [x0, y], [x1, y], [x1, y - 3.0]], Ink::Axis, 1.2);
                let name = text::fit(&run[0].groups[level], TEXT, x1 - x0 + 4.0);
                scene.text([0.5 * (x0 + x1), y + 16.0], &name, TEXT, Ink::Muted, Anchor::Middle);
                start += run.len();
            }
        }
        if y > bottom + 18.0 { y + 16.0 } else { y }
    }
}

fn heat(scene: &mut Scene, corner: [f64; 2], end: [f64; 2], strength: f64) {
    let ink = if strength < 0.0 { Ink::HeatNegative } else { Ink::HeatPositive };
    scene.rect(corner, end, ink, strength.abs().min(1.0));
}

fn colour_bar(scene: &mut Scene, (label, limit): (&str, f64), left: f64, top: f64) {
    const STEPS: usize = 31;
    let width = WIDTH - RIM - left;
    scene.text([left, top + 20.0], &text::fit(label, TEXT, width), TEXT, Ink::Ink, Anchor::Start);
    let y = top + 28.0;
    let step = width / STEPS as f64;
    for i in 0..STEPS {
        let x = left + step * i as f64;
        heat(scene, [x, y], [x + step, y + 12.0], 2.0 * i as f64 / (STEPS - 1) as f64 - 1.0);
    }
    let ends = [
        (left, format!("≤ {}", number(-limit, 0)), Anchor::Start),
        (left + 0.5 * width, "0".to_owned(), Anchor::Middle),
        (left + width, format!("≥ {}", number(limit, 0)), Anchor::End),
    ];
    for (x, label, anchor) in ends {
        scene.text([x, y + 27.0], &label, TEXT, Ink::Muted, anchor);
    }
    scene.height = y + 36.0;
}
