//! The bends that a robot would have, in the places and moments of a measured shape, and what an effect of it weighs there.

use super::points::Robot;
use super::shape::{Layout, Shape};
use super::view::{Pieces, View};
use crate::error::CompareError;
use models::{Model, Prediction, Scenario};
use nalgebra::DVector;

/// Numbers of a shape ([`Shape::numbers`]) that a robot would have: bends and drifts; what is shared is left at zero.
///
/// # Errors
/// A hold without equilibrium.
pub fn predicted(view: &View, shape: &Shape, robot: &Robot) -> Result<DVector<f64>, CompareError> {
    let bends = field(view, shape, robot, &|model, at| model.states(at).iter().map(|s| s.curvature).collect())?;
    Ok(numbers(shape, &bends))
}

/// What a robot weighs at its own bends: by how much they change per moment \[1/(N·m²)\], as numbers of a shape.
///
/// # Errors
/// A hold without equilibrium.
pub fn compliances(view: &View, shape: &Shape, robot: &Robot) -> Result<Vec<Vec<f64>>, CompareError> {
    field(view, shape, robot, &|model, at| model.states(at).iter().map(|s| s.compliance).collect())
}

/// Bends of a robot, moment after moment and place after place \[1/m\].
///
/// # Errors
/// A hold without equilibrium.
pub fn bent(view: &View, shape: &Shape, robot: &Robot) -> Result<Vec<Vec<f64>>, CompareError> {
    field(view, shape, robot, &|model, at| model.states(at).iter().map(|s| s.curvature).collect())
}

/// A value of the segments, averaged over places.
type Value = dyn Fn(&Model, &Prediction) -> Vec<f64>;

fn field(view: &View, shape: &Shape, robot: &Robot, value: &Value) -> Result<Vec<Vec<f64>>, CompareError> {
    let steps = shape.division.steps(view.dataset);
    let mut out = vec![Vec::new(); steps.len()];
    for (group, scenario) in robot.scenarios.iter().enumerate() {
        let is_own = |m: usize| robot.of_hold[shape.division.moments[m].hold] == group;
        if (0..steps.len()).any(is_own) {
            walk(scenario, shape, &steps, value, &mut |m, row| {
                if is_own(m) {
                    out[m] = row;
                }
            })?;
        }
    }
    Ok(out)
}

fn walk(
    scenario: &Scenario,
    shape: &Shape,
    steps: &[models::Step],
    value: &Value,
    each: &mut dyn FnMut(usize, Vec<f64>),
) -> Result<(), CompareError> {
    let model = Model::new(scenario);
    let overlaps = overlaps(&model, shape);
    let mut take = |m: usize, at: &Prediction| {
        let of_segments = value(&model, at);
        each(m, overlaps.iter().map(|row| row.iter().map(|(i, share)| share * of_segments[*i]).sum()).collect());
    };
    model.follow(steps, &mut model.prediction(), &mut take)?;
    Ok(())
}

/// Segments of every place with their shares of its length; those with actuators, where there are any.
fn overlaps(model: &Model, shape: &Shape) -> Vec<Vec<(usize, f64)>> {
    let overlap = |place: &super::Place| {
        let own = model.segments().iter().enumerate().filter(|(i, _)| model.is_active(*i) || !place.is_active);
        let shared = own.map(|(i, s)| (i, (s.start_m + s.length_m).min(place.to_m) - s.start_m.max(place.from_m)));
        let shared: Vec<(usize, f64)> = shared.filter(|(_, length)| *length > 0.0).collect();
        let all: f64 = shared.iter().map(|(_, length)| length).sum();
        shared.into_iter().map(|(i, length)| (i, length / all)).collect()
    };
    shape.division.places.iter().map(overlap).collect()
}

/// Values over moments and places as numbers of a shape: means over the holds, and drifts.
pub fn numbers(shape: &Shape, field: &[Vec<f64>]) -> DVector<f64> {
    let layout = Layout::of(&shape.division);
    let mut out = DVector::zeros(shape.numbers.len());
    let (groups, places) = (shape.division.groups, &shape.division.places);
    let length: f64 = places.iter().map(super::Place::length_m).sum();
    for (hold, rows) in field.chunks(groups).enumerate() {
        let mean = |place: usize| rows.iter().map(|row| row[place]).sum::<f64>() / groups as f64;
        for place in 0..places.len() {
            out[layout.bend(hold, place)] = mean(place);
        }
        for group in 1..groups {
            let away = |place: usize| places[place].length_m() * (rows[group][place] - mean(place));
            out[layout.drift(hold, group)] = (0..places.len()).map(away).sum::<f64>() / length;
        }
    }
    out
}

/// What a camera effect does to the numbers of a measured shape, to first order: it moves markers, and the shape takes that for bends.
pub fn as_seen(view: &View, shape: &Shape, other: &Scenario) -> DVector<f64> {
    let (plain, moved) = (Pieces::new(view.scenario, &shape.division), Pieces::new(other, &shape.division));
    let layout = Layout::of(&shape.division);
    let samples = view.dataset.samples_per_hold;
    let (mut a, mut b) = (plain.model.prediction(), moved.model.prediction());
    let mut shift = Vec::with_capacity(shape.residual_m.len());
    let steps = shape.division.steps(view.dataset);
    for hold in 0..view.dataset.holds.len() {
        for sample in 0..samples {
            let m = hold * shape.division.groups + shape.division.group(sample, samples);
            let at = shape.division.moments[m];
            let bends = super::shape::bends(&layout, &shape.numbers, at.hold, at.group);
            plain.model.bend(&steps[m].loads, &plain.curvatures(&bends), &mut a);
            moved.model.bend(&steps[m].loads, &moved.curvatures(&bends), &mut b);
            shift.extend(b.markers.iter().flatten().zip(a.markers.iter().flatten()).map(|(b, a)| b - a));
        }
    }
    shape.absorbed(view, &shift)
}

/// What a marker that sits elsewhere does to the numbers of a measured shape: shifted along an axis in every sample.
pub fn shift_numbers(view: &View, shape: &Shape, marker: usize, axis: usize, by_m: f64) -> DVector<f64> {
    let mut shift = vec![0.0; shape.residual_m.len()];
    for hold in 0..view.dataset.holds.len() {
        for sample in 0..view.dataset.samples_per_hold {
            shift[view.dataset.offset(hold, sample, marker) + axis] = by_m;
        }
    }
    shape.absorbed(view, &shift)
}
