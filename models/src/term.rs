//! The one interface of the project: a physical effect as an energy and its virtual work.
//!
//! A state of rest makes the virtual work of all terms vanish, `δW = Σᵢ Fᵢ·δq = 0` with `Fᵢ = −∂Eᵢ/∂q`. A model is
//! a list of terms; a missing physical effect is a missing entry of that list. The reduced model and the finite
//! element engine use the same trait over different coordinates `q`:
//!
//! | coordinates `q` | used by | energy |
//! |---|---|---|
//! | [`actuator_q`]: actuator coordinate, contraction, volume, geometric curvature | pressure work, shear, folds | J per metre of body |
//! | `[κ]`: curvature of a segment \[1/m\] | body pressure, bending, wrinkling | J per metre of body |
//! | `[x₀, y₀, x₁, y₁, …]`: node positions \[m\] | gravity, tip load | J |

/// Gauge pressures acting on the robot \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loads {
    /// Body gauge pressure p_b \[Pa\].
    pub body_pa: f64,
    /// Gauge pressure of each supply channel P \[Pa\]; a zone names its channel (0 unless said).
    pub actuator_pa: [f64; CHANNELS],
}

/// Number of independent actuator supply lines a robot can have.
pub const CHANNELS: usize = 4;

impl Loads {
    /// The same actuator pressure in every channel.
    ///
    /// ```
    /// let loads = models::Loads::uniform(2e3, 30e3);
    /// assert_eq!(loads.actuator_pa[3], 30e3);
    /// ```
    pub fn uniform(body_pa: f64, actuator_pa: f64) -> Loads {
        Loads { body_pa, actuator_pa: [actuator_pa; CHANNELS] }
    }
}

/// Where a term is evaluated: coordinates, and the two pressures of the place.
#[derive(Debug, Clone, Copy)]
pub struct Pose<'a> {
    /// Generalised coordinates; their meaning is that of the list the term is in.
    pub q: &'a [f64],
    /// Body gauge pressure \[Pa\].
    pub p_body_pa: f64,
    /// Pressure in this segment's actuator, after the supply stage \[Pa\]; 0 where there is none.
    pub p_act_pa: f64,
}

/// One physical effect: its energy and its virtual work.
///
/// Law (tested over every term at random poses): the force added equals minus the slope of the returned energy.
pub trait Term: Send + Sync {
    /// Name in the energy ledger.
    fn name(&self) -> &'static str;
    /// Adds `−∂E/∂q` to `force` (same length as `at.q`) and returns the energy E.
    fn add(&self, at: &Pose, force: &mut [f64]) -> f64;
}

/// Layout of the coordinates of an actuator-side term. Only the first is independent; the others follow from it, so a
/// term may be written in whichever is natural and the chain rule is applied once, in the balance.
pub mod actuator_q {
    /// The actuator's own coordinate: half arc angle θ \[rad\] of a pouch, contraction ε of a fabric muscle.
    pub const COORDINATE: usize = 0;
    /// Contraction ε \[-\].
    pub const CONTRACTION: usize = 1;
    /// Volume per unit flat length \[m²\].
    pub const VOLUME: usize = 2;
    /// Curvature κ the body would have if the fabric did not stretch \[1/m\].
    pub const CURVATURE: usize = 3;
    /// Length of the slice.
    pub const LEN: usize = 4;
}
