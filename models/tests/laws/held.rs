//! A robot held in a shape: nothing is missing at the model's own equilibrium, and what a richer robot has is missing at its shape.

use crate::support::*;
use models::effects::EFFECTS;
use models::{Loads, Model, Scenario, Step};

fn robots() -> Vec<(&'static str, Scenario)> {
    actuators().map(|name| (name, robot(name).with_bending(1.0))).collect()
}

/// Two pressures up, one down; each looked at twice.
fn steps() -> Vec<Step> {
    let holds = [(10e3, 0.0), (10e3, 2.0), (25e3, 3.0), (25e3, 5.0), (10e3, 6.0), (10e3, 8.0)];
    holds.map(|(p, t_s)| Step { t_s, loads: Loads::uniform(2e3, p) }).to_vec()
}

/// Curvature of every piece in every step.
fn shapes(model: &Model) -> Option<Vec<Vec<f64>>> {
    let mut shapes = Vec::new();
    let mut keep = |_: usize, at: &models::Prediction| {
        shapes.push(model.states(at).iter().map(|s| s.curvature).collect());
    };
    model.follow(&steps(), &mut model.prediction(), &mut keep).ok()?;
    Some(shapes)
}

/// Missing moment of every piece in every step.
fn missing(model: &Model, steps: &[Step], shapes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut all = Vec::new();
    let keep = &mut |_: usize, at: &models::Prediction| all.push(at.missing_moments().to_vec());
    model.hold(steps, shapes, &mut model.prediction(), keep).unwrap();
    all
}

/// Cut alike, whatever the effects, so that shapes of one are shapes of the other.
fn in_pieces(scenario: &Scenario) -> Model {
    Model::in_pieces(scenario, &[0.06, 0.12, 0.18, 0.24, 0.30])
}

#[test]
fn at_its_own_equilibrium_no_model_misses_anything() {
    for (kind, plain) in robots() {
        for effect in EFFECTS.iter().filter(|e| e.applies_to(plain.actuator.kind.family)) {
            let model = in_pieces(&plain.with_effect(effect.name, &effect.typical()));
            let Some(shapes) = shapes(&model) else { panic!("{kind} {} has no equilibrium", effect.name) };
            for (step, row) in missing(&model, &steps(), &shapes).iter().enumerate() {
                for (piece, m) in row.iter().enumerate().filter(|(i, _)| model.is_active(*i)) {
                    // What creeps was elsewhere between two looks, and only the looks are held.
                    let enough = if effect.name == "creep" { 5e-3 } else { 2e-6 };
                    assert!(m.abs() < enough, "{kind} {} step {step} piece {piece}: {m:e} N m", effect.name);
                }
            }
        }
    }
}

#[test]
fn a_constant_a_spring_and_a_share_of_the_pull_come_back() {
    for (kind, plain) in robots() {
        let base = in_pieces(&plain);
        let from = |rich: &Scenario| missing(&base, &steps(), &shapes(&in_pieces(rich)).unwrap());
        let each = |rich: &Scenario, law: &dyn Fn(f64, usize) -> f64| {
            let bent = shapes(&in_pieces(rich)).unwrap();
            for (step, (row, shape)) in from(rich).iter().zip(&bent).enumerate() {
                for (m, kappa) in row.iter().zip(shape) {
                    let truth = law(*kappa, step);
                    assert!((m - truth).abs() < 2e-6, "{kind} step {step}, {kappa} 1/m: {m} and not {truth} N m");
                }
            }
        };
        each(&plain.with_effect("tail_tension", &[0.2]), &|kappa, _| -0.2 * (kappa / 0.05).tanh());
        each(&plain.with_bending(plain.bending_stiffness + 0.3), &|kappa, _| -0.3 * kappa);
        // Of less pressure the same share of the pull is missing: that of the bare model at this bend and pressure.
        let bent = shapes(&in_pieces(&plain.with_effect("pressure_loss", &[0.1, 1.0]))).unwrap();
        let slack = steps().into_iter().map(|s| Step { loads: Loads::uniform(2e3, 0.0), ..s }).collect::<Vec<_>>();
        let rows = missing(&base, &steps(), &bent).into_iter().zip(missing(&base, &slack, &bent));
        for (full, slack) in rows {
            let pull = slack[0] - full[0];
            assert!((full[0] + 0.1 * pull).abs() < 2e-6, "{kind}: {} of {pull}", full[0]);
        }
    }
}

#[test]
fn a_bend_that_the_actuator_cannot_have_has_no_moment() {
    let (_, plain) = robots().remove(0);
    let model = in_pieces(&plain);
    for kappa in [-0.1, 0.0, 50.0, f64::NAN] {
        let shapes = vec![vec![kappa; model.segments().len()]; steps().len()];
        assert!(missing(&model, &steps(), &shapes)[0][0].is_nan(), "{kappa}");
    }
}
