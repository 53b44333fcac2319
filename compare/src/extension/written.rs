//! A new scenario, and what it brings.

use super::steps::{ErrorStep, Ground};
use super::text::{Addition, BodyValue, extended};
use crate::diagnosis::ParameterValue;
use crate::error::CompareError;
use crate::scenario_file::ScenarioFile;
use serde::Serialize;

/// A new scenario, and what it brings.
#[derive(Debug, Clone)]
pub struct Extension {
    /// The scenario with the effects; text and comments of the old one stay.
    pub file: ScenarioFile,
    /// Effects as they were written into the scenario.
    pub additions: Vec<Addition>,
    /// Their fitted values; none for those that were given.
    pub fitted: Vec<FittedEffect>,
    /// The new bending stiffness, if it was fitted.
    pub bending: Option<BodyValue>,
    /// Errors on the way, the scenario as given first; none without data.
    pub steps: Vec<ErrorStep>,
    /// Noise of the mean over runs, of one coordinate \[mm\].
    pub noise_floor_mm: Option<f64>,
    /// What was added and calibrated, one sentence each.
    pub told: Vec<String>,
    /// Cautions about scenario, data and fits, one sentence each.
    pub warnings: Vec<String>,
}

impl Extension {
    pub(super) fn written(
        file: &ScenarioFile,
        bending: Option<BodyValue>,
        additions: Vec<Addition>,
        told: Vec<String>,
    ) -> Result<Extension, CompareError> {
        let (fitted, steps, warnings) = (Vec::new(), Vec::new(), Vec::new());
        let file = extended(file, bending.as_ref(), &additions)?;
        Ok(Extension { file, additions, fitted, bending, steps, noise_floor_mm: None, told, warnings })
    }

    pub(super) fn climbed(self, ground: &Ground, step: ErrorStep) -> Extension {
        let steps = ground.first_steps().into_iter().chain([step]).collect();
        Extension { steps, noise_floor_mm: ground.d.base.noise_floor_mm, warnings: ground.warnings(), ..self }
    }
}

/// An effect and its fitted values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedEffect {
    /// Name of the effect as scenarios write it.
    pub effect: String,
    /// Fitted or held values of its parameters.
    pub parameters: Vec<ParameterValue>,
}

impl FittedEffect {
    pub(super) fn of(effect: &str, parameters: &[ParameterValue]) -> FittedEffect {
        FittedEffect { effect: effect.into(), parameters: parameters.to_vec() }
    }
}
