//! How the tip gives way to a force: closed forms, Betti's symmetry, and predictions under two forces.

use crate::support::*;
use models::{Loads, Model, Scenario};

fn compliance(scenario: &Scenario, loads: &Loads) -> [[f64; 3]; 3] {
    let model = Model::new(scenario);
    model.tip_stiffness(loads, &mut model.prediction()).unwrap().compliance_m_per_n
}

/// By predictions under forces of both signs on the tip, in addition to those that are there.
fn by_forces(scenario: &Scenario, loads: &Loads, there: [f64; 3], force_n: f64) -> [[f64; 3]; 3] {
    let mut found = [[0.0; 3]; 3];
    let axes = if scenario.is_spatial() { 3 } else { 2 };
    for column in 0..axes {
        let tip = |force_n: f64| {
            let mut all = there;
            all[column] += force_n;
            let at = predicted(&Model::new(&scenario.with_effect("tip_load", &all)), loads).unwrap().tip;
            [at.x_m, at.y_m, at.z_m]
        };
        let (high, low) = (tip(force_n), tip(-force_n));
        (0..axes).for_each(|row| found[row][column] = (high[row] - low[row]) / (2.0 * force_n));
    }
    found
}

fn agree(name: &str, found: [[f64; 3]; 3], wanted: [[f64; 3]; 3], within: f64) {
    let size = wanted.as_flattened().iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    for (f, w) in found.as_flattened().iter().zip(wanted.as_flattened()) {
        assert!((f - w).abs() < within * size, "{name}:\n{found:?}\n{wanted:?}");
    }
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        assert!((found[i][j] - found[j][i]).abs() < 1e-6 * size, "{name}: Betti {found:?}");
    }
}

/// With B alone against the bend: L³/3B across a straight robot, and ∫ r rᵀ/B along an arc.
#[test]
fn a_straight_robot_gives_way_as_a_cantilever() {
    let beam = robot("epam").with_bending(0.8);
    // Without pressure in the actuator the hinge is πp_bR³/k stiff in addition.
    let stiffness = 0.8 + std::f64::consts::PI * 2e3 * beam.radius_m.powi(3) / beam.hinge_curvature;
    let covered = beam.actuator.covered_m(beam.radius_m);
    assert!((covered / beam.length_m - 1.0).abs() < 1e-9);
    let found = compliance(&beam, &Loads::uniform(2e3, 0.0));
    let wanted = beam.length_m.powi(3) / (3.0 * stiffness);
    assert!((found[1][1] / wanted - 1.0).abs() < 1e-6, "{} {wanted}", found[1][1]);
}

#[test]
fn a_bent_robot_gives_way_as_predictions_under_two_forces() {
    for kind in actuators() {
        for scenario in [robot(kind).with_bending(0.5), full(kind)] {
            let mut scenario = scenario;
            scenario.segments = 400;
            for p in [8e3, 30e3] {
                let loads = Loads::uniform(2e3, p);
                agree(kind, compliance(&scenario, &loads), by_forces(&scenario, &loads, [0.0; 3], 1e-3), 2e-4);
            }
        }
    }
}

#[test]
fn a_loaded_robot_gives_way_as_predictions_under_two_forces() {
    let (loads, there) = (Loads::uniform(2e3, 20e3), [0.1, -0.12, 0.0]);
    for kind in actuators() {
        let loaded = full(kind).with_effect("gravity", &[1.0]).with_effect("tip_load", &there);
        let sprung = loaded.with_effect("tip_spring", &[20.0]);
        let mut sheared = loaded.clone();
        sheared.wall.shear_n_per_m = Some(5e3);
        for (name, scenario, within) in [("loaded", loaded, 1e-4), ("sprung", sprung, 1e-4), ("sheared", sheared, 1e-3)]
        {
            let found = compliance(&scenario, &loads);
            agree(&format!("{kind} {name}"), found, by_forces(&scenario, &loads, there, 1e-3), within);
        }
    }
}

#[test]
fn a_robot_in_space_gives_way_as_predictions_under_two_forces() {
    let loads = Loads { body_pa: 2e3, actuator_pa: [20e3, 12e3, 20e3, 20e3] };
    for (name, mut scenario) in in_space() {
        scenario.segments = 60;
        let there = [0.02, -0.05, 0.03];
        let loaded = scenario.with_effect("tip_load", &there).with_effect("gravity", &[0.4]);
        agree(name, compliance(&loaded, &loads), by_forces(&loaded, &loads, there, 1e-4), 1e-4);
        agree(name, compliance(&scenario, &loads), by_forces(&scenario, &loads, [0.0; 3], 1e-4), 2e-3);
    }
}
