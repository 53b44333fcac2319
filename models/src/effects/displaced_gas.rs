//! Gas of the body that the actuator pushes aside: what bulges into the body fills against its pressure, not against the air.
//!
//! ```text
//! V_b = πR²L − πR³φ − χ V_a      E = χ p_b v per metre of body       v = 0 for P ≤ χ p_b
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | χ | body volume lost per actuator volume gained, beyond πR³ times the turn φ | – |
//! | p_b, P | gauge pressures of body and actuator | Pa |
//! | v | actuator volume per metre of body | m² |
//!
//! The actuator works as if its pressure were χ p_b lower, and below χ p_b it stays flat. At one body pressure this is
//! `pressure_offset` with P₀ = χ p_b. A pouch that bulges inwards as far as outwards has χ = ½; where sealed edges also draw
//! the wall in, χ is larger (finite elements at 2 kPa: 0.5 cPAM, 0.9 fPAM, 1.1 ePAM, 1.3 sPAM; `docs/robots.md`).
//! **Validity**: one χ for all pressures; a body that is kept at its pressure. Derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "displaced_gas",
    group: Group::Actuator,
    formula: "E = χ p_b v per metre; flat for P ≤ χ p_b",
    sentence: "The actuator bulges into the body and pushes its gas aside, so it works against the body's pressure and not against the air.",
    differs: "The bend comes late by a share of the body's pressure: the curve over pressure shifts with that of the body.",
    remedy: "Measure at another body pressure, or the volume of gas that leaves the body while the actuator fills.",
    validity: "one share for all pressures; at one body pressure not separable from pressure_offset",
    reference: "derived here",
    parameters: &[Parameter {
        key: "share",
        symbol: "χ",
        typical: 1.0,
        upper: 2.5,
        fitted: Fitted::WithBodyPressures,
        meaning: "body volume lost per actuator volume gained",
        ..PLAIN
    }],
    needs: Needs::Actuator,
    add,
    ..BALANCE
};

struct DisplacedGas {
    share: f64,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    for site in assembly.sites.iter_mut().filter(|site| site.actuator.is_some()) {
        site.inner_share = values[0];
        site.act(DisplacedGas { share: values[0] }, Besides { closes: values[0], ..Besides::default() });
    }
}

impl Term for DisplacedGas {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::BodyGas)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let pressure = self.share * at.p_body_pa;
        force[actuator_q::VOLUME] -= pressure;
        pressure * at.q[actuator_q::VOLUME]
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::Scenario;
    use crate::{Loads, Model};

    fn shipped(effect: &str) -> Model {
        let text = crate::shipped("cpam-textbook").unwrap_or_default();
        Model::new(&Scenario::parse(&format!("{text}\n{effect}")).unwrap())
    }

    #[test]
    fn it_is_an_offset_that_grows_with_the_bodys_pressure() {
        for body_pa in [1e3, 2e3, 4e3] {
            let share = shipped("[effects.displaced_gas]\nshare = 0.5\n");
            let offset = shipped(&format!("[effects.pressure_offset]\noffset_kpa = {}\n", 0.5e-3 * body_pa));
            for actuator_pa in [0.0, 0.9 * body_pa, 5e3, 30e3] {
                let loads = Loads::uniform(body_pa, actuator_pa);
                let [mut a, mut b] = [share.prediction(), offset.prediction()];
                share.predict(&loads, &mut a).unwrap();
                offset.predict(&loads, &mut b).unwrap();
                assert!((a.tip.y_m - b.tip.y_m).abs() < 1e-9, "{body_pa} {actuator_pa}: {} {}", a.tip.y_m, b.tip.y_m);
            }
        }
    }

    #[test]
    fn an_actuator_below_its_share_of_the_bodys_pressure_stays_flat() {
        let model = shipped("[effects.displaced_gas]\nshare = 0.9\n");
        let mut at = model.prediction();
        model.predict(&Loads::uniform(4e3, 3.5e3), &mut at).unwrap();
        assert!(at.tip.y_m.abs() < 1e-5, "{}", at.tip.y_m);
    }
}
