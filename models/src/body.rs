//! The body's own terms: pressure work, with a step that is numerical or the wall's own, and the bending stiffness B.

use crate::term::{Account, LedgerLine, Pose, Term};
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
/// Validity: κ well above p_b/(Et), regulated body pressure. A body that is bent less has a wall: [`BodyWall`], or the
/// effect `wrinkling`. Derived here; the collapse moment follows Comer & Levy 1963.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPressure {
    /// Radius R of the inflated body \[m\].
    pub radius_m: f64,
    /// Curvature k₀ over which the hinge sets in \[1/m\]; numerical, not a property of the fabric.
    pub hinge_curvature: f64,
    /// Share of the collapse moment that the hinge carries \[-\]: 1 collapse, ½ first wrinkle.
    pub share: f64,
}

/// A pressurised wall that softens as it bends: the wall's stiffness and the hinge in series.
///
/// Two limits are exact. The taut wall is elastic, dM/dκ = πEtR³. The folded body is a hinge, M = πp_bR³. In between the
/// wall buckles and creases, one piece after the other. Where a new crease falls does not depend on those that are there,
/// so equal bends take equal shares of the smooth wall: dn = −n dκ/κ₀. A smooth piece has the taut wall's stiffness, a
/// creased one carries its share of the hinge's moment and no more, so dM/dκ = n πEtR³:
///
/// ```text
/// M = π p_b R³ (1 − e^(−κ/κ₀))      E = π p_b R³ (κ − κ₀ (1 − e^(−κ/κ₀)))      κ₀ = p_b/(E t)      κ ≥ 0, M odd
/// ```
///
/// The two limits leave one choice of κ₀: nothing is fitted. The wall's compliance adds to the hinge's, (πEtR³)⁻¹ at κ = 0
/// and ever more beyond.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | E t | membrane stiffness of the wall along the body | N/m |
/// | n | share of the wall that is still smooth, e^(−κ/κ₀) | - |
/// | κ₀ | p_b/(E t), twice the curvature of Comer & Levy's first wrinkle | 1/m |
///
/// Validity: first loading (creases do not heal at once; the law returns on its own path), κR ≪ 1 or hinge, a section that
/// stays round until it creases. A wall without creases follows Comer & Levy, linear up to half of the collapse moment:
/// measured beams do not (`verification::exact::inflated_cantilever` has that curve). The law of
/// creases is derived here; limits: Comer & Levy 1963, Le van & Wielgosz 2005; a rate in proportion to the rest is
/// Iwan's (1966) of distributed elements; that a load–deflection curve of kite beams is close to an exponential was measured
/// by Breukels (2011), see `tests/laws/beams.rs`. Of four laws between these limits, tried on those
/// beams, this one came nearest: agreement with them is not independent evidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyWall {
    /// Radius R of the inflated body \[m\].
    pub radius_m: f64,
    /// Modulus times thickness of the wall along the body, E t \[N/m\].
    pub stiffness_n_per_m: f64,
    /// Share of the collapse moment \[-\]; the initial stiffness keeps its value.
    pub share: f64,
}

/// The ledger's line of every law of the body pressure.
pub(crate) const BODY_PRESSURE: LedgerLine = LedgerLine::new("body_pressure", Account::BodyGas);

/// Law of the body pressure: its own, or what an effect puts in its place.
pub enum BodyLaw {
    /// The hinge, with a numerical step over k₀ instead of a wall's compliance.
    Hinge(BodyPressure),
    /// The hinge in series with a wall.
    Wall(BodyWall),
    /// Another law of the same name.
    Replaced(Box<dyn Term>),
}

impl std::ops::Deref for BodyLaw {
    type Target = dyn Term;

    fn deref(&self) -> &(dyn Term + 'static) {
        match self {
            BodyLaw::Hinge(law) => law,
            BodyLaw::Wall(law) => law,
            BodyLaw::Replaced(law) => &**law,
        }
    }
}

impl BodyLaw {
    /// Share of πp_bR³ that the folded section carries; 1 where an effect has replaced the law.
    pub(crate) fn share(&self) -> f64 {
        match self {
            BodyLaw::Hinge(law) => law.share,
            BodyLaw::Wall(law) => law.share,
            BodyLaw::Replaced(_) => 1.0,
        }
    }

    /// Curvature over which it sets in \[1/m\]; of a hinge alone, which every section in space has.
    pub(crate) fn hinge_per_m(&self) -> f64 {
        if let BodyLaw::Hinge(law) = self { law.hinge_curvature } else { 0.0 }
    }

    /// Multiplies the moment of the gas, relative to a round section; a replaced law keeps its own moment.
    pub(crate) fn scale(&mut self, factor: f64) {
        match self {
            BodyLaw::Hinge(law) => law.share *= factor,
            BodyLaw::Wall(law) => law.share *= factor,
            BodyLaw::Replaced(_) => {}
        }
    }

    /// Adds the force alone; the hinge needs no logarithm then.
    #[inline]
    pub(crate) fn add_force(&self, at: &Pose, force: &mut [f64]) {
        match self {
            BodyLaw::Hinge(law) => force[0] -= law.moment(at.p_body_pa) * soft_slope(at.q[0] / law.hinge_curvature),
            BodyLaw::Wall(law) => force[0] -= law.at(at).0,
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
    fn line(&self) -> LedgerLine {
        BODY_PRESSURE
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let moment = self.moment(at.p_body_pa);
        let (energy, slope) = soft_step(at.q[0], self.hinge_curvature);
        force[0] -= moment * slope;
        moment * energy
    }
}

impl BodyWall {
    /// Moment, complete moment and u = |κ|/κ₀; without pressure nothing.
    #[inline]
    fn at(&self, at: &Pose) -> (f64, f64, f64) {
        let complete = self.share * PI * at.p_body_pa * self.radius_m.powi(3);
        if complete == 0.0 {
            return (0.0, 0.0, 0.0);
        }
        let u = at.q[0].abs() * self.stiffness_n_per_m / (self.share * at.p_body_pa);
        (-(-u).exp_m1() * complete * at.q[0].signum(), complete, u)
    }
}

impl Term for BodyWall {
    fn line(&self) -> LedgerLine {
        BODY_PRESSURE
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (moment, complete, u) = self.at(at);
        force[0] -= moment;
        if complete == 0.0 {
            return 0.0;
        }
        // u − 1 + e^(−u), as a series where its digits cancel.
        let lag = if u < SERIES_BELOW {
            u * u * (0.5 - u * (1.0 / 6.0 - u * (1.0 / 24.0 - u * (1.0 / 120.0 - u * (1.0 / 720.0 - u / 5040.0)))))
        } else {
            u + (-u).exp_m1()
        };
        complete * lag * (self.share * at.p_body_pa / self.stiffness_n_per_m)
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

/// `tanh u` by its series near 0 and by ±1 beyond [`COMPLETE`], where it is complete.
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
pub struct WallBending {
    /// Effective bending stiffness B of the whole section \[N·m²\], 0 in the bare model.
    pub stiffness: f64,
}

impl Term for WallBending {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("bending", Account::Wall)
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
        for law in [BodyLaw::Hinge(hinge), BodyLaw::Wall(WALL)] {
            for kappa in [-30.0, -0.3, -1e-4, 0.0, 1e-5, 0.04, 0.9, 7.0] {
                let (mut whole, mut alone) = ([1.0], [1.0]);
                let q = [kappa];
                let at = Pose::new(&q, 3e3, 0.0);
                law.add(&at, &mut whole);
                law.add_force(&at, &mut alone);
                assert_eq!(whole, alone, "{kappa}");
            }
        }
    }

    const WALL: BodyWall = BodyWall { radius_m: 0.04, stiffness_n_per_m: 41.6e3, share: 0.9 };

    /// Energy and moment of the wall.
    fn wall(kappa: f64, p_body_pa: f64) -> (f64, f64) {
        let mut force = [0.0];
        let energy = WALL.add(&Pose::new(&[kappa], p_body_pa, 0.0), &mut force);
        (energy, -force[0])
    }

    #[test]
    fn a_wall_starts_with_its_own_stiffness_and_ends_as_the_hinge_of_the_pressure() {
        let (radius, stiffness) = (0.04_f64, 41.6e3);
        for p_body_pa in [500.0, 2e3, 3e4] {
            let taut = PI * stiffness * radius.powi(3);
            assert!((wall(1e-9, p_body_pa).1 / (1e-9 * taut) - 1.0).abs() < 1e-6);
            assert_eq!(wall(1e3, p_body_pa).1, 0.9 * PI * p_body_pa * radius.powi(3));
            // Softer than the one, and weaker than the other, everywhere.
            for kappa in [1e-3, 0.03, 0.4, 3.0] {
                let moment = wall(kappa, p_body_pa).1;
                assert!(moment < taut * kappa && moment <= 0.9 * PI * p_body_pa * radius.powi(3));
                assert_eq!(wall(-kappa, p_body_pa), (wall(kappa, p_body_pa).0, -moment));
            }
        }
        assert_eq!(wall(0.3, 0.0), (0.0, 0.0));
    }

    #[test]
    fn the_moment_of_a_wall_is_the_slope_of_its_energy() {
        for kappa in [-2.0, -0.04, -1e-3, 2e-4, 9e-4, 1e-3, 0.05, 0.6, 4.0] {
            let h = 1e-4 * f64::abs(kappa);
            let slope = |h: f64| (wall(kappa + h, 2e3).0 - wall(kappa - h, 2e3).0) / (2.0 * h);
            let by_energy = (4.0 * slope(0.5 * h) - slope(h)) / 3.0;
            assert!((by_energy / wall(kappa, 2e3).1 - 1.0).abs() < 1e-9, "{kappa}");
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
