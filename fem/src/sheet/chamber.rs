//! Pressure, volume and work of the chambers during a run.

use serde::{Deserialize, Serialize};

use crate::problem::{Chamber, Pressure};

/// A chamber while a run goes on.
#[derive(Debug, Clone)]
pub struct Air {
    chamber: Chamber,
    /// What changes.
    pub now: AirNow,
}

/// What a checkpoint holds of a chamber.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct AirNow {
    /// Gauge pressure now \[Pa\].
    pub pressure_pa: f64,
    /// Volume at the last step \[m³\]; `None` before the first.
    pub volume_m3: Option<f64>,
    /// Volume a step earlier \[m³\].
    before_m3: f64,
    /// Pressure when the volume was taken last \[Pa\].
    booked_pa: f64,
    /// Work done on the fabric so far \[J\].
    pub work_j: f64,
    /// (p + p_atm) V once sealed \[J\].
    sealed_j: Option<f64>,
}

impl Air {
    /// At rest, before the first step.
    pub fn new(chamber: &Chamber) -> Air {
        let pressure_pa = match &chamber.pressure {
            Pressure::Set(amplitude) | Pressure::Sealed { filling: amplitude, .. } => amplitude.at(0.0),
        };
        let chamber = chamber.clone();
        Air { chamber, now: AirNow { pressure_pa, ..AirNow::default() } }
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.chamber.name
    }

    /// Largest pressure the supply ever sets \[Pa\].
    pub fn peak_pa(&self) -> f64 {
        match &self.chamber.pressure {
            Pressure::Set(amplitude) | Pressure::Sealed { filling: amplitude, .. } => amplitude.peak(),
        }
    }

    /// True if the volume is needed at this step: the pressure depends on it, or has changed by more than a hundredth
    /// since the work ∫p dV was booked.
    pub fn wants_volume(&self) -> bool {
        let follows = matches!(self.chamber.pressure, Pressure::Sealed { .. });
        follows || (self.now.pressure_pa - self.now.booked_pa).abs() > 0.01 * self.now.pressure_pa.abs()
    }

    /// Sets the pressure for a step at time `t`. A sealed chamber extrapolates its volume by one step, to second order.
    pub fn set_pressure(&mut self, t: f64) {
        self.now.pressure_pa = match &self.chamber.pressure {
            Pressure::Set(amplitude) => amplitude.at(t),
            Pressure::Sealed { filling, sealed_at_s, .. } if t < *sealed_at_s => filling.at(t),
            Pressure::Sealed { filling, atmosphere_pa, .. } => match self.now.volume_m3 {
                None => filling.at(t),
                Some(volume) => {
                    let next = 2.0 * volume - self.now.before_m3;
                    let content = *self.now.sealed_j.get_or_insert((self.now.pressure_pa + atmosphere_pa) * volume);
                    if next > 0.0 { content / next - atmosphere_pa } else { self.now.pressure_pa }
                }
            },
        };
    }

    /// Takes the volume of this step and books the work ½(p + p′)ΔV since the last time.
    pub fn take_volume(&mut self, volume_m3: f64) {
        if let Some(before) = self.now.volume_m3 {
            self.now.work_j += 0.5 * (self.now.pressure_pa + self.now.booked_pa) * (volume_m3 - before);
        }
        self.now.booked_pa = self.now.pressure_pa;
        self.now.before_m3 = self.now.volume_m3.unwrap_or(volume_m3);
        self.now.volume_m3 = Some(volume_m3);
    }

    /// Volume from the fluxes ∫ x n_x, ∫ y n_y, ∫ z n_z: their mean, without an open axis.
    pub fn volume_of(&self, flux: [f64; 3]) -> f64 {
        match self.chamber.open_axis {
            None => (flux[0] + flux[1] + flux[2]) / 3.0,
            Some(open) => 0.5 * (0..3).filter(|k| *k != open).map(|k| flux[k]).sum::<f64>(),
        }
    }
}
