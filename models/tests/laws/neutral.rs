//! An effect at its neutral value changes no bit; at its typical value it changes something.

use crate::support::*;
use models::{Loads, Model, Prediction, Scenario, Step};

const PRESSURES: [(f64, f64); 6] = [(2e3, 0.0), (2e3, 1e3), (2e3, 10e3), (2e3, 30e3), (8e3, 30e3), (500.0, 90e3)];

fn bits(at: &Prediction) -> Vec<u64> {
    let tip = [at.tip.x_m, at.tip.y_m, at.tip.angle_rad];
    at.markers.iter().flatten().chain(&tip).map(|v| v.to_bits()).collect()
}

fn without(scenario: &Scenario, name: &str) -> Scenario {
    let mut changed = scenario.clone();
    changed.effects.retain(|e| e.name != name);
    changed
}

#[test]
fn a_neutral_effect_changes_no_bit_of_any_prediction() {
    for actuator in actuators() {
        for base in [robot(actuator).bare(), robot(actuator).with_bending(0.7), everything(actuator)] {
            for effect in applicable(&base) {
                let base = without(&base, effect.name);
                let neutral = base.with_effect(effect.name, &effect.neutral());
                for (p_body, p_act) in PRESSURES {
                    let (plain, with) = (predict(&base, p_body, p_act), predict(&neutral, p_body, p_act));
                    assert_eq!(bits(&plain), bits(&with), "{actuator} {} {p_body} {p_act}", effect.name);
                }
            }
        }
    }
}

/// Markers after five seconds at 30 kPa.
fn held(scenario: &Scenario) -> Vec<[f64; 2]> {
    let model = Model::new(scenario);
    let mut out = model.prediction();
    let step = Step { t_s: 5.0, loads: Loads::uniform(2e3, 30e3) };
    model.follow(&[step], &mut out, &mut |_, _| ()).unwrap();
    out.markers
}

#[test]
fn a_typical_effect_changes_the_prediction_of_every_actuator_it_applies_to() {
    for actuator in actuators() {
        let base = robot(actuator).bare().with_bending(0.02);
        for effect in applicable(&base) {
            let with = base.with_effect(effect.name, &effect.typical());
            let (a, b) = (held(&base), held(&with));
            let moved = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs());
            let moved = moved.fold(0.0, f64::max);
            if actuator == "cpam" && ["end_constraint", "sealed_sides", "crimped_sides"].contains(&effect.name) {
                assert_eq!(moved, 0.0, "the gussets of a cPAM free its edges");
            } else if actuator != "cpam" && effect.name == "gussets" {
                assert_eq!(moved, 0.0, "no other pouch has folds");
            } else if effect.name == "stuck_face" && actuator != "spam" {
                assert_eq!(moved, 0.0, "no other pouch is outside the wall");
            } else if (actuator, effect.name) == ("fpam", "self_contact") {
                assert_eq!(moved, 0.0, "a muscle does not turn a metre of body by π");
            } else if effect.name == "roofed_welds" {
                assert!(moved < 1e-12, "at 30 kPa its welds are chords: {moved:e}");
            } else if ["clock_lag", "regulator_hysteresis"].contains(&effect.name) {
                assert!(moved < 1e-12, "a hold longer than the lag, on the way up: {moved:e}");
            } else {
                assert!(moved > 1e-6, "{actuator} {}: {moved:e} m", effect.name);
            }
        }
    }
}

#[test]
fn a_prediction_does_not_depend_on_what_its_buffers_held_before() {
    for actuator in actuators() {
        for scenario in [robot(actuator), everything(actuator)] {
            let model = Model::new(&scenario);
            let mut used = model.prediction();
            for (p_body, p_act) in PRESSURES {
                let loads = Loads::uniform(p_body, p_act);
                model.predict(&loads, &mut used).unwrap();
                assert_eq!(bits(&used), bits(&predicted(&model, &loads).unwrap()), "{actuator} {p_act}");
            }
        }
    }
}
