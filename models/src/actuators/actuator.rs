//! What an actuator states: words for people, laws as functions.

use super::pattern::{ChamberBottom, Pattern};
use super::shape::ActuatorShape;

/// Contraction mechanism: what makes the actuator shorten under pressure.
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
    /// Full name, as in headings and reports.
    pub title: &'static str,
    /// One plain sentence: how it contracts and bends the body.
    pub sentence: &'static str,
    /// Stroke law as a formula in Unicode.
    pub formula: &'static str,
    /// Literature, and which parts are derived here.
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
    pub pattern: fn(&ActuatorShape) -> Pattern,
}

/// A kind is known by its name.
impl PartialEq for Actuator {
    fn eq(&self, other: &Actuator) -> bool {
        self.name == other.name
    }
}

impl Actuator {
    /// Whether it is a row of pouches, flat without pressure; a muscle is one tube of yarns, round from the start.
    pub fn has_pouches(&self) -> bool {
        match self.family {
            Family::Pouch => true,
            Family::Mckibben => false,
        }
    }

    /// Whether the body's wall is the bottom of its chambers.
    pub fn in_wall(&self, shape: &ActuatorShape) -> bool {
        matches!((self.pattern)(shape).joint, ChamberBottom::Wall)
    }
}

/// Restoring moment over P·area·D₀, `m = m₀ + m₁ ε D₀/D`, neither negative \[-\], on an arm `D = D₀ (1 + growth·lift)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Constant part m₀ of the moment, from the body's hinge.
    pub constant: f64,
    /// Part m₁ in proportion to the contraction, from the wall's bending stiffness.
    pub per_contraction: f64,
    /// Growth of the arm per lift of the line of action, β/D₀ \[1/m\].
    pub growth: f64,
}

/// Demand beyond which the arm of a start value is the one at rest.
const WEAK: f64 = 1e3;

/// What a growing arm makes of a demand: `m (1 − r)/d` with `d = D/D₀` and `r = ε d'/(ε' d)`, what virtual work takes.
pub(super) struct ArmDemand {
    pub value: f64,
    pub slope: f64,
    /// d/(1 − r): weighted imbalance per `force − weight·need`.
    pub lever: f64,
}

impl Demand {
    /// From contraction and d − 1, each with its first and second derivative by the coordinate.
    #[inline(always)]
    pub(super) fn need(&self, [e, de, dde]: [f64; 3], [grown, dd, ddd]: [f64; 3]) -> ArmDemand {
        let (m0, m1) = (self.constant, self.per_contraction);
        // A weak actuator hardly swells, and the quotients below lose all digits at rest.
        if self.growth == 0.0 || m0 + m1 > WEAK {
            return ArmDemand { value: m0 + m1 * e, slope: m1 * de, lever: 1.0 };
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
        ArmDemand { value, slope, lever: d / (1.0 - r) }
    }
}

/// Whether Newton's next step would be rounding: steps shrink as `next = step²·(step/last²)`, or near enough the square.
#[inline(always)]
pub(super) fn converged(step: f64, last: f64) -> bool {
    let square = step * step;
    square < 1e-16 || square * step.abs() < 1e-16 * last * last
}

/// Stroke law at one coordinate `a`, with derivatives by `a`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Shortening over flat length, ε \[-\].
    pub contraction: f64,
    /// Slope dε/da of the contraction by the coordinate.
    pub d_contraction: f64,
    /// Volume per unit flat length \[m²\].
    pub volume: f64,
    /// Slope of the volume per flat length by the coordinate.
    pub d_volume: f64,
    /// How far the line of action moves away from the body \[m\].
    pub lift: f64,
    /// Slope of the lift by the coordinate.
    pub d_lift: f64,
    /// Positive factor that makes the moment balance nearly linear in `a` (θ for a pouch, whose force goes as 1/θ).
    pub weight: f64,
}
