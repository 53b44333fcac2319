//! Where two models part: a map of their difference with the name of what carries it.

use crate::axis::number;
use crate::frame::{RIM, TEXT, title};
use crate::palette::Role;
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, same_length, text};

const CHART: &str = "breakdown map";
const ROW: f64 = 44.0;
/// Small text in a cell.
const SMALL: f64 = 10.0;

/// Differences over rows of one quantity and columns of another.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Breakdown {
    /// Title above the plot; empty for none.
    pub title: String,
    /// What a cell shows.
    pub value_label: String,
    /// What the columns are, with unit.
    pub column_label: String,
    /// What the rows are, with unit.
    pub row_label: String,
    /// Column heads.
    pub columns: Vec<String>,
    /// Row heads, first at the top.
    pub rows: Vec<String>,
    /// Cells by row.
    pub cells: Vec<Vec<BreakdownCell>>,
    /// Magnitude at which the models are said to part; cells below are pale.
    pub parts: f64,
    /// Magnitude at which the colour saturates.
    pub limit: f64,
}

/// One cell.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BreakdownCell {
    /// Difference in per cent; not finite: nothing is known.
    pub percent: f64,
    /// What carries it; empty for nothing.
    pub carrier: String,
}

/// Draws the map: orange where the first model bends more, blue where less.
///
/// Errors: no finite cell, rows or columns that do not match, over 12 of either.
pub fn breakdown(data: &Breakdown) -> Result<Drawn, ReportError> {
    same_length(CHART, "rows", data.rows.len(), data.cells.len())?;
    at_most(CHART, "columns", 12, data.columns.len())?;
    at_most(CHART, "rows", 12, data.rows.len())?;
    for row in &data.cells {
        same_length(CHART, "cells in a row", data.columns.len(), row.len())?;
    }
    super::axis::extent(data.cells.iter().flatten().map(|c| c.percent), CHART)?;
    let mut scene = Scene::new();
    let mut top = title(&mut scene, &data.title);
    for (line, words) in [&data.value_label, &data.row_label].into_iter().enumerate() {
        let role = if line == 0 { Role::Ink } else { Role::Muted };
        scene.text([RIM, top + 14.0], &text::fit(words, TEXT, WIDTH - 2.0 * RIM), TEXT, role, Anchor::Start);
        top += 19.0;
    }
    let widest = data.rows.iter().map(|r| text::width(r, TEXT)).fold(24.0, f64::max);
    let left = RIM + widest + 8.0;
    let width = (WIDTH - RIM - left) / data.columns.len().max(1) as f64;
    for (r, row) in data.cells.iter().enumerate() {
        let y = top + 6.0 + ROW * r as f64;
        scene.text_mid([left - 7.0, y + 0.5 * ROW], &data.rows[r], TEXT, Role::Muted, Anchor::End);
        for (c, cell) in row.iter().enumerate() {
            draw(&mut scene, data, cell, [left + width * c as f64, y], width);
        }
    }
    let bottom = top + 6.0 + ROW * data.rows.len() as f64;
    for (c, head) in data.columns.iter().enumerate() {
        let at = [left + width * (c as f64 + 0.5), bottom + 17.0];
        scene.text(at, head, TEXT, Role::Muted, Anchor::Middle);
    }
    let middle = left + 0.5 * width * data.columns.len() as f64;
    scene.text([middle, bottom + 36.0], &data.column_label, TEXT, Role::Muted, Anchor::Middle);
    scene.height = bottom + 46.0;
    paint::paint(&scene)
}

fn draw(scene: &mut Scene, data: &Breakdown, cell: &BreakdownCell, [x, y]: [f64; 2], width: f64) {
    let (corner, end) = ([x + 1.0, y + 1.0], [x + width - 1.0, y + ROW - 1.0]);
    scene.rect(corner, end, Role::Soft, 1.0);
    if cell.percent.is_finite() {
        scene.rect(corner, end, Role::Paper, 0.6);
        let role = if cell.percent < 0.0 { Role::HeatNegative } else { Role::HeatPositive };
        if cell.percent.abs() > data.parts {
            scene.rect(corner, end, role, (cell.percent.abs() / data.limit).clamp(0.15, 1.0));
        }
    }
    let sign = if cell.percent > 0.0 { "+" } else { "" };
    let value = if cell.percent.is_finite() { format!("{sign}{} %", number(cell.percent, 0)) } else { "–".into() };
    let lift = if cell.carrier.is_empty() { 0.0 } else { 8.0 };
    scene.text_mid([x + 0.5 * width, y + 0.5 * ROW - lift], &value, TEXT, Role::Ink, Anchor::Middle);
    if !cell.carrier.is_empty() {
        let words = text::fit(&cell.carrier, SMALL, width - 2.0);
        scene.text_mid([x + 0.5 * width, y + 0.5 * ROW + 10.0], &words, SMALL, Role::Ink, Anchor::Middle);
    }
}
