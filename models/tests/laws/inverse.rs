//! The inverse undoes the prediction, and the Jacobian is its slope.

use crate::support::*;
use models::{Loads, Model, Scenario, Target, TipSlope, Unsolved};

fn robots() -> Vec<(String, Scenario)> {
    let sets = |a: &'static str| {
        let loaded = robot(a).with_bending(0.6).with_effect("gravity", &[1.0]).with_effect("tip_load", &[0.1, -0.15]);
        [
            (format!("{a} bare"), robot(a).bare()),
            (format!("{a} B"), robot(a).with_bending(1.2)),
            (format!("{a} loaded"), loaded),
            // Yarns that give let two pressures reach one tip.
            (format!("{a} everything"), without_cell(&everything(a))),
        ]
    };
    actuators().flat_map(sets).collect()
}

#[test]
fn the_inverse_of_a_prediction_returns_its_pressure() {
    for (name, scenario) in robots() {
        let model = Model::new(&scenario);
        let mut out = model.prediction();
        for p in [500.0, 2e3, 8e3, 20e3, 33e3, 70e3] {
            let tip = predicted(&model, &Loads::uniform(2e3, p)).unwrap().tip;
            for target in [Target::TipHeight(tip.y_m), Target::Angle(tip.angle_rad)] {
                let found = model.pressure_for(target, 2e3, &mut out).unwrap_or_else(|e| panic!("{name} {p}: {e}"));
                assert!((found / p - 1.0).abs() < 1e-8, "{name} {target:?} at {p}: {found}");
                assert!((out.tip.y_m - tip.y_m).abs() < 1e-10, "{name} {p}: the state is that of the target");
                assert_eq!(out.markers, predicted(&model, &Loads::uniform(2e3, found)).unwrap().markers);
            }
        }
    }
}

#[test]
fn the_jacobian_at_the_largest_pressure_continues_those_below_it() {
    for kind in ["spam", "cpam", "epam", "fpam"] {
        let model = Model::new(&robot(kind));
        let slope = |p: f64| {
            let [TipSlope { x_per_pa, y_per_pa, angle_per_pa }, ..] =
                model.jacobian(&Loads::uniform(2e3, p), &mut model.prediction()).unwrap();
            [x_per_pa, y_per_pa, angle_per_pa]
        };
        let [at, near, far] = [1e6, 0.999e6, 0.998e6].map(slope);
        for i in 0..3 {
            let continued = 2.0 * near[i] - far[i];
            assert!((at[i] / continued - 1.0).abs() < 2e-5, "{kind} {i}: {:e} and {continued:e}", at[i]);
        }
    }
}

#[test]
fn a_target_out_of_reach_is_refused_with_the_reachable_range() {
    for (name, scenario) in robots() {
        let model = Model::new(&scenario);
        let mut out = model.prediction();
        for target in [0.5, -0.5] {
            let error = model.pressure_for(Target::TipHeight(target), 2e3, &mut out).unwrap_err();
            let Unsolved::OutOfReach { lowest, highest, p_max_kpa, .. } = error else { panic!("{name}: {error}") };
            let at = |p: f64| 1e3 * predicted(&model, &Loads::uniform(2e3, p)).unwrap().tip.y_m;
            let (none, most) = (at(0.0), at(1e3 * p_max_kpa));
            assert!(lowest <= none + 1e-9 && highest >= most - 1e-9, "{name}: {error}, {none} {most}");
            if !name.ends_with("everything") {
                assert!((lowest - none).abs() < 1e-9 && (highest - most).abs() < 1e-9, "{name} is monotone: {error}");
            }
            assert!(error.to_string().contains(&format!("{lowest:.4} to {highest:.4} mm")), "{error}");
        }
    }
}

#[test]
fn a_nonsense_target_or_pressure_is_an_error() {
    let model = Model::new(&robot("epam"));
    let mut out = model.prediction();
    assert!(model.pressure_for(Target::Angle(f64::NAN), 2e3, &mut out).is_err());
    assert!(model.pressure_for(Target::Angle(0.3), -1.0, &mut out).is_err());
    assert!(model.predict(&Loads::uniform(2e3, f64::NAN), &mut out).is_err());
    assert!(model.predict(&Loads::uniform(f64::INFINITY, 1e3), &mut out).is_err());
}

#[test]
fn the_jacobian_is_the_slope_of_the_tip() {
    for (name, scenario) in robots() {
        let model = Model::new(&scenario);
        for p in [2e3, 10e3, 30e3, 80e3] {
            let loads = Loads::uniform(2e3, p);
            let tip = |q: f64| predicted(&model, &Loads::uniform(2e3, q)).unwrap().tip;
            let slopes = model.jacobian(&loads, &mut model.prediction()).unwrap();
            assert_eq!(slopes[1], TipSlope { x_per_pa: 0.0, y_per_pa: 0.0, angle_per_pa: 0.0 });
            let TipSlope { x_per_pa, y_per_pa, angle_per_pa } = slopes[0];
            let parts = |tip: models::Tip| [tip.x_m, tip.y_m, tip.angle_rad];
            for (i, computed) in [x_per_pa, y_per_pa, angle_per_pa].into_iter().enumerate() {
                // Corners of the moment (hinge, first wrinkle) spoil some steps: the best of four counts.
                let error = |h: f64| (computed / slope(|q| parts(tip(q))[i], p, h * p) - 1.0).abs();
                let best = [1e-2, 3e-3, 1e-3, 3e-4].map(error).into_iter().fold(f64::INFINITY, f64::min);
                assert!(best < 1e-6, "{name} {p}: {computed:e}, relative error {best:e}");
            }
        }
    }
}

/// A load against the bend presses a pouch flat: it opens with a step, which no slope contains.
#[test]
fn no_slope_crosses_the_pressure_at_which_a_pouch_opens() {
    let model = Model::new(&full("epam").with_effect("gravity", &[1.5]));
    let mut at = model.prediction();
    let mut coordinate = |p: f64| {
        model.predict(&Loads::uniform(2e3, p), &mut at).unwrap();
        model.states(&at)[0].coordinate
    };
    let (mut low, mut high) = (1e3, 3e3);
    while high - low > 1e-9 * high {
        let middle = 0.5 * (low + high);
        *(if coordinate(middle) == 0.0 { &mut low } else { &mut high }) = middle;
    }
    let mut out = model.prediction();
    let mut slope = |p: f64| model.jacobian(&Loads::uniform(2e3, p), &mut out).unwrap()[0].y_per_pa;
    for off in [1e-6, 1e-5, 1e-4, 3e-4, 1e-3] {
        // Below it is flat, as far as it is held shut: that has no slope.
        assert!(slope(low * (1.0 - off)).is_nan(), "{off} below");
        let above = slope(high * (1.0 + off));
        assert!(above.abs() < 2e-6, "{off} above: {above:e} m/Pa");
        let rises = |p: f64| {
            let tip = |p: f64| predicted(&model, &Loads::uniform(2e3, p)).unwrap().tip.y_m;
            (tip(p * 1.00001) - tip(p)) / (1e-5 * p)
        };
        let size = rises(high * 1.002).abs();
        assert!((above - rises(high * (1.0 + off))).abs() < 0.1 * size, "{off}: {above:e} {size:e}");
    }
}
