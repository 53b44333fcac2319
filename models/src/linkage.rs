//! The linkage between an actuator and the body: arm, active share, compliance, law of the section; and the work of the gas.

use crate::term::{Account, LedgerLine, Pose, Term, actuator_q};

/// How the actuator's contraction becomes curvature of the body.
#[derive(Debug, Clone, Copy)]
pub struct Linkage {
    /// Share η of the actuator's volume that is active \[-\]; 1 in the bare model.
    pub active_fraction: f64,
    /// Share η_ε of its stroke that is active \[-\]; 1 in the bare model.
    pub stroke_fraction: f64,
    /// Arm D₀ from the taut generator to the line of action at rest \[m\].
    pub arm_m: f64,
    /// Share β of the actuator's lift by which the arm grows \[-\]; 0 in the bare model.
    pub arm_growth: f64,
    /// Line compliance of the actuator's fabric c/W \[1/N\], contraction lost per newton; 0 in the bare model.
    pub compliance_per_n: f64,
    /// What an effect makes of the section as the body bends; `None`: it stays as it is.
    pub section: Option<SectionLaw>,
}

/// How a section that changes as the body bends turns the curvature `g` of one that does not into κ.
#[derive(Debug, Clone, Copy)]
pub struct SectionLaw {
    /// κ and dκ/dg from the law's size and shape, and `g`.
    pub law: fn([f64; 2], f64) -> (f64, f64),
    /// Size and shape of [`SectionLaw::law`] in SI units.
    pub parameters: [f64; 2],
}

impl Linkage {
    /// Curvature κ of the body where one whose section stays as it is would have curvature `g`, and dκ/dg.
    #[inline]
    pub fn bent(&self, g: f64) -> (f64, f64) {
        self.section.map_or((g, 1.0), |section| (section.law)(section.parameters, g))
    }
}

/// Tension N from the actuator's balance `N (x + q N) = y`: the arm shrinks a little as the fabric stretches (q > 0).
#[inline]
pub(crate) fn line_tension(y: f64, x: f64, q: f64) -> f64 {
    if q == 0.0 || y <= 0.0 { y / x } else { 2.0 * y / (x + (x * x + 4.0 * q * y).sqrt()) }
}

/// Ledger line of the fabric along the line of action, which has no term: its energy follows from the equilibrium.
pub(crate) const FABRIC_STRETCH: LedgerLine = LedgerLine::new("fabric_stretch", Account::Stretch);

/// The pressure work of the actuator, `E = −P v`.
pub(crate) struct ActuatorPressure;

impl Term for ActuatorPressure {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("actuator_pressure", Account::ActuatorGas)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        force[actuator_q::VOLUME] += at.p_act_pa;
        -at.p_act_pa * at.q[actuator_q::VOLUME]
    }
}
