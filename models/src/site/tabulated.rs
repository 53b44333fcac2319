//! Starts of a place: the guess of its actuator, and a table where that fails.

use super::starts::Starts;
use super::{SideEffects, Site, SiteLoads, SiteState};
use crate::actuators::{Actuator, Demand};
use crate::root::Start;
use crate::term::Memory;

/// Least pressure of the table over the largest.
const LOWEST_SHARE: f64 = 1e-2;
/// Contractions at which the wall's moment is sampled for the start value: in the working range of every actuator here.
const TYPICAL_STROKE: (f64, f64) = (0.1, 0.3);

/// Starts, and the body pressure that they are solved at.
pub(super) struct Tabulated {
    starts: Starts,
    p_body_pa: f64,
}

impl Site {
    /// Start from the actuator's own balance with the wall's moment linearised.
    pub(super) fn start(&self, actuator: &Actuator, loads: &SiteLoads, memory: &[f64]) -> Start {
        let link = &self.linkage;
        let (share, (low, high)) = (link.active_fraction / link.stroke_fraction, TYPICAL_STROKE);
        let available = share * self.opening_pa(loads) * (actuator.area)(&self.shape) * link.arm_m;
        let moment = |stroke: f64| {
            let (curvature, gain) = link.bent(stroke * link.stroke_fraction / link.arm_m);
            (self.body_moment(curvature, loads, memory) - loads.moment) * gain
        };
        let at_low = moment(low);
        let rise = (moment(high) - at_low) / (high - low);
        let demand = Demand {
            constant: ((at_low - rise * low) / available).max(0.0),
            per_contraction: (rise / available).max(0.0),
            growth: link.arm_growth / link.arm_m,
        };
        let (x, slope) = (actuator.guess)(&self.shape, &demand);
        Start { x, f: None, slope: slope * available }
    }

    /// Lays out starts for this body pressure and actuator pressures up to `p_max_pa`, where the guess fails; each is solved at its
    /// first use, or by [`Site::solve_starts`].
    pub(crate) fn tabulate(&mut self, p_body_pa: f64, p_max_pa: f64) {
        let remembers = self.body_terms.iter().any(|term| term.memory() != Memory::NONE);
        if !self.side_effects.shifts_balance || remembers {
            return;
        }
        let loads = SiteLoads { p_body_pa, ..SiteState::REST.loads };
        let SideEffects { closes, tabulated_from, .. } = self.side_effects;
        let opened = ((2.0 * closes).max(tabulated_from) * p_body_pa).max(LOWEST_SHARE * p_max_pa);
        let starts = Starts::new(self.resisting(&loads, &[]), [opened, p_max_pa]);
        self.starts = starts.map(|starts| Tabulated { starts, p_body_pa });
    }

    /// Solves all starts now, so that no prediction has to.
    pub(crate) fn solve_starts(&self) {
        if let (Some(table), Some(actuator)) = (&self.starts, self.actuator) {
            table.starts.fill(|p_act_pa| self.node(actuator, table.p_body_pa, p_act_pa));
        }
    }

    fn node(&self, actuator: &Actuator, p_body_pa: f64, p_act_pa: f64) -> Option<[f64; 2]> {
        let loads = SiteLoads { p_body_pa, p_act_pa, ..SiteState::REST.loads };
        let state = self.solve_from(actuator, &loads, &[], None, self.start(actuator, &loads, &[]));
        state.ok().filter(|state| state.slope < 0.0).map(|state| [state.coordinate, state.slope])
    }

    /// A start from the table, if there is one for these loads.
    #[inline]
    pub(super) fn tabulated(&self, actuator: &Actuator, loads: &SiteLoads, memory: &[f64]) -> Option<Start> {
        let Tabulated { starts, p_body_pa } = self.starts.as_ref()?;
        let solved = |p_act_pa: f64| self.node(actuator, *p_body_pa, p_act_pa);
        starts.at(self.resisting(loads, memory), loads.p_act_pa, solved)
    }

    /// Moment at a typical bend that the actuator has to overcome \[N·m\].
    fn resisting(&self, loads: &SiteLoads, memory: &[f64]) -> f64 {
        self.body_moment(TYPICAL_STROKE.1 / self.linkage.arm_m, loads, memory) - loads.moment
    }
}
