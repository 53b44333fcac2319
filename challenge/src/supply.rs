//! From the regulator's set pressure to the pressure in the actuator.
//!
//! ```text
//! dead band   √(p² + p₀²) − p₀                                 a soft valve seat
//! loss        p − f √(p·20 kPa)                                orifice and laminar hose in series
//! leak        p (0.6 + 0.4 e^(−r t/0.4))                       runs down towards a level the regulator can hold
//! stuck       p (1 − s) if the set pressure is `stuck_at_pa`   one set point is not reached, in every run
//! ```

/// Supply laws; all off at 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TrueSupply {
    /// Dead band p₀ \[Pa\].
    pub dead_band_pa: f64,
    /// Loss f \[-\].
    pub loss: f64,
    /// Leak r \[1/s\].
    pub leak_per_s: f64,
    /// Missing share at one set point \[-\].
    pub stuck: f64,
    /// That set point \[Pa\].
    pub stuck_at_pa: f64,
}

impl TrueSupply {
    /// Pressure in the actuator `held_s` after the set pressure was reached; `gain` is the run's own error.
    pub fn pressure(&self, set_pa: f64, gain: f64, held_s: f64) -> f64 {
        let stuck = if self.stuck != 0.0 && (set_pa - self.stuck_at_pa).abs() < 1.0 { 1.0 - self.stuck } else { 1.0 };
        let p = set_pa * gain * stuck;
        let seat = p.hypot(self.dead_band_pa) - self.dead_band_pa;
        let after = (seat - self.loss * (seat * 20e3).sqrt()).max(0.0);
        after * (0.6 + 0.4 * (-self.leak_per_s * held_s / 0.4).exp())
    }
}
