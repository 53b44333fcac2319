//! More pressure bends more; without stiffness only the ratio of the pressures matters.

use crate::support::*;
use models::{Loads, Model};

#[test]
fn contraction_and_curvature_rise_with_pressure() {
    for actuator in actuators() {
        // Yarns that give lengthen a muscle again at high pressure.
        let all = without_cell(&everything(actuator));
        for scenario in [robot(actuator).bare(), robot(actuator).with_bending(1.0), all] {
            let model = Model::new(&scenario);
            let first = |p: f64| {
                let state = predicted(&model, &Loads::uniform(2e3, p)).unwrap();
                let places = model.states(&state).iter().find(|s| s.coordinate != 0.0).copied();
                places.unwrap_or_else(|| panic!("{actuator} at {p} Pa: no place acts"))
            };
            let mut before = first(100.0);
            for i in 1..=400 {
                let now = first(100.0 + 250.0 * f64::from(i));
                let rises = now.coordinate > before.coordinate && now.curvature > before.curvature;
                assert!(rises, "{actuator} step {i}: {now:?} after {before:?}");
                before = now;
            }
        }
    }
}

#[test]
fn without_stiffness_only_the_ratio_of_the_pressures_matters() {
    for actuator in actuators() {
        let scenario = robot(actuator).bare();
        for ratio in [0.8, 2.0, 5.0, 15.0] {
            let at = predict(&scenario, 2e3, 2e3 * ratio);
            for body in [300.0, 5e3, 20e3] {
                let other = predict(&scenario, body, body * ratio);
                for (a, b) in at.markers.iter().flatten().zip(other.markers.iter().flatten()) {
                    assert!((a - b).abs() < 1e-12 * 0.36, "{actuator} P/p = {ratio}, p = {body}: {:e}", a - b);
                }
            }
        }
    }
}

#[test]
fn bending_stiffness_breaks_the_scaling_law() {
    for actuator in actuators() {
        let scenario = robot(actuator).bare().with_bending(1.0);
        let (low, high) = (predict(&scenario, 1e3, 10e3), predict(&scenario, 4e3, 40e3));
        assert!(high.markers[5][1] > 1.05 * low.markers[5][1], "{actuator}");
    }
}
