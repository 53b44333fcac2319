//! A formula that takes the pull of the actuator at its place: a term over the actuator's coordinate, where that pull is explicit.
//!
//! ```text
//! pull = η P v'(a)/κ'(a)      E(a) = −∫₀^a M(κ, pull) κ' da' / η      κ of inextensible fabric
//! ```

use super::integral::integral;
use super::program::{INPUTS, KAPPA, Op, PULL, run};
use crate::actuators::{Actuator, ActuatorShape};
use crate::linkage::Linkage;
use crate::site::Site;
use crate::term::{Account, LedgerLine, Pose, Term, actuator_q};
use std::sync::Arc;

pub(super) struct PullTerm {
    program: Arc<[Op]>,
    actuator: &'static Actuator,
    shape: ActuatorShape,
    linkage: Linkage,
    inputs: [f64; INPUTS],
}

/// The pull of a flat pouch has no bound; its work does, and is taken from here on.
const FLAT: f64 = 1e-9;

impl PullTerm {
    pub(super) fn new(program: Arc<[Op]>, site: &Site, inputs: [f64; INPUTS]) -> Option<PullTerm> {
        let actuator = site.actuator?;
        Some(PullTerm { program, actuator, shape: site.shape, linkage: site.linkage, inputs })
    }

    /// M κ'/η at a coordinate: the moment as a force on the coordinate.
    fn slope(&self, at: &Pose, a: f64) -> f64 {
        let stroke = (self.actuator.stroke)(&self.shape, a.max(FLAT));
        let link = &self.linkage;
        let arm = link.arm_m + link.arm_growth * stroke.lift;
        let geometric = link.stroke_fraction * stroke.contraction / arm;
        let d_arm = link.arm_growth * stroke.d_lift;
        let (kappa, gain) = link.bent(geometric);
        let d_kappa = gain * (link.stroke_fraction * stroke.d_contraction - geometric * d_arm) / arm;
        let mut inputs = self.inputs;
        (inputs[KAPPA], inputs[KAPPA + 1]) = (kappa, kappa * self.shape.length_m);
        (inputs[2], inputs[3], inputs[4]) = (at.p_act_pa, at.p_body_pa, at.s_m);
        inputs[PULL] = at.p_act_pa * link.active_fraction * stroke.d_volume / d_kappa;
        run(&self.program, &inputs) * d_kappa / link.active_fraction
    }
}

impl Term for PullTerm {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("formula", Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        self.add_force(at, force);
        -integral(&mut |a| self.slope(at, a), at.q[actuator_q::COORDINATE])
    }

    fn add_force(&self, at: &Pose, force: &mut [f64]) {
        force[actuator_q::COORDINATE] += self.slope(at, at.q[actuator_q::COORDINATE]);
    }
}
