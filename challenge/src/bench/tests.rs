//! The bench itself: what it draws, and that it reports what fails.

use super::*;
use crate::HIDDEN;

#[test]
fn all_robots_and_all_effects_take_part_equally() {
    let plan = plan(&DiscoveryOptions { seed: 1, sets: 96 }).unwrap();
    let one: Vec<&PlannedSet> = plan.iter().filter(|case| case.part == Lot::Hidden(Hiding::One)).collect();
    assert_eq!(one.len(), 96);
    for effect in HIDDEN {
        let count = one.iter().filter(|case| case.truth.effects[0].name == effect.name).count();
        assert!((1..=8).contains(&count), "{}: {count}", effect.name);
    }
    for case in &plan {
        let size = |c: &crate::truth::HiddenChoice| (0.8..1.5).contains(&c.times_typical);
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
fn the_plan_follows_from_the_seed() {
    let truths = |seed: u64, sets: usize| -> Vec<Truth> {
        plan(&DiscoveryOptions { seed, sets }).unwrap().into_iter().map(|case| case.truth).collect()
    };
    assert_eq!(truths(1, 8), truths(1, 8));
    assert_ne!(truths(1, 8), truths(2, 8));
    assert_eq!(truths(1, 8)[..8], truths(1, 80)[..8], "more sets add to the same ones");
}

#[test]
fn a_diagnosis_that_fails_is_counted_and_named() {
    let refuse: Diagnoser = |_, _, _, _| Err(CompareError::NoModel);
    let bench = run(&DiscoveryOptions { seed: 1, sets: 2 }, refuse, &|_| ()).unwrap();
    assert_eq!(bench.failed.len(), 14 + LACKING.len());
    assert!(bench.failed[0].contains("no model is given") && bench.rows.iter().all(|row| row.measured.is_none()));
}

#[test]
fn the_finite_element_sets_are_diagnosed_and_what_is_named_lowers_the_held_out_error() {
    let mut failed = Vec::new();
    let made = made::made(compare::diagnosis::diagnose, &mut failed);
    assert!(failed.is_empty(), "{failed:?}");
    assert_eq!(made.iter().map(|m| m.robot).collect::<Vec<_>>(), ["spam", "cpam", "epam", "fpam"]);
    assert!(made[0].in_set && made[0].halved_as_stated(), "{:?}", made[0]);
    // Attempts count, which are said not to be enough.
    let halved: Vec<_> = made.iter().filter(|m| m.halved()).map(|m| m.robot).collect();
    assert_eq!(halved, ["spam", "epam"], "{made:?}");
    assert!(made.iter().all(|m| m.after_mm < m.before_mm), "{made:?}");
    assert!(made.iter().all(|m| m.before_mm.is_some_and(|mm| mm > 1.0)), "the bare model is wrong: {made:?}");
}

/// Loads and shape come together by a fiftieth of their gap a round here, and need more than 400 rounds at 10 kPa.
#[test]
fn a_robot_whose_loads_and_shape_agree_slowly_is_no_failure() {
    let truth = cases::draw(Lot::Hidden(Hiding::One), 4, (1 << 32) + 154, 154).unwrap();
    let found = cases::outcome(&PlannedSet { part: Lot::Hidden(Hiding::One), truth }, compare::diagnosis::diagnose);
    assert!(found.failed.is_none(), "{:?}", found.failed);
    assert!(found.named.unwrap().after.is_some());
}
