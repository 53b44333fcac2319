//! Small-load statics: a passive robot under a tip load is a cantilever.

use crate::support::*;
use models::{Loads, Model};

/// Deflection of a passive robot with wall stiffness B alone, relative to F L³/3B.
fn deflection(segments: usize, force_n: f64, stiffness: f64) -> f64 {
    let mut scenario = robot("epam").bare().with_bending(stiffness).with_effect("tip_load", &[0.0, force_n]);
    scenario.segments = segments;
    let model = Model::new(&scenario);
    // Without any pressure only B resists.
    let tip = predicted(&model, &Loads::uniform(0.0, 0.0)).unwrap().tip;
    tip.y_m / (force_n * scenario.length_m.powi(3) / (3.0 * stiffness))
}

#[test]
fn a_small_tip_load_bends_a_passive_robot_like_a_cantilever() {
    for force in [1e-4, -1e-4] {
        let error = deflection(12, force, 1.0) - 1.0;
        assert!((error + 1.0 / (4.0 * 144.0)).abs() < 1e-5, "piecewise constant curvature loses 1/4n²: {error:e}");
    }
}

#[test]
fn the_deflection_converges_with_the_square_of_the_number_of_segments() {
    let errors: Vec<f64> = [4, 8, 16, 32].map(|n| 1.0 - deflection(n, 1e-4, 1.0)).to_vec();
    for pair in errors.windows(2) {
        let rate = (pair[0] / pair[1]).log2();
        assert!((rate - 2.0).abs() < 0.02, "{errors:?}");
    }
}

#[test]
fn own_weight_droops_a_passive_robot_as_a_uniform_load_does() {
    let mut scenario = robot("epam").bare().with_bending(2.0).with_effect("gravity", &[1e-3]);
    scenario.segments = 64;
    let tip = predicted(&Model::new(&scenario), &Loads::uniform(0.0, 0.0)).unwrap().tip;
    let expected = -1e-3 * scenario.length_m.powi(4) / (8.0 * 2.0);
    assert!((tip.y_m / expected - 1.0).abs() < 1e-3, "{:e} {expected:e}", tip.y_m);
}

#[test]
fn a_vanishing_load_leaves_the_unloaded_robot() {
    for actuator in actuators() {
        let base = robot(actuator).with_bending(0.5);
        let (plain, loaded) =
            (predict(&base, 2e3, 20e3), predict(&base.with_effect("tip_load", &[0.0, 1e-9]), 2e3, 20e3));
        for (a, b) in plain.markers.iter().flatten().zip(loaded.markers.iter().flatten()) {
            assert!((a - b).abs() < 1e-9, "{actuator}: {:e}", a - b);
        }
    }
}
