//! The catalogue is complete, and every entry says what a diagnosis needs.

use crate::support::*;
use models::effects::{EFFECTS, Fitted, Group, Stage};
use models::{Loads, Model};

/// Names in the order of the catalogue.
const NAMES: &[&str] = &[
    "chord_arm",
    "weld_width",
    "end_constraint",
    "end_fittings",
    "arm_growth",
    "sunk_muscle",
    "yarn_stretch",
    "glued_face",
    "flat_ends",
    "fabric_stretch",
    "ovalization",
    "shear_stiffness",
    "shear_lock",
    "seam_stiffness",
    "displaced_gas",
    "gussets",
    "sealed_sides",
    "roofed_welds",
    "fold_energy",
    "crimped_sides",
    "stuck_face",
    "wrinkled_sheets",
    "self_contact",
    "weak_place",
    "wrinkling",
    "softening",
    "tail_tension",
    "base_clamp",
    "tip_clamp",
    "tapered_wall",
    "initial_curvature",
    "plastic_set",
    "friction",
    "creep",
    "gravity",
    "tip_load",
    "tip_spring",
    "pressure_offset",
    "pressure_loss",
    "body_pressure_offset",
    "leak",
    "gauge_drift",
    "gauge_curve",
    "regulator_hysteresis",
    "body_leak",
    "sealed_body",
    "marker_height",
    "mount_rotation",
    "camera_scale",
    "camera_rotation",
    "camera_tilt",
    "camera_lens",
    "camera_moved",
    "clock_lag",
];

#[test]
fn the_catalogue_has_these_effects() {
    assert_eq!(EFFECTS.iter().map(|e| e.name).collect::<Vec<_>>(), NAMES);
}

#[test]
fn every_entry_has_its_words_and_its_numbers_within_bounds() {
    for effect in EFFECTS {
        for text in [effect.sentence, effect.differs, effect.remedy] {
            assert!(text.ends_with(['.', '?']) && text.len() > 20, "{}: {text}", effect.name);
        }
        assert!(!effect.formula.is_empty() && !effect.validity.is_empty() && !effect.reference.is_empty());
        assert_eq!(effect.stage == Stage::Camera, effect.group == Group::Measurement, "{}", effect.name);
        assert_eq!(effect.stage == Stage::Supply, effect.group == Group::Supply, "{}", effect.name);
        for p in effect.parameters {
            let inside = |v: f64| (p.lower..=p.upper).contains(&v);
            let sizes =
                p.by_actuator.iter().map(|(_, v)| *v).chain(p.starts.iter().copied()).chain([p.typical, p.neutral]);
            assert!(sizes.into_iter().all(inside), "{} {}", effect.name, p.key);
            let possible = p.possible[0] <= p.lower && p.upper <= p.possible[1] && !p.is_possible(f64::NAN);
            assert!(possible && !p.is_possible(f64::INFINITY), "{} {}", effect.name, p.key);
            assert!(p.by_actuator.iter().all(|(name, _)| actuators().any(|a| a == *name)), "{}", effect.name);
            // The usual form of a law is a start as well.
            let fewest = if p.fitted == Fitted::Shape { 1 } else { 3 };
            assert!(p.starts.is_empty() || (fewest..=5).contains(&p.starts.len()), "{} {}", effect.name, p.key);
        }
    }
}

#[test]
fn an_effect_has_history_where_it_says_so() {
    for actuator in actuators() {
        let base = robot(actuator).with_bending(1.0);
        for effect in applicable(&base) {
            let model = Model::new(&base.with_effect(effect.name, &effect.typical_for(actuator)));
            assert_eq!(model.has_history(), effect.history, "{actuator} {}", effect.name);
        }
    }
}

#[test]
fn clamps_hold_their_own_end_and_flattening_bends_more_per_stroke() {
    for actuator in actuators() {
        let base = robot(actuator).bare().with_bending(1.0);
        let curvatures = |name: &str, value: f64| -> Vec<f64> {
            let model = Model::new(&base.with_effect(name, &[value, 1.5]));
            let at = predicted(&model, &Loads::uniform(2e3, 20e3)).unwrap();
            model.curvatures(&at).map(|(_, kappa)| kappa).collect()
        };
        let free = predict(&base, 2e3, 20e3);
        let free = Model::new(&base).curvatures(&free).next().unwrap().1;
        let (clamped, capped) = (curvatures("base_clamp", 2.0), curvatures("tip_clamp", 2.0));
        assert!(
            clamped[0] < 0.9 * free && clamped.windows(2).take(6).all(|pair| pair[1] > pair[0]),
            "{actuator}: {clamped:?}"
        );
        assert!((clamped[9] / free - 1.0).abs() < 0.05 && (capped[0] / free - 1.0).abs() < 0.05, "{actuator}");
        assert!(capped[9] < capped[5] && capped[9] < free, "{actuator}: {capped:?}");
        let model = Model::new(&base.with_effect("ovalization", &[0.01]));
        let at = predicted(&model, &Loads::uniform(2e3, 20e3)).unwrap();
        let state = &model.states(&at)[0];
        let site = &model.assembly().sites[0];
        let stroke = (site.actuator.unwrap().stroke)(&site.shape, state.coordinate);
        assert!(state.curvature > stroke.contraction / site.linkage.arm_m, "{actuator}: {state:?}");
    }
}

#[test]
fn folds_under_a_muscle_stop_it_near_the_turn_at_which_they_close() {
    let base = robot("fpam").bare();
    let curvature = |touch: f64, p: f64| {
        let model = Model::new(&base.with_effect("self_contact", &[1000.0, touch]));
        model.states(&predicted(&model, &Loads::uniform(2e3, p)).unwrap())[0].curvature
    };
    for (touch, p) in [(0.6, 20e3), (1.0, 20e3), (1.0, 30e3)] {
        let at = curvature(touch, p);
        assert!(at > touch && at < touch + 0.02, "{touch} {p}: {at}");
    }
    assert_eq!(curvature(3.0, 30e3), curvature(4.0, 30e3), "out of reach");
}

#[test]
fn a_jammed_weave_stops_the_muscle_near_its_angle() {
    let base = robot("fpam").bare();
    let contraction = |lock: f64, p: f64| {
        let model = Model::new(&base.with_effect("shear_lock", &[lock, 2000.0]));
        model.states(&predicted(&model, &Loads::uniform(2e3, p)).unwrap())[0].coordinate
    };
    let locked = |lock: f64| 1.0 - std::f64::consts::SQRT_2 * (0.5 * lock + std::f64::consts::FRAC_PI_4).cos();
    for lock in [0.1, 0.2] {
        for p in [20e3, 30e3] {
            let at = contraction(lock, p);
            assert!(at > locked(lock) && at < locked(lock) + 0.02, "{lock} {p}: {at} {}", locked(lock));
        }
    }
    assert_eq!(contraction(0.4, 30e3), contraction(1.0, 30e3), "out of reach");
}
