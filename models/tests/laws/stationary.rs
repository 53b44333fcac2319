//! At a predicted equilibrium the total potential of the robot is stationary: nothing is lost between terms, linkage,
//! fabric stretch and shape.

use crate::support::*;
use models::effects::Stage;
use models::site::SiteState;
use models::{Loads, Model, Scenario};

/// Largest |∂Π/∂q|·q relative to the work of the body moment, over all free coordinates.
pub(crate) fn imbalance(scenario: &Scenario, loads: Loads) -> f64 {
    let model = Model::new(scenario);
    let state = predicted(&model, &loads).unwrap_or_else(|e| panic!("{e}"));
    let potential = Potential { assembly: model.assembly(), loads };
    let states = model.states(&state);
    let kappas: Vec<f64> = states.iter().map(|s| s.curvature).collect();
    (0..states.len()).map(|i| of_segment(&potential, states, &kappas, i)).fold(0.0, f64::max)
}

fn of_segment(potential: &Potential, states: &[SiteState], kappas: &[f64], i: usize) -> f64 {
    let h = potential.assembly.segments[i].length_m;
    let (site, state) = (potential.site(i), &states[i]);
    let total = |a: f64, kappa: f64| {
        let mut moved = kappas.to_vec();
        moved[i] = kappa;
        potential.of_segment(i, a, kappa) * h + potential.of_nodes(&moved)
    };
    let scale = std::f64::consts::PI * potential.loads.body_pa * site.radius_m.powi(3) * h;
    // The moment has corners (first wrinkle, contact, set at κ = 0): the best of four steps keeps away from them.
    let best = |f: &dyn Fn(f64) -> f64, x: f64, h: f64| {
        [h, 0.1 * h, 0.01 * h, 0.001 * h].map(|h| slope(f, x, h).abs()).into_iter().fold(f64::INFINITY, f64::min)
    };
    let by_curvature = |a: f64| best(&|k| total(a, k), state.curvature, 1e-3) / scale;
    if !potential.is_active(i) {
        return by_curvature(0.0);
    }
    let step = 1e-3 * state.coordinate;
    if site.linkage.compliance_per_n == 0.0 {
        let d_curvature = slope(|a| potential.geometric(i, a).0, state.coordinate, step);
        return best(&|a| total(a, potential.geometric(i, a).0), state.coordinate, step) / (d_curvature * scale);
    }
    let by_coordinate = best(&|a| total(a, state.curvature), state.coordinate, step) * state.coordinate;
    by_curvature(state.coordinate).max(by_coordinate / (state.curvature.abs() * scale))
}

fn hold(name: &str, scenario: &Scenario) {
    for (p_body, p_act) in [(2e3, 5e3), (2e3, 30e3), (8e3, 30e3), (1e3, 80e3), (2e3, 1e3)] {
        let error = imbalance(scenario, Loads::uniform(p_body, p_act));
        assert!(error < 2e-7, "{} {name} at {p_body} {p_act}: {error:e}", scenario.name);
    }
}

#[test]
fn the_bare_model_is_in_equilibrium() {
    for actuator in actuators() {
        hold("bare", &robot(actuator).bare());
        hold("with B", &robot(actuator).bare().with_bending(1.35));
    }
}

#[test]
fn every_effect_alone_leaves_the_virtual_work_in_balance() {
    for actuator in actuators() {
        for effect in applicable(&robot(actuator)).filter(|e| e.stage == Stage::Balance) {
            let scenario = robot(actuator).bare().with_bending(0.7);
            hold(effect.name, &scenario.with_effect(effect.name, &effect.typical()));
            hold(effect.name, &scenario.with_effect(effect.name, &values(effect, |p| 0.7 * p.typical + 0.3 * p.upper)));
        }
    }
}

#[test]
fn all_effects_together_leave_the_virtual_work_in_balance() {
    for actuator in actuators() {
        hold("everything", &everything(actuator));
    }
}

#[test]
fn transverse_loads_are_balanced_in_any_direction_and_on_a_passive_stretch() {
    for actuator in actuators() {
        for force in [[0.3, 0.2], [-0.3, -0.2], [0.0, -0.6], [0.5, 0.0]] {
            let scenario = robot(actuator).with_bending(0.5).with_effect("tip_load", &force);
            hold("tip load", &scenario);
            hold("tip load and gravity", &scenario.with_effect("gravity", &[1.5]));
            let error = imbalance(&scenario, Loads::uniform(2e3, 0.0));
            assert!(error < 2e-7, "{actuator} without pressure: {error:e}");
        }
    }
}

#[test]
fn the_ledger_holds_the_same_potential() {
    // What stretches of fabric, folds and weight store is in the ledger: its sum changes with pressure as −ΔV dP.
    // A muscle's cell has part of the pressure's work in its own line; `muscle_tests.rs` closes its books.
    for actuator in actuators() {
        let model = Model::new(&without_cell(&everything(actuator)));
        let ledger = |p: f64| {
            let loads = Loads::uniform(2e3, p);
            model.ledger(&loads, &predicted(&model, &loads).unwrap())
        };
        let total = |p: f64| ledger(p).iter().map(|line| line.energy_j).sum::<f64>();
        let p = 20e3;
        let work = ledger(p).iter().find(|line| line.name == "actuator_pressure").unwrap().energy_j;
        let by_pressure = slope(total, p, 20.0);
        assert!((by_pressure / (work / p) - 1.0).abs() < 1e-7, "{actuator}: {by_pressure:e} {:e}", work / p);
    }
}
