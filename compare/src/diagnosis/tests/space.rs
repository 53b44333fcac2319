//! Robots with strips round the body: what the scenario lacks is named, and a complete one raises no alarm.

use super::quick;
use crate::ScenarioFile;
use crate::diagnosis::*;
use crate::study::{Generator, generate};
use data::Dataset;

/// Two strips at 90°, complete: every effect that the shipped robot has.
fn complete() -> Scenario {
    ScenarioFile::parse("robot", include_str!("../../../../studies/epam-two-strips.toml")).unwrap().scenario
}

fn lacking(effect: &str) -> Scenario {
    let mut scenario = complete();
    scenario.effects.retain(|e| e.name != effect);
    scenario
}

fn measured(truth: &Scenario, seed: u64) -> Dataset {
    let protocol = "0/0,10/0,20/0,30/0,30/15,30/30,15/30,0/30,0/15@2;0/0,20/0,40/20,20/40,0/20@4";
    let generator = Generator { runs: 5, samples: 2, seed, ..Generator::default() }.with_protocol(protocol).unwrap();
    generate(truth, "made", &generator).unwrap()
}

fn run(scenario: &Scenario, dataset: &Dataset) -> Diagnosis {
    diagnose(scenario, &[Evidence::of(dataset.clone(), None)], &quick(), &mut |_, _| ()).unwrap()
}

#[test]
fn what_a_robot_with_two_strips_lacks_is_named_first() {
    for (effect, seed) in [("chord_arm", 1), ("sealed_sides", 2), ("crimped_sides", 3), ("pressure_loss", 4)] {
        let truth = match effect {
            "pressure_loss" => complete().with_effect(effect, &[0.1]),
            _ => complete(),
        };
        let found = run(&lacking(effect), &measured(&truth, seed));
        assert_eq!(found.verdict, Some(Verdict::Effect), "{effect}: {:?}", found.summary);
        assert_eq!(found.indistinguishable[0], effect, "{:?}", found.indistinguishable);
        assert!(found.limits.iter().any(|l| l.contains("tip_spring") && l.contains("friction")), "{:?}", found.limits);
    }
}

#[test]
fn a_complete_robot_with_two_strips_raises_no_alarm() {
    let alarms: Vec<u64> = (11..17)
        .filter(|seed| run(&complete(), &measured(&complete(), *seed)).verdict != Some(Verdict::None))
        .collect();
    assert!(alarms.len() <= 1, "{alarms:?}");
}
