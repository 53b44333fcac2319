//! Grid lines of a robot: along the body so that welds and markers lie on rings, around so that edges and folds of the
//! actuator lie on generators.

use std::f64::consts::TAU;

use models::Scenario;
use models::actuators::pattern::Pattern;

use super::RobotSettings;
use super::settings::{FOLDED_ROW, TAPED_SPACING};

/// Largest ratio of neighbouring elements where the size changes.
const GROWTH: f64 = 1.25;
/// A weld narrower than this share of the element size is a line, a margin is none: a row of slivers turns inside out.
const LEAST_STRIP: f64 = 0.5;
/// Lines closer than this share of the element size become one.
const MERGE: f64 = 0.4;

/// The grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lines {
    /// Places of the rings \[m\].
    pub x_m: Vec<f64>,
    /// Rows of elements that are welded flat: (first ring, last ring); equal for a weld without width.
    pub welds: Vec<[usize; 2]>,
    /// Places across the strip \[m\], from edge to edge of the sheet, its side welds included; the first generators.
    pub s_m: Vec<f64>,
    /// Angles of all generators from the middle of the strip \[rad\], ascending from the strip's edge.
    pub angles: Vec<f64>,
    /// Ring of every marker.
    pub markers: Vec<usize>,
}

impl Lines {
    pub fn of(scenario: &Scenario, pattern: &Pattern, settings: &RobotSettings) -> Lines {
        let (x_m, bands) = along(scenario, rows(pattern, settings), settings);
        let nearest = |place: f64| nearest(&x_m, place);
        let welds = bands.iter().map(|band| band.map(nearest)).collect();
        let markers = scenario.markers_m.iter().map(|s| nearest(*s)).collect();
        let s_m = across(pattern, settings);
        let angles = around(scenario.radius_m, &s_m, settings);
        Lines { welds, markers, s_m, angles, x_m }
    }

    /// Generator at a place across the strip.
    pub fn column(&self, s_m: f64) -> usize {
        nearest(&self.s_m, s_m)
    }
}

fn nearest(places: &[f64], wanted: f64) -> usize {
    let far = |i: &usize| (places[*i] - wanted).abs();
    (0..places.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
}

/// Width of the welds in the mesh \[m\]; 0 is a line.
pub(super) fn weld_m(settings: &RobotSettings) -> f64 {
    strip(settings.weld_m, settings)
}

fn strip(width_m: f64, settings: &RobotSettings) -> f64 {
    if width_m >= LEAST_STRIP * settings.actuator_size_m { width_m } else { 0.0 }
}

/// Distance of the rings at the actuator over the element size there.
pub(super) fn spacing(pattern: &Pattern, settings: &RobotSettings) -> f64 {
    settings.ring_spacing.unwrap_or(if pattern.is_taped() { TAPED_SPACING } else { 1.0 })
}

/// Lengths of the rows at the actuator \[m\]: away from welds, and beside them.
fn rows(pattern: &Pattern, settings: &RobotSettings) -> [f64; 2] {
    let row = spacing(pattern, settings) * settings.actuator_size_m;
    let folded = pattern.folds().then_some(FOLDED_ROW * weld_m(settings)).filter(|row| *row > 0.0);
    [row, settings.seam_row_m.or(folded).unwrap_or(row).min(row)]
}

/// Rings, and where each weld begins and ends.
fn along(scenario: &Scenario, [row, beside]: [f64; 2], settings: &RobotSettings) -> (Vec<f64>, Vec<[f64; 2]>) {
    let (actuator, length) = (&scenario.actuator, scenario.length_m);
    let seam = |k: usize| actuator.start_m + k as f64 * actuator.shape.length_m;
    let half = 0.5 * weld_m(settings);
    let bands: Vec<[f64; 2]> =
        (0..=actuator.count).map(|k| [-half, half].map(|w| (seam(k) + w).clamp(0.0, length))).collect();
    let mut cuts = vec![0.0, length];
    bands.iter().flatten().for_each(|place| add(&mut cuts, *place, 1e-9));
    let [first, last] = [seam(0), seam(actuator.count)];
    let pouch = |place: f64| first < place && place < last;
    let size = |place: f64| if pouch(place) { row } else { settings.body_size_m };
    scenario.markers_m.iter().for_each(|place| add(&mut cuts, *place, MERGE * size(*place)));
    if beside < row {
        let middle = |pair: &[[f64; 2]]| 0.5 * (pair[0][1] + pair[1][0]);
        bands.windows(2).map(middle).for_each(|place| add(&mut cuts, place, MERGE * row));
    }
    cuts.sort_by(f64::total_cmp);
    let weld = |place: f64| bands.iter().flatten().any(|edge| (edge - place).abs() < 1e-9);
    let mut x_m = vec![0.0];
    for pair in cuts.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let middle = 0.5 * (a + b);
        if beside < row && pouch(middle) && weld(a) != weld(b) {
            x_m.extend(growing(a, b, [beside, row], weld(b)));
        } else {
            x_m.extend(divided(a, b, size(middle)).skip(1));
        }
    }
    (x_m, bands)
}

/// Adds a line unless there is one within `apart`.
fn add(cuts: &mut Vec<f64>, place: f64, apart: f64) {
    if cuts.iter().all(|c| (c - place).abs() > apart) {
        cuts.push(place);
    }
}

/// Lines from `a` to `b`, about `size` apart.
fn divided(a: f64, b: f64, size: f64) -> impl Iterator<Item = f64> {
    let n = ((b - a) / size).round().max(1.0) as usize;
    (0..=n).map(move |i| if i == n { b } else { a + (b - a) * i as f64 / n as f64 })
}

/// Lines after `a` to `b`, with steps that grow from `from` beside a weld, at `a` or at `b`, to `to`.
fn growing(a: f64, b: f64, [from, to]: [f64; 2], weld_at_b: bool) -> impl Iterator<Item = f64> {
    let (mut steps, mut sum) = (vec![from], from);
    while let Some(step) = steps.last().map(|last| to.min(last * GROWTH)).filter(|step| sum + 0.5 * step < b - a) {
        steps.push(step);
        sum += step;
    }
    if weld_at_b {
        steps.reverse();
    }
    let (scale, n, mut place) = ((b - a) / sum, steps.len(), a);
    steps.into_iter().enumerate().map(move |(i, step)| {
        place += scale * step;
        if i + 1 == n { b } else { place }
    })
}

/// Places across the strip: edges, the welds beside them, folds, and even steps between.
fn across(pattern: &Pattern, settings: &RobotSettings) -> Vec<f64> {
    let half = 0.5 * pattern.width_m;
    let mut cuts = vec![-half, half];
    let weld = if pattern.side_welds { weld_m(settings) } else { 0.0 };
    let margin = if pattern.is_taped() { strip(settings.tape_margin_m, settings) } else { 0.0 };
    for edge in [half + weld, half + weld + margin] {
        [-edge, edge].iter().for_each(|place| add(&mut cuts, *place, 1e-9));
    }
    pattern.panels.iter().flat_map(|p| p.range_m()).for_each(|place| add(&mut cuts, place, 1e-9));
    cuts.sort_by(f64::total_cmp);
    let steps = |pair: &[f64]| divided(pair[0], pair[1], settings.actuator_size_m).skip(1).collect::<Vec<_>>();
    std::iter::once(cuts[0]).chain(cuts.windows(2).flat_map(steps)).collect()
}

/// The strip's generators, then the others: growing from the strip's size to the body's and back.
fn around(radius: f64, s_m: &[f64], settings: &RobotSettings) -> Vec<f64> {
    let (first, last) = (s_m[0], s_m[s_m.len() - 1]);
    let half = 0.5 * (TAU * radius - (last - first));
    let mut steps = Vec::new();
    let (mut size, mut sum) = (settings.actuator_size_m, 0.0);
    while sum + 0.5 * size < half || steps.is_empty() {
        let grown = if size < settings.body_size_m { size * GROWTH } else { size / GROWTH };
        size = match size < settings.body_size_m {
            true => grown.min(settings.body_size_m),
            false => grown.max(settings.body_size_m),
        };
        steps.push(size);
        sum += size;
    }
    let scale = half / sum;
    let mut place = last;
    let mut angles: Vec<f64> = s_m.iter().map(|s| s / radius).collect();
    for step in steps.iter().chain(steps.iter().rev()) {
        place += step * scale;
        angles.push(place / radius);
    }
    angles.pop();
    angles
}
