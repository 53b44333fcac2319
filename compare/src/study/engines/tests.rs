//! Both engines on runs that are the reduced model itself.

use super::*;
use crate::study::published::textbook_scenario;

/// A run that is the reduced model itself, but for one term.
fn run(extra: usize, mj: f64) -> (Scenario, EngineRun, EnginePair) {
    let scenario = textbook_scenario("epam").unwrap().with_bending(0.4);
    let model = Model::new(&scenario);
    let mut at = model.prediction();
    let loads = Loads::uniform(2e3, 20e3);
    model.predict(&loads, &mut at).unwrap();
    let [gas, body, bending, ..] = reduced_ledger(&model, &loads, &at, 1.0);
    let mut energies_mj = [0.0, bending, 0.0, 0.0, 0.0];
    energies_mj[extra] += mj;
    let filled = EngineState { body_cm3: 1800.0, ..EngineState::default() };
    let state = EngineState {
        actuator_kpa: 20.0,
        tip_mm: at.tip.y_m * 1e3,
        turn_rad: at.tip.angle_rad,
        body_cm3: 1800.0 - body / 2.0,
        actuator_cm3: -gas / 20.0,
        energies_mj,
        ..filled.clone()
    };
    let run = EngineRun {
        actuator: "epam".into(),
        scenario: scenario.name.clone(),
        mesh_mm: [4.0; 2],
        body_kpa: 2.0,
        radius_mm: 40.0,
        width_mm: 60.0,
        pouch_mm: 60.0,
        count: 6,
        known: "assumed".into(),
        states: vec![filled, state],
        ..EngineRun::default()
    };
    let pair = pairs(&scenario, &run).unwrap().remove(0);
    (scenario, run, pair)
}

#[test]
fn a_run_that_is_the_reduced_model_has_no_excess_and_nothing_that_carries_a_difference() {
    let (_, _, pair) = run(0, 0.0);
    let largest = pair.reduced_mj.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    assert!(pair.excess_mj.unwrap().iter().all(|e| e.abs() < 1e-4 * largest), "{pair:?}");
    assert!(pair.difference().unwrap().abs() < 1e-9 && pair.carrier().is_none());
}

#[test]
fn the_term_that_holds_more_energy_at_the_same_bend_carries_the_difference() {
    for (place, term) in [(0, "stretch"), (1, "wall bending"), (2, "contact"), (3, "hourglass")] {
        let (_, _, pair) = run(place, 50.0);
        // The reduced tip is put 20 % above.
        let apart = EnginePair { reduced_mm: [0.0, 1.2 * pair.fe_mm[1]], ..pair };
        assert_eq!(apart.carrier(), Some(term));
    }
}

#[test]
fn between_two_pressures_a_run_that_is_the_reduced_model_has_its_ledger_and_filling_is_in_neither() {
    let plain = textbook_scenario("epam").unwrap();
    let scenario = plain.with_effect("end_constraint", &[0.4, 1.0]);
    let model = Model::new(&scenario);
    let mut at = model.prediction();
    let (_, mut run, _) = run(0, 0.0);
    let filling_cm3 = 77.0;
    let states = [10.0, 20.0, 30.0].map(|kpa| {
        let loads = Loads::uniform(2e3, kpa * 1e3);
        model.predict(&loads, &mut at).unwrap();
        let [gas, body, bending, ..] = reduced_ledger(&model, &loads, &at, 1.0);
        let energies_mj = [0.0, bending, 0.0, 0.0, 0.0];
        let [body_cm3, actuator_cm3] = [1800.0 - body / 2.0, filling_cm3 - gas / kpa];
        EngineState {
            actuator_kpa: kpa,
            turn_rad: at.tip.angle_rad,
            body_cm3,
            actuator_cm3,
            energies_mj,
            ..run.states[0].clone()
        }
    });
    run.states.truncate(1);
    run.states.extend(states);
    let apart = |scenario: &Scenario| {
        let [fe, own] = between(scenario, &run, 30.0).unwrap();
        (0..6).map(|k| (fe[k] - own[k]).abs()).sum::<f64>() / fe[0].abs()
    };
    assert!(apart(&scenario) < 1e-4, "{}", apart(&scenario));
    assert!(apart(&plain) > 0.1, "{}", apart(&plain));
    assert!(between(&scenario, &run, 15.0).is_none() && between(&scenario, &run, 10.0).is_none());
}

#[test]
fn an_ensemble_is_of_the_finest_mesh_and_of_runs_with_what_is_recommended() {
    let (scenario, run, _) = run(0, 0.0);
    let of = |seed: u64, mesh: f64, tip_mm: f64| {
        let mut run = EngineRun { seed, mesh_mm: [mesh; 2], ..run.clone() };
        run.states[1].actuator_kpa = 30.0;
        run.states[1].tip_mm = tip_mm;
        run
    };
    let runs = [of(2, 4.0, 13.0), of(1, 4.0, 11.0), of(1, 6.0, 99.0)];
    let own = ensemble(&runs, &scenario);
    let [_, (mean, spread)] = own.at(30.0).unwrap();
    assert!(mean == 12.0 && (spread.unwrap() - 2.0_f64.sqrt()).abs() < 1e-12);
    assert!(own.at(10.0).is_none());
}

#[test]
fn stored_runs_can_be_read_and_are_of_shipped_robots() {
    let runs = stored().unwrap();
    assert!(!runs.is_empty());
    for run in &runs {
        let scenario = textbook_scenario(&run.actuator).unwrap();
        assert_eq!(run.scenario, scenario.name);
        assert!(run.states.len() > 1 && run.states[0].actuator_kpa == 0.0);
    }
}
