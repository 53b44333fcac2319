//! Starts of a place, tabulated where the guess of its actuator fails.

use super::starts::Starts;
use super::{SideEffects, Site, SiteLoads, TYPICAL_STROKE};
use crate::root::Start;
use crate::term::Memory;

/// Least pressure of the table over the largest.
const LOWEST_SHARE: f64 = 1e-2;

impl Site {
    /// Tabulates starts for this body pressure and actuator pressures up to `p_max_pa`, where the guess fails.
    pub(crate) fn tabulate(&mut self, p_body_pa: f64, p_max_pa: f64) {
        let remembers = self.body_terms.iter().any(|term| term.memory() != Memory::NONE);
        if !self.side_effects.shifts_balance || remembers {
            return;
        }
        let loads = |p_act_pa: f64| SiteLoads::new(p_body_pa, p_act_pa);
        let moment = self.resisting(&loads(0.0), &[]);
        let SideEffects { closes, tabulated_from, .. } = self.side_effects;
        let opened = ((2.0 * closes).max(tabulated_from) * p_body_pa).max(LOWEST_SHARE * p_max_pa);
        let mut near = None;
        self.starts = Starts::new(moment, [opened, p_max_pa], |p_act_pa| {
            let state = self.solve(&loads(p_act_pa), &[], near.as_ref()).ok().filter(|state| state.slope < 0.0)?;
            near = Some(state);
            Some([state.coordinate, state.slope])
        });
    }

    /// A start from the table, if there is one for these loads.
    pub(super) fn tabulated(&self, loads: &SiteLoads, memory: &[f64]) -> Option<Start> {
        self.starts.as_ref()?.at(self.resisting(loads, memory), loads.p_act_pa)
    }

    /// Moment at a typical bend that the actuator has to overcome \[N·m\].
    fn resisting(&self, loads: &SiteLoads, memory: &[f64]) -> f64 {
        self.body_moment(TYPICAL_STROKE.1 / self.linkage.arm_m, loads, memory) - loads.moment
    }
}
