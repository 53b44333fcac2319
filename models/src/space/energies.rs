//! Energies of a section, by line of the ledger.

use super::frame::Bend;
use super::section::{StripSection, dot};
use super::state::StripState;
use crate::body::{BODY_PRESSURE, WallBending};
use crate::term::{LedgerLine, Pose, Term};

impl StripSection<'_> {
    /// Energies per metre of body \[J/m\] by line of the ledger.
    pub(crate) fn energies(&self, bend: &Bend, strips: &[StripState], post: &mut dyn FnMut(LedgerLine, f64)) {
        for (strip, state) in self.strips.iter().zip(strips) {
            let site = &self.sites[strip.site];
            let Some(actuator) = site.actuator.filter(|_| state.p_act_pa > 0.0) else { continue };
            let stroke = (actuator.stroke)(&site.shape, state.coordinate.max(actuator.range.0));
            let at = Pose { s_m: self.segment.middle_m(), ..Pose::new(&[], self.p_body_pa, state.p_act_pa) };
            site.actuator_energies(&stroke, [state.coordinate, state.tension], &at, &mut |line, energy| {
                post(line, energy / strip.cos_slant);
            });
        }
        let gas = match self.is_passive(strips) {
            true => self.displaced_m2(bend.kappa),
            false => self.area_m2 * bend.contraction + dot(self.moment_m3, bend.kappa),
        };
        post(BODY_PRESSURE, self.p_body_pa * gas);
        post(WallBending { stiffness: 0.0 }.line(), 0.5 * self.bending * dot(bend.kappa, bend.kappa));
    }
}
