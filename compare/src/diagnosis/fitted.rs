//! Scenarios at the values that a diagnosis found.

use super::result::{Diagnosis, ParameterValue, Ranked};
use models::Scenario;

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
