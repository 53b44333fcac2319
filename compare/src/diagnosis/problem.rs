//! The fit behind every hypothesis: bending stiffness and effect parameters to the whitened mean over runs.

use super::basis::Basis;
use super::candidates::{Candidate, Free, NEAR};
use super::evaluator::positions;
use super::known::Known;
use super::least_squares::{Minimum, Range, dot, jacobian, minimise, square};
use crate::error::CompareError;
use crate::gauge::Gauge;
use crate::policy;
use crate::study::predict::is_open;
use crate::whiten::{MISFIT_ROUNDS, Whitener};
use data::{Dataset, Direct};
use models::Scenario;
use models::effects::Stage;
use std::borrow::Cow;

/// A change of B that matters \[N·m²\], for the steps of the fit.
const BENDING_SCALE: f64 = 0.5;

/// Whitener of the block with that number.
type WhitenerOf<'w> = dyn Fn(usize) -> Cow<'w, Whitener> + 'w;

/// Measurements under one set of loads, and their noise.
pub struct Block<'a> {
    /// The base with the loads of this block.
    pub scenario: Scenario,
    /// Protocol and markers.
    pub dataset: Cow<'a, Dataset>,
    /// What was measured directly: effects there change nothing in this block.
    pub direct: Direct,
    /// Rolled by 180° against the first block: what is fixed to the room acts the other way.
    pub rolled: bool,
    /// Holds that are fitted, rising.
    pub holds: Vec<usize>,
    /// Index of the bending stiffness of every hold of the dataset.
    pub bending_of: Vec<usize>,
    /// What is to be met \[m\], in run layout.
    pub target_m: Vec<f64>,
    /// Whitens the values of the fitted holds.
    pub whitener: Whitener,
    /// A gauge at the actuator, at whose readings the positions are predicted.
    pub gauge: Option<Readings>,
}

/// What the supply's laws are held against.
pub struct Readings {
    /// The readings.
    pub gauge: Gauge,
    /// Whitens their differences to a law.
    pub whitener: Whitener,
}

impl Readings {
    /// # Errors
    /// If the covariance cannot be decomposed.
    pub fn of(gauge: Gauge) -> Result<Readings, CompareError> {
        Ok(Readings { whitener: gauge.whitener()?, gauge })
    }
}

/// A list of blocks with shared parameters.
pub struct Problem<'a> {
    /// Catalogue.
    pub candidates: &'a [Candidate],
    /// Measurements.
    pub blocks: Vec<Block<'a>>,
    /// Bending stiffnesses that are fitted; 0 if B is kept as the scenarios say.
    pub bendings: usize,
    /// The first of them as it was measured by itself, and its standard deviation: one more value that is fitted \[N·m²\].
    pub known_bending: Option<[f64; 2]>,
    /// Parameters of effects measured by themselves, one more value each.
    pub known: Vec<Known>,
    /// A round of a fit that lowers the whitened sum of squares by less is the last one.
    pub enough: f64,
}

/// A fitted hypothesis. Parameters: bending stiffnesses, then those of its effects one after the other.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Effects, as indices into the catalogue.
    pub effects: Vec<usize>,
    /// Where the fit ended; residuals are whitened.
    pub minimum: Minimum,
    /// Mean square of the whitened residuals of each block by which the fit allowed for its misfit; 1 where it did not.
    pub misfit: Vec<f64>,
    /// Parameters on a bound against which the data push: physics forbids what lies beyond.
    pub binding: Vec<bool>,
    /// Parameters at the end of the range that is searched, against which the data push: physics goes on.
    pub open: Vec<bool>,
    /// Different starts ended in different minima.
    pub several_minima: bool,
}

impl Fit {
    /// Whitened sum of squares.
    pub fn cost(&self) -> f64 {
        self.minimum.cost
    }

    /// Parameters.
    pub fn theta(&self) -> &[f64] {
        &self.minimum.at
    }
}

impl Block<'_> {
    /// Positions in run layout \[m\]; holds that are not asked for are zero. `None` without equilibrium.
    fn predict(&self, candidates: &[Candidate], effects: &[usize], theta: &[f64], bendings: usize) -> Option<Vec<f64>> {
        self.predict_at(&self.holds, candidates, effects, theta, bendings)
    }

    /// The same at other holds.
    pub fn predict_at(
        &self,
        holds: &[usize],
        candidates: &[Candidate],
        effects: &[usize],
        theta: &[f64],
        bendings: usize,
    ) -> Option<Vec<f64>> {
        let mut model = self.with_effects(candidates, effects, &theta[bendings..]);
        let mut out = vec![0.0; self.dataset.values_per_run()];
        if bendings == 0 {
            positions(&model, &self.dataset, holds, &mut out).ok()?;
        }
        for (group, bending) in theta[..bendings].iter().enumerate() {
            let own: Vec<usize> = holds.iter().copied().filter(|h| self.bending_of[*h] == group).collect();
            if !own.is_empty() {
                model.bending_stiffness = *bending;
                positions(&model, &self.dataset, &own, &mut out).ok()?;
            }
        }
        Some(out)
    }

    /// The base of this block with effects at values in SI, one effect's parameters after the other's.
    pub fn with_effects(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> Scenario {
        let turned = if self.rolled { turned(candidates, effects, values) } else { values.to_vec() };
        with(&self.scenario, candidates, effects, &turned, &|stage| is_open(stage, self.direct))
    }

    /// Differences of the supply's laws to the readings of the gauge \[Pa\]; none without one.
    pub fn supply_pa(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> Vec<f64> {
        self.gauge.as_ref().map_or(Vec::new(), |Readings { gauge, .. }| {
            let laws = with(&gauge.scenario, candidates, effects, values, &|stage| stage == Stage::Supply);
            gauge.differences_pa(&laws)
        })
    }

    /// The same, whitened.
    pub fn supply(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> Option<Vec<f64>> {
        let Readings { whitener, .. } = self.gauge.as_ref()?;
        Some(whitener.whiten(&self.supply_pa(candidates, effects, values)))
    }

    /// Whitened difference of a prediction to the target.
    fn whiten_by(&self, whitener: &Whitener, predicted_m: &[f64]) -> Vec<f64> {
        let width = predicted_m.len() / self.dataset.holds.len();
        let rows = self.holds.iter().flat_map(|h| h * width..(h + 1) * width);
        let residual: Vec<f64> = rows.map(|i| predicted_m[i] - self.target_m[i]).collect();
        whitener.whiten(&residual)
    }
}

impl Problem<'_> {
    /// Whitened residuals of all blocks, prediction minus target, and of what was measured by itself.
    pub fn residuals(&self, effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        self.residuals_by(&|i| Cow::Borrowed(&self.blocks[i].whitener), effects, theta)
    }

    fn residuals_by(&self, whitener: &WhitenerOf, effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        let mut all = Vec::new();
        for (i, block) in self.blocks.iter().enumerate() {
            let predicted = block.predict(self.candidates, effects, theta, self.bendings)?;
            all.append(&mut block.whiten_by(&whitener(i), &predicted));
            all.append(&mut block.supply(self.candidates, effects, &theta[self.bendings..]).unwrap_or_default());
        }
        // Last, so that every block keeps its place.
        all.extend(self.known_bending.zip(theta[..self.bendings].first()).map(|([known, sd], b)| (b - known) / sd));
        let values = &theta[self.bendings..];
        all.extend(self.known.iter().map(|known| known.residual(self.candidates, effects, values)));
        Some(all)
    }

    /// Ranges of the parameters of a hypothesis.
    pub fn ranges(&self, effects: &[usize]) -> Vec<Range> {
        let bending = Range { lower: 0.0, upper: policy::MOST_BENDING, scale: BENDING_SCALE };
        let free = effects.iter().flat_map(|e| &self.candidates[*e].parameters);
        let free = free.map(|p| match p.is_free() {
            true => Range { lower: p.lower, upper: p.upper, scale: p.scale() },
            false => Range { lower: p.held_at(), upper: p.held_at(), scale: p.scale() },
        });
        std::iter::repeat_n(bending, self.bendings).chain(free).collect()
    }

    /// Number of fitted parameters of a hypothesis beyond the bending stiffnesses, without those that shape a law.
    pub fn sizes(&self, effects: &[usize]) -> usize {
        effects.iter().map(|e| self.candidates[*e].sizes()).sum()
    }

    /// The best fit from several starts; `None` if none of them has an equilibrium.
    pub fn fit(&self, effects: &[usize], starts: &[Vec<f64>]) -> Option<Fit> {
        let ranges = self.ranges(effects);
        let mut costs = Vec::new();
        let mut best: Option<Minimum> = None;
        for start in starts {
            let Some(found) = minimise(start, &ranges, self.enough, &mut |theta| self.residuals(effects, theta)) else {
                continue;
            };
            costs.push(found.cost);
            if best.as_ref().is_none_or(|b| found.cost < b.cost) {
                best = Some(found);
            }
        }
        let minimum = best?;
        let several_minima = costs.iter().any(|c| policy::is_another_minimum(*c, minimum.cost));
        let neutral = self.neutral(effects);
        let free: Vec<&Free> = effects.iter().flat_map(|e| &self.candidates[*e].parameters).collect();
        // No end of a range says no to a form, its prior does.
        let is_shape = |k: usize| k.checked_sub(self.bendings).is_some_and(|own| free[own].is_shape());
        let pushed = |m: &Minimum| -> Vec<bool> {
            (0..ranges.len()).map(|k| !is_shape(k) && is_binding(m, k, &ranges[k], neutral[k])).collect()
        };
        let (pushed, minimum, misfit) = match self.allowing(effects, &ranges, &minimum) {
            Some((wide, misfit)) => (pushed(&wide), self.at(effects, &ranges, wide.at)?, misfit),
            None => (pushed(&minimum), minimum, vec![1.0; self.blocks.len()]),
        };
        let is_forbidden =
            |k: usize| k.checked_sub(self.bendings).is_none_or(|own| free[own].is_forbidden_beyond(minimum.at[k]));
        let (binding, open) =
            (0..pushed.len()).map(|k| (pushed[k] && is_forbidden(k), pushed[k] && !is_forbidden(k))).unzip();
        Some(Fit { effects: effects.to_vec(), minimum, misfit, binding, open, several_minima })
    }

    /// The fit of a law that misses the data, and by how much: to it, its misfit is noise ([`crate::policy::MISFIT`]). `None` where none misses.
    fn allowing(&self, effects: &[usize], ranges: &[Range], least: &Minimum) -> Option<(Minimum, Vec<f64>)> {
        let mut factors = self.factors(&least.residual);
        if !factors.iter().any(|f| policy::is_a_misfit(*f)) {
            return None;
        }
        let mut wide: Option<Minimum> = None;
        for _ in 0..MISFIT_ROUNDS {
            let start = wide.as_ref().map_or(&least.at, |w| &w.at);
            let residuals = &mut |theta: &[f64]| self.residuals_allowing(&factors, effects, theta);
            let found = minimise(start, ranges, self.enough / factors.iter().copied().fold(1.0, f64::max), residuals)?;
            factors = self.factors(&self.residuals(effects, &found.at)?);
            wide = Some(found);
        }
        Some((wide?, factors))
    }

    /// Whitened residuals in units of noise and misfit.
    pub fn residuals_allowing(&self, misfit: &[f64], effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        let whitener = |i: usize| match &self.blocks[i].whitener {
            own if misfit[i] > 1.0 => Cow::Owned(own.wider(misfit[i])),
            own => Cow::Borrowed(own),
        };
        self.residuals_by(&whitener, effects, theta)
    }

    /// Derivatives of these at the end of a fit.
    pub fn jacobian_allowing(&self, fit: &Fit) -> Option<Vec<Vec<f64>>> {
        if fit.misfit.iter().all(|factor| *factor == 1.0) {
            return Some(fit.minimum.jacobian.clone());
        }
        let residuals = &mut |theta: &[f64]| self.residuals_allowing(&fit.misfit, &fit.effects, theta);
        let residual = residuals(fit.theta())?;
        let there = Minimum { cost: square(&residual), at: fit.theta().to_vec(), residual, jacobian: Vec::new() };
        Some(jacobian(&there, &self.ranges(&fit.effects), residuals))
    }

    /// Mean square of the whitened residuals of each block, no less than one.
    fn factors(&self, residual: &[f64]) -> Vec<f64> {
        let mut from = 0;
        self.blocks
            .iter()
            .map(|block| {
                let width = block.target_m.len() / block.dataset.holds.len() * block.holds.len();
                let own = &residual[from..from + width];
                let unseen = |h: &&usize| block.dataset.lost.unseen.iter().filter(|[hold, _]| hold == *h).count();
                let unseen: usize = block.holds.iter().map(|h| unseen(&h)).sum();
                let seen = width - unseen * 2 * block.dataset.samples_per_hold;
                from += width + block.gauge.as_ref().map_or(0, |g| g.gauge.differences_pa(&g.gauge.scenario).len());
                (square(own) / seen as f64).max(1.0)
            })
            .collect()
    }

    /// Residuals and derivatives at a place.
    fn at(&self, effects: &[usize], ranges: &[Range], at: Vec<f64>) -> Option<Minimum> {
        let residual = self.residuals(effects, &at)?;
        let mut there = Minimum { cost: square(&residual), at, residual, jacobian: Vec::new() };
        there.jacobian = jacobian(&there, ranges, &mut |theta| self.residuals(effects, theta));
        Some(there)
    }

    /// Fit of the base: B scanned from zero up, evenly in √B, then refined.
    pub fn fit_base(&self, always: &[usize], own_values: &[f64]) -> Option<Fit> {
        let start = |bending: f64| -> Vec<f64> {
            std::iter::repeat_n(bending, self.bendings).chain(own_values.iter().copied()).collect()
        };
        let cost = |theta: &[f64]| {
            self.residuals(always, theta).map_or(f64::INFINITY, |r| r.iter().map(|r| r * r).sum::<f64>())
        };
        let grid = if self.bendings == 0 { 0 } else { 24 };
        let scan: Vec<Vec<f64>> =
            (0..=grid).map(|i| start(policy::MOST_BENDING * (f64::from(i) / 24.0).powi(2))).collect();
        let costs: Vec<f64> = scan.iter().map(|theta| cost(theta)).collect();
        let best = (0..scan.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b]))?;
        self.fit(always, &scan[best..=best])
    }

    /// Values at which parameters do nothing; NaN for bending stiffnesses, which always act.
    fn neutral(&self, effects: &[usize]) -> Vec<f64> {
        let free = effects.iter().flat_map(|e| &self.candidates[*e].parameters).map(|p| p.neutral);
        std::iter::repeat_n(f64::NAN, self.bendings).chain(free).collect()
    }
}

/// Values as a robot rolled by 180° sees them.
fn turned(candidates: &[Candidate], effects: &[usize], values: &[f64]) -> Vec<f64> {
    let chosen = effects.iter().map(|e| &candidates[*e]);
    let in_room = chosen.flat_map(|c| c.parameters.iter().map(|p| p.in_room));
    in_room.zip(values).map(|(in_room, v)| if in_room { -v } else { *v }).collect()
}

/// A scenario with those of the effects whose stage is open, at values in SI.
pub fn with(
    scenario: &Scenario,
    candidates: &[Candidate],
    effects: &[usize],
    values: &[f64],
    is_open: &dyn Fn(Stage) -> bool,
) -> Scenario {
    let mut model = scenario.clone();
    let mut from = 0;
    for candidate in effects.iter().map(|e| &candidates[*e]) {
        let to = from + candidate.parameters.len();
        if is_open(candidate.stage) {
            model = candidate.apply(&model, &values[from..to]);
        }
        from = to;
    }
    model
}

/// On a bound that is not the neutral value, and the sum of squares would fall beyond it by more than noise explains.
pub(super) fn is_binding(minimum: &Minimum, k: usize, range: &Range, neutral: f64) -> bool {
    let near = NEAR * range.scale;
    let at_bound = minimum.at[k] - range.lower < near || range.upper - minimum.at[k] < near;
    if !at_bound || (minimum.at[k] - neutral).abs() < near {
        return false;
    }
    let others: Vec<Vec<f64>> =
        (0..minimum.at.len()).filter(|j| *j != k).map(|j| minimum.jacobian[j].clone()).collect();
    let own = Basis::of(&others).rest(&minimum.jacobian[k]);
    let (squares, slope) = (square(&own), dot(&own, &minimum.residual));
    squares > 0.0 && slope * slope / squares > policy::BINDING
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_binds_where_the_data_push_beyond_it_by_two_standard_errors() {
        let at = |value: f64, push: f64| {
            let minimum =
                Minimum { at: vec![value], residual: vec![push], cost: push * push, jacobian: vec![vec![1.0]] };
            is_binding(&minimum, 0, &Range { lower: -2.0, upper: 2.0, scale: 1.0 }, 0.0)
        };
        assert_eq!([1.9, 2.1].map(|push| at(2.0, push)), [false, true]);
        assert!(!at(1.0, 9.0) && at(-2.0, 9.0));
    }
}
