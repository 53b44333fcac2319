//! A dataset as a diagnosis uses it.

use crate::error::CompareError;
use crate::gauge::Gauge;
use crate::noise::NoiseModel;
use crate::policy;
use crate::study::predict::is_open;
use data::{Dataset, Direct, MeasuredValue};
use models::Scenario;
use models::effects::Stage;

/// Whether one robot lies rolled by 180° against the other: gravity pulls it the other way across.
pub fn is_rolled(one: &Scenario, other: &Scenario) -> bool {
    let ([ax, ay], [bx, by]) = (one.gravity_direction, other.gravity_direction);
    ay.abs() > policy::SAME_DIRECTION
        && (ax - bx).abs() < policy::SAME_DIRECTION
        && (ay + by).abs() < policy::SAME_DIRECTION
}

/// A scenario as the robot sees it when it is rolled by 180°: forces and cameras that stay in the room change sides.
pub fn seen_rolled(scenario: &Scenario) -> Scenario {
    let mut seen = scenario.clone();
    for effect in &mut seen.effects {
        let parameters = models::effects::by_name(&effect.name).map_or(&[][..], |entry| entry.parameters);
        let in_room = parameters.iter().zip(&mut effect.values).filter(|(p, _)| p.in_room);
        in_room.for_each(|(_, value)| *value = -*value);
    }
    seen
}

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
    /// Rolled by 180° against the first data: what is fixed to the room acts the other way.
    pub rolled: bool,
    /// Bending stiffness at the first body pressure, measured by itself, and its standard deviation \[N·m²\].
    pub bending_nm2: Option<[f64; 2]>,
    /// Parameters of effects measured by themselves.
    pub measured: &'a [MeasuredValue],
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::published::textbook_scenario;

    #[test]
    fn a_robot_is_rolled_if_gravity_pulls_it_the_other_way_across_to_a_twentieth() {
        let of = |gravity_direction| Scenario { gravity_direction, ..textbook_scenario("epam").unwrap() };
        let rolled = |a, b| is_rolled(&of(a), &of(b));
        assert!(rolled([0.0, -1.0], [0.0, 1.0]) && !rolled([0.0, -1.0], [0.0, -1.0]));
        // Hung along x nothing is across.
        assert!(rolled([0.99, 0.051], [0.99, -0.051]) && !rolled([1.0, 0.049], [1.0, -0.049]));
        assert!(rolled([0.0, -1.0], [0.049, 1.0]) && !rolled([0.0, -1.0], [0.051, 1.0]));
        assert!(rolled([0.0, -1.0], [0.0, 0.951]) && !rolled([0.0, -1.0], [0.0, 0.949]));
    }
}
