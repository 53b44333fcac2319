//! The body's own terms: pressure work with its hinge regularisation, and the bending stiffness B.

use crate::term::{Pose, Term};
use std::f64::consts::{LN_2, PI};

/// Pressure work of a tube that folds about its taut generator.
///
/// The centre line shortens by (1 − κR), so the volume is `V' = πR²(1 − κR)` per metre and the restoring moment is the
/// constant πp_bR³, the collapse moment of a Comer–Levy tube. A step at κ = 0 is regularised:
///
/// ```text
/// E = π p_b R³ k₀ ln cosh(κ/k₀)      M = −∂E/∂κ = −π p_b R³ tanh(κ/k₀)
/// ```
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | κ | curvature per length of the taut generator | 1/m |
/// | R | body radius | m |
/// | p_b | body gauge pressure | Pa |
/// | k₀ | curvature over which the hinge sets in (numerical; 0.05 1/m is 1 % of a bent robot) | 1/m |
///
/// Validity: κ well above the wrinkling curvature p_b/(2Et) (the effect `wrinkling` replaces the step by the real
/// curve), regulated body pressure. Derived here; the collapse moment is that of Comer & Levy 1963.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPressure {
    /// Body radius R \[m\].
    pub radius_m: f64,
    /// Hinge curvature k₀ \[1/m\].
    pub hinge_curvature: f64,
}

impl Term for BodyPressure {
    fn name(&self) -> &'static str {
        "body_pressure"
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let moment = PI * at.p_body_pa * self.radius_m.powi(3);
        let (energy, slope) = soft_step(at.q[0], self.hinge_curvature);
        force[0] -= moment * slope;
        moment * energy
    }
}

/// `k₀ ln cosh(x/k₀)` and its slope `tanh(x/k₀)`: an energy whose force steps from −1 to 1 over ±k₀.
#[inline]
pub(crate) fn soft_step(x: f64, k0: f64) -> (f64, f64) {
    let u = x / k0;
    let size = u.abs();
    // From 20 on the step is complete to the last bit.
    if size > 20.0 {
        return (x.abs() - LN_2 * k0, u.signum());
    }
    if size < SMALL {
        // cosh u = 1 + 2 sinh²(u/2) keeps the digits that ln 2 would swallow.
        let half = (0.5 * size).sinh();
        return (k0 * (2.0 * half * half).ln_1p(), u.tanh());
    }
    let decay = (-2.0 * size).exp();
    (x.abs() + k0 * (decay.ln_1p() - LN_2), u.signum() * (1.0 - decay) / (1.0 + decay))
}

/// Below this, exp(−2u) is too close to 1 for the form used above it.
const SMALL: f64 = 0.3;

/// Elastic bending of the wall, `E = ½Bκ²`.
///
/// B \[N·m²\] is an **effective** number: folds, welds, glue and wrinkled wall are all in it. 0 in the bare model;
/// calibrate it on data and say so. Do not read a fitted B as a fabric property.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bending {
    /// Effective bending stiffness B \[N·m²\].
    pub stiffness: f64,
}

impl Term for Bending {
    fn name(&self) -> &'static str {
        "bending"
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let moment = self.stiffness * at.q[0];
        force[0] -= moment;
        0.5 * moment * at.q[0]
    }
}
