//! Laws of robots in space: symmetries, limits and derivatives of the energy.

use super::frame::direction;
use super::section::StripSection;
use super::*;
use crate::{Loads, Model, Prediction, Scenario};
use std::f64::consts::TAU;

/// The robot of one actuator without the planar mechanics, with lines for `[actuator]` and strips.
pub(super) fn robot(kind: &str, actuator: &str, strips: &str) -> Scenario {
    let text = crate::shipped(&format!("{kind}-textbook")).unwrap();
    let text = text.replace("width_mm = 60", "width_mm = 50");
    let text = text.replace("max_pressure_kpa = 100", &format!("max_pressure_kpa = 100\n{actuator}\n{strips}"));
    let mut scenario = Scenario::parse(&text).unwrap_or_else(|e| panic!("{}", e.in_text(&text)));
    scenario.effects.retain(|effect| IN_SPACE.contains(&effect.name.as_str()));
    scenario
}

/// The same with the mechanics of pouches in the wall.
pub(super) fn full(actuator: &str, strips: &str) -> Scenario {
    let own: &[(&str, &[f64])] = &[
        ("weld_width", &[3e-3]),
        ("chord_arm", &[1.0]),
        ("displaced_gas", &[0.5]),
        ("sealed_sides", &[1.0]),
        ("fold_energy", &[5.37e-5]),
        ("fabric_stretch", &[2.33e-5]),
    ];
    own.iter().fold(robot("epam", actuator, strips), |robot, (name, values)| robot.with_effect(name, values))
}

/// Numbers between 0 and 1, the same for a seed.
pub(super) fn random(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    }
}

pub(super) fn at(scenario: &Scenario, kpa: [f64; 4]) -> (Model, Prediction) {
    let model = Model::new(scenario);
    let mut out = model.prediction();
    model.predict(&Loads { body_pa: 2e3, actuator_pa: kpa.map(|p| p * 1e3) }, &mut out).unwrap();
    (model, out)
}

fn bend(scenario: &Scenario, kpa: [f64; 4]) -> ([f64; 2], f64) {
    let (model, out) = at(scenario, kpa);
    let section = model.sections(&out).next().unwrap();
    (section.kappa, section.contraction)
}

const QUARTER: &str = "[[strip]]\nazimuth_deg = 90\nchannel = 1";
const OPPOSITE: &str = "[[strip]]\nazimuth_deg = 180\nchannel = 1";

#[test]
fn one_strip_anywhere_is_the_planar_robot_turned() {
    for (kind, p) in [("spam", 20.0), ("cpam", 15.0), ("epam", 30.0), ("fpam", 25.0)] {
        let (_, planar) = at(&robot(kind, "", ""), [p; 4]);
        for degrees in [-120.0, -90.0, 33.0, 90.0, 180.0] {
            let (_, turned) = at(&robot(kind, &format!("azimuth_deg = {degrees}"), ""), [p; 4]);
            let [cos, sin] = direction(f64::to_radians(degrees));
            assert!((turned.tip.angle_rad - planar.tip.angle_rad).abs() < 1e-14);
            for (i, [x, y]) in planar.markers.iter().enumerate() {
                let ([a, b], c) = (turned.markers[i], turned.markers_z_m[i]);
                let off = (a - x).abs().max((b - y * cos).abs()).max((c - y * sin).abs());
                assert!(off < 1e-15, "{kind} {degrees}: {off:e}");
            }
        }
    }
}

#[test]
fn the_convex_minimum_of_one_strip_is_the_planar_balance() {
    for (scenario, p) in [(full("azimuth_deg = 90", ""), 30e3), (robot("epam", "azimuth_deg = 90", ""), 8e3)] {
        let model = Model::new(&scenario);
        let section = StripSection::new(model.assembly(), 0, 2e3);
        let mut state = [StripState { p_act_pa: p, ..StripState::default() }];
        let alone = section.solve(&mut state).unwrap();
        let found = section.minimum(&mut state, [0.3, 1.5]).unwrap();
        let off = (found.kappa[1] / alone.kappa[1] - 1.0).abs();
        assert!(off < 1e-9 && found.kappa[0].abs() < 1e-9, "{:?} {:?}", found, alone);
    }
}

#[test]
fn a_strip_without_pressure_changes_no_bit() {
    let (alone, _) = bend(&robot("epam", "azimuth_deg = 0", QUARTER), [20.0, 0.0, 0.0, 0.0]);
    let (_, planar) = at(&robot("epam", "", ""), [20.0; 4]);
    assert_eq!(alone, [planar.work.states[0].curvature, 0.0]);
}

/// Beyond eight strips each finds its coordinate for itself.
#[test]
fn many_strips_of_which_two_pull_bend_as_these_two() {
    let pulling = "[[strip]]\nazimuth_deg = 270\nchannel = 1\n[[strip]]\nazimuth_deg = 310\nchannel = 2";
    let flat: String = (1..9).map(|i| format!("[[strip]]\nazimuth_deg = {}\nchannel = 0\n", 27 * i)).collect();
    let narrow = |strips: &str| {
        let text = crate::shipped("epam-textbook").unwrap().replace("width_mm = 60", "width_mm = 15");
        let text = text.replace("max_pressure_kpa = 100", &format!("max_pressure_kpa = 100\n{strips}"));
        Scenario::parse(&text).unwrap_or_else(|e| panic!("{}", e.in_text(&text)))
    };
    for (p, q) in [(20.0, 10.0), (30.0, 30.0), (8.0, 40.0), (90.0, 90.0)] {
        let (few, shorter) = bend(&narrow(pulling), [0.0, p, q, 0.0]);
        let (many, short) = bend(&narrow(&(flat.clone() + pulling)), [0.0, p, q, 0.0]);
        let off = (few[0] - many[0]).hypot(few[1] - many[1]) + (short - shorter).abs();
        assert!(few[1] < -0.1 && off < 1e-9, "{p}, {q}: {few:?} {many:?}");
    }
}

#[test]
fn two_equal_strips_at_a_right_angle_bend_half_way_between() {
    for scenario in [robot("epam", "", QUARTER), robot("fpam", "", QUARTER), full("", QUARTER)] {
        for p in [8.0, 20.0, 40.0] {
            let ([y, z], contraction) = bend(&scenario, [p; 4]);
            assert!(y > 0.1 && (y - z).abs() < 1e-9 * y, "{p}: {y} {z}");
            assert!(contraction >= 0.04 * y.hypot(z) * (1.0 - 1e-12));
        }
    }
}

#[test]
fn antagonists_shorten_the_body_and_make_it_stiff() {
    for scenario in [robot("epam", "", OPPOSITE), full("", OPPOSITE)] {
        let mut before = 0.0;
        for p in [10.0, 20.0, 40.0] {
            let ([y, z], contraction) = bend(&scenario, [p; 4]);
            assert!(y.hypot(z) < 1e-9 && contraction > before, "{p}: {y} {z} {contraction}");
            before = contraction;
            // Stiffness against a small difference of pressures falls as both rise: more of it bends less.
        }
        let softness = |p: f64| bend(&scenario, [p * 1.01, p * 0.99, 0.0, 0.0]).0[0];
        assert!(softness(10.0) > 0.0 && softness(40.0) < softness(10.0));
    }
}

/// Without bending stiffness, closed form: each antagonist pulls half of the gas' thrust, P W L₀ cosθ/θ = ½ p_b π R².
#[test]
fn each_antagonist_pulls_half_of_the_thrust() {
    let (model, out) = at(&robot("epam", "", OPPOSITE), [20.0; 4]);
    let section = model.sections(&out).next().unwrap();
    let thrust = 2e3 * std::f64::consts::PI * 0.04 * 0.04;
    for strip in section.strips {
        let theta = strip.coordinate;
        assert!((strip.tension / (0.5 * thrust) - 1.0).abs() < 1e-9, "{}", strip.tension);
        assert!((20e3 * 0.05 * 0.06 * theta.cos() / theta / strip.tension - 1.0).abs() < 1e-9);
        assert!((section.contraction - (1.0 - theta.sin() / theta)).abs() < 1e-12);
    }
}

#[test]
fn forces_are_the_slopes_of_the_energy() {
    let third = "[[strip]]\nazimuth_deg = 100\nchannel = 1\n[[strip]]\nazimuth_deg = -95\nchannel = 2";
    let grown = robot("epam", "", third).with_effect("arm_growth", &[0.5]);
    for scenario in [robot("epam", "", third), full("", third), robot("fpam", "", third), grown] {
        let scenario = scenario.with_bending(0.7);
        let model = Model::new(&scenario);
        let section = StripSection::new(model.assembly(), 0, 2e3);
        let mut strips = [30e3, 20e3, 25e3].map(|p_act_pa| StripState { p_act_pa, ..StripState::default() });
        for q in [[1.0, 0.4, 0.08], [-0.6, 1.2, 0.07], [0.2, 0.1, 0.1]] {
            let forces = section.forces(&mut strips, [q[0], q[1]], q[2]);
            for i in 0..3 {
                let mut energy = |h: f64| {
                    let mut moved = q;
                    moved[i] += h;
                    section.energy(&mut strips, [moved[0], moved[1]], moved[2])
                };
                let h = if i == 2 { 1e-4 } else { 1e-3 };
                let wide = (energy(h) - energy(-h)) / (2.0 * h);
                let narrow = (energy(0.5 * h) - energy(-0.5 * h)) / h;
                let slope = (4.0 * narrow - wide) / 3.0;
                let size = forces.iter().fold(1e-2_f64, |m, f| m.max(f.abs()));
                assert!((forces[i] + slope).abs() < 1e-6 * size, "{i} at {q:?}: {} and {slope}", forces[i]);
            }
        }
    }
}

#[test]
fn at_equilibrium_no_bend_and_no_contraction_has_less_energy() {
    let third = "[[strip]]\nazimuth_deg = 100\nchannel = 1\n[[strip]]\nazimuth_deg = -95\nchannel = 2";
    for pressures in [[30e3, 20e3, 25e3], [30e3, 3e3, 0.0], [8e3, 30e3, 5e3]] {
        let scenario = full("", third).with_bending(0.3);
        let model = Model::new(&scenario);
        let section = StripSection::new(model.assembly(), 0, 2e3);
        let mut strips = pressures.map(|p_act_pa| StripState { p_act_pa, ..StripState::default() });
        let at = section.solve(&mut strips).unwrap();
        let least = section.energy(&mut strips, at.kappa, at.contraction);
        for i in 0..24 {
            let e = direction(f64::from(i) * std::f64::consts::TAU / 24.0);
            for (size, shorter) in [(0.05, 0.0), (0.05, 4e-3), (0.0, 4e-3), (0.3, 0.0)] {
                let kappa = [at.kappa[0] + size * e[0], at.kappa[1] + size * e[1]];
                let contraction = (at.contraction + shorter).max(0.04 * kappa[0].hypot(kappa[1]));
                let more = section.energy(&mut strips, kappa, contraction);
                assert!(more > least - 1e-9 * least.abs(), "{pressures:?}: {more} below {least} towards {i}");
            }
        }
    }
}

/// A circular helix in the frame of its start: bend k towards `e`, turning by τ per length, contraction ε.
fn helix([ey, ez]: [f64; 2], k: f64, tau: f64, contraction: f64, s: f64) -> [f64; 3] {
    let (t, n, b) = ([1.0, 0.0, 0.0], [0.0, ey, ez], [0.0, -ez, ey]);
    let w = k.hypot(tau);
    // Rotation vector τ t + k b over w; ŵ × t = (k/w) n.
    let axis = frame::mix(tau / w, t, k / w, b);
    let along = tau / w;
    let (sin, cos) = (w * s).sin_cos();
    let ring = frame::mix(1.0, t, -along, axis);
    let part = frame::mix(along * s, axis, sin / w, ring);
    frame::mix(1.0 - contraction, part, (1.0 - contraction) * (1.0 - cos) / w * (k / w), n)
}

#[test]
fn a_helical_strip_makes_a_helix_and_sections_converge_with_their_square() {
    // The strip covers the body: its length is √(L² + (2πR)²) for one turn.
    let turns = 1.0;
    let mut misses = Vec::new();
    for segments in [10, 20, 40, 80] {
        let mut scenario = robot("epam", &format!("azimuth_deg = 30\nturns = {turns}"), "");
        scenario.segments = segments;
        let covered = scenario.actuator.covered_m(0.04);
        scenario.length_m = covered;
        scenario.markers_m.clear();
        let (model, out) = at(&scenario, [20.0; 4]);
        let section = model.sections(&out).next().unwrap();
        let k = section.kappa[0].hypot(section.kappa[1]);
        let tau = TAU * turns / covered;
        let tip = helix(direction(30f64.to_radians()), k, tau, section.contraction, covered);
        let found = [out.tip.x_m, out.tip.y_m, out.tip.z_m];
        misses.push((0..3).map(|i| (found[i] - tip[i]).powi(2)).sum::<f64>().sqrt());
    }
    for pair in misses.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.2, "{misses:?}");
    }
    assert!(misses[3] < 1e-3 * 0.36, "{misses:?}");
}

#[test]
fn a_slanted_strip_pulls_with_its_share() {
    // One strip: N cosβ D = π p_b R³, and cos²β κ D = ε.
    let mut scenario = robot("epam", "turns = 0.5", "");
    scenario.segments = 40;
    let (model, out) = at(&scenario, [20.0; 4]);
    let section = model.sections(&out).next().unwrap();
    let (cos, strip) = (scenario.actuator.cos_slant(0.04), section.strips[0]);
    let wanted = std::f64::consts::PI * 2e3 * 0.04_f64.powi(3);
    assert!((strip.tension * cos * 0.08 / wanted - 1.0).abs() < 1e-9);
    let strain = 1.0 - strip.coordinate.sin() / strip.coordinate;
    let kappa = section.kappa[0].hypot(section.kappa[1]);
    assert!((cos * cos * kappa * 0.08 / strain - 1.0).abs() < 1e-9);
}

#[test]
fn what_is_not_built_is_refused() {
    let two = robot("epam", "", QUARTER);
    let model = Model::new(&two);
    let mut out = model.prediction();
    let loads = Loads::uniform(2e3, 20e3);
    for (effect, values) in [("tip_spring", vec![1.0]), ("camera_scale", vec![0.02]), ("wrinkling", vec![1e-3])] {
        let model = Model::new(&two.with_effect(effect, &values));
        let told = model.predict(&loads, &mut model.prediction());
        assert!(matches!(told, Err(Unsolved::InSpace { .. })), "{effect}: {told:?}");
    }
    let limits = crate::Limits::up_to(30e3);
    let aimed = model.steer(crate::Aim::Tip([0.3, 0.1]), 2e3, &limits, &mut model.steering());
    assert!(matches!(aimed, Err(Unsolved::InSpace { .. })));
    let step = crate::Step { t_s: 0.0, loads };
    let held = model.hold(&[step], &[vec![1.0]], &mut out, &mut |_, _| ());
    assert!(matches!(held, Err(Unsolved::InSpace { .. })));
    assert!(crate::export::Table::new(&model, 2e3, [0.0, 30e3]).is_err());
    let making = crate::cutting::Making { weld_m: 3e-3, allowance_m: 1e-2 };
    assert!(crate::cutting::CuttingPlan::new(&two, &making).is_err());
}

#[test]
fn the_slopes_of_the_tip_are_those_of_two_predictions() {
    let model = Model::new(&full("", QUARTER));
    let loads = Loads { body_pa: 2e3, actuator_pa: [20e3, 12e3, 0.0, 0.0] };
    let slopes = model.jacobian(&loads, &mut model.prediction()).unwrap();
    let tip = |p: f64| {
        let mut out = model.prediction();
        model.predict(&Loads { actuator_pa: [20e3, p, 0.0, 0.0], ..loads }, &mut out).unwrap();
        out.tip.y_m
    };
    let slope = (tip(12.1e3) - tip(11.9e3)) / 200.0;
    assert!((slopes[1].y_per_pa / slope - 1.0).abs() < 1e-2, "{} {slope}", slopes[1].y_per_pa);
}

/// Curvatures at 20 kPa \[1/m\], guarded: the planar law of these robots.
const PLANAR: [(&str, f64); 8] = [
    ("spam", 1.529674298352632),
    ("cpam", 3.941626277598568),
    ("epam", 2.1257502281555443),
    ("fpam", 1.0944503665610517),
    ("spam-textbook", 3.3667842102841754),
    ("cpam-textbook", 4.030559589937582),
    ("epam-textbook", 4.030559589937582),
    ("fpam-textbook", 1.47361045223847),
];

#[test]
fn planar_robots_do_not_change_a_bit() {
    for (name, kappa) in PLANAR {
        let scenario = Scenario::parse(crate::shipped(name).unwrap()).unwrap();
        let (model, out) = at(&scenario, [20.0; 4]);
        assert!(!model.is_spatial() && model.sections(&out).next().is_none());
        assert_eq!(out.work.states[0].curvature, kappa, "{name}");
        assert!(out.tip.z_m == 0.0 && out.markers_z_m.iter().all(|z| *z == 0.0));
    }
}

/// A step of the search may try a bend whose taut wall alone would be shorter than nothing, and a slack body is flat along all bends.
#[test]
fn a_bare_helix_is_solved() {
    let helix = robot("epam", "turns = 0.5", "").bare();
    let mut before = 0.0;
    for i in 1..=250 {
        let angle = at(&helix, [0.4 * f64::from(i); 4]).1.tip.angle_rad;
        assert!(angle > before && angle < 8.0, "{} kPa: {angle} rad", 0.4 * f64::from(i));
        before = angle;
    }
}

impl StripSection<'_> {
    /// Energy per metre at any bend and contraction, strips settled \[J/m\].
    pub(crate) fn energy(&self, strips: &mut [StripState], kappa: [f64; 2], contraction: f64) -> f64 {
        self.acting(strips);
        self.pulls(strips, kappa, contraction);
        let mut sum = 0.0;
        self.energies(&Bend { kappa, contraction }, strips, &mut |_, energy| sum += energy);
        sum
    }

    /// Forces on κ and ε₀ there, of everything but the constraint.
    pub(crate) fn forces(&self, strips: &mut [StripState], kappa: [f64; 2], contraction: f64) -> [f64; 3] {
        self.acting(strips);
        let pulls = self.pulls(strips, kappa, contraction);
        let by = |i: usize| pulls.moment[i] - self.p_body_pa * self.moment_m3[i] - self.bending * kappa[i];
        [by(0), by(1), pulls.force - self.p_body_pa * self.area_m2]
    }
}
