//! The actuator of a scenario: its kind, its units and where they lie.

use crate::actuators::{Actuator, ActuatorShape, BEAM, BIAS};
use crate::effects::Effect;
use std::f64::consts::TAU;

/// Actuator of a scenario: its kind, its units, and where they are on the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActuatorChoice {
    /// Entry of the actuator in [`crate::actuators::ACTUATORS`].
    pub kind: &'static Actuator,
    /// Dimensions of one unit, flat and unpressurised.
    pub shape: ActuatorShape,
    /// Number of units in series along the body; 0 for a passive body.
    pub count: usize,
    /// Where the first unit starts \[m\].
    pub start_m: f64,
    /// Arm from the taut generator \[m\]; `None`: the kind's own.
    pub arm_m: Option<f64>,
    /// Supply channel that fills it, an index into [`crate::Loads::actuator_pa`].
    pub channel: usize,
    /// Azimuth of its first unit's start, from y towards z \[rad\].
    pub azimuth_rad: f64,
    /// Turns round the body from its start to its end, in the same sense; not 0: a helix.
    pub turns: f64,
}

impl ActuatorChoice {
    /// A scenario without `[actuator]`: a passive beam.
    pub const NONE: ActuatorChoice = ActuatorChoice {
        kind: &BEAM,
        shape: ActuatorShape { length_m: 0.0, width_m: 0.0, fold_m: 0.0, volume_gain: 1.0, bias_rad: BIAS },
        count: 0,
        start_m: 0.0,
        arm_m: None,
        channel: 0,
        azimuth_rad: 0.0,
        turns: 0.0,
    };

    /// False for a passive body, whose number of units is 0.
    pub fn exists(&self) -> bool {
        self.count > 0
    }

    /// Whether the body's wall is the bottom of its pouches.
    pub fn in_wall(&self) -> bool {
        self.kind.in_wall(&self.shape)
    }

    /// Whether an effect can act on this robot: effects of a family, and all inside an actuator, need one.
    pub fn takes(&self, effect: &Effect) -> bool {
        effect.applies_to(self.kind.family) && (self.exists() || !effect.needs_actuator())
    }

    /// Whether its strip runs along azimuth 0.
    pub(super) fn is_planar(&self) -> bool {
        self.azimuth_rad == 0.0 && self.turns == 0.0
    }

    /// Length along the strip, all units \[m\].
    pub fn strip_m(&self) -> f64 {
        self.count as f64 * self.shape.length_m
    }

    /// Length of body that it covers, on a body of radius `radius_m` \[m\]: a helix is longer than that. NaN where so many turns
    /// need a longer strip.
    pub fn covered_m(&self, radius_m: f64) -> f64 {
        if self.turns == 0.0 {
            return self.strip_m();
        }
        (self.strip_m().powi(2) - (TAU * radius_m * self.turns).powi(2)).sqrt()
    }

    /// Azimuth of the strip at a station \[rad\]: constant, or growing along a helix.
    pub fn azimuth_at(&self, radius_m: f64, s_m: f64) -> f64 {
        if self.turns == 0.0 {
            return self.azimuth_rad;
        }
        self.azimuth_rad + TAU * self.turns * (s_m - self.start_m) / self.covered_m(radius_m)
    }

    /// cos β of the slant to the axis.
    pub fn cos_slant(&self, radius_m: f64) -> f64 {
        if self.turns == 0.0 { 1.0 } else { self.covered_m(radius_m) / self.strip_m() }
    }

    /// sin β, positive from y towards z.
    pub fn sin_slant(&self, radius_m: f64) -> f64 {
        if self.turns == 0.0 { 0.0 } else { TAU * radius_m * self.turns / self.strip_m() }
    }
}
