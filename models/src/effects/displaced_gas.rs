//! Gas of the body that the actuator pushes aside: what bulges into the body fills against its pressure, not against the air.
//!
//! ```text
//! V_b = πR²L − πR³φ − χ V_a      v: actuator volume per metre of body
//! ```
//!
//! The actuator works as if its pressure were χ p_b lower, and below χ p_b it stays flat. At one body pressure this is
//! `pressure_offset` with P₀ = χ p_b. A pouch that bulges inwards as far as outwards has χ = ½; where sealed edges also draw
//! the wall in, χ is larger (finite elements at 2 kPa: 0.5 cPAM, 0.9 fPAM, 1.1 ePAM, 1.3 sPAM; `docs/robots.md`). The body is kept at its
//! pressure.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "displaced_gas",
    formula: "E = χ p_b v per metre; flat for P ≤ χ p_b",
    sentence: "The actuator bulges into the body and pushes its gas aside, so it works against the body's pressure and not against the air.",
    differs: "The bend comes late by a share of the body's pressure: the curve over pressure shifts with the body's pressure.",
    remedy: "Measure at another body pressure, or the volume of gas that leaves the body while the actuator fills.",
    validity: "one share for all pressures; at one body pressure not separable from pressure_offset",
    reference: "derived here",
    parameters: &[parameter("share", "χ", "-", 1.0)
        .usual(1.0, [0.0, 2.5])
        .fitted(Fitted::WithBodyPressures)
        .means("body volume lost per actuator volume gained")],
    needs: Needs::Actuator,
    add: |values, assembly| {
        let share = values[0];
        for site in assembly.sites.iter_mut().filter(|site| site.actuator.is_some()) {
            site.inner_share = share;
            let law = ENTRY.law(Account::BodyGas, move |at, force| {
                let pressure = share * at.p_body_pa;
                force[actuator_q::VOLUME] -= pressure;
                pressure * at.q[actuator_q::VOLUME]
            });
            site.act(*law, SideEffects { closes: share, ..SideEffects::default() });
        }
    },
    ..BALANCE
};
