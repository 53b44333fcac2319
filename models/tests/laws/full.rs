//! The shipped robots as they are, with all that their textbook models lack.

use crate::solver::sweep;
use crate::stationary::imbalance;
use crate::support::*;
use models::{Loads, Model, Scenario, Target};

fn all() -> impl Iterator<Item = (&'static str, Scenario)> {
    actuators().map(|actuator| (actuator, full(actuator)))
}

#[test]
fn they_find_their_equilibrium_at_every_pressure_that_an_inverse_may_ask_for() {
    for (actuator, robot) in all() {
        for scenario in [robot.clone(), robot.with_bending(0.5)] {
            let model = Model::new(&scenario);
            for p_body in [500.0, 1e3, 2e3, 4e3, 8e3] {
                for i in 0..=200 {
                    let loads = Loads::uniform(p_body, 500.0 * f64::from(i));
                    let tip = predicted(&model, &loads).unwrap_or_else(|e| panic!("{actuator}: {e}")).tip;
                    assert!(tip.y_m.is_finite() && tip.y_m >= 0.0, "{actuator} {loads:?}: {tip:?}");
                }
            }
        }
    }
}

#[test]
fn their_potential_is_stationary() {
    for (actuator, robot) in all() {
        for (p_body, p_act) in [(1e3, 20e3), (2e3, 5e3), (2e3, 30e3), (4e3, 20e3), (8e3, 30e3)] {
            for scenario in [robot.clone(), robot.with_bending(0.5).with_effect("tip_load", &[0.1, -0.2])] {
                let error = imbalance(&scenario, Loads::uniform(p_body, p_act));
                assert!(error < 1e-6, "{actuator} at {p_body} {p_act}: {error:e}");
            }
        }
    }
}

/// The table of starts is that of the scenario's body pressure and of the largest actuator pressure; the answer knows neither.
#[test]
fn the_table_of_starts_changes_no_answer() {
    for (actuator, robot) in all() {
        let of = |p_body_pa: f64, p_max_pa: f64| Model::new(&Scenario { p_body_pa, p_max_pa, ..robot.clone() });
        let models = [of(robot.p_body_pa, robot.p_max_pa), of(3.3e3, robot.p_max_pa), of(1e3, 40e3)];
        for i in 1..=200 {
            for p_body in [1e3, 2e3, 4e3] {
                let loads = Loads::uniform(p_body, 300.0 * f64::from(i));
                let angle = |model: &Model| predicted(model, &loads).unwrap().tip.angle_rad;
                let [own, others @ ..] = models.each_ref().map(angle);
                assert!(others.iter().all(|a| (a - own).abs() < 1e-11), "{actuator} {loads:?}: {own} {others:?}");
            }
        }
    }
}

#[test]
fn a_pouch_that_has_opened_bends_more_with_every_pressure_and_the_inverse_returns_it() {
    for actuator in ["spam", "cpam", "epam"] {
        let model = Model::new(&full(actuator));
        let (mut out, mut before) = (model.prediction(), 0.0);
        for i in 1..=100 {
            let p = 1e3 * f64::from(i);
            let tip = predicted(&model, &Loads::uniform(2e3, p)).unwrap().tip;
            assert!(tip.angle_rad > before || (tip.angle_rad == 0.0 && p < 4e3), "{actuator} at {p}: {tip:?}");
            before = tip.angle_rad;
            if p >= 4e3 {
                let found = model.pressure_for(Target::Angle(tip.angle_rad), 2e3, &mut out).unwrap();
                assert!((found / p - 1.0).abs() < 1e-6, "{actuator} at {p}: {found}");
            }
        }
    }
}

/// Where the body resists nothing a sealed pouch contracts by 23.8 % (30.6 % if twice as wide as long) and holds 0.201 W L²; one
/// with free sides contracts by 36.3 %.
#[test]
fn without_a_body_they_contract_as_sealed_and_as_free_pouches_do() {
    for (actuator, width_m, known) in [("epam", 0.06, 0.2377), ("epam", 0.12, 0.3060), ("cpam", 0.06, 0.363)] {
        let mut scenario =
            robot(actuator).bare().with_effect("sealed_sides", &[1.0]).with_effect("displaced_gas", &[0.5]);
        scenario.actuator.shape.width_m = width_m;
        let model = Model::new(&scenario);
        let (loads, body) = (Loads::uniform(1e-3, 50e3), scenario.length_m);
        let at = predicted(&model, &loads).unwrap();
        let theta = model.states(&at)[0].coordinate;
        assert!((1.0 - theta.sin() / theta - known).abs() < 6e-4, "{actuator} {width_m}: {theta}");
        if actuator == "epam" && width_m == 0.06 {
            let gas: f64 =
                model.ledger(&loads, &at).iter().map(|line| line.energy_j).sum::<f64>() / -loads.actuator_pa[0];
            let per_pouch = gas * 0.06 / body / (width_m * 0.06_f64.powi(2));
            assert!((per_pouch - 0.2008).abs() < 5e-4, "{per_pouch} W L²");
        }
    }
}

#[test]
fn every_effect_beside_them_converges() {
    for actuator in actuators() {
        let base = full(actuator).with_bending(0.8);
        for effect in applicable(&base).filter(|e| !base.effects.iter().any(|own| own.name == e.name)) {
            let refused = sweep(effect.name, &base.with_effect(effect.name, &effect.typical()));
            let may_refuse = ["gravity", "tip_load", "tail_tension", "initial_curvature", "yarn_stretch"];
            assert!(refused == 0 || may_refuse.contains(&effect.name), "{actuator} {}: {refused} refused", effect.name);
        }
    }
}
