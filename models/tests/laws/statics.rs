//! A pose holds where all wall tensions and pulls are possible, whatever the actuator pulls; beyond, it is a collapse.

use crate::support::*;
use models::{Limit, Loads, Model, Scenario, collapse_length_m};
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
