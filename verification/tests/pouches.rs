//! Pouches in a robot against pouches in closed form.

#![allow(clippy::unwrap_used)]

use compare::study::published_ladders;
use models::{Loads, Model, Pose, PouchShape, Scenario, shipped};
use std::f64::consts::{LN_2, PI};
use verification::exact::hinge::{Arm, BentBody, LeverRule, SeriesUnit, axis_point_m, equilibrium_theta, fold_angle};
use verification::exact::pouch::{Pouch, contraction, sealed_theta, sealed_volume_m3, volume_m3};

fn epam() -> Scenario {
    Scenario::parse(shipped("epam-textbook").unwrap()).unwrap()
}

fn shape(text: &str, loads: &Loads) -> (PouchShape, f64, f64) {
    let model = Model::new(&Scenario::parse(text).unwrap());
    let mut at = model.prediction();
    model.predict(loads, &mut at).unwrap();
    let theta = model.states(&at)[0].coordinate;
    (model.pouch_shape(loads, &at).unwrap(), theta, at.tip.angle_rad)
}

#[test]
fn the_textbook_robot_has_free_lenses_on_a_body_that_folds_about_its_far_side() {
    let (at, theta, turn) = shape(shipped("epam-textbook").unwrap(), &Loads::uniform(2e3, 10e3));
    let flat = Pouch { length_m: 0.06, width_m: 0.06 };
    let lenses = 6.0 * volume_m3(&flat, theta);
    // The pouch starts at θ = 1e-6, not at nothing.
    assert!((at.actuator_m3 / lenses - 1.0).abs() < 2e-6, "{at:?} {lenses}");
    // The hinge sets in over 0.05 1/m, on which it loses ln 2 of that.
    let folded = turn - 0.36 * 0.05 * LN_2;
    assert!((at.body_m3 / (PI * 1.6e-3 * (0.36 - 0.04 * folded)) - 1.0).abs() < 1e-6, "{at:?}");
    assert!((at.arm_m - 0.08).abs() < 1e-12 && at.width_m == 0.06);
    assert!((at.height_m / (0.06 * (1.0 - theta.cos()) / theta) - 1.0).abs() < 1e-12);
}

#[test]
fn a_sealed_pouch_in_a_wall_holds_its_known_volume_and_half_of_it_displaces_the_body() {
    let text = "
        [effects.displaced_gas]
        share = 0.5
        [effects.sealed_sides]
        share = 1";
    let (at, theta, _) = shape(&format!("{}{text}", shipped("epam-textbook").unwrap()), &Loads::uniform(2e3, 10e3));
    let flat = Pouch { length_m: 0.06, width_m: 0.06 };
    let sealed = 6.0 * sealed_volume_m3(&flat, theta);
    assert!((at.actuator_m3 / sealed - 1.0).abs() < 2e-6, "{at:?} {sealed}");
    let q = 1.05 - 0.355 * 0.5 * at.height_m / 0.06;
    assert!((at.width_m - (0.06 - q * (PI - 2.0) * 0.5 * at.height_m)).abs() < 1e-12);
}

#[test]
fn without_a_body_it_is_the_sealed_pouch_and_its_known_contractions() {
    for (aspect, known) in [(1.0, 0.2377), (1.5, 0.2839), (2.0, 0.3060), (4.0, 0.3366)] {
        let flat = Pouch { length_m: 0.06, width_m: 0.06 * aspect };
        let mut robot = epam().bare().with_effect("sealed_sides", &[1.0]);
        robot.actuator.shape.width_m = flat.width_m;
        let model = Model::new(&robot);
        let sides =
            model.assembly().sites[0].actuator_terms.iter().find(|term| term.line().name == "sealed_sides").unwrap();
        let lost = |theta: f64| -0.06 * sides.add(&Pose::new(&[theta, 0.0, 0.0, 0.0], 0.0, 1.0), &mut [0.0; 4]);
        let volume = |theta: f64| volume_m3(&flat, theta) + lost(theta);
        for theta in [0.3, 0.8, 1.1] {
            assert!((volume(theta) / sealed_volume_m3(&flat, theta) - 1.0).abs() < 1e-9, "{aspect} {theta}");
        }
        let largest = (0..4000).map(|i| 0.8 + 2e-4 * f64::from(i)).max_by(|a, b| volume(*a).total_cmp(&volume(*b)));
        assert!((contraction(largest.unwrap()) - known).abs() < 6e-4, "{aspect}: {largest:?}");
    }
}

#[test]
fn the_published_ladders_start_at_the_hinge_model() {
    let ladders = published_ladders().unwrap();
    let pouch = Pouch { length_m: 0.06, width_m: 0.06 };
    let height = |arm| {
        let unit = SeriesUnit { pouch, body_radius_m: 0.04, end_factor: 1.0, arm };
        let theta = equilibrium_theta(&unit, 30e3, 2e3, LeverRule::VirtualWork);
        let total_angle = 6.0 * fold_angle(&unit, theta);
        axis_point_m(&BentBody { body_radius_m: 0.04, length_m: 0.36, total_angle }, 0.33)[1]
    };
    for (kind, rung, arm) in [("epam", 0, Arm::Embedded), ("spam", 1, Arm::External)] {
        let ladder = ladders.iter().find(|l| l.published.kind == kind).unwrap();
        assert!((ladder.rungs[rung].y_m - height(arm)).abs() < 1e-9, "{kind}");
    }
}

/// W/L, volume \[cm³\] and contraction of isolated pouches of 60 mm in finite elements, on which q was calibrated: the case of the check
/// `sealed-pouch` with 48 elements along. W/L = ½, whose sides meet, was left out: the law contracts 8 % less there.
const FINE: [[f64; 3]; 6] = [
    [0.667, 22.756, 0.17295],
    [0.8, 30.610, 0.20348],
    [1.0, 43.174, 0.23863],
    [1.5, 76.306, 0.28854],
    [2.0, 110.251, 0.31117],
    [4.0, 247.412, 0.34021],
];

#[test]
fn the_law_of_sealed_sides_is_within_two_per_cent_of_the_pouches_it_was_calibrated_on() {
    for [aspect, volume_cm3, contracted] in FINE {
        let pouch = Pouch { length_m: 0.06, width_m: 0.06 * aspect };
        let theta = sealed_theta(&pouch);
        let [volume, stroke] =
            [1e6 * sealed_volume_m3(&pouch, theta) / volume_cm3, contraction(theta) / contracted].map(|r| r - 1.0);
        assert!(volume.abs() < 0.02 && stroke.abs() < 0.02, "{aspect}: {volume} {stroke}");
    }
}
