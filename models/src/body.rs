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
/// | share | 1 in the base law; a scenario may set another share of the collapse moment | - |
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
    /// Share of the collapse moment that the hinge carries \[-\]: 1 collapse, ½ first wrinkle.
    pub share: f64,
}

/// Law of the body pressure: its own, or what an effect puts in its place.
pub enum BodyLaw {
    /// The hinge.
    Hinge(BodyPressure),
    /// Another law of the same name.
    Replaced(Box<dyn Term>),
}

impl std::ops::Deref for BodyLaw {
    type Target = dyn Term;

    fn deref(&self) -> &(dyn Term + 'static) {
        match self {
            BodyLaw::Hinge(law) => law,
            BodyLaw::Replaced(law) => &**law,
        }
    }
}

impl BodyLaw {
    /// Adds the force alone; the hinge needs no logarithm then.
    #[inline]
    pub(crate) fn add_force(&self, at: &Pose, force: &mut [f64]) {
        match self {
            BodyLaw::Hinge(law) => force[0] -= law.moment(at.p_body_pa) * soft_slope(at.q[0] / law.hinge_curvature),
            BodyLaw::Replaced(law) => {
                law.add(at, force);
            }
        }
    }
}

impl BodyPressure {
    /// The complete hinge's moment, a share of πp_bR³ \[N·m\].
    #[inline]
    fn moment(&self, p_body_pa: f64) -> f64 {
        self.share * PI * p_body_pa * self.radius_m.powi(3)
    }
}

impl Term for BodyPressure {
    fn name(&self) -> &'static str {
        "body_pressure"
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let moment = self.moment(at.p_body_pa);
        let (energy, slope) = soft_step(at.q[0], self.hinge_curvature);
        force[0] -= moment * slope;
        moment * energy
    }
}

/// `k₀ ln cosh(x/k₀)` and its slope `tanh(x/k₀)`: an energy whose force steps from −1 to 1 over ±k₀.
pub(crate) fn soft_step(x: f64, k0: f64) -> (f64, f64) {
    let u = x / k0;
    let size = u.abs();
    if size > COMPLETE {
        return (x.abs() - LN_2 * k0, soft_slope(u));
    }
    if size < SERIES_BELOW {
        let z = u * u;
        return (k0 * z * (0.5 - z * (1.0 / 12.0 - z * (1.0 / 45.0 - z * (17.0 / 2520.0)))), soft_slope(u));
    }
    let decay = (-2.0 * size).exp();
    // ln(1 + decay) is decay to the last bit where the step is nearly complete.
    let rest = if decay < 1e-16 { decay } else { decay.ln_1p() };
    (x.abs() + k0 * (rest - LN_2), soft_slope(u))
}

/// `tanh u`.
#[inline]
fn soft_slope(u: f64) -> f64 {
    let size = u.abs();
    if size > COMPLETE {
        return u.signum();
    }
    if size < SERIES_BELOW {
        let z = u * u;
        return u * (1.0 - z * (1.0 / 3.0 - z * (2.0 / 15.0 - z * (17.0 / 315.0))));
    }
    let decay = (-2.0 * size).exp();
    u.signum() * (1.0 - decay) / (1.0 + decay)
}

/// From here on the step is complete to the last bit.
const COMPLETE: f64 = 20.0;
/// Below this the exponential form loses the digits that the series keeps.
const SERIES_BELOW: f64 = 0.02;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_soft_step_is_ln_cosh_and_tanh_everywhere() {
        for i in -400..400 {
            let u = 0.1 * f64::from(i) + 1e-3;
            let (energy, slope) = soft_step(0.05 * u, 0.05);
            assert!((energy - 0.05 * u.cosh().ln()).abs() < 1e-15 * (1.0 + u.abs()), "{u}");
            assert!((slope - u.tanh()).abs() < 1e-15, "{u}");
        }
    }

    #[test]
    fn the_force_alone_is_the_force_of_the_law_to_the_bit() {
        let hinge = BodyPressure { radius_m: 0.04, hinge_curvature: 0.05, share: 0.7 };
        let law = BodyLaw::Hinge(hinge);
        for kappa in [-30.0, -0.3, -1e-4, 0.0, 1e-5, 0.04, 0.9, 7.0] {
            let (mut whole, mut alone) = ([1.0], [1.0]);
            let q = [kappa];
            let at = Pose::new(&q, 3e3, 0.0);
            law.add(&at, &mut whole);
            law.add_force(&at, &mut alone);
            assert_eq!(whole, alone, "{kappa}");
        }
    }

    #[test]
    fn the_branches_of_the_soft_step_meet() {
        for (join, size) in [(SERIES_BELOW, 1e-13), (20.0, 1e-15)] {
            let (below, above) = (soft_step(join * (1.0 - 1e-15), 1.0), soft_step(join * (1.0 + 1e-15), 1.0));
            assert!((above.0 / below.0 - 1.0).abs() < 1e-12 && (above.1 / below.1 - 1.0).abs() < size, "{join}");
        }
    }
}
