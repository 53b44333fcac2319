//! The actuator of one cell: its stroke, its push, and how far its line of action is from the taut generator.
//!
//! Base laws are those of the project (pouch lens, McKibben at 45°, linear lift of an external actuator); written again
//! from the geometry, so that a slip in `models` does not hide here. The other fields are hidden laws, off at 0:
//!
//! ```text
//! sealed edges    v → v (1 − β h/W), fPAM: v (1 − 4β r/L)         only the volume is lost, by the lens's height
//! swelling arm    D += s h²/(h² + h₀²)                            Hill curve: late, then saturated
//! stretch         e = c (0.4 T + 300 (1 − e^(−T/500)))            yarns uncrimp, then stretch; T = N/W in N/m
//! crease          U' = m tanh(θ/0.6)/L₀                           a fold that gives way plastically
//! shear           τ = G γ (1 + (γ/0.3)²)                          a coated weave that stiffens
//! lock            τ += τ_L exp((γ − 0.22)/0.035)                  yarns press on each other ever harder
//! ```

use models::actuators::Family;
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Laws of one cell's actuator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// Pouch or McKibben.
    pub family: Family,
    /// Flat length of one unit L₀ \[m\].
    pub length_m: f64,
    /// Flat width W \[m\].
    pub width_m: f64,
    /// Factor on the volume \[-\].
    pub gain: f64,
    /// Arm at rest D₀ \[m\].
    pub arm_m: f64,
    /// Share of the lift by which the arm grows \[-\]: the base's geometry.
    pub lift_share: f64,
    /// Factor on the pressure \[-\]: 1; 0 in a dead pouch.
    pub strength: f64,
    /// Sealed edges β \[-\].
    pub edge_loss: f64,
    /// Swelling arm s \[m\].
    pub swell_m: f64,
    /// Stretch c \[m/N\].
    pub stretch_m_per_n: f64,
    /// Crease m \[N·m\] per pouch.
    pub crease_nm: f64,
    /// Shear stiffness G \[N/m\].
    pub shear_n_per_m: f64,
    /// Shear lock τ_L \[N/m\].
    pub lock_n_per_m: f64,
}

/// What the actuator does at one coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct DriveState {
    /// Contraction and its slope by the coordinate.
    pub contraction: f64,
    pub d_contraction: f64,
    /// P dv/da − dU/da \[N·m/m…\], the generalised push on the coordinate.
    pub push: f64,
    /// Arm \[m\] and its slope.
    pub arm: f64,
    pub d_arm: f64,
    /// Factor that makes the balance nearly linear.
    pub weight: f64,
}

/// Lens of a pouch at half arc angle θ, or tube at contraction ε: contraction, volume per length, height; with slopes.
struct Bag {
    contraction: [f64; 2],
    volume: [f64; 2],
    height: [f64; 2],
}

impl Drive {
    /// Interval of the coordinate.
    pub(super) fn range(&self) -> (f64, f64) {
        match self.family {
            Family::Pouch => (1e-3, PI - 1e-6),
            Family::Mckibben => (-0.25, 0.6),
        }
    }

    pub(super) fn at(&self, a: f64, p_act_pa: f64) -> DriveState {
        let bag = self.bag(a);
        let ([v, dv], [h, dh]) = (bag.volume, bag.height);
        let per = match self.family {
            Family::Pouch => 1.0 / self.width_m,
            Family::Mckibben => 4.0 / self.length_m,
        };
        let kept = 1.0 - self.edge_loss * h * per;
        let d_volume = dv * kept - v * self.edge_loss * dh * per;
        let (swell, d_swell) = self.swell(h);
        let lift = match self.family {
            Family::Pouch => [0.5 * h, 0.5 * dh],
            Family::Mckibben => [h - self.width_m / PI, dh],
        };
        DriveState {
            contraction: bag.contraction[0],
            d_contraction: bag.contraction[1],
            push: self.strength * p_act_pa * d_volume - self.resistance(a),
            arm: self.arm_m + self.lift_share * lift[0] + swell,
            d_arm: self.lift_share * lift[1] + d_swell * dh,
            weight: if self.family == Family::Pouch { a } else { 1.0 },
        }
    }

    /// Strain that the tension N eats.
    pub(super) fn stretch(&self, tension: f64) -> f64 {
        let line = (tension / self.width_m).max(0.0);
        self.stretch_m_per_n * (0.4 * line + 300.0 * (1.0 - (-line / 500.0).exp()))
    }

    fn bag(&self, a: f64) -> Bag {
        match self.family {
            Family::Pouch => self.lens(a),
            Family::Mckibben => self.tube(a),
        }
    }

    /// Two arcs of length L₀ and half angle θ: chord L₀ sinθ/θ, area of the lens L₀² (θ − sinθ cosθ)/(2θ²), height.
    fn lens(&self, t: f64) -> Bag {
        let (sin, cos) = t.sin_cos();
        let l = self.length_m;
        let d_chord = (cos - sin / t) / t;
        let section = (t - sin * cos) / (2.0 * t * t);
        let d_section = sin * sin / (t * t) - 2.0 * section / t;
        let height = l * (1.0 - cos) / t;
        let flat = self.gain * self.width_m * l;
        Bag {
            contraction: [1.0 - sin / t, -d_chord],
            volume: [flat * section, flat * d_section],
            height: [height, (l * sin - height) / t],
        }
    }

    /// A tube of inextensible yarns at ±45°: length (1 − ε), radius r₀ √(2 − (1 − ε)²), r₀ = W/π.
    fn tube(&self, e: f64) -> Bag {
        let (rest, short) = (self.width_m / PI, 1.0 - e);
        let radius = rest * (2.0 - short * short).sqrt();
        let d_radius = rest * rest * short / radius;
        let volume = PI * radius * radius * short;
        let d_volume = 2.0 * PI * radius * d_radius * short - PI * radius * radius;
        Bag { contraction: [e, 1.0], volume: [self.gain * volume, self.gain * d_volume], height: [radius, d_radius] }
    }

    /// Hill curve in the height of the bag (of a muscle: in its growth), and its slope by the height.
    fn swell(&self, height: f64) -> (f64, f64) {
        let (x, half) = match self.family {
            Family::Pouch => (height, 0.35 * self.length_m),
            Family::Mckibben => ((height - self.width_m / PI).max(0.0), 0.05 * self.width_m / PI),
        };
        let sum = x * x + half * half;
        (self.swell_m * x * x / sum, self.swell_m * 2.0 * x * half * half / (sum * sum))
    }

    /// Shear load of the weave at a shear angle \[N/m\].
    pub(super) fn shear_load(&self, shear: f64) -> f64 {
        let elastic = self.shear_n_per_m * shear * (1.0 + (shear / 0.3).powi(2));
        let lock = if self.lock_n_per_m == 0.0 { 0.0 } else { ((shear - 0.22) / 0.035).exp() };
        elastic + self.lock_n_per_m * lock
    }

    /// dU/da of what the actuator's fabric stores or loses, per length.
    fn resistance(&self, a: f64) -> f64 {
        match self.family {
            Family::Pouch => self.crease_nm * (a / 0.6).tanh() / self.length_m,
            Family::Mckibben => {
                let yarn = ((1.0 - a) / SQRT_2).acos();
                let shear = 2.0 * yarn - FRAC_PI_2;
                2.0 * self.width_m * self.shear_load(shear) * SQRT_2 / yarn.sin()
            }
        }
    }
}
