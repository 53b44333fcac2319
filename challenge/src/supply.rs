//! From the regulator's set pressure to the pressure in the actuator.
//!
//! [`crate::HIDDEN`], [`crate::ALSO`] and [`crate::OUTSIDE`] have the equations of the hidden laws.

use super::laws::ByLaw;

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct TrueSupply {
    /// Pressure p₀ that a dead band withholds \[Pa\].
    pub dead_band_pa: ByLaw,
    /// Coefficient f of the pressure lost on the way \[-\].
    pub loss: ByLaw,
    /// Rate r of the leak at the actuator \[1/s\].
    pub leak_per_s: ByLaw,
    pub stuck: f64,
    pub stuck_at_pa: f64,
}

impl TrueSupply {
    /// Pressure in the actuator `held_s` after the set pressure was reached; `gain` is the run's own error.
    pub(crate) fn pressure(&self, set_pa: f64, gain: f64, held_s: f64) -> f64 {
        let stuck = if self.stuck != 0.0 && (set_pa - self.stuck_at_pa).abs() < 1.0 { 1.0 - self.stuck } else { 1.0 };
        let p = set_pa * gain * stuck;
        let seat = self.past_the_seat(p);
        let [hole, seam] = self.loss;
        let after = (seat - hole * (seat * 20e3).sqrt() - seam * seat * (seat / 30e3).sqrt()).max(0.0);
        let [held, emptied] = self.leak_per_s;
        let left = after * (0.6 + 0.4 * (-held * held_s / 0.4).exp());
        if emptied == 0.0 || left == 0.0 {
            return left;
        }
        left * (1.0 - 0.5 * emptied * held_s * (20e3 / left).sqrt()).max(0.0).powi(2)
    }

    fn past_the_seat(&self, p: f64) -> f64 {
        let [soft, rubber] = self.dead_band_pa;
        match rubber == 0.0 {
            true => p.hypot(soft) - soft,
            false => p - rubber * (1.0 - (-p / rubber).exp()),
        }
    }
}
