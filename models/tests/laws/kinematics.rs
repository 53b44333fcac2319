//! A tip stays within its fabric, and a shape that crosses itself is reported.

use crate::random_inverse::any_robot;
use crate::support::*;
use models::{Limit, Loads, Model, Scenario};

/// Share by which the tip of the robot is farther from its base than the fabric is long.
fn beyond(scenario: &Scenario, loads: &Loads) -> Option<f64> {
    let tip = predicted(&Model::new(scenario), loads).ok()?.tip;
    Some(tip.x_m.hypot(tip.y_m) / scenario.length_m - 1.0)
}

#[test]
fn no_tip_of_a_random_robot_is_beyond_its_fabric() {
    // 1e5 robots: `IBR_ROBOTS=100000 cargo test --release -p ibr-models kinematics`.
    let robots = std::env::var("IBR_ROBOTS").ok().and_then(|n| n.parse().ok()).unwrap_or(2000);
    let (mut random, mut solved, mut longest) = (Random(7), 0, 0.0_f64);
    for _ in 0..robots {
        let mut scenario = any_robot(&mut random);
        scenario.actuator.shape.bias_rad = random.between(15.0, 75.0).to_radians();
        if random.unit() < 0.5 {
            let force = [random.between(-5.0, 5.0), random.between(-5.0, 5.0), 0.0];
            scenario = scenario.with_effect("tip_load", &force);
        }
        let p_act_pa = if random.unit() < 0.3 { 0.0 } else { random.decades(1.0, 1e5) };
        let Some(beyond) = beyond(&scenario, &Loads::uniform(scenario.p_body_pa, p_act_pa)) else { continue };
        solved += 1;
        longest = longest.max(beyond);
        if beyond > 1e-3 {
            println!("{beyond:.4} at {p_act_pa:.0} Pa, {:?}: {scenario:?}", scenario.wall);
        }
    }
    println!("{solved} of {robots} robots solved, tip at most {longest:.1e} beyond the fabric");
    assert!(solved > robots / 2 && longest < 1e-3, "{solved} {longest}");
}

#[test]
fn a_muscle_that_lengthens_and_a_load_away_from_a_vented_actuator_keep_the_fabric() {
    for (bias_deg, p_act_pa) in [(60.0_f64, 30e3), (75.0, 11e3), (75.0, 12e3), (75.0, 20e3)] {
        let mut muscle = full("fpam");
        muscle.actuator.shape.bias_rad = bias_deg.to_radians();
        let longer = beyond(&muscle, &Loads::uniform(2e3, p_act_pa));
        assert!(longer.is_none_or(|longer| longer < 1e-3), "{bias_deg} {p_act_pa}: {longer:?}");
    }
    for newton in [-0.3, -1.0, -3.0] {
        let vented = robot("epam").with_bending(1.0).with_effect("tip_load", &[0.0, newton]);
        let longer = beyond(&vented, &Loads::uniform(2e3, 0.0)).unwrap();
        assert!(longer < 1e-3, "{newton} N: {longer}");
    }
}

/// The push of a muscle that lengthens bends its body as a load with the same moment about the wall next to it does.
#[test]
fn a_muscle_that_lengthens_bends_the_body_away_with_its_arm_from_the_wall_next_to_it() {
    let mut muscle = robot("fpam").bare().with_bending(0.5);
    muscle.actuator.shape.bias_rad = 70.0_f64.to_radians();
    for p_act_pa in [10e3, 60e3, 100e3] {
        let model = Model::new(&muscle);
        let at = predicted(&model, &Loads::uniform(2e3, p_act_pa)).unwrap();
        let state = model.states(&at).iter().find(|state| state.tension != 0.0).unwrap();
        let (kappa, k) = (state.curvature, muscle.hinge_curvature);
        let hinge = std::f64::consts::PI * 2e3 * 0.04_f64.powi(3) * (kappa / k).tanh() + 0.5 * kappa;
        let lever = muscle.actuator.shape.width_m / std::f64::consts::PI + 0.08 * (1.0 + (kappa / k).tanh());
        assert!(kappa < 0.0 && (state.tension * lever / hinge - 1.0).abs() < 1e-6, "{p_act_pa}: {state:?}");
    }
}

#[test]
fn a_shape_that_crosses_itself_is_reported_and_one_that_does_not_is_not() {
    let text = models::shipped("epam-textbook").unwrap().replace("length_mm = 360", "length_mm = 3000");
    let long = Scenario::parse(&text.replace("count = 6 ", "count = 50 ")).unwrap();
    let model = Model::new(&long.with_bending(0.5));
    for (p_act_pa, crosses) in [(2e3, false), (4e3, false), (30e3, true)] {
        let loads = Loads::uniform(2e3, p_act_pa);
        let at = predicted(&model, &loads).unwrap();
        let beyond = model.beyond(&loads, &at);
        let found = beyond.iter().find(|beyond| beyond.limit == Limit::Crossing);
        assert_eq!(found.is_some(), crosses, "{p_act_pa}: {beyond:?}, turn {}", at.tip.angle_rad.to_degrees());
        assert!(found.is_none_or(|f| f.start_m > 1.0 && f.start_m + f.length_m <= 3.0 && f.share >= 1.0), "{beyond:?}");
    }
}
