//! The actuator of one cell: its stroke, its push, and how far its line of action is from the taut generator.
//!
//! Base laws are the project's (pouch lens, McKibben at 45°, linear lift of an external actuator), but derived again
//! from the geometry, so that a slip in `models` does not hide here. The other fields are hidden laws, off at 0:
//! [`crate::HIDDEN`], [`crate::ALSO`] and [`crate::OUTSIDE`] have the equations of the hidden laws.

use super::laws::ByLaw;
use models::actuators::Family;
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Line load at which the second law's fabric has doubled its stiffness \[N/m\].
const FUNG_N_PER_M: f64 = 300.0;
/// Shear angle at which no room is left between yarns \[rad\].
const DENSE_RAD: f64 = 0.36;
/// Room at which the law ends: its load is a million times the scale.
const LEAST_ROOM: f64 = 0.01;

/// Geometry of one cell's actuator and amounts of its hidden laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drive {
    pub family: Family,
    /// Flat length of one unit L₀ \[m\].
    pub length_m: f64,
    /// Width W of the flat unit \[m\].
    pub width_m: f64,
    pub gain: f64,
    /// Distance D₀ of the line of action from the taut generator at rest \[m\].
    pub arm_m: f64,
    /// Share of the lift by which the arm grows \[-\]: the base's geometry.
    pub lift_share: f64,
    /// Factor on the pressure \[-\]: 1; 0 in a dead pouch.
    pub strength: f64,
    /// Share β of the volume that sealed edges cost \[-\].
    pub edge_loss: ByLaw,
    /// Largest growth s of the arm by swelling \[m\].
    pub swell_m: ByLaw,
    /// Compliance c of the stretched fabric \[m/N\].
    pub stretch_m_per_n: ByLaw,
    /// Scale m of the moment of a crease, per pouch \[N·m\].
    pub crease_nm: ByLaw,
    /// Shear stiffness G of the fabric at small angles \[N/m\].
    pub shear_n_per_m: ByLaw,
    /// Scale τ_L of the load at which shear locks \[N/m\].
    pub lock_n_per_m: ByLaw,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct DriveState {
    pub contraction: f64,
    pub d_contraction: f64,
    /// P dv/da − dU/da \[N·m/m…\], the generalised push on the coordinate.
    pub push: f64,
    pub arm: f64,
    pub d_arm: f64,
    /// Factor that makes the balance nearly linear.
    pub weight: f64,
}

/// Lens of a pouch at half arc angle θ, or tube at contraction ε; numbers with their slopes.
struct Bag {
    contraction: [f64; 2],
    /// Per length of the actuator.
    volume: [f64; 2],
    height: [f64; 2],
    /// Height by which the line of action is lifted.
    lift: [f64; 2],
    /// Height of the centroid of the bulged wall over L₀; of a muscle its growth over its radius at rest.
    centroid: [f64; 2],
    /// What the sealed edges see of the height, 1/W or 4/L.
    per_m: f64,
    /// Height that swells the arm, of a muscle its growth, and the height of half of the effect.
    swollen_m: [f64; 2],
    /// Factor that makes the balance nearly linear.
    weight: f64,
}

impl Drive {
    /// Lower and upper bound of the coordinate, a half arc angle or a contraction.
    pub(super) fn range(&self) -> (f64, f64) {
        match self.family {
            Family::Pouch => (1e-3, PI - 1e-6),
            Family::Mckibben => (-0.25, 0.6),
        }
    }

    pub(super) fn at(&self, a: f64, p_act_pa: f64) -> DriveState {
        let bag = match self.family {
            Family::Pouch => self.lens(a),
            Family::Mckibben => self.tube(a),
        };
        let ([v, dv], [h, dh], per) = (bag.volume, bag.height, bag.per_m);
        let [pinched, bowed] = self.edge_loss;
        let kept = 1.0 - pinched * h * per - bowed * (h * per).powi(2);
        let d_volume = dv * kept - v * pinched * dh * per - 2.0 * v * bowed * h * dh * per * per;
        let [swell, d_swell] = self.swell(&bag);
        DriveState {
            contraction: bag.contraction[0],
            d_contraction: bag.contraction[1],
            push: self.strength * p_act_pa * d_volume - self.resistance(a),
            arm: self.arm_m + self.lift_share * bag.lift[0] + swell,
            d_arm: self.lift_share * bag.lift[1] + d_swell,
            weight: bag.weight,
        }
    }

    /// Strain that the tension N eats.
    pub(super) fn stretch(&self, tension: f64) -> f64 {
        let line = (tension / self.width_m).max(0.0);
        let [crimped, fung] = self.stretch_m_per_n;
        crimped * (0.4 * line + 300.0 * (1.0 - (-line / 500.0).exp()))
            + fung * FUNG_N_PER_M * (line / FUNG_N_PER_M).ln_1p()
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
        let slope = (l * sin - height) / t;
        let rise = (sin / t - cos) / (2.0 * t);
        Bag {
            contraction: [1.0 - sin / t, -d_chord],
            volume: [flat * section, flat * d_section],
            height: [height, slope],
            lift: [0.5 * height, 0.5 * slope],
            centroid: [rise, (cos / t - sin / (t * t) + sin) / (2.0 * t) - rise / t],
            per_m: 1.0 / self.width_m,
            swollen_m: [height, 0.35 * self.length_m],
            weight: t,
        }
    }

    /// A tube of inextensible yarns at ±45°: length (1 − ε), radius r₀ √(2 − (1 − ε)²), r₀ = W/π.
    fn tube(&self, e: f64) -> Bag {
        let (rest, short) = (self.width_m / PI, 1.0 - e);
        let radius = rest * (2.0 - short * short).sqrt();
        let d_radius = rest * rest * short / radius;
        let volume = PI * radius * radius * short;
        let d_volume = 2.0 * PI * radius * d_radius * short - PI * radius * radius;
        Bag {
            contraction: [e, 1.0],
            volume: [self.gain * volume, self.gain * d_volume],
            height: [radius, d_radius],
            lift: [radius - rest, d_radius],
            centroid: [radius * PI / self.width_m - 1.0, d_radius * PI / self.width_m],
            per_m: 4.0 / self.length_m,
            swollen_m: [(radius - rest).max(0.0), 0.05 * self.width_m / PI],
            weight: 1.0,
        }
    }

    /// Growth of the arm with its slope: a Hill curve in the height of the bag; and the centroid of the bulged wall.
    fn swell(&self, bag: &Bag) -> [f64; 2] {
        let ([x, half], slope) = (bag.swollen_m, bag.height[1]);
        let sum = x * x + half * half;
        let [hill, wall] = self.swell_m;
        let first = [hill * x * x / sum, hill * 2.0 * x * half * half / (sum * sum) * slope];
        let second = bag.centroid.map(|rise| wall * rise);
        [first[0] + second[0], first[1] + second[1]]
    }

    /// Shear load of the weave at a shear angle \[N/m\].
    pub(super) fn shear_load(&self, shear: f64) -> f64 {
        let [stiffens, softens] = self.shear_n_per_m;
        let elastic = stiffens * shear * (1.0 + (shear / 0.3).powi(2));
        let [ever_harder, pressed] = self.lock_n_per_m;
        let lock = if ever_harder == 0.0 { 0.0 } else { ((shear - 0.22) / 0.035).exp() };
        // Fibres push by the cube of their density, relative to the sheet at rest; not on the other side.
        let dense = (1.0 - shear.max(0.0) / DENSE_RAD).max(LEAST_ROOM).powi(-3) - 1.0;
        elastic + ever_harder * lock + softens * shear / (1.0 + shear.abs() / 0.15) + pressed * dense
    }

    /// dU/da of what the actuator's fabric stores or loses, per length.
    fn resistance(&self, a: f64) -> f64 {
        match self.family {
            Family::Pouch => {
                let [yields, hardens] = self.crease_nm;
                (yields * (a / 0.6).tanh() + hardens * a.powf(0.4)) / self.length_m
            }
            Family::Mckibben => {
                let yarn = ((1.0 - a) / SQRT_2).acos();
                let shear = 2.0 * yarn - FRAC_PI_2;
                2.0 * self.width_m * self.shear_load(shear) * SQRT_2 / yarn.sin()
            }
        }
    }
}
