//! The fit behind every hypothesis: bending stiffness and effect parameters to the whitened mean over runs.

use crate::diagnosis::candidates::{Candidate, Free, NEAR};
use crate::diagnosis::evaluator::positions;
use crate::diagnosis::known::KnownParameter;
use crate::diagnosis::source::{DiagnosisSource, nearest};
use crate::error::CompareError;
use crate::fit::basis::own_part;
use crate::fit::least_squares::{FitRange, Minimum, dot, jacobian, minimise, square};
use crate::fit::numbers::{differences, least};
use crate::fit::whiten::{MISFIT_ROUNDS, Whitener};
use crate::layout::{single, values_of};
use crate::noise::NoiseModel;
use crate::policy;
use crate::study::predict::is_open;
use data::Dataset;
use models::Scenario;
use models::effects::Stage;
use std::borrow::Cow;

/// A change of B that matters \[N·m²\], for the steps of the fit.
const BENDING_SCALE: f64 = 0.5;
/// Values of B from which the fit of the base is started.
const BENDINGS_TRIED: u32 = 24;

/// Whitener of the block with that number.
type WhitenerOf<'w> = dyn Fn(usize) -> Cow<'w, Whitener> + 'w;

/// What a fit meets of a dataset.
#[derive(Clone)]
pub(crate) struct Block<'a> {
    pub source: Cow<'a, DiagnosisSource>,
    /// Fitted holds of the dataset, rising.
    pub holds: Vec<usize>,
    /// Index of the bending stiffness of every hold of the dataset; 0 if B is kept.
    pub bending_of: Vec<usize>,
    /// Positions to be met \[m\], in run layout.
    pub target_m: Vec<f64>,
    /// Whitens the values of the fitted holds.
    pub whitener: Whitener,
    /// Whitens differences of the supply's laws to the readings of the gauge.
    pub of_gauge: Option<Whitener>,
}

impl<'a> Block<'a> {
    /// All holds of a dataset's mean; `levels` are body pressures with a stiffness of their own \[Pa\].
    pub(crate) fn of(
        source: &'a DiagnosisSource,
        noise: &NoiseModel,
        levels: &[f64],
    ) -> Result<Block<'a>, CompareError> {
        let dataset = &source.dataset;
        let all: Vec<usize> = (0..dataset.holds.len()).collect();
        Ok(Block {
            source: Cow::Borrowed(source),
            bending_of: dataset.holds.iter().map(|h| nearest(levels, h.p_body_pa)).collect(),
            target_m: dataset.mean_over_runs(),
            whitener: whitener(dataset, &all, noise)?,
            of_gauge: source.gauge.as_ref().map(|gauge| gauge.whitener()).transpose()?,
            holds: all,
        })
    }

    /// The same with another target at some of its holds.
    pub(crate) fn to_meet(
        &self,
        holds: Vec<usize>,
        target_m: Vec<f64>,
        noise: &NoiseModel,
    ) -> Result<Block<'a>, CompareError> {
        let whitener = whitener(&self.source.dataset, &holds, noise)?;
        Ok(Block { whitener, holds, target_m, ..self.clone() })
    }

    /// Places of the fitted values in run layout.
    fn values(&self) -> impl Iterator<Item = usize> {
        values_of(&self.source.dataset, &self.holds)
    }
}

/// Whitens the values of some holds.
fn whitener(dataset: &Dataset, holds: &[usize], noise: &NoiseModel) -> Result<Whitener, CompareError> {
    noise.whitener_of(&single(values_of(dataset, holds)))
}

#[derive(Clone)]
pub(crate) struct FitProblem<'a> {
    pub candidates: &'a [Candidate],
    pub blocks: Vec<Block<'a>>,
    /// Bending stiffnesses that are fitted; 0 if B is kept as the scenarios say.
    pub bendings: usize,
    /// The first of them as measured separately, and its standard deviation: one more value that is fitted \[N·m²\].
    pub known_bending: Option<[f64; 2]>,
    /// Parameters of effects measured by themselves, one more value each.
    pub known: Vec<KnownParameter>,
    /// A round of a fit that lowers the whitened sum of squares by less is the last one.
    pub enough: f64,
}

/// A fitted hypothesis. Parameters: bending stiffnesses, then each effect's parameters one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    /// Effects, as indices into the catalogue.
    pub effects: Vec<usize>,
    /// Where the fit ended; residuals are whitened.
    pub minimum: Minimum,
    /// Mean square of the whitened residuals of each block by which the fit allowed for its misfit; 1 where it did not.
    pub misfit: Vec<f64>,
    /// Parameters on a bound against which the data push: physics forbids values beyond it.
    pub binding: Vec<bool>,
    /// Parameters at the end of the range that is searched, against which the data push: physics goes on.
    pub open: Vec<bool>,
    /// Different starts ended in different minima.
    pub several_minima: bool,
}

impl Fit {
    pub(crate) fn cost(&self) -> f64 {
        self.minimum.cost
    }

    pub(crate) fn theta(&self) -> &[f64] {
        &self.minimum.at
    }

    pub(crate) fn theta_with(&self, values: &[f64]) -> Vec<f64> {
        [self.theta(), values].concat()
    }

    pub(crate) fn change_from(&self, other: &Fit) -> Vec<f64> {
        differences(&self.minimum.residual, &other.minimum.residual)
    }
}

impl FitProblem<'_> {
    /// The base of a block with effects at values in SI: one scenario per bending stiffness, one alone if B is kept.
    pub(crate) fn scenarios(&self, block: &Block, effects: &[usize], theta: &[f64]) -> Vec<Scenario> {
        let (source, (bendings, values)) = (&block.source, theta.split_at(self.bendings));
        let seen = |(p, v): (&Free, &f64)| if p.in_room && source.rolled { -v } else { *v };
        let values: Vec<f64> = self.parameters(effects).zip(values).map(seen).collect();
        let is_open = |stage| is_open(stage, source.direct);
        let model = with(&source.scenario, self.candidates, effects, &values, &is_open);
        match bendings.is_empty() {
            true => vec![model],
            false => bendings.iter().map(|b| model.with_bending(*b)).collect(),
        }
    }

    /// Positions at some holds of a block in run layout \[m\], others zero; `None` without equilibrium.
    pub(crate) fn predict(&self, block: &Block, holds: &[usize], effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        let mut out = vec![0.0; block.source.dataset.values_per_run()];
        for (group, scenario) in self.scenarios(block, effects, theta).iter().enumerate() {
            let own: Vec<usize> = holds.iter().copied().filter(|h| block.bending_of[*h] == group).collect();
            if !own.is_empty() {
                positions(scenario, &block.source.dataset, &own, &mut out).ok()?;
            }
        }
        Some(out)
    }

    /// Differences of the supply's laws to the readings of a block's gauge \[Pa\]; none without one.
    pub(crate) fn supply_pa(&self, block: &Block, effects: &[usize], theta: &[f64]) -> Vec<f64> {
        let Some(gauge) = &block.source.gauge else { return Vec::new() };
        let (values, is_supply) = (&theta[self.bendings..], |stage| stage == Stage::Supply);
        gauge.differences_pa(&with(&gauge.scenario, self.candidates, effects, values, &is_supply))
    }

    /// The same in standard deviations of the gauge; empty without one.
    pub(crate) fn supply(&self, block: &Block, effects: &[usize], theta: &[f64]) -> Vec<f64> {
        let whitened = |whitener: &Whitener| whitener.whiten(&self.supply_pa(block, effects, theta));
        block.of_gauge.as_ref().map(whitened).unwrap_or_default()
    }

    /// Whitened residuals of all blocks, prediction minus target, and of quantities measured separately.
    pub(crate) fn residuals(&self, effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        self.residuals_by(&|i| Cow::Borrowed(&self.blocks[i].whitener), effects, theta)
    }

    fn residuals_by(&self, whitener: &WhitenerOf, effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        let mut all = Vec::new();
        for (i, block) in self.blocks.iter().enumerate() {
            let predicted = self.predict(block, &block.holds, effects, theta)?;
            let residual: Vec<f64> = block.values().map(|i| predicted[i] - block.target_m[i]).collect();
            all.append(&mut whitener(i).whiten(&residual));
            all.append(&mut self.supply(block, effects, theta));
        }
        // Last, so that every block keeps its place.
        let (bendings, values) = theta.split_at(self.bendings);
        all.extend(self.known_bending.zip(bendings.first()).map(|([known, sd], b)| (b - known) / sd));
        all.extend(self.known.iter().map(|known| known.residual(self.candidates, effects, values)));
        Some(all)
    }

    fn parameters(&self, effects: &[usize]) -> impl Iterator<Item = &Free> {
        effects.iter().flat_map(|e| &self.candidates[*e].parameters)
    }

    pub(crate) fn ranges(&self, effects: &[usize]) -> Vec<FitRange> {
        let bending = FitRange { lower: 0.0, upper: policy::MOST_BENDING, scale: BENDING_SCALE };
        std::iter::repeat_n(bending, self.bendings).chain(self.parameters(effects).map(Free::range)).collect()
    }

    /// Number of fitted parameters of a hypothesis beyond the bending stiffnesses, without those that shape a law.
    pub(crate) fn sizes(&self, effects: &[usize]) -> usize {
        effects.iter().map(|e| self.candidates[*e].sizes()).sum()
    }

    /// The best fit from several starts; `None` if none of them has an equilibrium.
    pub(crate) fn fit(&self, effects: &[usize], starts: &[Vec<f64>]) -> Option<Fit> {
        let ranges = self.ranges(effects);
        let from =
            |start: &Vec<f64>| minimise(start, &ranges, self.enough, &mut |theta| self.residuals(effects, theta));
        let found: Vec<Minimum> = starts.iter().filter_map(from).collect();
        let lowest = found.iter().map(|m| m.cost).fold(f64::INFINITY, f64::min);
        let several_minima = found.iter().any(|m| policy::is_another_minimum(m.cost, lowest));
        let minimum = found.into_iter().find(|m| m.cost == lowest)?;
        let free: Vec<&Free> = self.parameters(effects).collect();
        let own = |k: usize| k.checked_sub(self.bendings).map(|own| free[own]);
        // The prior limits a form, not the end of its range; stiffnesses always act.
        let pushed = |m: &Minimum| -> Vec<bool> {
            let is_pushed = |k: usize| {
                let neutral = own(k).map_or(f64::NAN, |p| p.neutral);
                !own(k).is_some_and(Free::is_shape) && is_binding(m, k, &ranges[k], neutral)
            };
            (0..ranges.len()).map(is_pushed).collect()
        };
        let (pushed, minimum, misfit) = match self.allowing(effects, &ranges, &minimum) {
            Some((wide, misfit)) => (pushed(&wide), self.at(effects, &ranges, wide.at)?, misfit),
            None => (pushed(&minimum), minimum, vec![1.0; self.blocks.len()]),
        };
        let is_forbidden = |k: usize| own(k).is_none_or(|p| p.is_forbidden_beyond(minimum.at[k]));
        let (binding, open) =
            (0..pushed.len()).map(|k| (pushed[k] && is_forbidden(k), pushed[k] && !is_forbidden(k))).unzip();
        Some(Fit { effects: effects.to_vec(), minimum, misfit, binding, open, several_minima })
    }

    /// The fit of a law that misses the data, and by how much: to it, its misfit is noise ([`crate::policy::MISFIT`]). `None` where none misses.
    fn allowing(&self, effects: &[usize], ranges: &[FitRange], found: &Minimum) -> Option<(Minimum, Vec<f64>)> {
        let mut factors = self.factors(&found.residual);
        if !factors.iter().any(|f| policy::is_a_misfit(*f)) {
            return None;
        }
        let mut wide: Option<Minimum> = None;
        for _ in 0..MISFIT_ROUNDS {
            let start = wide.as_ref().map_or(&found.at, |w| &w.at);
            let residuals = &mut |theta: &[f64]| self.residuals_allowing(&factors, effects, theta);
            let found = minimise(start, ranges, self.enough / factors.iter().copied().fold(1.0, f64::max), residuals)?;
            factors = self.factors(&self.residuals(effects, &found.at)?);
            wide = Some(found);
        }
        Some((wide?, factors))
    }

    pub(crate) fn residuals_allowing(&self, misfit: &[f64], effects: &[usize], theta: &[f64]) -> Option<Vec<f64>> {
        let whitener = |i: usize| match &self.blocks[i].whitener {
            own if misfit[i] > 1.0 => Cow::Owned(own.wider(misfit[i])),
            own => Cow::Borrowed(own),
        };
        self.residuals_by(&whitener, effects, theta)
    }

    /// Derivatives of these at the end of a fit.
    pub(crate) fn jacobian_allowing(&self, fit: &Fit) -> Option<Vec<Vec<f64>>> {
        if fit.misfit.iter().all(|factor| *factor == 1.0) {
            return Some(fit.minimum.jacobian.clone());
        }
        let residuals = &mut |theta: &[f64]| self.residuals_allowing(&fit.misfit, &fit.effects, theta);
        let there = Minimum::there(fit.theta().to_vec(), residuals)?;
        Some(jacobian(&there, &self.ranges(&fit.effects), residuals))
    }

    /// Mean square of the whitened residuals of each block, no less than one.
    fn factors(&self, residual: &[f64]) -> Vec<f64> {
        let mut from = 0;
        let mut factor = |block: &Block| {
            let (dataset, values) = (&block.source.dataset, block.values().count());
            let own = &residual[from..from + values];
            let unseen = dataset.lost.unseen.iter().filter(|[hold, _]| block.holds.contains(hold)).count();
            from += values + block.source.gauge.as_ref().map_or(0, |gauge| gauge.readings.len());
            (square(own) / (values - unseen * dataset.axes * dataset.samples_per_hold) as f64).max(1.0)
        };
        self.blocks.iter().map(&mut factor).collect()
    }

    fn at(&self, effects: &[usize], ranges: &[FitRange], at: Vec<f64>) -> Option<Minimum> {
        let residuals = &mut |theta: &[f64]| self.residuals(effects, theta);
        let there = Minimum::there(at, residuals)?;
        Some(Minimum { jacobian: jacobian(&there, ranges, residuals), ..there })
    }

    /// Fit of the base: B scanned from zero up, evenly in √B, then refined.
    pub(crate) fn fit_base(&self, always: &[usize], own_values: &[f64]) -> Option<Fit> {
        let start = |i: u32| -> Vec<f64> {
            let bending = policy::MOST_BENDING * (f64::from(i) / f64::from(BENDINGS_TRIED)).powi(2);
            [&vec![bending; self.bendings], own_values].concat()
        };
        let last = if self.bendings == 0 { 0 } else { BENDINGS_TRIED };
        let cost = |theta: &Vec<f64>| self.residuals(always, theta).map_or(f64::INFINITY, |r| square(&r));
        let scan: Vec<_> = (0..=last).map(start).map(|theta| (cost(&theta), theta)).collect();
        self.fit(always, &[least(scan, |(cost, _)| *cost)?.1])
    }
}

/// A scenario with the effects whose stage is open, at values in SI.
pub(crate) fn with(
    scenario: &Scenario,
    candidates: &[Candidate],
    effects: &[usize],
    values: &[f64],
    is_open: &dyn Fn(Stage) -> bool,
) -> Scenario {
    let (mut model, mut rest) = (scenario.clone(), values);
    for candidate in effects.iter().map(|e| &candidates[*e]) {
        let (own, others) = rest.split_at(candidate.parameters.len());
        if is_open(candidate.stage) {
            model = candidate.apply(&model, own);
        }
        rest = others;
    }
    model
}

/// On a bound that is not the neutral value, and the sum of squares would fall beyond it by more than noise explains.
pub(crate) fn is_binding(minimum: &Minimum, k: usize, range: &FitRange, neutral: f64) -> bool {
    let near = NEAR * range.scale;
    let at_bound = minimum.at[k] - range.lower < near || range.upper - minimum.at[k] < near;
    if !at_bound || (minimum.at[k] - neutral).abs() < near {
        return false;
    }
    let own = own_part(&minimum.jacobian, k);
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
            is_binding(&minimum, 0, &FitRange { lower: -2.0, upper: 2.0, scale: 1.0 }, 0.0)
        };
        assert_eq!([1.9, 2.1].map(|push| at(2.0, push)), [false, true]);
        assert!(!at(1.0, 9.0) && at(-2.0, 9.0));
    }
}
