//! How a place gives way to a moment, exact where the solver stopped.

use super::{Site, SiteState};

/// Step of the differences, as a share of the coordinate's range.
const DIFFERENCE: f64 = 1e-6;

impl Site {
    /// dκ/dM of a state by differences of its balance: the solver's own slopes are secants of the steps that it ended with.
    pub(crate) fn compliance(&self, state: &SiteState, memory: &[f64]) -> f64 {
        let Some(actuator) = self.actuator.filter(|_| state.slope < 0.0) else { return state.compliance };
        let step = DIFFERENCE * (actuator.range.1 - actuator.range.0);
        let [low, high] = [-step, step].map(|by| self.balance(actuator, state.coordinate + by, &state.loads, memory));
        -state.weight * (high.curvature - low.curvature) / (high.imbalance - low.imbalance)
    }
}
