//! The dimensions of one actuator unit.

/// Dimensions of one actuator unit \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActuatorShape {
    /// Flat length L₀ along the body: one pouch, or the whole muscle.
    pub length_m: f64,
    /// Flat width W of the pouch or of the muscle's tube.
    pub width_m: f64,
    /// Depth f of a lateral gusset fold; 0 without folds.
    pub fold_m: f64,
    /// Factor on the enclosed volume \[-\]; 1 unless the scenario assumes otherwise.
    pub volume_gain: f64,
    /// Angle α₀ of the two yarn families to the axis of a muscle at rest \[rad\]; pouches have none.
    pub bias_rad: f64,
}

/// The bias cut: yarns at 45° to the axis.
pub const BIAS: f64 = std::f64::consts::FRAC_PI_4;

impl ActuatorShape {
    /// Squares of cosine and sine of the bias angle, exactly one half each at 45°.
    pub fn bias_squares(&self) -> [f64; 2] {
        if self.bias_rad == BIAS {
            return [0.5; 2];
        }
        let double = (2.0 * (BIAS - self.bias_rad)).sin();
        [0.5 * (1.0 + double), 0.5 * (1.0 - double)]
    }

    /// Turn of the yarns against each other `γ = 2(α − α₀)` where the muscle has shortened by ε, cosα = (1 − ε) cosα₀, and
    /// its derivative.
    pub(crate) fn yarn_shear(&self, contraction: f64) -> [f64; 2] {
        let per_cos = 1.0 / self.bias_squares()[0];
        let cos = (1.0 - contraction) / per_cos.sqrt();
        let turn = 2.0 * (1.0 / per_cos) * per_cos.sqrt();
        [2.0 * cos.acos() - 2.0 * self.bias_rad, turn / (1.0 - cos * cos).sqrt()]
    }
}
