//! Grid lines of a robot: along the body so that welds and markers lie on rings, around so that edges and folds of the
//! actuator lie on generators.
//!
//! Where strips turn round the body, the grid turns with them. In the unrolled wall, with s across a strip of slant β:
//!
//! ```text
//! x = x_m − s sin β        Rθ = R (θ₀ + x_m tan β/R) + s cos β
//! ```
//!
//! Between strips x changes evenly, so that every ring closes. Towards base and tip the rings straighten, and generators run along the body.

use std::f64::consts::TAU;

use models::Scenario;
use models::actuators::pattern::Pattern;
use models::scenario::ActuatorChoice;

use super::RobotSettings;
use super::settings::{FOLDED_ROW, TAPED_SPACING};
use crate::vec3::{V3, where_so};
use crate::{FemError, Result};

/// Largest ratio of neighbouring elements where the size changes.
const GROWTH: f64 = 1.25;
/// A weld narrower than this share of the element size is a line, a margin is none: a row of slivers turns inside out. Strips and
/// their seams keep that far apart.
const LEAST_STRIP: f64 = 0.5;
/// Lines closer than this share of the element size become one.
const MERGE: f64 = 0.4;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct GridLines {
    /// Places of the rings where they cross the middle of a strip \[m\].
    pub x_m: Vec<f64>,
    /// The strips, in the order of the scenario.
    pub strips: Vec<StripLines>,
    /// Angles of all generators \[rad\], ascending from the edge of the first strip; where they turn, those at the base.
    pub angles: Vec<f64>,
    pub markers: Vec<usize>,
    turn: Option<GridTurn>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct StripLines {
    /// Rows of elements that are welded flat: (first ring, last ring); equal for a weld without width.
    pub welds: Vec<[usize; 2]>,
    pub first: usize,
    /// Places across the strip \[m\], from edge to edge of the sheet, its side welds included.
    pub s_m: Vec<f64>,
}

/// How the grid turns with slanted strips.
#[derive(Debug, Clone, PartialEq)]
struct GridTurn {
    /// From the first weld to the last \[m\].
    zone_m: [f64; 2],
    length_m: f64,
    /// Turn per length along the body, tan β/R \[rad/m\].
    rad_per_m: f64,
    /// How far each generator's nodes lie ahead of their ring there \[m\].
    ahead_m: Vec<f64>,
}

impl GridLines {
    /// # Errors
    /// [`FemError::Problem`] for strips of several slants, or so close that elements between them are slivers.
    pub(super) fn of(scenario: &Scenario, patterns: &[Pattern], settings: &RobotSettings) -> Result<GridLines> {
        let radius_m = scenario.radius_m;
        let cos = scenario.actuator.cos_slant(radius_m);
        let sin = scenario.actuator.sin_slant(radius_m);
        if scenario.strips().any(|strip| (strip.sin_slant(radius_m) - sin).abs() > 1e-9) {
            return Err(refused("strips of different slant\ngive all of them the same turns, count and length_mm"));
        }
        let bands = bands(scenario, cos, settings);
        let x_m = along(scenario, cos, &bands, patterns, settings);
        if let Some(pair) = sliver(&bands, LEAST_STRIP * cos * settings.actuator_size_m) {
            let [a, b] = pair.map(|m| m * 1e3);
            return Err(refused(&format!(
                "seams of two strips at {a:.2} and {b:.2} mm are too close for elements\nmove start_mm or length_mm of one"
            )));
        }
        let on_ring = |place: &f64| nearest(&x_m, *place);
        let mut strips: Vec<StripLines> = std::iter::zip(patterns, &bands)
            .map(|(pattern, bands)| StripLines {
                welds: bands.iter().map(|band| [on_ring(&band[0]), on_ring(&band[1])]).collect(),
                first: 0,
                s_m: across(pattern, settings),
            })
            .collect();
        let markers = scenario.markers_m.iter().map(on_ring).collect();
        let zone_m = [f64::min, f64::max].map(|of| bands.iter().flatten().flatten().copied().reduce(of).unwrap_or(0.0));
        let rad_per_m = sin / cos / radius_m;
        // Azimuths where the grid begins to turn.
        let centres: Vec<f64> = scenario
            .strips()
            .map(|strip| strip.azimuth_rad + rad_per_m * where_so(sin != 0.0, zone_m[0] - strip.start_m))
            .collect();
        let angles = around(radius_m, cos, &centres, &mut strips, settings)?;
        let ahead =
            || GridTurn { zone_m, length_m: scenario.length_m, rad_per_m, ahead_m: ahead(&angles, &strips, sin) };
        let turn = (sin != 0.0).then(ahead);
        Ok(GridLines { strips, markers, angles, turn, x_m })
    }

    /// Place of the node of a ring and a generator at a radius \[m\].
    pub(super) fn place(&self, ring: usize, column: usize, radius_m: f64) -> V3 {
        let (mut x, mut angle) = (self.x_m[ring], self.angles[column]);
        if let Some(turn) = &self.turn {
            angle += turn.angle(x);
            x += turn.ahead_m[column] * turn.share(x);
        }
        [x, radius_m * angle.cos(), radius_m * angle.sin()]
    }

    /// How far generators turn from base to tip \[rad\].
    pub(crate) fn turned_rad(&self) -> f64 {
        self.turn.as_ref().map_or(0.0, |turn| turn.angle(turn.length_m))
    }
}

impl StripLines {
    /// Generator at a place across the strip.
    pub(super) fn column(&self, s_m: f64) -> usize {
        self.first + nearest(&self.s_m, s_m)
    }
}

impl GridTurn {
    /// By which generators have turned at a ring \[rad\].
    fn angle(&self, x_m: f64) -> f64 {
        self.rad_per_m * (x_m.clamp(self.zone_m[0], self.zone_m[1]) - self.zone_m[0])
    }

    /// Share of `ahead_m` that a ring has.
    fn share(&self, x_m: f64) -> f64 {
        let [first, last] = self.zone_m;
        match x_m {
            x if x < first => x / first,
            x if x > last => (self.length_m - x) / (self.length_m - last),
            _ => 1.0,
        }
    }
}

fn refused(message: &str) -> FemError {
    FemError::Problem(format!("robot: {message}"))
}

/// Where every weld of every strip begins and ends along the body \[m\].
fn bands(scenario: &Scenario, cos: f64, settings: &RobotSettings) -> Vec<Vec<[f64; 2]>> {
    let (length, half) = (scenario.length_m, 0.5 * weld_m(settings) * cos);
    let of = |strip: &ActuatorChoice| {
        (0..=strip.count).map(|k| [-half, half].map(|w| (seam(strip, k, cos) + w).clamp(0.0, length))).collect()
    };
    scenario.strips().map(of).collect()
}

fn seam(strip: &ActuatorChoice, k: usize, cos: f64) -> f64 {
    strip.start_m + k as f64 * (strip.shape.length_m * cos)
}

/// Edges of welds of two strips that are neither on one ring nor `apart`.
fn sliver(bands: &[Vec<[f64; 2]>], apart: f64) -> Option<[f64; 2]> {
    let off = |strip: &[[f64; 2]], place: f64| {
        strip.iter().flatten().map(|edge| (edge - place).abs()).fold(f64::INFINITY, f64::min)
    };
    let close = |strip: &Vec<[f64; 2]>, other: &Vec<[f64; 2]>| {
        let place = other.iter().flatten().copied().find(|place| (1e-9..apart).contains(&off(strip, *place)))?;
        strip.iter().flatten().copied().find(|edge| (edge - place).abs() < apart).map(|edge| [edge, place])
    };
    bands.iter().enumerate().find_map(|(i, strip)| bands[..i].iter().find_map(|other| close(strip, other)))
}

/// How far the nodes of every generator lie ahead of their ring where the grid turns \[m\].
fn ahead(angles: &[f64], strips: &[StripLines], sin: f64) -> Vec<f64> {
    let mut known: Vec<(usize, f64)> = strips
        .iter()
        .flat_map(|strip| strip.s_m.iter().enumerate().map(|(i, s)| (strip.first + i, -s * sin)))
        .collect();
    known.sort_by_key(|(column, _)| *column);
    known.push((angles.len(), known[0].1));
    let angle = |column: usize| angles.get(column).copied().unwrap_or(angles[0] + TAU);
    let mut found = Vec::with_capacity(angles.len());
    for pair in known.windows(2) {
        let [(from, a), (to, b)] = [pair[0], pair[1]];
        let share = |column: usize| (angle(column) - angle(from)) / (angle(to) - angle(from));
        found.extend((from..to).map(|column| a + (b - a) * share(column)));
    }
    found
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
    where_so(width_m >= LEAST_STRIP * settings.actuator_size_m, width_m)
}

/// Distance of the rings at the actuator over the element size there.
pub(super) fn spacing(pattern: &Pattern, settings: &RobotSettings) -> f64 {
    settings.ring_spacing.unwrap_or(if pattern.is_taped() { TAPED_SPACING } else { 1.0 })
}

/// Lengths of the rows at the actuator \[m\]: away from welds, and next to them.
fn rows(pattern: &Pattern, settings: &RobotSettings) -> [f64; 2] {
    let row = spacing(pattern, settings) * settings.actuator_size_m;
    let folded = pattern.folds().then_some(FOLDED_ROW * weld_m(settings)).filter(|row| *row > 0.0);
    [row, settings.seam_row_m.or(folded).unwrap_or(row).min(row)]
}

fn along(
    scenario: &Scenario,
    cos: f64,
    bands: &[Vec<[f64; 2]>],
    patterns: &[Pattern],
    settings: &RobotSettings,
) -> Vec<f64> {
    let [row, beside] = rows(&patterns[0], settings).map(|row| cos * row);
    let length = scenario.length_m;
    let mut cuts = vec![0.0, length];
    for place in bands.iter().flatten().flatten() {
        add(&mut cuts, *place, 1e-9);
    }
    let pouch = |place: f64| {
        let over = |strip: &ActuatorChoice| seam(strip, 0, cos) < place && place < seam(strip, strip.count, cos);
        scenario.strips().any(over)
    };
    let size = |place: f64| if pouch(place) { row } else { settings.body_size_m };
    for place in scenario.markers_m.iter() {
        add(&mut cuts, *place, MERGE * size(*place));
    }
    if beside < row {
        let middle = |pair: &[[f64; 2]]| 0.5 * (pair[0][1] + pair[1][0]);
        bands
            .iter()
            .flat_map(|strip| strip.windows(2))
            .map(middle)
            .for_each(|place| add(&mut cuts, place, MERGE * row));
    }
    cuts.sort_by(f64::total_cmp);
    let weld = |place: f64| bands.iter().flatten().flatten().any(|edge| (edge - place).abs() < 1e-9);
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
    x_m
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

/// Lines after `a` to `b`, with steps that grow from `from` at a weld, at `a` or at `b`, to `to`.
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

/// Places across the strip: edges, the welds next to them, folds, and even steps between.
fn across(pattern: &Pattern, settings: &RobotSettings) -> Vec<f64> {
    let half = 0.5 * pattern.width_m;
    let mut cuts = vec![-half, half];
    let weld = where_so(pattern.side_welds, weld_m(settings));
    let margin = where_so(pattern.is_taped(), strip(settings.tape_margin_m, settings));
    for edge in [half + weld, half + weld + margin] {
        [-edge, edge].iter().for_each(|place| add(&mut cuts, *place, 1e-9));
    }
    for place in pattern.panels.iter().flat_map(|p| p.range_m()) {
        add(&mut cuts, place, 1e-9);
    }
    cuts.sort_by(f64::total_cmp);
    let steps = |pair: &[f64]| divided(pair[0], pair[1], settings.actuator_size_m).skip(1).collect::<Vec<_>>();
    std::iter::once(cuts[0]).chain(cuts.windows(2).flat_map(steps)).collect()
}

/// Generators of every strip and those between, which grow from the strips' size to the body's and back.
fn around(
    radius_m: f64,
    cos: f64,
    centres: &[f64],
    strips: &mut [StripLines],
    settings: &RobotSettings,
) -> Result<Vec<f64>> {
    let turned = |i: usize| (centres[i] - centres[0]).rem_euclid(TAU);
    let mut order: Vec<usize> = (0..centres.len()).collect();
    order.sort_by(|a, b| turned(*a).total_cmp(&turned(*b)));
    let mut angles = Vec::new();
    for (k, i) in order.iter().enumerate() {
        let next = order.get(k + 1).copied();
        let centre = radius_m * (centres[0] + turned(*i));
        let to_next = radius_m * (next.map_or(TAU, turned) - turned(*i));
        let last = cos * strips[*i].s_m[strips[*i].s_m.len() - 1];
        let gap = to_next - (last - cos * strips[next.unwrap_or(0)].s_m[0]);
        if gap < LEAST_STRIP * settings.actuator_size_m {
            return Err(refused(&format!(
                "{:.1} mm are left between the welds of two strips round the body\nmake them narrower, or move azimuth_deg",
                1e3 * gap
            )));
        }
        strips[*i].first = angles.len();
        angles.extend(strips[*i].s_m.iter().map(|s| (centre + cos * s) / radius_m));
        angles.extend(between(centre + last, 0.5 * gap, settings).map(|place| place / radius_m));
    }
    Ok(angles)
}

/// Places of the generators after one at `place` to another `2 half` further \[m\].
fn between(mut place: f64, half: f64, settings: &RobotSettings) -> impl Iterator<Item = f64> {
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
    let (scale, inner) = (half / sum, 2 * steps.len() - 1);
    let back: Vec<f64> = steps.iter().rev().copied().collect();
    steps.into_iter().chain(back).take(inner).map(move |step| {
        place += step * scale;
        place
    })
}
