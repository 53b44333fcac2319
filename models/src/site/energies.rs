//! Energies of the actuator of a place in a state.

use super::{Site, SiteLoads};
use crate::actuators::Stroke;
use crate::linkage::FABRIC_STRETCH;
use crate::term::{LedgerLine, Pose, Term, actuator_q};

/// Coordinates of an actuator at which its laws are evaluated for one without a value.
const EVALUATED: usize = 64;

impl Site {
    /// Name of the first law of the actuator without a value at these loads, over the range of its coordinate.
    pub(crate) fn without_value(&self, loads: &SiteLoads) -> Option<&'static str> {
        let actuator = self.actuator?;
        let (low, high) = actuator.range;
        (1..EVALUATED).find_map(|i| {
            let a = low + (high - low) * i as f64 / EVALUATED as f64;
            let stroke = (actuator.stroke)(&self.shape, a);
            let q = [a, stroke.contraction, stroke.volume, self.geometric(&stroke)];
            let has_none = |term: &dyn Term| {
                let mut force = [0.0; actuator_q::LEN];
                term.add_force(&loads.pose(&q), &mut force);
                force.iter().any(|force| force.is_nan())
            };
            self.actuator_terms.iter().find(|term| has_none(&***term)).map(|term| term.line().name)
        })
    }

    /// Energies of the actuator per metre by line of the ledger \[J/m\], at a stroke, its coordinate and tension; `at` has the
    /// pressures and the station.
    pub(crate) fn actuator_energies(
        &self,
        stroke: &Stroke,
        [coordinate, tension]: [f64; 2],
        at: &Pose,
        post: &mut dyn FnMut(LedgerLine, f64),
    ) {
        let Some(actuator) = self.actuator else { return };
        let rest = (actuator.stroke)(&self.shape, 0.0_f64.max(actuator.range.0));
        let q = [coordinate, stroke.contraction, stroke.volume - rest.volume, self.geometric(stroke)];
        let mut unused = [0.0; actuator_q::LEN];
        for term in &self.actuator_terms {
            post(term.line(), term.add(&Pose { q: &q, ..*at }, &mut unused) * self.linkage.active_fraction);
        }
        let stretch = 0.5 * self.linkage.compliance_per_n * tension.max(0.0).powi(2);
        if stretch != 0.0 {
            post(FABRIC_STRETCH, stretch);
        }
    }
}
