//! Gradual wrinkling of the body wall after Comer & Levy, in place of the ideal hinge.
//!
//! The wall carries tension only. With κ_w = p_b c/2 the wrinkling curvature and γ the half angle of the slack zone:
//!
//! ```text
//! κ ≤ κ_w:  M = ½ π p_b R³ κ/κ_w
//! κ > κ_w:  κ/κ_w = π/D,  M = π p_b R³ (2π − 2γ + sin2γ)/(4D),  D = sinγ + (π − γ) cosγ
//! E = ½ ∮ Eₜ ε² R dφ − N (ε₀ − N c/(2·2πR))          so that M = −∂E/∂κ;  N = πR²p_b, ε₀ the strain at the axis
//! ```
//!
//! c = 2.3e-5 m/N for 215 MPa × 0.2 mm. At the curvatures of a bent robot (κ/κ_w of 50–200) M is within 2–3 % of the hinge moment, so with a
//! fabric's real compliance this effect is small; a large fitted c means that the wall folds gradually for another reason. The typical sizes
//! belong to such a wall: κ_w half of the curvature at which the robots work. AIAA Journal 1(7), 1963.

use super::entry::*;
use crate::body::{BODY_PRESSURE, BodyLaw};
use crate::comer_levy::{gamma0_from_curvature_ratio, moment_ratio};
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "wrinkling",
    group: Group::Body,
    formula: "M = π p_b R³ α(κ/κ_w), κ_w = p_b c/2, α from 0 over 1/2 (first wrinkle) to 1 (hinge)",
    sentence: "The wall wrinkles gradually: small bends meet less resistance than the full hinge moment.",
    differs: "Small bends come more easily than predicted; large ones hardly change.",
    remedy: "Bend the inflated body with a known tip force and measure its deflection.",
    validity: "tension-only membrane, circular section, regulated body pressure",
    reference: "Comer & Levy 1963",
    parameters: &[parameter("compliance_m_per_n", "c", "m/N", 1.0)
        .usual(1e-3, [0.0, 5e-3])
        .starts(&[2.3e-5, 1e-4, 4e-4, 1.5e-3])
        .by_actuator(&[("spam", 8e-4), ("epam", 1.8e-3), ("cpam", 2.4e-3), ("fpam", 9.5e-4)])
        .means("compliance 1/(E t) of the body fabric")],
    add: |values, assembly| {
        let c = values[0];
        if c == 0.0 {
            return;
        }
        for site in &mut assembly.sites {
            let r = site.radius_m;
            let law = LawTerm(BODY_PRESSURE, move |at: &Pose, force: &mut [f64]| {
                let kappa = at.q[0].abs();
                let thrust = PI * r * r * at.p_body_pa;
                let wrinkling = 0.5 * at.p_body_pa * c;
                let (moment, energy) = if kappa <= wrinkling {
                    let moment = PI * r.powi(3) / c * kappa;
                    (moment, 0.5 * moment * kappa)
                } else {
                    wrinkled(thrust, r, c, kappa, gamma0_from_curvature_ratio(kappa / wrinkling))
                };
                force[0] -= moment * at.q[0].signum();
                energy
            });
            site.body_pressure = BodyLaw::Replaced(Box::new(law));
        }
    },
    ..BALANCE
};

/// Moment and energy with a slack zone of half angle `gamma`.
fn wrinkled(thrust: f64, r: f64, c: f64, kappa: f64, gamma: f64) -> (f64, f64) {
    let (sin, cos) = gamma.sin_cos();
    let open = PI - gamma;
    let moment = thrust * r * moment_ratio(gamma);
    let strain = kappa * kappa * r.powi(3) / c * (open * (0.5 + cos * cos) + 1.5 * sin * cos);
    let energy = strain - thrust * kappa * r * cos + thrust * thrust * c / (4.0 * PI * r);
    (moment, energy)
}
