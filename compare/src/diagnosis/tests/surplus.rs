//! Small effects, effects too many, and robots that are made otherwise than the scenario says.

use super::{measured, of_one, quick, robot};
use crate::diagnosis::*;
use crate::study::{Generator, generate, predict_dataset};
use models::Scenario;

/// A name comes first, and the summary adds that it moves the markers by hardly anything.
#[test]
fn a_small_effect_has_a_name_and_a_size() {
    let plain = robot("epam");
    let quiet = Generator { runs: 10, camera_sd_m: 1e-4, pressure_sd: 1e-3, seed: 3, ..Generator::default() };
    let small = generate(&plain.with_effect("friction", &[0.03]), "made", &quiet).unwrap();
    let d = of_one(&plain, &small, None, &Options { tolerance_m: None, ..quick() }).unwrap();
    assert!(d.base.systematic_mm < d.tolerance_mm && d.p_value.unwrap() < d.alpha, "{:?}", d.summary);
    assert_eq!(d.verdict, Some(Verdict::Effect), "{:?}", d.summary);
    assert!(d.indistinguishable.iter().any(|name| name == "friction"), "{:?}", d.indistinguishable);
    let worth = d.worth.as_ref().unwrap();
    assert!(worth.here_mm < d.tolerance_mm && worth.elsewhere_mm.unwrap() > 0.0, "{worth:?}");
    assert!(d.summary.iter().any(|told| told.contains("below the tolerance")), "{:?}", d.summary);
}

/// The scenario has an effect that the robot does not have: taking it away is the answer, and nothing absent is named for it.
#[test]
fn an_effect_too_many_is_taken_away() {
    let plain = robot("epam");
    let (data, options) = (measured(&plain, 5, 17), Options { keep_bending: true, ..quick() });
    for (name, value) in [("friction", 0.4), ("camera_scale", 0.04), ("pressure_loss", 0.1)] {
        let more = plain.with_effect(name, &[value]);
        let d = of_one(&more, &data, None, &options).unwrap();
        assert_eq!(d.verdict, Some(Verdict::Effect), "{name} {:?}", d.summary);
        let away = format!("without {name}");
        assert!(d.indistinguishable.contains(&away), "{:?}", d.indistinguishable);
        let answer = d.answers().into_iter().find(|answer| answer.name() == away).unwrap();
        assert!(!answer.on(&more, 0).effects.iter().any(|e| e.name == name));
        // What the scenario has rightly stays.
        let kept = of_one(&more, &measured(&more, 5, 18), None, &options).unwrap();
        assert_eq!(kept.verdict, Some(Verdict::None), "{:?}", kept.summary);
        let held = Options { not: vec![away.clone()], ..options.clone() };
        let d = of_one(&more, &data, None, &held).unwrap();
        assert!(d.ranked(&away).is_none() && d.verdict != Some(Verdict::None), "{:?}", d.summary);
    }
}

/// Data of a robot without the mechanisms of the shipped one, diagnosed with all of them, and the other way round.
#[test]
fn a_robot_that_is_made_otherwise_is_named_before_a_name_from_physics() {
    let [whole, bare] = ["epam", "epam-textbook"].map(|name| crate::ScenarioFile::read(name).unwrap());
    let quiet = Generator { camera_sd_m: 3e-4, pressure_sd: 3e-3, ..Generator::default() };
    let evidence = [Evidence::of(generate(&bare.with_bending(0.4), "made", &quiet).unwrap(), None)];
    let options = Options { other_design: true, ..quick() };
    let run = |scenario: &Scenario| diagnose(scenario, &evidence, &options, &mut |_, _| ()).unwrap();
    let d = run(&whole);
    let other = d.other_design.as_ref().unwrap();
    assert!(other.switched.iter().all(|name| name.starts_with("without ")), "{:?}", other.switched);
    assert!(other.systematic_after_mm < 0.8 * d.base.systematic_with_added_mm, "{:?}", d.summary);
    assert!(d.confidence != Some(Confidence::IdentifiedInCatalog), "{:?}", d.summary);
    assert!(d.summary[1].contains("how the robot is made"), "{:?}", d.summary);
    assert!(run(&bare).other_design.is_none());
}

/// The changes that the page and Python write into a text for `without NAME` give the robot without it, for every shipped effect.
#[test]
fn what_is_written_for_an_effect_that_is_taken_away_is_the_robot_without_it() {
    for name in ["spam", "cpam", "epam", "fpam"] {
        let file = crate::ScenarioFile::read(name).unwrap();
        let evidence = [Evidence::read(&format!("synthetic-{name}")).unwrap()];
        let d = diagnose(&file, &evidence, &Options { pairs: false, ..quick() }, &mut |_, _| ()).unwrap();
        let away: Vec<_> = d.answers().into_iter().filter(|answer| taken_away(&answer.name()).is_some()).collect();
        assert!(away.len() + 1 >= file.effects.len(), "{name}: {}", away.len());
        for answer in away {
            let written = file.with(&answer.changes(0)).unwrap_or_else(|error| panic!("{}: {error}", answer.name()));
            let [a, b] = [&written.scenario, &answer.on(&file, 0)]
                .map(|scenario| predict_dataset(scenario, &evidence[0].dataset).unwrap().coordinates_m);
            assert_eq!(a, b, "{name} {}", answer.name());
        }
    }
}
