//! From the set pressure to the pressure in the actuator: the supply stage of a scenario alone.

use crate::assembly::{Assembly, Moment, SupplyLaw};
use crate::effects::{Stage, by_name};
use crate::scenario::Scenario;

/// The supply laws of a scenario, in order.
pub struct Supply {
    laws: Vec<SupplyLaw>,
}

impl Supply {
    /// Of the effects that are switched on.
    pub fn of(scenario: &Scenario) -> Supply {
        let mut assembly = Assembly::empty(scenario.gravity_direction);
        for chosen in scenario.effects.iter() {
            if let Some(effect) = by_name(&chosen.name).filter(|effect| effect.stage == Stage::Supply) {
                (effect.add)(&chosen.values, &mut assembly);
            }
        }
        Supply { laws: assembly.supply }
    }

    /// Pressure in the actuator \[Pa\] when `set_pa` is set, at a moment.
    ///
    /// ```
    /// let robot = models::Scenario::parse(models::shipped("epam-textbook").unwrap()).unwrap();
    /// let lossy = models::Supply::of(&robot.with_effect("pressure_loss", &[0.1, 1.0]));
    /// assert!((lossy.pressure(30e3, &Default::default()) - 27e3).abs() < 1e-9);
    /// ```
    pub fn pressure(&self, set_pa: f64, at: &Moment) -> f64 {
        self.laws.iter().fold(set_pa, |p, law| law(p, at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A leak through a hole: twice the pressure loses √2 times as much; a pressure that is lost altogether is none.
    #[test]
    fn a_loss_with_an_exponent_is_its_share_at_20_kpa_and_never_more_than_there_is() {
        let robot = Scenario::parse(crate::shipped("epam-textbook").unwrap()).unwrap();
        let lost = |n: f64, pa: f64| {
            pa - Supply::of(&robot.with_effect("pressure_loss", &[0.1, n])).pressure(pa, &Moment::default())
        };
        for n in [0.5, 0.75, 1.0, 2.0] {
            assert!((lost(n, 20e3) - 2e3).abs() < 1e-9, "{n}");
            assert!((lost(n, 40e3) / lost(n, 20e3) - 2f64.powf(n)).abs() < 1e-12, "{n}");
        }
        assert_eq!(lost(0.5, 100.0), 100.0);
        assert_eq!(lost(0.5, 0.0), 0.0);
    }
}
