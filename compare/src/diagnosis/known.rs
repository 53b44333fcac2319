//! Quantities that were measured by themselves: parameters of effects, from a test of their own.
//!
//! A parameter p that a test found to be m ± s is one more value that every hypothesis has to meet, `(p − m)/s`: one with the
//! effect by its own p, one without it by the value at which the effect vanishes.

use super::candidates::Candidate;
use crate::error::CompareError;
use data::MeasuredValue;
use models::Scenario;

/// A parameter measured by itself, in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// Effect, as an index into the catalogue.
    pub effect: usize,
    /// Its parameter.
    pub parameter: usize,
    /// What was found.
    pub value: f64,
    /// Its standard deviation.
    pub sd: f64,
}

/// A test without the robot moving, and what it measures.
#[derive(Debug, PartialEq)]
pub struct BenchTest {
    /// Short name.
    pub name: &'static str,
    /// What to do.
    pub sentence: &'static str,
    /// Effects and parameters.
    pub parameters: &'static [(&'static str, &'static str)],
}

/// Tests that may be proposed.
pub const BENCH_TESTS: [BenchTest; 2] = [
    BenchTest {
        name: "fabric test",
        sentence: "with strips of the actuator's fabric pulled along the body and at 45° to the yarns",
        parameters: &[
            ("fabric_stretch", "compliance_m_per_n"),
            ("shear_stiffness", "shear_n_per_m"),
            ("shear_lock", "lock_rad"),
        ],
    },
    BenchTest {
        name: "scale",
        sentence: "with the robot weighed, its weight written as [measured.gravity]",
        parameters: &[("gravity", "weight_n_per_m")],
    },
];

/// Standard deviation that is expected of such a test, as a share of the value and of no less than its typical size. Assumed.
pub const BENCH_TEST: f64 = 0.1;

impl Known {
    /// Difference of a hypothesis to it, in standard deviations; `values` are those of its effects, one after the other.
    pub fn residual(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> f64 {
        (self.of(candidates, effects, values) - self.value) / self.sd
    }

    /// The parameter as a hypothesis has it.
    pub fn of(&self, candidates: &[Candidate], effects: &[usize], values: &[f64]) -> f64 {
        let mut from = 0;
        for effect in effects {
            if *effect == self.effect {
                return values[from + self.parameter];
            }
            from += candidates[*effect].parameters.len();
        }
        candidates[self.effect].parameters[self.parameter].neutral
    }
}

/// What a bench test would measure of the catalogue: effect and parameter; nothing of effects that are not candidates.
pub fn parameters_of(test: &BenchTest, candidates: &[Candidate]) -> Vec<(usize, usize)> {
    test.parameters.iter().filter_map(|(effect, key)| place(candidates, effect, key)).collect()
}

/// The values measured of effects that may be missing or are refitted.
///
/// # Errors
/// A name that neither the catalogue nor the scenario has.
pub fn known<'m>(
    measured: impl IntoIterator<Item = &'m MeasuredValue>,
    candidates: &[Candidate],
    scenario: &Scenario,
) -> Result<Vec<Known>, CompareError> {
    let mut all: Vec<Known> = Vec::new();
    for m in measured {
        let Some((effect, parameter)) = place(candidates, &m.effect, &m.key) else {
            exists(scenario, m)?;
            continue;
        };
        // Of two tests of one quantity the first stands.
        if all.iter().all(|k| (k.effect, k.parameter) != (effect, parameter)) {
            let si = candidates[effect].parameters[parameter].si;
            all.push(Known { effect, parameter, value: m.value * si, sd: m.sd * si });
        }
    }
    Ok(all)
}

fn place(candidates: &[Candidate], effect: &str, key: &str) -> Option<(usize, usize)> {
    let index = candidates.iter().position(|candidate| candidate.name == effect)?;
    Some((index, candidates[index].parameters.iter().position(|p| p.key == key)?))
}

fn exists(scenario: &Scenario, m: &MeasuredValue) -> Result<(), CompareError> {
    let catalogue = scenario.catalogue();
    let Some(effect) = catalogue.effects().find(|effect| effect.name == m.effect) else {
        let known: Vec<String> = catalogue.effects().map(|effect| effect.name.to_string()).collect();
        return Err(CompareError::UnknownMeasured { what: format!("effect `{}`", m.effect), known: known.join(", ") });
    };
    if effect.parameters.iter().any(|p| p.key == m.key) {
        return Ok(());
    }
    let known: Vec<&str> = effect.parameters.iter().map(|p| p.key).collect();
    Err(CompareError::UnknownMeasured { what: format!("parameter `{}` of {}", m.key, m.effect), known: known.join(", ") })
}
