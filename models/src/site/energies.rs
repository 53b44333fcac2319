//! Energies of the actuator of a place in a state.

use super::Site;
use crate::actuators::Stroke;
use crate::linkage::FABRIC_STRETCH;
use crate::term::{LedgerLine, Pose, actuator_q};

impl Site {
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
        let stretch = 0.5 * self.linkage.compliance_per_n * tension * tension;
        if stretch != 0.0 {
            post(FABRIC_STRETCH, stretch);
        }
    }
}
