//! The shipped muscle as it is: in the wall, with yarns that give, a glued face and flat ends.

use crate::support::*;
use models::{Loads, Model, Scenario, shipped};

fn muscle() -> Scenario {
    Scenario::parse(shipped("fpam").unwrap()).unwrap()
}

#[test]
fn it_finds_its_equilibrium_at_every_pressure_that_an_inverse_may_ask_for() {
    for scenario in [muscle(), muscle().with_bending(0.5)] {
        let model = Model::new(&scenario);
        for p_body in [500.0, 1e3, 2e3, 4e3, 8e3] {
            for i in 0..=200 {
                let loads = Loads::uniform(p_body, 500.0 * f64::from(i));
                let tip = predicted(&model, &loads).unwrap_or_else(|e| panic!("{e}")).tip;
                assert!(tip.y_m.is_finite() && tip.y_m >= 0.0, "{loads:?}: {tip:?}");
            }
        }
    }
}

#[test]
fn its_potential_is_stationary() {
    for (p_body_pa, p_act_pa) in [(2e3, 5e3), (2e3, 30e3), (4e3, 20e3), (8e3, 30e3)] {
        let (model, loads) = (Model::new(&muscle()), Loads::uniform(p_body_pa, p_act_pa));
        let at = predicted(&model, &loads).unwrap();
        let potential = Potential { assembly: model.assembly(), loads };
        let a = model.states(&at)[0].coordinate;
        let of = |a: f64| potential.of_segment(0, a, potential.geometric(0, a).0);
        let scale = std::f64::consts::PI * p_body_pa * 0.04_f64.powi(3) / 0.0683;
        let left = slope(of, a, 1e-3 * a) / scale;
        assert!(left.abs() < 1e-6, "{p_body_pa} {p_act_pa}: {left:e}");
    }
}
