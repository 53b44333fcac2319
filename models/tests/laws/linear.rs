//! The linear form of a robot is the tangent of its model.

use crate::support::*;
use models::export::Linear;
use models::{Loads, Model, Scenario};

/// Textbook robots with a bending stiffness, and one under gravity, cut into six.
fn robots() -> Vec<Scenario> {
    let gravity = robot("epam").with_bending(0.8).with_effect("gravity", &[1.0]);
    actuators().map(|actuator| robot(actuator).with_bending(0.8)).chain([gravity]).collect()
}

#[test]
fn at_the_working_point_the_moments_balance_and_beside_it_they_follow_the_model() {
    for scenario in robots().iter().take(4) {
        let at = |p: f64| Linear::new(scenario, 6, &Loads::uniform(2e3, p)).unwrap();
        let (chain, next) = (at(15e3), at(15.03e3));
        for (joint, moved) in chain.joints.iter().zip(&next.joints) {
            let [k, b, c] = [joint.stiffness_nm, joint.per_pa[0], joint.offset_nm];
            assert!((k * joint.angle_rad - b * 15e3 - c).abs() < 1e-7, "{}: {joint:?}", scenario.name);
            // By the pressure alone the joint moves on its tangent; what is left is of second order.
            let step = (c + b * 15.03e3) / k - joint.angle_rad;
            let real = moved.angle_rad - joint.angle_rad;
            assert!((step - real).abs() <= 5e-3 * real.abs(), "{}: {step} {real}", scenario.name);
        }
    }
}

#[test]
fn a_chain_at_the_largest_pressure_continues_those_below_it() {
    let drive = |p: f64| Linear::new(&robot("epam"), 6, &Loads::uniform(2e3, p)).unwrap().joints[0].per_pa[0];
    let [at, near, far] = [1e6, 0.999e6, 0.998e6].map(drive);
    assert!((at / (2.0 * near - far) - 1.0).abs() < 1e-4, "{at:e} {near:e} {far:e}");
}

#[test]
fn the_tip_of_the_chain_is_the_tip_of_the_model_at_the_working_point_and_that_of_the_straight_robot_nearby() {
    for scenario in robots().iter().take(4) {
        let loads = Loads::uniform(2e3, 20e3);
        let chain = Linear::new(scenario, 6, &loads).unwrap();
        let tip = predicted(&Model::new(scenario), &loads).unwrap().tip;
        let reached = |share: f64| {
            let ([mut x, mut y], mut heading, mut before) = ([0.0; 2], 0.0_f64, 0.0);
            let mut move_by = |along: f64, across: f64, heading: f64| {
                x += along * heading.cos() - across * heading.sin();
                y += along * heading.sin() + across * heading.cos();
            };
            for joint in &chain.joints {
                move_by(joint.joint_at_m - before, -joint.line_offset_m, heading);
                heading += share * joint.angle_rad;
                move_by(0.0, joint.line_offset_m, heading);
                before = joint.joint_at_m;
            }
            move_by(chain.tip_at_m - before, 0.0, heading);
            [x, y, heading]
        };
        let miss = |[x, y, heading]: [f64; 3]| (x - tip.x_m).hypot(y - tip.y_m).max((heading - tip.angle_rad).abs());
        assert!(tip.angle_rad > 0.2 && miss(reached(1.0)) < 1e-12, "{}: {:?} {tip:?}", scenario.name, reached(1.0));
        let [longer, aside, _] = reached(0.0);
        assert!(aside.abs() < 1e-15 && (0.0..0.01).contains(&(longer / scenario.length_m - 1.0)), "{longer}");
    }
}

/// A beam: K is its bending stiffness over the length of a joint, plus the hinge of its pressure.
#[test]
fn the_joint_of_a_beam_has_its_closed_form() {
    let text = "[body]\nradius_mm = 40\nlength_mm = 400\npressure_kpa = 2\nbending_stiffness_nm2 = 0.6\n\
                [effects.creep]\nshare = 0.5\ntime_s = 3\n";
    let chain = Linear::new(&Scenario::parse(text).unwrap(), 4, &Loads::uniform(2e3, 0.0)).unwrap();
    let hinge = std::f64::consts::PI * 2e3 * 0.04_f64.powi(3) / 0.05;
    assert_eq!(chain.joints.len(), 4);
    for joint in &chain.joints {
        // At once the wall has (1 + a) B.
        let exact = (1.5 * 0.6 + hinge) / 0.1;
        assert!((joint.stiffness_nm / exact - 1.0).abs() < 1e-6, "{joint:?} {exact}");
        assert!((joint.damping_nms.unwrap() - 0.5 * 0.6 * 3.0 / 0.1).abs() < 1e-12 && joint.per_pa == [0.0; 4]);
    }
}

#[test]
fn loads_across_the_body_bend_the_working_point_and_nothing_else() {
    let scenario = &robots()[4];
    let loads = Loads::uniform(2e3, 15e3);
    let chain = Linear::new(scenario, 6, &loads).unwrap();
    let cuts: Vec<f64> = (1..6).map(|i| 0.06 * f64::from(i)).collect();
    let model = Model::in_pieces(scenario, &cuts);
    let at = predicted(&model, &loads).unwrap();
    for (i, (joint, state)) in chain.joints.iter().zip(model.states(&at)).enumerate() {
        assert!((joint.angle_rad - 0.06 * state.curvature).abs() < 1e-15);
        // What is left of the balance is the moment of the weight beyond, which holds the robot down until it heads back.
        let left = joint.stiffness_nm * joint.angle_rad - joint.per_pa[0] * 15e3 - joint.offset_nm;
        assert!((left < 0.0 || i > 2) && left.abs() < 0.36 * 0.36, "{joint:?} {left}");
    }
    assert!(chain.joints[0].per_pa[0] > 0.0 && chain.joints[0].stiffness_nm > 0.0);
}
