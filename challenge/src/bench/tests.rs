//! The bench itself: what it draws, and that it reports what fails.

use super::*;
use crate::HIDDEN;
use compare::diagnosis::Options;

#[test]
fn all_robots_and_all_effects_take_part_equally() {
    let plan = plan(&DiscoveryOptions { seed: 1, sets: 96, laws: Laws::First }).unwrap();
    let one: Vec<&PlannedSet> = plan.iter().filter(|case| case.part == Lot::Hidden(Hiding::One)).collect();
    assert_eq!(one.len(), 96);
    for effect in HIDDEN {
        let count = one.iter().filter(|case| case.truth.effects[0].name == effect.name).count();
        assert!((1..=8).contains(&count), "{}: {count}", effect.name);
    }
    for case in &plan {
        let sizes = if case.part == Lot::Clamp { 0.5..30.0 } else { 0.8..1.5 };
        let size = |c: &crate::truth::HiddenChoice| sizes.contains(&c.times_typical);
        assert!(case.truth.effects.iter().all(size), "{:?}", case.truth);
        let sigma = case.truth.camera_sd_m;
        assert!((0.5e-3..=2e-3).contains(&sigma) && [3, 5, 10].contains(&case.truth.runs));
    }
    let tested = plan.iter().filter(|case| case.part == Lot::Measured(Hiding::One));
    assert!(
        tested.map(|case| &case.truth).eq(one.iter().map(|case| &case.truth)),
        "the same robots, with a bending test"
    );
    let two = plan.iter().filter(|case| case.part == Lot::Hidden(Hiding::Two));
    assert!(two.clone().count() == 48 && two.clone().all(|c| c.truth.effects[0].name != c.truth.effects[1].name));
}

#[test]
fn the_second_laws_are_asked_of_the_same_robots_and_sizes() {
    let [first, second] =
        [Laws::First, Laws::Second].map(|laws| plan(&DiscoveryOptions { seed: 1, sets: 8, laws }).unwrap());
    for (a, b) in first.iter().zip(&second) {
        assert_eq!((a.truth.laws, b.truth.laws), (Laws::First, Laws::Second));
        assert_eq!(a.truth, Truth { laws: Laws::First, ..b.truth.clone() });
    }
}

#[test]
fn the_plan_follows_from_the_seed() {
    let truths = |seed: u64, sets: usize| -> Vec<Truth> {
        plan(&DiscoveryOptions { seed, sets, laws: Laws::First }).unwrap().into_iter().map(|case| case.truth).collect()
    };
    assert_eq!(truths(1, 8), truths(1, 8));
    assert_ne!(truths(1, 8), truths(2, 8));
    assert_eq!(truths(1, 8)[..8], truths(1, 80)[..8], "more sets add to the same ones");
}

#[test]
fn a_diagnosis_that_fails_is_counted_and_named() {
    let refuse: Diagnoser = |_, _, _, _| Err(CompareError::NoModel);
    let bench = PlannedBench::plan(DiscoveryOptions { seed: 1, sets: WHOLE, laws: Laws::First }).unwrap();
    let sets = plan(&bench.options).unwrap().len();
    let answers: Vec<PieceAnswer> = (0..bench.pieces.len()).map(|piece| bench.answer(piece, refuse)).collect();
    assert_eq!(
        answers.len(),
        sets + made::MADE.len() + slipped::count(WHOLE) + surplus::count(WHOLE) + faults::count(WHOLE)
    );
    let told = bench.table(answers.clone());
    assert_eq!(told.failed.len(), answers.len());
    assert!(told.failed.iter().all(|why| why.contains("no model is given")) && told.seen.len() == sets);
    assert!(
        told.rows.iter().all(|row| row.measured.is_none())
            && told.made.is_empty()
            && told.slipped.is_empty()
            && told.surplus.is_empty()
            && told.faults.is_empty()
    );
}

/// Keys name files: two pieces with one key would have one answer.
#[test]
fn every_piece_has_a_key_of_its_own() {
    let keys =
        |seed: u64| PlannedBench::plan(DiscoveryOptions { seed, sets: WHOLE, laws: Laws::First }).unwrap().keys();
    let (mut one, other) = (keys(1), keys(2));
    let made = one.iter().filter(|key| other.contains(key)).count();
    assert_eq!(made, made::MADE.len(), "only the finite element data know no seed");
    let all = one.len();
    one.sort();
    one.dedup();
    assert_eq!(one.len(), all);
}

/// A mechanism that does nothing in a robot is no question; every other is asked with B kept and fitted.
#[test]
fn every_mechanism_of_a_finite_element_robot_is_switched_off_in_turn() {
    let quiet: Diagnoser = |scenario, evidence, options, progress| {
        let sure = Options { tolerance_m: Some(0.0), pairs: false, ..options.clone() };
        compare::diagnosis::diagnose(scenario, evidence, &sure, progress)
    };
    let made = made::made("epam", quiet).unwrap();
    let asked = |robot: &str, lacking: &str| made.iter().filter(|m| m.robot == robot && m.lacking == lacking).count();
    assert_eq!(asked("epam", "gussets"), 0, "without folds");
    assert!(made.iter().any(|m| m.bodies == 1 && m.matters));
    let sealed = made.iter().find(|m| m.robot == "epam" && m.lacking == "sealed_sides" && m.kept).unwrap();
    let mut named = sealed.stated.iter().chain(&sealed.attempted).flat_map(|entry| entry.split(" + "));
    assert!(sealed.does_mm > 5.0 && (sealed.by_design || named.any(|name| name == "sealed_sides")), "{sealed:?}");
}

/// Loads and shape come together by a fiftieth of their gap a round here, and need more than 400 rounds at 10 kPa.
#[test]
fn a_robot_whose_loads_and_shape_agree_slowly_is_no_failure() {
    let truth = cases::draw(Lot::Hidden(Hiding::One), 4, (1 << 32) + 154, 154).unwrap();
    let found = cases::named(&PlannedSet { part: Lot::Hidden(Hiding::One), truth }, compare::diagnosis::diagnose);
    assert!(found.is_ok(), "{found:?}");
}
