//! The body's side of a place: moments of its wall and of its further terms.

use super::{SLACK_BELOW_PA, Site, SiteLoads, SiteState};
use crate::root::{NoRoot, Start, find_root};
use crate::term::{Extreme, Pose, Term};

impl Site {
    /// By how much the moment of the terms with history has fallen since the state `at` was remembered: their share of the
    /// imbalance when time passes. `None` if they do not remember that very state.
    pub(super) fn relaxed(&self, at: &SiteState, loads: &SiteLoads, memory: &[f64]) -> Option<f64> {
        if memory.is_empty() || loads.stamp != at.loads.stamp.wrapping_add(1) {
            return None;
        }
        let q = [at.curvature];
        let now = SiteLoads { dt_s: 0.0, ..*loads };
        Some(self.term_force(&loads.pose(&q), memory, false) - self.term_force(&now.pose(&q), memory, false))
    }

    /// Where a formula of the scenario is largest at these loads, over the curvatures that the search for an equilibrium sees.
    pub(crate) fn extreme(&self, loads: &SiteLoads) -> Option<Extreme> {
        let within = match self.actuator {
            Some(actuator) if self.opening_pa(loads) > SLACK_BELOW_PA => {
                <[f64; 2]>::from(actuator.range).map(|a| self.geometric(&(actuator.stroke)(&self.shape, a)))
            }
            _ => [-self.folded(), self.folded()],
        };
        let found = self.body_terms.iter().filter_map(|term| term.extreme(&loads.pose(&[0.0]), within));
        found.max_by(|a, b| a.moment.total_cmp(&b.moment))
    }

    /// Force of all body terms, or of those with history.
    fn term_force(&self, at: &Pose, memory: &[f64], all: bool) -> f64 {
        let (mut force, mut rest, mut pose) = ([0.0], memory, *at);
        for term in &self.body_terms {
            let count = term.memory().values;
            if all || count > 0 {
                (pose.memory, rest) = rest.split_at(count);
                term.add_force(&pose, &mut force);
            }
        }
        force[0]
    }

    /// ∂U/∂κ of all body-side terms \[N·m\].
    #[inline]
    pub(super) fn body_moment(&self, curvature: f64, loads: &SiteLoads, memory: &[f64]) -> f64 {
        let q = [curvature];
        let mut force = [0.0];
        let pose = loads.pose(&q);
        self.body_pressure.add_force(&pose, &mut force);
        self.bending.add(&pose, &mut force);
        if !memory.is_empty() {
            return -force[0] - self.term_force(&pose, memory, true);
        }
        for term in &self.body_terms {
            term.add_force(&pose, &mut force);
        }
        -force[0]
    }

    /// Curvature beyond which a passive stretch has folded \[1/m\]: its centre line would be longer again than the fabric.
    pub(super) fn folded(&self) -> f64 {
        2.0 / self.radius_m
    }

    /// Without actuator pressure the pouch is slack: only the wall resists.
    pub(super) fn solve_passive(
        &self,
        loads: &SiteLoads,
        memory: &[f64],
        near: Option<&SiteState>,
    ) -> Result<SiteState, NoRoot> {
        let mut imbalance = |k: f64| loads.moment - self.body_moment(k, loads, memory);
        let stiffness = |k: f64| -> f64 {
            let moment = |k: f64| self.body_moment(k, loads, memory);
            let rise = moment(k + PASSIVE_STEP) - moment(k - PASSIVE_STEP);
            (rise / (2.0 * PASSIVE_STEP)).max(LEAST_STIFFNESS)
        };
        // A wall that remembers rests where it was bent to, not straight.
        let x = near.filter(|_| !memory.is_empty()).map_or(0.0, |state| state.curvature);
        let at_rest = imbalance(x);
        let curvature = if at_rest == 0.0 {
            x
        } else {
            let start = Start::known(x, at_rest, -stiffness(x));
            let root = find_root(&mut imbalance, (-self.folded(), self.folded()), start)?;
            root.x + root.step
        };
        Ok(SiteState { curvature, compliance: 1.0 / stiffness(curvature), loads: *loads, ..SiteState::REST })
    }
}

/// Half step of the passive stiffness \[1/m\], well inside the hinge's step.
const PASSIVE_STEP: f64 = 1e-5;
/// Stiffness below which a passive stretch counts as free \[N·m²\]; keeps the compliance finite.
const LEAST_STIFFNESS: f64 = 1e-12;
