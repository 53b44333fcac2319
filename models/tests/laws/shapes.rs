//! Numbers that shape a law, where a closed form of the other shape exists.

use crate::support::*;
use models::{Model, Pose, Scenario, Supply};

const BODY: f64 = 2e3;

fn held(held_s: f64) -> models::Moment {
    models::Moment { held_s, ..Default::default() }
}

/// Torricelli: a closed volume that empties through a hole, p = p₀ (1 − ½ r t √(P_r/p₀))².
#[test]
fn a_leak_through_a_hole_is_torricellis() {
    let robot = robot("spam");
    let through = |k: f64| Supply::of(&robot.with_effect("leak", &[0.05, k]));
    for (p, t) in [(5e3, 1.0), (20e3, 4.0), (30e3, 10.0)] {
        let exact = p * (1.0 - 0.5 * 0.05 * t * (20e3_f64 / p).sqrt()).powi(2);
        assert!((through(0.5).pressure(p, &held(t)) / exact - 1.0).abs() < 1e-12, "{p} {t}");
        let pores = p * (-0.05_f64 * t).exp();
        assert!((through(1.0 + 1e-7).pressure(p, &held(t)) / pores - 1.0).abs() < 1e-6, "{p} {t}: no jump at k = 1");
    }
    assert_eq!(through(0.5).pressure(10.0, &held(60.0)), 0.0, "a hole empties it, pores never do");
    assert_eq!(through(0.5).pressure(0.0, &held(60.0)), 0.0);
}

/// Markers and heading of the tip at 20 kPa.
fn seen(scenario: &Scenario) -> (Vec<[f64; 2]>, f64) {
    let at = predict(scenario, BODY, 20e3);
    (at.markers.clone(), at.tip.angle_rad)
}

#[test]
fn a_camera_that_turns_about_a_point_keeps_every_distance_to_it() {
    let base = robot("epam").with_bending(1.0);
    let (length, angle) = (base.length_m, 0.03_f64);
    let (plain, turned) = (seen(&base).0, seen(&base.with_effect("camera_rotation", &[angle, 0.5])).0);
    for (a, b) in plain.iter().zip(&turned) {
        let (from, to) = ([a[0] - 0.5 * length, a[1]], [b[0] - 0.5 * length, b[1]]);
        assert!((from[0].hypot(from[1]) - to[0].hypot(to[1])).abs() < 1e-14);
        let turn = (from[0] * to[1] - from[1] * to[0]).atan2(from[0] * to[0] + from[1] * to[1]);
        assert!((turn - angle).abs() < 1e-12);
    }
}

/// A pin is rigid: its head, from the place on the axis that it is on, keeps its length and turns with the body.
#[test]
fn pins_that_lean_are_as_long_as_ever() {
    let base = robot("epam").with_bending(1.0);
    let (height, lean) = (0.01, 0.3_f64);
    let along = height * lean.tan();
    let (plain, pinned) = (seen(&base).0, seen(&base.with_effect("marker_height", &[height, lean])).0);
    for (a, b) in plain.iter().zip(&pinned) {
        let head = [b[0] - a[0] + along, b[1] - a[1] + height];
        assert!((head[0].hypot(head[1]) - height / lean.cos()).abs() < 1e-14, "{head:?}");
    }
    let upright = seen(&base.with_effect("marker_height", &[height])).0;
    let outermost = upright.iter().zip(&pinned).next_back().map(|(a, b)| b[1] - a[1]).unwrap();
    assert!(outermost > 0.0, "the bend lifts a pin that leans to the tip above an upright one: {outermost}");
}

/// The flattening at 2 /m is that of any exponent, and κ rises with g.
#[test]
fn exponents_of_a_section_agree_where_they_are_measured() {
    let law = |n: f64, g: f64| {
        let model = Model::new(&robot("spam").with_effect("ovalization", &[0.05, n]));
        model.assembly().sites[0].linkage.bent(g)
    };
    for n in [0.5, 1.0, 1.9, 2.0, 3.3] {
        assert!((law(n, 2.0).0 - 2.0 * (1.0 + 0.05 * 4.0)).abs() < 1e-12, "{n}");
        for g in [0.3, 1.0, 4.0] {
            let slope = (law(n, g + 1e-6).0 - law(n, g - 1e-6).0) / 2e-6;
            assert!((law(n, g).1 / slope - 1.0).abs() < 1e-6 && slope > 0.0, "{n} {g}");
        }
    }
}

/// At a reach from the end every clamp has e⁻¹ of its stiffness; one that ends suddenly has all of it before, and none beyond.
#[test]
fn a_clamp_may_end_suddenly() {
    let base = robot("epam").with_bending(1.0);
    let moment = |end: f64, radii: f64| {
        let model = Model::new(&base.with_effect("base_clamp", &[2.0, 1.5, end]));
        let site = &model.assembly().sites[0];
        let mut force = [0.0; 3];
        let at = Pose { q: &[1.0], p_body_pa: BODY, p_act_pa: 0.0, s_m: radii * site.radius_m, dt_s: 0.0, memory: &[] };
        let clamp = site.body_terms.iter().find(|term| term.line().name == "base_clamp").unwrap();
        clamp.add(&at, &mut force);
        -force[0]
    };
    for end in [0.5, 1.0, 3.0, 40.0] {
        assert!((moment(end, 1.5) - 2.0 * (-1.0_f64).exp()).abs() < 1e-12, "{end}");
    }
    assert!((moment(40.0, 1.2) - 2.0).abs() < 1e-3 && moment(40.0, 1.8) < 1e-9);
}
