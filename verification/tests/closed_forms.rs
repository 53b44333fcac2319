//! Predictions against the closed forms, with the lever of virtual work.

#![allow(clippy::unwrap_used)]

use models::{Loads, Model, Prediction, Scenario, shipped};
use std::f64::consts::PI;
use verification::exact::fpam::{Fpam, bending_alpha, total_angle};
use verification::exact::hinge::{Arm, BentBody, LeverRule, SeriesUnit, axis_point_m, equilibrium_theta, fold_angle};
use verification::exact::pouch::{Pouch, robin_end_factor};

const PRESSURES: [f64; 5] = [2e3, 5e3, 10e3, 20e3, 30e3];
const BODY_PA: f64 = 2e3;

/// The textbook model of that actuator's robot.
fn robot(actuator: &str) -> Scenario {
    Scenario::parse(shipped(&format!("{actuator}-textbook")).unwrap()).unwrap()
}

fn predict(scenario: &Scenario, p_body_pa: f64, p_act_pa: f64) -> Prediction {
    let model = Model::new(scenario);
    let mut out = model.prediction();
    model.predict(&Loads::uniform(p_body_pa, p_act_pa), &mut out).unwrap_or_else(|e| panic!("{}: {e}", scenario.name));
    out
}

fn agree(scenario: &Scenario, p_act: f64, body: BentBody, what: &str) {
    let at = predict(scenario, BODY_PA, p_act);
    for (station, marker) in scenario.markers_m.iter().zip(&at.markers) {
        let [x, y] = axis_point_m(&body, *station);
        let error = (marker[0] - x).abs().max((marker[1] - y).abs());
        assert!(error < 1e-10 * 0.36, "{what} {p_act} Pa, s = {station}: {error:e} m");
    }
}

fn pouch(scenario: &Scenario, unit: SeriesUnit, what: &str) {
    for p_act in PRESSURES {
        let theta = equilibrium_theta(&unit, p_act, BODY_PA, LeverRule::VirtualWork);
        let total_angle = 6.0 * fold_angle(&unit, theta);
        agree(scenario, p_act, BentBody { body_radius_m: 0.04, length_m: 0.36, total_angle }, what);
    }
}

fn unit(arm: Arm, end_factor: f64) -> SeriesUnit {
    SeriesUnit { pouch: Pouch { length_m: 0.06, width_m: 0.06 }, body_radius_m: 0.04, end_factor, arm }
}

#[test]
fn bare_embedded_pouches_are_the_hinge_model() {
    for actuator in ["epam", "cpam"] {
        pouch(&robot(actuator).bare(), unit(Arm::Embedded, 1.0), actuator);
    }
}

#[test]
fn robins_end_factor_comes_in_through_the_end_constraint() {
    let eta = robin_end_factor(1.0);
    let sealed = |s: Scenario| s.with_effect("end_constraint", &[0.142 * PI, 1.0]);
    pouch(&sealed(robot("epam").bare()), unit(Arm::Embedded, eta), "epam, sealed");
    pouch(&sealed(robot("spam")), unit(Arm::External, eta), "spam, sealed");
    pouch(&sealed(robot("cpam").bare()), unit(Arm::Embedded, 1.0), "cpam, free edges");
}

/// Volume goes with the width and contraction does not: less volume at the same stroke is a narrower pouch.
#[test]
fn sealed_edges_that_cost_volume_and_no_stroke_are_a_narrower_pouch() {
    let eta = robin_end_factor(1.0);
    let sealed = robot("epam").bare().with_effect("end_constraint", &[0.142 * PI, 0.0]);
    let narrow = Pouch { length_m: 0.06, width_m: 0.06 * eta };
    pouch(&sealed, SeriesUnit { pouch: narrow, ..unit(Arm::Embedded, 1.0) }, "epam, volume only");
}

#[test]
fn external_pouches_with_growing_arm_are_the_hinge_model_with_the_virtual_work_lever() {
    pouch(&robot("spam"), unit(Arm::External, 1.0), "spam");
}

#[test]
fn the_fabric_muscle_agrees_with_and_without_shear_stiffness() {
    for shear in [0.0, 51.6] {
        let mut scenario = robot("fpam").with_effect("shear_stiffness", &[shear]);
        scenario.actuator.start_m = 0.0;
        // A muscle bends the body little at low pressure: a hinge narrow enough to be complete there too.
        scenario.hinge_curvature = 1e-3;
        let muscle = Fpam { flat_width_m: 0.06, rest_length_m: 0.3, shear_stiffness_n_per_m: shear };
        for p_act in [5e3, 10e3, 20e3, 30e3] {
            let alpha = bending_alpha(&muscle, 0.04, p_act, BODY_PA, LeverRule::VirtualWork);
            let total_angle = total_angle(&muscle, 0.04, alpha);
            assert!(total_angle / 0.3 > 20.0 * scenario.hinge_curvature, "{shear} {p_act}");
            agree(&scenario, p_act, BentBody { body_radius_m: 0.04, length_m: 0.3, total_angle }, "fpam");
        }
    }
}

/// The base law with one bending stiffness: arm mm, B, volume gain → y mm at s = 330 mm for 10, 20, 30 kPa.
#[test]
fn the_base_law_with_bending_stiffness_reproduces_the_known_table() {
    let rows = [
        ("spam", 85.0, 6.0, 1.0, [34.8, 51.5, 63.3], 0.05),
        ("epam", 80.0, 1.35, 1.0, [71.0, 96.0, 111.0], 0.5),
        ("cpam", 80.0, 0.90, 1.8, [105.0, 128.0, 139.0], 0.5),
        ("fpam", 99.0, 0.30, 1.0, [33.5, 50.5, 57.6], 0.05),
    ];
    for (actuator, arm_mm, stiffness, gain, expected, half_digit) in rows {
        let mut scenario = robot(actuator).bare().with_bending(stiffness);
        scenario.actuator.arm_m = Some(1e-3 * arm_mm);
        scenario.actuator.shape.volume_gain = gain;
        if actuator == "fpam" {
            scenario.actuator.start_m = 0.03;
        }
        for (p_act, y_mm) in [10e3, 20e3, 30e3].into_iter().zip(expected) {
            let computed = 1e3 * predict(&scenario, BODY_PA, p_act).markers[5][1];
            assert!((computed - y_mm).abs() <= half_digit, "{actuator} {p_act} Pa: {computed:.4} mm, not {y_mm}");
        }
    }
}
