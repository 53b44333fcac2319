//! A pose holds where all wall tensions and pulls are possible, whatever the actuator pulls; beyond, it is a collapse.

use crate::support::*;
use models::{Limit, Loads, Model, Scenario, collapse_length_m, collapse_loads};
use std::f64::consts::PI;

const THRUST: f64 = PI * 2e3 * 0.0016;

fn against(robot: &Scenario, newton: f64) -> Model {
    Model::new(&robot.with_effect("tip_load", &[0.0, -newton, 0.0]))
}

/// Whether a predicted pose folds, and from where to where.
fn folds(model: &Model, loads: &Loads) -> Option<[f64; 2]> {
    let at = predicted(model, loads).unwrap();
    let beyond = model.beyond(loads, &at);
    let collapse = beyond.iter().find(|beyond| beyond.limit == Limit::Collapse)?;
    Some([collapse.start_m, collapse.length_m])
}

/// Without a bending stiffness the pull itself shows it: more than the gas of the section gives is no equilibrium of a membrane.
#[test]
fn a_pose_folds_where_the_pull_exceeds_the_gas_of_the_section() {
    let robot = robot("epam").bare();
    let (mut holding, mut folding) = (0, 0);
    for p_act_pa in [10e3, 30e3, 80e3] {
        for newton in [0.3, 0.8, 1.1, 1.4, 2.0, 4.0] {
            let (model, loads) = (against(&robot, newton), Loads::uniform(2e3, p_act_pa));
            let at = predicted(&model, &loads).unwrap();
            let [start_m, length_m] = folds(&model, &loads).unwrap_or([f64::NAN; 2]);
            let mut heading = 0.0;
            for ((segment, kappa), state) in model.curvatures(&at).zip(model.states(&at)) {
                let is_folded = (start_m..start_m + length_m).contains(&segment.middle_m());
                let along = -newton * (heading + 0.5 * kappa * segment.length_m).sin();
                heading += kappa * segment.length_m;
                let excess = state.tension / (THRUST + along) - 1.0;
                // The load acts at the nodes: some hundredths of doubt about its moment in a segment.
                if excess.abs() > 0.03 && kappa > 1.0 {
                    assert_eq!(excess > 0.0, is_folded, "{p_act_pa} {newton} at {}: {excess}", segment.start_m);
                }
                (holding, folding) = (holding + usize::from(excess < 0.0), folding + usize::from(excess > 0.0));
            }
        }
    }
    assert!(holding > 150 && folding > 15, "{holding} {folding}");
}

#[test]
fn four_newton_against_the_bend_collapse_the_epam_from_its_base_on() {
    let (model, loads) = (against(&full("epam"), 4.0), Loads::uniform(2e3, 30e3));
    let at = predicted(&model, &loads).unwrap();
    let beyond = model.beyond(&loads, &at);
    let collapse = beyond.iter().find(|beyond| beyond.limit == Limit::Collapse).unwrap();
    assert!(collapse.start_m < 0.05 && collapse.length_m > 0.1 && collapse.share > 3.0, "{collapse:?}");
    assert!(folds(&against(&full("epam"), 0.2), &loads).is_none());
}

#[test]
fn the_collapse_length_of_a_steered_epam_is_that_of_its_statics() {
    let heavy = full("epam").with_effect("gravity", &[1.5]);
    let length_m = |p_act_pa: f64| collapse_length_m(&heavy, &Loads::uniform(2e3, p_act_pa)).unwrap();
    assert!((0.65..0.75).contains(&length_m(0.0)) && (0.71..0.86).contains(&length_m(30e3)), "{}", length_m(30e3));
}

/// Strips round the body: the strip at azimuth 0 alone is the planar robot.
#[test]
fn a_strip_round_the_body_collapses_as_the_planar_one_does() {
    let text = models::shipped("epam-textbook").unwrap();
    let more = "\n[[strip]]\nazimuth_deg = 180\nchannel = 1\n";
    let [planar, round] = [text.to_string(), format!("{text}{more}")].map(|text| {
        let robot = Scenario::parse(&text).unwrap_or_else(|e| panic!("{e}")).bare().with_bending(0.5);
        let robot = Scenario { segments: 12, ..robot };
        let loads = Loads { actuator_pa: [30e3, 0.0, 0.0, 0.0], ..Loads::uniform(2e3, 0.0) };
        [0.5, 1.3, 3.0].map(|newton| folds(&against(&robot, newton), &loads))
    });
    assert_eq!(planar, round);
    assert!(planar[0].is_none() && planar[2].is_some(), "{planar:?}");
}

/// A straight robot: F L = πp_bR³ to every side, and half of w L² in place of F L; strips without pressure change nothing.
#[test]
fn a_straight_robot_with_strips_collapses_at_the_same_load_to_every_side() {
    let two = in_space()[0].1.bare();
    let straight = Loads::uniform(2e3, 0.0);
    let hinge = THRUST * 0.04;
    for direction in [[0.0, 0.2, 0.0], [0.0, 0.0, -0.3], [0.0, -0.15, 0.15]] {
        let size = f64::hypot(direction[1], direction[2]);
        let robot = two.with_effect("tip_load", &direction);
        for factor in collapse_loads(&robot, &straight) {
            let share = factor.unwrap() * size * two.length_m / hinge;
            // The sag before collapse shortens the lever.
            assert!(share > 0.995 && share < 1.02, "{direction:?}: {share}");
        }
        let share = collapse_length_m(&robot, &straight).unwrap() * size / hinge;
        assert!(share > 0.995 && share < 1.1, "{direction:?}: length {share}");
    }
    let heavy = two.with_effect("gravity", &[1.5]);
    let share = 0.5 * 1.5 * collapse_length_m(&heavy, &straight).unwrap().powi(2) / hinge;
    assert!(share > 0.995 && share < 1.05, "{share}");
    assert_eq!(collapse_loads(&two, &straight), [None; 2]);
}

/// One strip at any azimuth, and a load turned with it, are the planar robot: with and against the bend.
#[test]
fn a_strip_at_any_azimuth_collapses_at_the_loads_and_the_length_of_the_planar_robot() {
    let planar = full("epam");
    let text = |azimuth: &str| {
        models::shipped("epam")
            .unwrap()
            .replace("max_pressure_kpa", &format!("azimuth_deg = {azimuth}\nmax_pressure_kpa"))
    };
    let loads = Loads::uniform(2e3, 30e3);
    let mut of_planar = planar.with_effect("tip_load", &[0.0, -1.0, 0.0]);
    let mut turned = Scenario::parse(&text("90")).unwrap().with_effect("tip_load", &[0.0, 0.0, -1.0]);
    // In space the wall of a section takes no further terms.
    for robot in [&mut of_planar, &mut turned] {
        robot.effects.retain(|effect| models::space::IN_SPACE.contains(&effect.name.as_str()));
    }
    let [against, with] = collapse_loads(&of_planar, &loads);
    // About the base: p_b A (D − ȳ) = 0.305 N·m against the bend, and πp_bR³ with it; half of a segment of 60 is the doubt.
    for (factor, sign, carried) in [(against, -1.0, 0.305), (with, 1.0, THRUST * 0.04)] {
        let newton = sign * factor.unwrap();
        let bent = predicted(&Model::new(&of_planar.with_effect("tip_load", &[0.0, newton, 0.0])), &loads).unwrap();
        let share = newton.abs() * bent.tip.x_m / carried;
        assert!((share - 1.0).abs() < 0.02, "{newton}: {share}");
    }
    for (a, b) in collapse_loads(&turned, &loads).into_iter().zip([against, with]) {
        assert!((a.unwrap() / b.unwrap() - 1.0).abs() < 1e-3, "{a:?} {b:?}");
    }
    let [a, b] = [&turned, &of_planar].map(|robot| collapse_length_m(robot, &loads).unwrap());
    assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
}
