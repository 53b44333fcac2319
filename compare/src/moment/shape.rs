//! Stage 1, shape: a free bend for every hold and place, without any law, and the few numbers that all holds share.
//!
//! ```text
//! κ(hold, sample, place) = bend(hold, place) + drift(hold, sample)      Σ drift over a hold's samples = 0
//! markers = camera(line at a distance from the taut generator; κ) + noise
//! ```
//!
//! Fitted by least squares to the whitened mean over runs. No law of bending can mend the remaining misfit: a marker that was glued
//! elsewhere, a camera that moved. The shared numbers are the position of the tracked line, by which it shortens as it
//! bends (a marker's height is the same number), and the camera's scale and roll. Each is held near nothing by a wide prior.

use super::result::SharedNumber;
use super::view::{Division, HoldMoment, Pieces, View};
use crate::error::CompareError;
use crate::fit::least_squares::{FitRange, minimise_by, products, square};
use crate::fit::numbers::differences;
use models::{Prediction, Scenario, Step};
use nalgebra::DMatrix;

/// Bends of all holds, fitted to the markers without a law.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Parts with a separate bend each.
    pub division: Division,
    /// Bends, drifts and shared numbers, in that order: see `ShapeLayout`.
    pub numbers: Vec<f64>,
    pub covariance: DMatrix<f64>,
    pub shared: Vec<SharedNumber>,
    /// What no law of bending can mend, beyond noise \[mm\].
    pub floor_mm: f64,
}

impl Shape {
    /// Bends of all places, moment after moment \[1/m\].
    pub fn bends(&self) -> Vec<Vec<f64>> {
        let layout = ShapeLayout::of(&self.division);
        self.division.moments.iter().map(|m| bends(&layout, &self.numbers, m.hold, m.group)).collect()
    }
}

/// Index of each number of a shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShapeLayout {
    holds: usize,
    places: usize,
    groups: usize,
}

impl ShapeLayout {
    pub(super) fn of(division: &Division) -> ShapeLayout {
        let groups = division.groups;
        ShapeLayout { holds: division.moments.len() / groups, places: division.places.len(), groups }
    }

    /// Bend of a hold at a place.
    pub(super) fn bend(&self, hold: usize, place: usize) -> usize {
        hold * self.places + place
    }

    /// Drift of a later group of samples in a hold, from 1.
    pub(super) fn drift(&self, hold: usize, group: usize) -> usize {
        self.holds * self.places + hold * (self.groups - 1) + group - 1
    }

    pub(super) fn shared(&self) -> usize {
        self.holds * (self.places + self.groups - 1)
    }

    /// Drift of a group as a sum of numbers: the first is what the others leave.
    pub(super) fn drifts(&self, hold: usize, group: usize) -> Vec<(usize, f64)> {
        match group {
            0 => (1..self.groups).map(|later| (self.drift(hold, later), -1.0)).collect(),
            _ => vec![(self.drift(hold, group), 1.0)],
        }
    }
}

/// Words, unit and units per SI of the shared numbers; of the first per body radius.
const SHARED: [(&str, &str, f64); 3] = [
    ("tracked line further from the taut side", "mm", 1e3),
    ("camera scale", "%", 100.0),
    ("camera roll", "°", 180.0 / std::f64::consts::PI),
];
/// Wide priors of the shared numbers: the tracked line by a body radius, the camera by a tenth.
const PRIOR: [f64; 3] = [1.0, 0.1, 0.1];
/// Step of the differences: of a bend \[1/m\], of the line's distance over the radius.
const STEP: f64 = 1e-5;
/// A round that lowers the sum of squares by less is the last.
const ENOUGH: f64 = 1e-7;
/// Turns of the whole robot among which the start is looked for \[rad\].
const TURNS: [f64; 2] = [-1.5, 5.0];
const TRIED: usize = 66;

/// Fits a shape.
///
/// # Errors
/// Positions that no shape comes near: not finite.
pub(crate) fn shape(view: &View) -> Result<Shape, CompareError> {
    let uniform = Division::uniform(view);
    let start = start(view, &uniform);
    let most = start.iter().fold(0.0_f64, |most, bend| most.max(bend.abs()));
    let division = Division::of(view, most);
    let layout = ShapeLayout::of(&division);
    let mut numbers = vec![0.0; layout.shared() + shared_count(view)];
    for (hold, bend) in start.iter().enumerate() {
        (0..division.places.len()).for_each(|place| numbers[layout.bend(hold, place)] = *bend);
    }
    ShapeFit { view, layout, steps: division.steps(view.dataset), division: &division }.from(&numbers)
}

/// The camera's numbers are settled where its frame was measured.
fn shared_count(view: &View) -> usize {
    if view.direct.frame { 1 } else { 3 }
}

/// Uniform bend of every hold, the best of a scan.
fn start(view: &View, uniform: &Division) -> Vec<f64> {
    let pieces = Pieces::new(view.scenario, uniform);
    let (mut state, steps) = (pieces.model.prediction(), uniform.steps(view.dataset));
    let width = view.target_m.len() / steps.len();
    let mut best = vec![(f64::INFINITY, 0.0); steps.len()];
    for i in 0..=TRIED {
        let turn = TURNS[0] + (TURNS[1] - TURNS[0]) * i as f64 / TRIED as f64;
        let bend = turn / view.scenario.length_m;
        for (hold, step) in steps.iter().enumerate() {
            pieces.model.bend(&step.loads, &pieces.curvatures(&[bend]), &mut state);
            let seen = state.markers.iter().flatten().cycle();
            let rows = &view.target_m[hold * width..(hold + 1) * width];
            let squares: f64 = rows.iter().zip(seen).map(|(y, f)| (y - f).powi(2)).sum();
            if squares < best[hold].0 {
                best[hold] = (squares, bend);
            }
        }
    }
    best.into_iter().map(|(_, bend)| bend).collect()
}

struct ShapeFit<'a> {
    view: &'a View<'a>,
    division: &'a Division,
    layout: ShapeLayout,
    steps: Vec<Step>,
}

impl ShapeFit<'_> {
    fn from(&self, start: &[f64]) -> Result<Shape, CompareError> {
        let ranges: Vec<FitRange> = (0..start.len()).map(|k| FitRange::endless(self.prior(k))).collect();
        let mut residuals = |numbers: &[f64]| Some(self.residuals(numbers)).filter(|r| r.iter().all(|v| v.is_finite()));
        let found = minimise_by(start, &ranges, ENOUGH, &mut residuals, &mut |at, _| self.jacobian(&at.at))
            .ok_or_else(|| no_shape("its positions are not finite"))?;
        let numbers = found.at;
        let all: Vec<usize> = (0..numbers.len()).collect();
        let inverse =
            products(&found.jacobian, &all).cholesky().ok_or_else(|| no_shape("its markers do not determine one"))?;
        let white = &found.residual[..found.residual.len() - numbers.len()];
        let unseen = self.view.dataset.unseen_values().count();
        let dof = (white.len() - unseen).saturating_sub(numbers.len()).max(1);
        // A misfit of the shape itself makes every number of it less certain.
        let wider = (square(white) / dof as f64).max(1.0);
        let covariance = inverse.inverse() * wider;
        let scales = [self.view.scenario.radius_m, 1.0, 1.0];
        let shared = SHARED.iter().zip(scales).zip(self.layout.shared()..numbers.len());
        let shared = shared.map(|(((name, unit, factor), scale), k)| SharedNumber {
            name: name.to_string(),
            unit: unit.to_string(),
            value: factor * scale * numbers[k],
            sd: factor * scale * covariance[(k, k)].sqrt(),
        });
        Ok(Shape {
            division: self.division.clone(),
            shared: shared.collect(),
            floor_mm: 1e3 * self.view.whitener.unit_m() * (wider - 1.0).sqrt(),
            covariance,
            numbers,
        })
    }

    /// Standard deviation of the prior of a number: a bend is of the size 1/R, also where no marker shows it.
    fn prior(&self, number: usize) -> f64 {
        number.checked_sub(self.layout.shared()).map_or(1.0 / self.view.scenario.radius_m, |k| PRIOR[k])
    }

    /// Whitened differences of the markers, then of every number from its prior.
    fn residuals(&self, numbers: &[f64]) -> Vec<f64> {
        let predicted = self.predicted(numbers, None);
        let mut residual = differences(&predicted, self.view.target_m);
        self.view.dataset.unseen_values().for_each(|i| residual[i] = 0.0);
        let mut white = self.view.whitener.whiten(&residual);
        white.extend(numbers.iter().enumerate().map(|(k, x)| x / self.prior(k)));
        white
    }

    /// Positions \[m\], with the bends of one place moved by a step in every hold and group.
    fn predicted(&self, numbers: &[f64], moved: Option<usize>) -> Vec<f64> {
        let shared = &numbers[self.layout.shared()..];
        let pieces = Pieces::new(&tracked(self.view.scenario, shared[0]), self.division);
        let mut state = pieces.model.prediction();
        let samples = self.view.dataset.samples_per_hold;
        let mut out = Vec::with_capacity(self.view.target_m.len());
        let mut positions = |(moment, step): (&HoldMoment, &Step)| {
            let mut bends = bends(&self.layout, numbers, moment.hold, moment.group);
            moved.iter().for_each(|place| bends[*place] += STEP);
            pieces.model.bend(&step.loads, &pieces.curvatures(&bends), &mut state);
            seen(&state, &shared[1..])
        };
        let all: Vec<Vec<f64>> = self.division.moments.iter().zip(&self.steps).map(&mut positions).collect();
        for rows in all.chunks(self.division.groups) {
            out.extend((0..samples).flat_map(|t| rows[self.division.group(t, samples)].iter().copied()));
        }
        out
    }

    /// Whitened derivatives, one column per number. A bend moves its own hold alone, so one step of a place serves all holds.
    fn jacobian(&self, numbers: &[f64]) -> Vec<Vec<f64>> {
        let here = self.predicted(numbers, None);
        let unseen: Vec<usize> = self.view.dataset.unseen_values().collect();
        let column = |there: Vec<f64>| {
            let mut column: Vec<f64> = there.iter().zip(&here).map(|(b, a)| (b - a) / STEP).collect();
            unseen.iter().for_each(|i| column[*i] = 0.0);
            column
        };
        let of_place = |place| column(self.predicted(numbers, Some(place)));
        let of_places: Vec<Vec<f64>> = (0..self.division.places.len()).map(of_place).collect();
        let mut all = vec![vec![0.0; here.len()]; numbers.len()];
        let holds = self.layout.holds;
        let samples = self.view.dataset.samples_per_hold;
        let (width, block) = (here.len() / holds, here.len() / holds / samples);
        for hold in 0..holds {
            for (place, from) in of_places.iter().enumerate() {
                let rows = hold * width..(hold + 1) * width;
                all[self.layout.bend(hold, place)][rows.clone()].copy_from_slice(&from[rows]);
            }
            for sample in 0..samples {
                let rows = hold * width + sample * block..hold * width + (sample + 1) * block;
                for (k, sign) in self.layout.drifts(hold, self.division.group(sample, samples)) {
                    rows.clone().for_each(|i| all[k][i] = sign * of_places.iter().map(|column| column[i]).sum::<f64>());
                }
            }
        }
        for k in self.layout.shared()..numbers.len() {
            let mut there = numbers.to_vec();
            there[k] += STEP;
            all[k] = column(self.predicted(&there, None));
        }
        let of_prior = |own: usize| (0..all.len()).map(move |k| if k == own { 1.0 / self.prior(k) } else { 0.0 });
        let white = |column: &Vec<f64>| self.view.whitener.whiten(column).into_iter();
        all.iter().enumerate().map(|(k, column)| white(column).chain(of_prior(k)).collect()).collect()
    }
}

pub(super) fn bends(layout: &ShapeLayout, numbers: &[f64], hold: usize, group: usize) -> Vec<f64> {
    let drift: f64 = layout.drifts(hold, group).iter().map(|(k, sign)| sign * numbers[*k]).sum();
    (0..layout.places).map(|place| numbers[layout.bend(hold, place)] + drift).collect()
}

/// The robot with its tracked line further from the taut generator by a share of the radius.
fn tracked(scenario: &Scenario, share: f64) -> Scenario {
    let mut moved = scenario.clone();
    moved.centre_line_m = Some(scenario.centre_line_m.unwrap_or(scenario.radius_m) + share * scenario.radius_m);
    moved
}

/// Markers as a camera of another scale and roll sees them.
fn seen(state: &Prediction, camera: &[f64]) -> Vec<f64> {
    let [scale, roll] = <[f64; 2]>::try_from(camera).unwrap_or([0.0; 2]);
    let (sin, cos) = roll.sin_cos();
    let turned = |[x, y]: &[f64; 2]| [(1.0 + scale) * (cos * x - sin * y), (1.0 + scale) * (sin * x + cos * y)];
    state.markers.iter().flat_map(turned).collect()
}

fn no_shape(problem: &str) -> CompareError {
    CompareError::Fit { what: "the shape of every hold", problem: problem.into() }
}
