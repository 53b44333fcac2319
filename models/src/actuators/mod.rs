//! The actuators: one file each, one line in [`ACTUATORS`].
//!
//! An actuator states its **stroke law**: how contraction, volume and the lift of its line of action follow from one
//! coordinate. Everything else (pressure work, arm, body, effects) is common.

mod beam;
mod cpam;
mod epam;
mod fpam;
pub mod pattern;
pub mod pouch;
mod spam;

/// The list: what `ibr list`, the scenarios, the tests and the benches know.
pub const ACTUATORS: &[Actuator] = &[spam::ENTRY, cpam::ENTRY, epam::ENTRY, fpam::ENTRY];

pub use beam::BEAM;

/// What makes the actuator contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Flat pouch that becomes a lens: geometry-based contraction.
    Pouch,
    /// Bias-cut fabric tube that widens and shortens: material-based contraction.
    Mckibben,
}

/// An actuator kind. Plain data: formulas as text for `ibr list`, laws as functions.
#[derive(Debug, Clone, Copy, serde::Serialize)]
pub struct Actuator {
    /// Name in scenarios and data: `spam`, `cpam`, `epam`, `fpam`.
    pub name: &'static str,
    /// Full name.
    pub title: &'static str,
    /// One plain sentence.
    pub sentence: &'static str,
    /// Stroke law in Unicode.
    pub formula: &'static str,
    /// Literature and what is derived here.
    pub reference: &'static str,
    /// When the law holds and when not to use it.
    pub validity: &'static str,
    /// Contraction mechanism; decides which effects apply.
    #[serde(skip)]
    pub family: Family,
    /// Contraction, volume and lift at a coordinate.
    #[serde(skip)]
    pub stroke: fn(&ActuatorShape, f64) -> Stroke,
    /// Coordinate interval in which equilibrium is sought.
    #[serde(skip)]
    pub range: (f64, f64),
    /// Coordinate at which the actuator meets a demand, to rounding, and the slope there of the weighted imbalance over
    /// P·area·D₀.
    #[serde(skip)]
    pub guess: fn(&ActuatorShape, &Demand) -> (f64, f64),
    /// Area A so that P·A is a typical actuator force \[m²\].
    #[serde(skip)]
    pub area: fn(&ActuatorShape) -> f64,
    /// Arm from the taut generator to the line of action at rest \[m\], from body radius and shape; used if the
    /// scenario gives none.
    #[serde(skip)]
    pub arm: fn(f64, &ActuatorShape) -> f64,
    /// Share of the sealed-edge loss that the edges of this actuator suffer: 1 for sealed edges, 0 for free ones.
    #[serde(skip)]
    pub edge_restraint: fn(&ActuatorShape) -> f64,
    /// How it is cut, folded, welded and joined to the body.
    #[serde(skip)]
    pub pattern: fn(&ActuatorShape) -> pattern::Pattern,
}

/// Restoring moment over P·area·D₀, `m = m₀ + m₁ ε D₀/D`, neither negative \[-\], on an arm `D = D₀ (1 + growth·lift)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// m₀: the body's hinge.
    pub constant: f64,
    /// m₁: the wall's bending stiffness.
    pub per_contraction: f64,
    /// β/D₀ \[1/m\].
    pub growth: f64,
}

/// Demand beyond which the arm of a start value is the one at rest.
const WEAK: f64 = 1e3;

/// What a growing arm makes of a demand: `m (1 − r)/d` with `d = D/D₀` and `r = ε d'/(ε' d)`, what virtual work takes.
struct Need {
    value: f64,
    /// Its derivative by the coordinate.
    slope: f64,
    /// d/(1 − r): weighted imbalance per `force − weight·need`.
    lever: f64,
}

impl Demand {
    /// From contraction and d − 1, each with its first and second derivative by the coordinate.
    #[inline(always)]
    fn need(&self, [e, de, dde]: [f64; 3], [grown, dd, ddd]: [f64; 3]) -> Need {
        let (m0, m1) = (self.constant, self.per_contraction);
        // A weak actuator hardly swells, and the quotients below lose all digits at rest.
        if self.growth == 0.0 || m0 + m1 > WEAK {
            return Need { value: m0 + m1 * e, slope: m1 * de, lever: 1.0 };
        }
        let d = 1.0 + grown;
        let per = 1.0 / (de * d);
        let (per_d, d_ratio) = (de * per, dd * de * per);
        let r = e * dd * per;
        let slope_r = (de * dd + e * ddd) * per - r * (dde * d * per + d_ratio);
        let m = m0 + m1 * e * per_d;
        let slope_m = m1 * (de - e * d_ratio) * per_d;
        let value = m * (1.0 - r) * per_d;
        let slope = (slope_m * (1.0 - r) - m * slope_r) * per_d - value * d_ratio;
        Need { value, slope, lever: d / (1.0 - r) }
    }
}

/// Whether Newton's next step would be rounding: steps shrink as `next = step²·(step/last²)`, or near enough the square.
#[inline(always)]
fn converged(step: f64, last: f64) -> bool {
    let square = step * step;
    square < 1e-16 || square * step.abs() < 1e-16 * last * last
}

/// Dimensions of one actuator unit \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActuatorShape {
    /// Flat length L₀ along the body: one pouch, or the whole muscle.
    pub length_m: f64,
    /// Flat width W.
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

/// Stroke law at one coordinate `a`, with derivatives by `a`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Contraction ε \[-\].
    pub contraction: f64,
    /// dε/da.
    pub d_contraction: f64,
    /// Volume per unit flat length \[m²\].
    pub volume: f64,
    /// d(volume)/da.
    pub d_volume: f64,
    /// How far the line of action moves away from the body \[m\].
    pub lift: f64,
    /// d(lift)/da.
    pub d_lift: f64,
    /// Positive factor that makes the moment balance nearly linear in `a` (θ for a pouch, whose force goes as 1/θ).
    pub weight: f64,
}

/// The entry of that name.
pub fn by_name(name: &str) -> Option<&'static Actuator> {
    ACTUATORS.iter().find(|a| a.name == name)
}
