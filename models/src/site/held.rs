//! A place that is held at a curvature, and the moment missing there for an equilibrium.

use super::{SLACK_BELOW_PA, Site, SiteLoads, SiteState};
use crate::root::{Start, find_root};

impl Site {
    /// State at a curvature that is not solved for, and the moment that is missing there \[N·m\]; NaN where the actuator
    /// cannot have it.
    pub(crate) fn held(&self, curvature: f64, loads: &SiteLoads, memory: &[f64]) -> (SiteState, f64) {
        let at_rest = SiteState { curvature, loads: *loads, ..SiteState::REST };
        let Some(actuator) = self.actuator.filter(|_| self.opening_pa(loads) > SLACK_BELOW_PA) else {
            return (at_rest, self.body_moment(curvature, loads, memory) - loads.moment);
        };
        let (low, high) = actuator.range;
        let bent = |a: f64| self.balance(actuator, a, loads, memory).curvature;
        let most = bent(high);
        if !(curvature > bent(low) && curvature < most) {
            return (at_rest, f64::NAN);
        }
        let share = (curvature / most).max(0.0).sqrt();
        let start = Start::guess(low + share * (high - low), -2.0 * share * most / (high - low));
        let Ok(root) = find_root(&mut |a| curvature - bent(a), actuator.range, start) else {
            return (at_rest, f64::NAN);
        };
        let at = self.balance(actuator, root.x + root.step, loads, memory);
        let state = SiteState { coordinate: at.coordinate, tension: at.tension, ..at_rest };
        (state, -at.imbalance / at.weight)
    }
}
