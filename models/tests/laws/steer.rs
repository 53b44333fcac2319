//! Steering by several channels: it undoes the prediction, and says what holds it back.

use crate::support::*;
use models::{Aim, End, Limits, Loads, Model, Scenario, Target, Unsolved, shipped};

/// Zones of a channel each, over equal parts of the body.
fn with_channels(actuator: &str, count: usize) -> Scenario {
    let zone = |i: usize| {
        let [from, to] = [i, i + 1].map(|k| 360 * k / count);
        format!("\n[[zone]]\nfrom_mm = {from}\nto_mm = {to}\nchannel = {i}\n")
    };
    let zones: String = (0..count).map(zone).collect();
    Scenario::parse(&(shipped(actuator).unwrap().to_string() + &zones)).unwrap()
}

#[test]
fn with_one_channel_it_is_the_inverse() {
    for actuator in actuators() {
        let model = Model::new(&robot(actuator));
        let (mut work, mut state) = (model.steering(), model.prediction());
        for p in [1e3, 4e3, 12e3, 25e3, 45e3] {
            let tip = predicted(&model, &Loads::uniform(2e3, p)).unwrap().tip;
            let aim = Aim::Tip([tip.x_m, tip.y_m]);
            let found = model.steer(aim, 2e3, &Limits::up_to(50e3), &mut work).unwrap();
            let inverse = model.pressure_for(Target::TipHeight(tip.y_m), 2e3, &mut state).unwrap();
            assert!((found.loads.actuator_pa[0] / inverse - 1.0).abs() < 1e-6, "{actuator} {p}: {found:?} {inverse}");
            assert!(found.miss_m < 1e-9 && found.held == [None; 4], "{actuator} {p}: {found:?}");
        }
    }
}

#[test]
fn two_channels_reach_every_tip_that_they_can_make() {
    let gravity = with_channels("fpam-textbook", 2).with_effect("gravity", &[0.5]);
    let robots =
        [with_channels("epam-textbook", 2), with_channels("spam", 2), with_channels("cpam-textbook", 2), gravity];
    for scenario in robots {
        let model = Model::new(&scenario);
        let mut work = model.steering();
        for [a, b] in [0.0, 3e3, 9e3, 20e3, 40e3].iter().flat_map(|a| [0.0, 5e3, 14e3, 39e3].map(|b| [*a, b])) {
            let loads = Loads { body_pa: 2e3, actuator_pa: [a, b, 0.0, 0.0] };
            let tip = predicted(&model, &loads).unwrap().tip;
            let found = model.steer(Aim::Tip([tip.x_m, tip.y_m]), 2e3, &Limits::up_to(50e3), &mut work).unwrap();
            assert!(found.miss_m < 1e-9, "{} {a} {b}: {found:?}", scenario.name);
            let back = predicted(&model, &found.loads).unwrap();
            assert!((back.tip.x_m - tip.x_m).hypot(back.tip.y_m - tip.y_m) < 1e-9 && back == *work.state());
        }
    }
}

#[test]
fn markers_tell_four_pressures_apart() {
    let model = Model::new(&with_channels("epam-textbook", 4));
    let mut random = Random(11);
    for _ in 0..5 {
        let actuator_pa = [0; 4].map(|_| random.between(3e3, 40e3));
        let markers = predicted(&model, &Loads { body_pa: 2e3, actuator_pa }).unwrap().markers;
        let found = model.steer(Aim::Markers(&markers), 2e3, &Limits::up_to(50e3), &mut model.steering()).unwrap();
        let far = found.loads.actuator_pa.iter().zip(actuator_pa).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(far < 1e-5, "{actuator_pa:?}: {found:?}");
    }
}

#[test]
fn out_of_reach_it_comes_as_near_as_any_pressure_and_names_the_limit() {
    let model = Model::new(&with_channels("epam-textbook", 2));
    let limits = Limits::up_to(30e3);
    for (wanted, held) in [
        ([0.0, 0.3], [Some(End::Most), Some(End::Most)]),
        ([0.5, 0.0], [Some(End::Least), Some(End::Least)]),
        ([0.30, 0.25], [Some(End::Most), Some(End::Least)]),
    ] {
        let found = model.steer(Aim::Tip(wanted), 2e3, &limits, &mut model.steering()).unwrap();
        let far = |loads: &Loads| {
            let tip = predicted(&model, loads).unwrap().tip;
            (tip.x_m - wanted[0]).hypot(tip.y_m - wanted[1])
        };
        let grid = (0..=60).flat_map(|i| (0..=60).map(move |j| [i, j].map(|k| 30e3 * f64::from(k * k) / 3600.0)));
        let nearest =
            grid.map(|[a, b]| far(&Loads { body_pa: 2e3, actuator_pa: [a, b, 0.0, 0.0] })).fold(1.0, f64::min);
        assert!(found.miss_m <= nearest + 1e-9, "{wanted:?}: {} {nearest}", found.miss_m);
        assert!((found.miss_m - far(&found.loads)).abs() < 1e-12);
        assert_eq!(&found.held[..2], held, "{wanted:?}: {found:?}");
        let limit = held.map(|end| if end == Some(End::Most) { 30e3 } else { 0.0 });
        assert_eq!(&found.loads.actuator_pa[..2], limit, "the limit itself, and no rounding of it");
    }
}

#[test]
fn within_a_rate_it_goes_as_far_as_it_may() {
    let model = Model::new(&with_channels("epam-textbook", 2));
    let now = [10e3, 20e3, 0.0, 0.0];
    let goal = predicted(&model, &Loads { body_pa: 2e3, actuator_pa: [20e3, 12e3, 0.0, 0.0] }).unwrap().tip;
    let limits = Limits::up_to(50e3).near(&now, 1e3);
    let found = model.steer(Aim::Tip([goal.x_m, goal.y_m]), 2e3, &limits, &mut model.steering()).unwrap();
    let change = [0, 1].map(|i: usize| found.loads.actuator_pa[i] - now[i]);
    assert!(change.iter().all(|c| c.abs() <= 1e3 + 1e-9) && (change[0] - 1e3).abs() < 1e-9, "{found:?}");
    assert_eq!(found.held[0], Some(End::Most));
}

#[test]
fn an_aim_that_means_nothing_is_refused() {
    let model = Model::new(&with_channels("epam-textbook", 2));
    let mut work = model.steering();
    let mut steer = |aim, limits: &Limits| model.steer(aim, 2e3, limits, &mut work).unwrap_err();
    let all = Limits::up_to(50e3);
    let crossed = Limits { least_pa: [2e3; 4], most_pa: [1e3; 4] };
    assert!(matches!(steer(Aim::Tip([f64::NAN, 0.0]), &all), Unsolved::BadAim { .. }));
    assert!(matches!(steer(Aim::Markers(&[[0.0; 2]]), &all), Unsolved::BadAim { .. }));
    assert!(matches!(steer(Aim::Tip([0.1, 0.1]), &crossed), Unsolved::BadAim { .. }));
    assert!(matches!(steer(Aim::Tip([0.1, 0.1]), &Limits::up_to(f64::NAN)), Unsolved::BadPressure { .. }));
}
