//! A dataset as a diagnosis uses it.

use crate::error::CompareError;
use crate::gauge::Gauge;
use crate::noise::NoiseModel;
use crate::study::predict::is_open;
use data::{Dataset, Direct};
use models::Scenario;
use models::effects::Stage;

/// A dataset and the base as it was measured there.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The base with the dataset's markers and loads, without effects of what was measured directly.
    pub scenario: &'a Scenario,
    /// The data; with a gauge at its readings.
    pub dataset: &'a Dataset,
    /// What was measured directly.
    pub direct: Direct,
    /// Readings of the actuator's pressure, which the supply's laws must meet.
    pub gauge: Option<&'a Gauge>,
    /// Bending stiffness at the first body pressure, measured by itself, and its standard deviation \[N·m²\].
    pub bending_nm2: Option<[f64; 2]>,
}

impl<'a> Source<'a> {
    /// Whether anything is left to be seen of effects of a stage.
    pub fn shows(&self, stage: Stage) -> bool {
        is_open(stage, self.direct) || stage == Stage::Supply && self.gauge.is_some()
    }

    /// The base with all its effects.
    pub fn as_given(&self) -> &'a Scenario {
        self.gauge.map_or(self.scenario, |gauge| &gauge.scenario)
    }

    /// Noise at the readings of the gauge, if there is one, given ∂f/∂ln p.
    pub fn at_readings(&self, noise: NoiseModel, slope: &[f64]) -> Result<NoiseModel, CompareError> {
        match self.gauge {
            Some(gauge) => noise.at_readings(gauge.errors_m(self.dataset, slope)),
            None => Ok(noise),
        }
    }
}
