//! Signed residuals per marker and hold, in units of noise.

use crate::axis::{extent, number};
use crate::frame::{RIM, TEXT, title};
use crate::palette::Role;
use crate::scene::{Anchor, Scene};
use crate::{Drawn, ReportError, WIDTH, at_most, paint, same_length, text};

const CHART: &str = "residual map";
const ROW: f64 = 30.0;
/// Height of the line above a panel [design px].
const HEAD: f64 = 24.0;
/// Blank between panels [design px].
const BETWEEN: f64 = 8.0;
/// Most columns and rows that still show their colours on a phone.
const MOST: usize = 60;

/// Heat maps marker × hold of residuals divided by their noise, one under the other with the same columns and colours.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResidualMap {
    /// Title above the plot; empty for none.
    pub title: String,
    /// What a cell shows, e.g. `(predicted − measured) / noise`.
    pub value_label: String,
    /// Columns in the order of the protocol.
    pub holds: Vec<MapHold>,
    /// Marker stations along the robot in mm, base first.
    pub stations_mm: Vec<f64>,
    /// One heat map per direction.
    pub panels: Vec<MapPanel>,
    /// Magnitude at which the colour saturates, in units of noise, e.g. 10; must be positive.
    pub limit: f64,
}

/// One direction of a [`ResidualMap`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MapPanel {
    /// Which, e.g. `y, across the robot`.
    pub label: String,
    /// Cell values by marker, then by hold, in units of noise; non-finite cells show "–".
    pub values: Vec<Vec<f64>>,
}

/// One column of a [`ResidualMap`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MapHold {
    /// Actuator pressure, in kPa.
    pub p_act_kpa: f64,
    /// Phase of the protocol, e.g. `load` or `unload`.
    pub phase: String,
    /// What several phases have in common, e.g. `body 2 kPa`; empty for none.
    pub group: String,
}

/// Draws the heat maps: blue below zero, orange above, the number in each cell.
///
/// Errors: no finite cell, rows or columns that do not match the stations and holds, over 60 of either.
pub fn residual_map(data: &ResidualMap) -> Result<Drawn, ReportError> {
    for MapPanel { values, .. } in &data.panels {
        same_length(CHART, "rows", data.stations_mm.len(), values.len())?;
        for row in values {
            same_length(CHART, "cells in a row", data.holds.len(), row.len())?;
        }
    }
    at_most(CHART, "holds", MOST, data.holds.len())?;
    at_most(CHART, "markers", MOST, data.stations_mm.len())?;
    extent(all_values(data), CHART)?;
    let mut scene = Scene::new();
    let top = title(&mut scene, &data.title);
    scene.text([RIM, top + 14.0], "marker station [mm]", TEXT, Role::Muted, Anchor::Start);
    let mut grid = Grid::new(data, top + HEAD);
    for (i, panel) in data.panels.iter().enumerate() {
        grid.top = if i == 0 { grid.top + HEAD } else { grid.bottom() + BETWEEN + HEAD };
        let label = text::fit(&panel.label, TEXT, WIDTH - RIM - grid.left);
        scene.text([grid.left, grid.top - 7.0], &label, TEXT, Role::Ink, Anchor::Start);
        cells(&mut scene, data, panel, &grid);
        stations(&mut scene, data, &grid);
    }
    let below = phases(&mut scene, data, &grid);
    colour_bar(&mut scene, data, &grid, below);
    paint::paint(&scene)
}

fn all_values(data: &ResidualMap) -> impl Iterator<Item = f64> {
    data.panels.iter().flat_map(|panel| &panel.values).flatten().copied()
}

/// Pixel layout of the cells of a panel; the tip is the top row.
struct Grid {
    left: f64,
    top: f64,
    cell: f64,
    rows: usize,
}

impl Grid {
    fn new(data: &ResidualMap, top: f64) -> Self {
        let widest = data.stations_mm.iter().map(|s| text::width(&number(*s, 0), TEXT)).fold(24.0, f64::max);
        let left = RIM + widest + 8.0;
        let cell = ((WIDTH - RIM - left) / data.holds.len().max(1) as f64).min(90.0);
        Grid { left, top, cell, rows: data.stations_mm.len() }
    }

    fn x(&self, hold: usize) -> f64 {
        self.left + hold as f64 * self.cell
    }

    fn y(&self, marker: usize) -> f64 {
        self.top + (self.rows - 1 - marker) as f64 * ROW
    }

    fn bottom(&self) -> f64 {
        self.top + self.rows as f64 * ROW
    }
}

fn limit(data: &ResidualMap) -> f64 {
    if data.limit.is_finite() && data.limit > 0.0 { data.limit } else { 10.0 }
}

fn heat(scene: &mut Scene, corner: [f64; 2], size: [f64; 2], value: f64, limit: f64) {
    let role = if value < 0.0 { Role::HeatNegative } else { Role::HeatPositive };
    let strength = (value.abs() / limit).min(1.0);
    scene.rect(corner, [corner[0] + size[0], corner[1] + size[1]], role, strength);
}

fn cells(scene: &mut Scene, data: &ResidualMap, panel: &MapPanel, grid: &Grid) {
    let gap = if grid.cell > 14.0 { 2.0 } else { 0.5 };
    let shown = |value: f64| number(value, usize::from(value.abs() < 99.95 && grid.cell >= 34.0));
    let widest = all_values(data).map(|v| text::width(&shown(v), 1.0)).fold(1.0, f64::max);
    let size = ((grid.cell - 5.0) / widest).min(TEXT);
    for (marker, row) in panel.values.iter().enumerate() {
        for (hold, value) in row.iter().enumerate() {
            let corner = [grid.x(hold) + 0.5 * gap, grid.y(marker) + 0.5 * gap];
            let extent = [grid.cell - gap, ROW - gap];
            scene.rect(corner, [corner[0] + extent[0], corner[1] + extent[1]], Role::Soft, 1.0);
            if value.is_finite() {
                scene.rect(corner, [corner[0] + extent[0], corner[1] + extent[1]], Role::Paper, 0.6);
                heat(scene, corner, extent, *value, limit(data));
            }
            if size >= 8.5 {
                let role = if value.is_finite() { Role::Ink } else { Role::Muted };
                let middle = [grid.x(hold) + 0.5 * grid.cell, grid.y(marker) + 0.5 * ROW];
                scene.text_mid(middle, &shown(*value), size, role, Anchor::Middle);
            }
        }
    }
}

fn stations(scene: &mut Scene, data: &ResidualMap, grid: &Grid) {
    for (marker, station) in data.stations_mm.iter().enumerate() {
        let at = [grid.left - 7.0, grid.y(marker) + 0.5 * ROW];
        scene.text_mid(at, &number(*station, 0), TEXT, Role::Muted, Anchor::End);
    }
}

/// Pressures under the columns and a bracket under each run of columns of one phase, and of one group where there are several;
/// returns the height below.
fn phases(scene: &mut Scene, data: &ResidualMap, grid: &Grid) -> f64 {
    let labels: Vec<String> = data.holds.iter().map(|hold| number(hold.p_act_kpa, 0)).collect();
    let widest = labels.iter().map(|label| text::width(label, TEXT)).fold(1.0, f64::max);
    let every = ((widest + 6.0) / grid.cell).ceil().max(1.0) as usize;
    for (hold, label) in labels.iter().enumerate().step_by(every) {
        let at = [grid.x(hold) + 0.5 * grid.cell, grid.bottom() + 17.0];
        scene.text(at, label, TEXT, Role::Muted, Anchor::Middle);
    }
    let mut y = grid.bottom() + 26.0;
    let phases = data.holds.chunk_by(|a, b| (&a.phase, &a.group) == (&b.phase, &b.group));
    brackets(scene, grid, y, phases.map(|run| (run.len(), run[0].phase.as_str())));
    let groups = data.holds.chunk_by(|a, b| a.group == b.group);
    if groups.clone().count() > 1 {
        y += 24.0;
        brackets(scene, grid, y, groups.map(|run| (run.len(), run[0].group.as_str())));
    }
    let middle = 0.5 * (grid.left + grid.x(data.holds.len()));
    let name = "actuator pressure [kPa]";
    let half = 0.5 * text::width(name, TEXT);
    scene.text([middle.max(RIM + half), y + 34.0], name, TEXT, Role::Muted, Anchor::Middle);
    y + 40.0
}

/// A bracket at a height under each run of columns, with its name below it; runs as their lengths and names.
fn brackets<'n>(scene: &mut Scene, grid: &Grid, y: f64, runs: impl Iterator<Item = (usize, &'n str)>) {
    let mut start = 0;
    for (columns, name) in runs {
        let (x0, x1) = (grid.x(start) + 3.0, grid.x(start + columns) - 3.0);
        scene.line(&[[x0, y - 3.0], [x0, y], [x1, y], [x1, y - 3.0]], Role::Axis, 1.2);
        let name = text::fit(name, TEXT, x1 - x0 + 4.0);
        scene.text([0.5 * (x0 + x1), y + 16.0], &name, TEXT, Role::Muted, Anchor::Middle);
        start += columns;
    }
}

fn colour_bar(scene: &mut Scene, data: &ResidualMap, grid: &Grid, top: f64) {
    const STEPS: usize = 31;
    let (limit, left, width) = (limit(data), grid.left, WIDTH - RIM - grid.left);
    let label = text::fit(&data.value_label, TEXT, width);
    scene.text([left, top + 20.0], &label, TEXT, Role::Ink, Anchor::Start);
    let y = top + 28.0;
    for i in 0..STEPS {
        let value = limit * (2.0 * i as f64 / (STEPS - 1) as f64 - 1.0);
        heat(scene, [left + width * i as f64 / STEPS as f64, y], [width / STEPS as f64, 12.0], value, limit);
    }
    let digits = usize::from(limit < 10.0 && limit.fract() != 0.0);
    let ends = [
        (left, format!("≤ {}", number(-limit, digits)), Anchor::Start),
        (left + 0.5 * width, "0".to_owned(), Anchor::Middle),
        (left + width, format!("≥ {}", number(limit, digits)), Anchor::End),
    ];
    for (x, label, anchor) in ends {
        scene.text([x, y + 27.0], &label, TEXT, Role::Muted, anchor);
    }
    scene.height = y + 36.0;
}
