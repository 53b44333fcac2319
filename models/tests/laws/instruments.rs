//! What instruments and single places do, against closed forms and against the robot at other pressures and times.

use crate::support::*;
use models::{Loads, Model, Scenario, Step};

const PA: f64 = 20e3;
const BODY_PA: f64 = 2e3;

fn seen(scenario: &Scenario, loads: &Loads) -> Vec<[f64; 2]> {
    predicted(&Model::new(scenario), loads).unwrap().markers
}

/// Markers of every step of a protocol.
fn walked(scenario: &Scenario, steps: &[Step]) -> Vec<Vec<[f64; 2]>> {
    let model = Model::new(scenario);
    let (mut state, mut all) = (model.prediction(), Vec::new());
    model.follow(steps, &mut state, &mut |_, at| all.push(at.markers.clone())).unwrap();
    all
}

fn step(t_s: f64, p: f64) -> Step {
    Step { t_s, loads: Loads::uniform(BODY_PA, p) }
}

fn near(a: &[[f64; 2]], b: &[[f64; 2]], tolerance_m: f64) {
    for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
        assert!((a - b).abs() < tolerance_m, "{a} {b}");
    }
}

fn bent() -> Scenario {
    robot("epam").with_bending(1.0)
}

#[test]
fn a_lens_moves_a_point_by_the_cube_of_its_distance_from_the_axis() {
    let loads = Loads::uniform(BODY_PA, PA);
    let (plain, through) = (seen(&bent(), &loads), seen(&bent().with_effect("camera_lens", &[0.5, 0.0, 0.0]), &loads));
    for ([x, y], [u, v]) in plain.into_iter().zip(through) {
        let (r, moved) = (x.hypot(y), (u - x).hypot(v - y));
        assert!((moved - 0.5 * r.powi(3)).abs() < 1e-12 && (u * y - v * x).abs() < 1e-12);
    }
}

/// Two rotations about axes through the base and a pinhole at distance d, in full.
#[test]
fn a_tilted_camera_is_a_pinhole_in_front_of_a_turned_plane() {
    let (a, b, d) = (4_f64.to_radians(), 3_f64.to_radians(), 0.8);
    let loads = Loads::uniform(BODY_PA, PA);
    let plain = seen(&bent(), &loads);
    let pinhole = |[x, y]: [f64; 2]| {
        let (x, deep) = (x * a.cos(), x * a.sin());
        let (y, deep) = (y * b.cos() - deep * b.sin(), y * b.sin() + deep * b.cos());
        [x / (1.0 + deep / d), y / (1.0 + deep / d)]
    };
    let right: Vec<[f64; 2]> = plain.iter().copied().map(pinhole).collect();
    // The order of the two turns is left out: a b x across, 0.4 % of x.
    near(&seen(&bent().with_effect("camera_tilt", &[a, b, d]), &loads), &right, 0.004 * 0.5);
}

#[test]
fn pressures_that_instruments_hide_are_those_of_the_robot() {
    let shape = |body_pa: f64, p: f64| seen(&bent(), &Loads::uniform(body_pa, p));
    let at = |scenario: &Scenario, p: f64| seen(scenario, &Loads::uniform(BODY_PA, p));
    near(&at(&bent().with_effect("sealed_body", &[0.02]), PA), &shape(BODY_PA + 0.02 * PA, PA), 1e-9);
    near(&at(&bent().with_effect("gauge_curve", &[0.1]), 10e3), &shape(BODY_PA, 10e3 * 0.95), 1e-9);
    let steps = [step(1.0, 0.0), step(30.0, PA), step(60.0, 10e3)];
    let drifting = walked(&bent().with_effect("gauge_drift", &[10.0]), &steps);
    near(&drifting[1], &shape(BODY_PA, PA - 300.0), 1e-9);
    near(&drifting[2], &shape(BODY_PA, 10e3 - 600.0), 1e-9);
    let held = walked(&bent().with_effect("regulator_hysteresis", &[500.0]), &steps);
    near(&held[1], &shape(BODY_PA, PA), 1e-9);
    near(&held[2], &shape(BODY_PA, 10.5e3), 1e-9);
    let leaking = walked(&bent().with_effect("body_leak", &[0.01]), &steps);
    near(&leaking[1], &shape(BODY_PA * (-0.3_f64).exp(), PA), 1e-9);
}

#[test]
fn a_late_camera_shows_the_pressure_before_and_a_moved_one_shifts_what_follows() {
    let steps: Vec<Step> = (1..=8).map(|k| step(f64::from(k), if k <= 4 { 10e3 } else { PA })).collect();
    let (right, late) = (walked(&bent(), &steps), walked(&bent().with_effect("clock_lag", &[1.5, 0.0]), &steps));
    // The pressure changes right after 4 s, and is seen 1.5 s later.
    let shown = [0, 0, 0, 0, 0, 4, 4, 4];
    late.iter().zip(shown).for_each(|(seen, k)| near(seen, &right[k], 1e-9));
    let moved = walked(&bent().with_effect("camera_moved", &[5.5, 3e-3, -2e-3, 0.0]), &steps);
    for (k, (seen, right)) in moved.iter().zip(&right).enumerate() {
        let by = if steps[k].t_s >= 5.5 { [3e-3, -2e-3] } else { [0.0; 2] };
        let shifted: Vec<[f64; 2]> = right.iter().map(|[x, y]| [x + by[0], y + by[1]]).collect();
        near(seen, &shifted, 1e-9);
    }
}

/// Where no pressure arrives the robot stays straight, and elsewhere it bends as before.
#[test]
fn a_place_without_pressure_is_straight() {
    let (plain, weak) = (bent(), bent().with_effect("weak_place", &[1.0, 0.5, 1.5, 0.0]));
    let loads = Loads::uniform(BODY_PA, PA);
    let at = |scenario: &Scenario, share: f64| {
        let model = Model::new(scenario);
        let state = predicted(&model, &loads).unwrap();
        let is_there = |from_m: f64, to_m: f64| (from_m..=to_m).contains(&(share * scenario.length_m));
        model.curvatures(&state).find(|(s, _)| is_there(s.start_m, s.start_m + s.length_m)).unwrap().1
    };
    let [straight, usual] = [at(&weak, 0.5), at(&plain, 0.5)];
    assert!(straight.abs() < 0.02 * usual && usual > 0.2, "{straight} {usual}");
    assert!((at(&weak, 0.05) / at(&plain, 0.05) - 1.0).abs() < 1e-6);
    let above = bent().with_effect("weak_place", &[1.0, 0.5, 1.5, 10e3]);
    let halfway = seen(&bent(), &Loads::uniform(BODY_PA, 10e3));
    near(&seen(&above, &Loads::uniform(BODY_PA, 10e3)), &halfway, 1e-9);
}

/// A wall whose stiffness resists alone bends as 1/B(s) under one moment; the hinge of the body is the same everywhere.
#[test]
fn a_tapered_wall_bends_more_where_it_is_softer_and_in_its_middle_as_before() {
    let taper = bent().with_effect("tapered_wall", &[0.5]);
    let loads = Loads::uniform(BODY_PA, PA);
    let curvatures = |scenario: &Scenario| {
        let model = Model::new(scenario);
        let state = predicted(&model, &loads).unwrap();
        model.curvatures(&state).map(|(_, curvature)| curvature).collect::<Vec<_>>()
    };
    let (plain, tapered) = (curvatures(&bent())[0], curvatures(&taper));
    assert!(tapered.windows(2).all(|pair| pair[0] < pair[1]));
    assert!((tapered[tapered.len() / 2] / plain - 1.0).abs() < 0.03);
}
