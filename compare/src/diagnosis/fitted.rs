//! Scenarios at the values that a diagnosis found.

use super::case::Case;
use super::problem::{Block, Fit};
use super::result::{Diagnosis, ParameterValue, Ranked};
use crate::gauge::Reading;
use models::Scenario;
use serde::Serialize;

/// Data of the same robot that were fitted along with the first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedBeside {
    /// Dataset.
    pub dataset: String,
    /// Runs.
    pub runs: usize,
    /// What was measured directly in it.
    pub direct: data::Direct,
    /// Error beyond noise of the calibrated base there \[mm\].
    pub systematic_mm: f64,
    /// The same with what was added, or attempted \[mm\].
    pub systematic_with_added_mm: f64,
}

/// What a gauge at the actuator read, beside what was set.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GaugeFit {
    /// Dataset.
    pub dataset: String,
    /// Set pressures \[kPa\].
    pub set_kpa: Vec<f64>,
    /// For how long they had been set \[s\].
    pub held_s: Vec<f64>,
    /// Mean readings there \[kPa\].
    pub read_kpa: Vec<f64>,
    /// The same by the supply's laws with what was added, or attempted \[kPa\].
    pub with_added_kpa: Vec<f64>,
    /// Root-mean-square difference of the base's laws to the readings \[kPa\].
    pub before_kpa: f64,
    /// The same with what was added, or attempted \[kPa\].
    pub after_kpa: f64,
}

impl GaugeFit {
    /// Of every source with a gauge.
    pub(super) fn all(case: &Case, last: &Fit) -> Vec<GaugeFit> {
        let rms = |d: &[f64]| 1e-3 * (d.iter().map(|d| d * d).sum::<f64>() / d.len().max(1) as f64).sqrt();
        let problem = &case.problem;
        let fit_of = |block: &Block, fit: &Fit| {
            block.supply_pa(problem.candidates, &fit.effects, &fit.theta()[problem.bendings..])
        };
        let entry = |block: &Block| {
            let readings = &block.gauge.as_ref()?.gauge.readings;
            let (before, after) = (fit_of(block, &case.base), fit_of(block, last));
            let kpa = |value: &dyn Fn((usize, &Reading)) -> f64| {
                readings.iter().enumerate().map(|r| 1e-3 * value(r)).collect()
            };
            let held_s = readings.iter().map(|r| r.held_s).collect();
            Some(GaugeFit {
                dataset: block.dataset.name.clone(),
                set_kpa: kpa(&|(_, r)| r.set_pa),
                held_s,
                read_kpa: kpa(&|(_, r)| r.read_pa),
                with_added_kpa: kpa(&|(i, r)| r.read_pa + after[i]),
                before_kpa: rms(&before),
                after_kpa: rms(&after),
            })
        };
        problem.blocks.iter().filter_map(entry).collect()
    }
}

impl Diagnosis {
    /// Which of the fitted bending stiffnesses, one per body pressure, belongs to a body pressure \[kPa\]: the nearest.
    pub fn level(&self, p_body_kpa: f64) -> usize {
        let away = |k: &usize| (self.base.bending[*k].p_body_kpa - p_body_kpa).abs();
        (0..self.base.bending.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// The scenario with the calibrated B of a level; its own if B was kept.
    pub fn calibrated(&self, scenario: &Scenario, level: usize) -> Scenario {
        with_fitted(scenario, &[], self.base.bending.get(level).map(|b| b.value_nm2))
    }
}

impl Ranked {
    /// The scenario with this effect alone, and the B of a level that was fitted with it.
    pub fn on(&self, scenario: &Scenario, level: usize) -> Scenario {
        with_fitted(scenario, &[(&self.effect, &self.parameters)], self.bending_nm2.get(level).copied())
    }
}

/// The scenario with effects at their fitted values, and a B if one is given. Names that the scenario does not know are left out.
pub fn with_fitted(scenario: &Scenario, added: &[(&str, &[ParameterValue])], bending_nm2: Option<f64>) -> Scenario {
    let catalogue = scenario.catalogue();
    let mut with = scenario.clone();
    for (name, fitted) in added {
        let Some(effect) = catalogue.by_name(name) else { continue };
        let value = |p: &models::effects::Parameter| {
            fitted.iter().find(|v| v.key == p.key).map_or(p.neutral, |v| v.value) * p.si
        };
        let values: Vec<f64> = effect.parameters.iter().map(value).collect();
        with = with.with_effect(name, &values);
    }
    bending_nm2.map_or(with.clone(), |b| with.with_bending(b))
}
