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
    let mut energies_mj = [0.0, 0.0, bending, 0.0, 0.0, 0.0];
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
    let pair = pairs(&scenario, &run, &[]).unwrap().remove(0);
    (scenario, run, pair)
}

#[test]
fn a_run_that_is_the_reduced_model_has_no_excess_and_nothing_that_carries_a_difference() {
    let (_, _, pair) = run(0, 0.0);
    let largest = pair.reduced_mj.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    assert!(pair.excess_mj.unwrap().iter().all(|e| e.abs() < 1e-4 * largest), "{pair:?}");
    assert!(pair.difference().unwrap().abs() < 1e-9 && pair.carrier.is_none());
}

/// The finite elements reach 100 mm where the reduced model says 120; with a tenth of a term they reach so much.
fn carried(scenario: &Scenario, without_mm: [f64; 2]) -> Option<Carrier> {
    let (_, run, pair) = run(0, 0.0);
    let pair = EnginePair { fe_mm: [0.0, pair.reduced_mm[1] / 1.2], ..pair };
    let with_cut = |(cut, share): (&ReducedTerm, f64)| {
        let mut other = EngineRun { cut: cut.term.into(), ..run.clone() };
        other.states[1].tip_mm = share * pair.fe_mm[1];
        other
    };
    let all: Vec<EngineRun> = CUTS.iter().zip(without_mm).map(with_cut).collect();
    carrier(scenario, &run, &pair, &all).unwrap()
}

#[test]
fn the_term_whose_cut_in_both_engines_makes_them_meet_carries_the_difference() {
    let bare = textbook_scenario("epam").unwrap();
    let tip_mm = |scenario: &Scenario| {
        let model = Model::new(scenario);
        let mut at = model.prediction();
        model.predict(&Loads::uniform(2e3, 20e3), &mut at).unwrap();
        at.tip.y_m * 1e3
    };
    let stiff = bare.with_bending(0.4);
    // Without its B the model reaches farther; with sheets cut it stays, and the finite elements come up to it.
    let soft = 1.2 * tip_mm(&bare) / tip_mm(&stiff);
    let found = carried(&stiff, [soft, 1.0]).unwrap();
    assert!(found.term == "wall bending" && found.difference_without.abs() < 1e-12, "{found:?}");
    let found = carried(&stiff, [1.0, 1.2]).unwrap();
    assert!(found.term == "compressed sheets" && found.difference_without.abs() < 1e-12, "{found:?}");
    assert_eq!(carried(&stiff, [soft / 1.4, 1.05]), None);
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
        let energies_mj = [0.0, 0.0, bending, 0.0, 0.0, 0.0];
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
        (0..TERMS.len()).map(|k| (fe[k] - own[k]).abs()).sum::<f64>() / fe[0].abs()
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
