//! The work of the gas of an actuator.

use crate::term::{Account, LedgerLine, Pose, Term, actuator_q};

/// The pressure work of the actuator, `E = −P v`.
pub(super) struct ActuatorPressure;

impl Term for ActuatorPressure {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("actuator_pressure", Account::ActuatorGas)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        force[actuator_q::VOLUME] += at.p_act_pa;
        -at.p_act_pa * at.q[actuator_q::VOLUME]
    }
}
