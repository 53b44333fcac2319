//! Datasets as the blocks of a fit, and their body pressures.

use super::problem::{Block, Problem, Readings};
use super::source::Source;
use crate::error::CompareError;
use crate::layout::Weights;
use crate::noise::NoiseModel;
use crate::policy;
use data::Dataset;
use models::Scenario;
use std::borrow::Cow;

/// The block of all holds of a dataset.
///
/// # Errors
/// If the covariance cannot be decomposed.
pub fn whole_block<'a>(
    source: &Source<'a>,
    target_m: Vec<f64>,
    noise: &NoiseModel,
    body_pa: &[f64],
) -> Result<Block<'a>, CompareError> {
    let all: Vec<usize> = (0..source.dataset.holds.len()).collect();
    block(source, &all, target_m, noise, body_pa)
}

/// The block of a dataset's mean, or of another target at its holds.
///
/// # Errors
/// If the covariance cannot be decomposed.
pub fn block<'a>(
    source: &Source<'a>,
    holds: &[usize],
    target_m: Vec<f64>,
    noise: &NoiseModel,
    body_pa: &[f64],
) -> Result<Block<'a>, CompareError> {
    let Source { scenario, dataset, direct, gauge, rolled, .. } = *source;
    let width = dataset.values_per_run() / dataset.holds.len();
    let each: Vec<Weights> = holds.iter().flat_map(|h| h * width..(h + 1) * width).map(|i| vec![(i, 1.0)]).collect();
    Ok(Block {
        scenario: scenario.clone(),
        dataset: Cow::Borrowed(dataset),
        direct,
        rolled,
        holds: holds.to_vec(),
        bending_of: dataset.holds.iter().map(|h| nearest(body_pa, h.p_body_pa)).collect(),
        target_m,
        whitener: noise.whitener_of(&each)?,
        gauge: gauge.map(|gauge| Readings::of(gauge.clone())).transpose()?,
    })
}

/// Distinct body pressures in order of appearance \[Pa\].
pub fn body_pressures<'d>(datasets: impl IntoIterator<Item = &'d Dataset>) -> Vec<f64> {
    let mut levels: Vec<f64> = Vec::new();
    for hold in datasets.into_iter().flat_map(|dataset| &dataset.holds) {
        let p = hold.p_body_pa;
        if !levels.iter().any(|l| policy::is_same_pressure(*l, p)) {
            levels.push(p);
        }
    }
    levels
}

/// Index of the nearest level.
pub fn nearest(levels: &[f64], p: f64) -> usize {
    (0..levels.len()).min_by(|a, b| (levels[*a] - p).abs().total_cmp(&(levels[*b] - p).abs())).unwrap_or(0)
}

/// Scenarios of a fit, one per bending stiffness; the scenario's own if B is kept.
pub fn fitted_scenarios(problem: &Problem, block: &Block, effects: &[usize], theta: &[f64]) -> Vec<Scenario> {
    let model = block.with_effects(problem.candidates, effects, &theta[problem.bendings..]);
    match problem.bendings {
        0 => vec![model],
        n => theta[..n].iter().map(|b| model.with_bending(*b)).collect(),
    }
}
