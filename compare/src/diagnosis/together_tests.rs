//! Laws of a diagnosis of several data at once. Data by the catalogue's own formulas, seeded.

use super::tests::{measured, quick, robot, run};
use super::*;

fn about(direct: Direct) -> About {
    About { direct, ..crate::study::tests::about(&[]) }
}

const GAUGE: Direct = Direct { pressure: true, frame: false };

fn together(scenario: &Scenario, data: &[(&Dataset, Direct)]) -> Result<Diagnosis, CompareError> {
    let abouts: Vec<About> = data.iter().map(|(_, direct)| about(*direct)).collect();
    let parts: Vec<Measured> =
        data.iter().zip(&abouts).map(|((dataset, _), about)| Measured { dataset, about: Some(about) }).collect();
    diagnose_together(scenario, parts[0], &parts[1..], &quick())
}

fn group_of(d: &Diagnosis, name: &str) -> Group {
    d.ranked.iter().find(|r| r.effect == name).unwrap().group
}

#[test]
fn a_gauge_tells_supply_from_physics_either_way() {
    let plain = robot("epam");
    let offset = candidates(&plain).into_iter().find(|c| c.name == "pressure_offset").unwrap();
    let off = measured(&offset.apply(&plain, &offset.at(1.0)), 5, 301);
    let alone = run(&plain, &off);
    assert!(
        alone.indistinguishable.iter().any(|n| group_of(&alone, n) != Group::Supply),
        "{:?}",
        alone.indistinguishable
    );
    // With the pressure taken at the actuator it is what it is said to be.
    let d = together(&plain, &[(&off, Direct::default()), (&measured(&plain, 5, 302), GAUGE)]).unwrap();
    assert_eq!((d.verdict, d.indistinguishable[0].as_str()), (Some(Verdict::Effect), "pressure_offset"));
    assert!(d.indistinguishable.iter().all(|n| group_of(&d, n) == Group::Supply), "{:?}", d.indistinguishable);

    let tail = plain.with_effect("tail_tension", &[0.9]);
    let pulled = [303, 304].map(|seed| measured(&tail, 5, seed));
    let d = together(&plain, &[(&pulled[0], Direct::default()), (&pulled[1], GAUGE)]).unwrap();
    assert!(d.indistinguishable.iter().any(|n| n == "tail_tension"), "{:?}", d.indistinguishable);
    assert!(d.indistinguishable.iter().all(|n| group_of(&d, n) != Group::Supply), "{:?}", d.indistinguishable);
}

/// Information adds: 1/h² of the fitted B with the test is that without it and that of the test. What B could take up before, a lost
/// share of the pressure, is then seen at a smaller size.
#[test]
fn a_bending_test_is_one_more_value_of_the_fit() {
    let plain = robot("spam");
    let data = measured(&plain, 5, 305);
    let alone = run(&plain, &data);
    let half = |d: &Diagnosis| 0.5 * (d.base.bending[0].hi.unwrap() - d.base.bending[0].lo.unwrap());
    let sd = 0.5 * half(&alone);
    let tested = |stiffness: f64| {
        let about = About { bending_nm2: Some([stiffness, sd]), ..about(Direct::default()) };
        diagnose(&plain, &data, Some(&about), &quick()).unwrap()
    };
    let d = tested(alone.base.bending[0].value_nm2);
    let expected = (half(&alone).powi(-2) + (1.96 * sd).powi(-2)).powf(-0.5);
    assert!((half(&d) / expected - 1.0).abs() < 0.15, "{} {expected} of {}", half(&d), half(&alone));
    let seen = |d: &Diagnosis| {
        d.undetectable.iter().find(|u| u.effect == "pressure_loss").and_then(|u| u.smallest_detectable).unwrap()
    };
    assert!(seen(&d) < 0.9 * seen(&alone), "{} {}", seen(&d), seen(&alone));
    // A test that found more pulls B towards it by its weight.
    let up = tested(alone.base.bending[0].value_nm2 + sd).base.bending[0].value_nm2 - d.base.bending[0].value_nm2;
    assert!(up > 0.3 * sd && up < sd, "{up} {sd}");
    // One that the markers contradict is said, with what they ask for.
    let told = |d: &Diagnosis| d.warnings.iter().find(|w| w.contains("bending test")).cloned();
    let off = told(&tested(alone.base.bending[0].value_nm2 + 10.0 * sd)).unwrap();
    let asked: f64 = off.split("ask for ").nth(1).and_then(|rest| rest.split(':').next()).unwrap().parse().unwrap();
    assert!((asked - alone.base.bending[0].value_nm2).abs() < 1.5 * sd, "{off} {}", alone.base.bending[0].value_nm2);
    assert_eq!(told(&d), None);
    // Two tests that contradict each other are.
    let of = |stiffness: f64| About { bending_nm2: Some([stiffness, sd]), ..about(Direct::default()) };
    let (more, first, other) = (measured(&plain, 5, 306), of(6.0), of(9.0));
    let both = |second: &About| {
        let further = [Measured { dataset: &more, about: Some(second) }];
        let d =
            diagnose_together(&plain, Measured { dataset: &data, about: Some(&first) }, &further, &quick()).unwrap();
        d.warnings.iter().any(|w| w.contains("says something else of [bending]"))
    };
    assert!(both(&other) && !both(&first));
}

#[test]
fn two_halves_together_say_what_the_whole_says() {
    let plain = robot("spam");
    let whole = measured(&plain.with_effect("end_constraint", &[0.446, 1.0]), 10, 311);
    let half = |first: usize| Dataset {
        runs: whole.runs[first..first + 5].to_vec(),
        xy_m: (first..first + 5).flat_map(|r| whole.run(r).to_vec()).collect(),
        ..whole.clone()
    };
    let (one, other) = (half(0), half(5));
    let d = together(&plain, &[(&one, Direct::default()), (&other, Direct::default())]).unwrap();
    let value = |d: &Diagnosis| {
        let r = d.ranked.iter().find(|r| r.effect == "end_constraint").unwrap();
        [r.value, r.hi.unwrap() - r.lo.unwrap()]
    };
    let (halves, all, alone) = (value(&d), value(&run(&plain, &whole)), value(&run(&plain, &one)));
    assert!((halves[0] - all[0]).abs() < 0.3 * all[1], "{halves:?} {all:?}");
    assert!((halves[1] / all[1]).ln().abs() < 0.5 && halves[1] < alone[1], "{halves:?} {all:?} {alone:?}");
    assert_eq!((d.verdict, d.beside.len(), d.beside[0].runs), (Some(Verdict::Effect), 1, 5));
    assert!(d.beside[0].systematic_with_added_mm < d.beside[0].systematic_mm, "{:?}", d.beside);
}

#[test]
fn complete_models_rarely_alarm_with_several_data_either() {
    let mut alarms = 0;
    for (kind, seed) in [("spam", 321), ("epam", 331), ("cpam", 341), ("fpam", 351)] {
        let data = [0, 1].map(|i| measured(&robot(kind), 5, seed + i));
        let d = together(&robot(kind), &[(&data[0], Direct::default()), (&data[1], GAUGE)]).unwrap();
        alarms += usize::from(d.verdict != Some(Verdict::None));
    }
    assert!(alarms <= 1, "{alarms} of 4");
}

#[test]
fn what_all_data_measure_directly_is_no_candidate_and_an_effect_of_it_in_the_scenario_does_not_act() {
    let plain = robot("epam");
    let data = measured(&plain, 5, 361);
    let all = Direct { pressure: true, frame: true };
    let d = together(&plain.with_effect("pressure_loss", &[0.2, 1.0]), &[(&data, all)]).unwrap();
    assert_eq!(d.verdict, Some(Verdict::None));
    assert!(d.ranked.iter().all(|r| r.group != Group::Supply && r.effect != "camera_scale"));
}

#[test]
fn a_copy_beside_the_first_data_is_left_out() {
    let plain = robot("epam");
    let data = measured(&plain.with_effect("friction", &[0.3]), 5, 365);
    let alone = run(&plain, &data);
    let d = together(&plain, &[(&data, Direct::default()), (&data, Direct::default())]).unwrap();
    assert!(d.warnings.iter().any(|w| w.contains("made is a copy")), "{:?}", d.warnings);
    assert!(d.beside.is_empty() && d.ranked[0].gain == alone.ranked[0].gain);
}

#[test]
fn data_beside_others_need_runs_enough_to_know_their_noise() {
    let plain = robot("epam");
    let (first, few) = (measured(&plain, 5, 371), measured(&plain, 2, 372));
    let refused = together(&plain, &[(&first, Direct::default()), (&few, GAUGE)]).unwrap_err();
    assert!(matches!(refused, CompareError::TooFewRunsBeside { runs: 2, needed: 3, .. }), "{refused}");
}
