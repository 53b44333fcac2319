//! The generator against the model, and against what must hold in general.

use super::measure::ideal;
use super::robot::TrueRobot;
use super::truth::{HiddenChoice, standard_protocol};
use super::*;
use compare::Evidence;
use compare::diagnosis::{Options, Verdict, diagnose};
use compare::study::generate::{Generator, generate};
use models::{Scenario, shipped};

fn scenario(kind: &str, bending: f64) -> Scenario {
    Scenario::parse(shipped(&format!("{kind}-textbook")).unwrap()).unwrap().with_bending(bending)
}

fn model(scenario: &Scenario) -> Vec<f64> {
    let quiet = Generator {
        runs: 1,
        camera_sd_m: 0.0,
        pressure_sd: 0.0,
        alignment_sd_m: 0.0,
        rotation_sd: 0.0,
        ..Default::default()
    };
    generate(scenario, "quiet", &quiet).unwrap().coordinates_m
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

fn rms(a: &[f64], b: &[f64]) -> f64 {
    (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
}

#[test]
fn without_a_hidden_effect_the_generator_is_the_model_within_20_micrometres() {
    for (kind, bending) in truth::ROBOTS {
        for bending in [0.0, bending] {
            let scenario = scenario(kind, bending);
            let made = ideal(&TrueRobot::new(&scenario).unwrap(), &Generator::default()).unwrap();
            let off = largest(&made, &model(&scenario));
            println!("{kind} B = {bending}: {:.2e} mm", 1e3 * off);
            assert!(off < 2e-5, "{kind}: {off}");
        }
    }
}

#[test]
fn every_effect_moves_the_markers_by_a_visible_but_not_absurd_amount() {
    for (laws, (kind, bending)) in
        [Laws::First, Laws::Second].into_iter().flat_map(|laws| truth::ROBOTS.map(|r| (laws, r)))
    {
        let scenario = scenario(kind, bending);
        let base = ideal(&TrueRobot::new(&scenario).unwrap(), &Generator::default()).unwrap();
        for effect in HIDDEN.iter().chain(ALSO).chain(OUTSIDE).filter(|effect| effect.applies_to(&scenario)) {
            let moved = |times: f64| {
                let mut robot = TrueRobot::new(&scenario).unwrap();
                let amount = times * effect.typical(laws, kind, &robot).unwrap();
                effect.put(laws, &mut robot, amount);
                1e3 * rms(&ideal(&robot, &Generator::default()).unwrap(), &base)
            };
            let (none, one, most) = (moved(0.0), moved(1.0), moved(1.5));
            println!("{laws:?} {kind:5} {:18} {one:7.3} mm, {most:7.3} mm", effect.name);
            assert!(none == 0.0, "{kind} {}: nothing of it must change nothing", effect.name);
            assert!(one > 0.02 && one < 30.0 && most >= one, "{laws:?} {kind} {}: {one} {most}", effect.name);
        }
    }
}

/// Sizes of second laws are no choice: they move the markers of the usual robot as far as the first ones do.
#[test]
fn a_second_law_moves_the_markers_as_far_as_the_first() {
    for (kind, _) in truth::ROBOTS {
        let usual = truth::usual(kind).unwrap();
        let bare = TrueRobot::new(&usual).unwrap();
        let base = ideal(&bare, &Generator::default()).unwrap();
        for effect in HIDDEN.iter().chain(ALSO).filter(|effect| effect.applies_to(&usual)) {
            let [first, second] = [Laws::First, Laws::Second].map(|laws| {
                let mut robot = bare.clone();
                effect.put(laws, &mut robot, effect.typical(laws, kind, &bare).unwrap());
                rms(&ideal(&robot, &Generator::default()).unwrap(), &base)
            });
            assert!((second / first - 1.0).abs() < 0.006, "{kind} {}: {first} {second}", effect.name);
        }
    }
}

#[test]
fn friction_and_set_leave_the_robot_bent_after_unloading_and_creep_moves_within_a_hold() {
    let made = |name: &str| {
        let truth = Truth { effects: vec![HiddenChoice { name: name.into(), times_typical: 1.0 }], ..plain("epam") };
        ideal(&truth.robot().unwrap(), &Generator::default()).unwrap()
    };
    let tip = |xy: &[f64], hold: usize, sample: usize| 1e3 * xy[(hold * 5 + sample) * 12 + 11];
    for name in ["friction", "plastic_set"] {
        assert!(tip(&made(name), 4, 4) > 1.0, "{name}: {}", tip(&made(name), 4, 4));
    }
    let creep = made("creep");
    assert!(tip(&creep, 3, 4) - tip(&creep, 3, 0) > 0.5);
    assert!((tip(&made("gravity"), 3, 4) - tip(&made("gravity"), 3, 0)).abs() < 1e-9);
}

#[test]
fn the_same_truth_gives_the_same_bytes_and_another_seed_other_ones() {
    let protocol = truth::standard_protocol();
    let data = |seed: u64| Truth { seed, ..plain("fpam") }.dataset("d", &protocol).unwrap();
    assert_eq!(data(1), data(1));
    assert_ne!(data(1), data(2));
}

#[test]
fn heavy_tails_have_the_same_spread_and_more_far_points() {
    let protocol = truth::standard_protocol();
    let quiet = Truth { runs: 100, camera_sd_m: 1e-3, pressure_sd: 0.0, alignment_sd_m: 0.0, ..plain("epam") };
    let residuals = |heavy_tails: bool| {
        let truth = Truth { heavy_tails, ..quiet.clone() };
        let exact = Truth { camera_sd_m: 0.0, ..truth.clone() }.dataset("d", &protocol).unwrap().coordinates_m;
        let seen = truth.dataset("d", &protocol).unwrap().coordinates_m;
        // The roll of the camera is common to both.
        seen.iter().zip(exact).map(|(a, b)| a - b).collect::<Vec<f64>>()
    };
    let far = |r: &[f64]| r.iter().filter(|v| v.abs() > 4e-3).count();
    let (normal, heavy) = (residuals(false), residuals(true));
    let sd = (normal.iter().map(|v| v * v).sum::<f64>() / normal.len() as f64).sqrt();
    assert!((sd / 1e-3 - 1.0).abs() < 0.05, "{sd}");
    // 4 mm of noise of 1 mm are 4√3 of Student's t; counts scatter by their root.
    let expected = normal.len() as f64 * compare::stats::two_sided_p(4.0 * 3f64.sqrt(), 3);
    let off = (far(&heavy) as f64 - expected).abs();
    assert!(far(&normal) < 12 && off < 4.0 * expected.sqrt(), "{} {} {expected}", far(&normal), far(&heavy));
}

#[test]
fn what_cannot_be_hidden_is_refused_with_the_known_names() {
    let with = |actuator: &str, name: &str| {
        let effects = vec![HiddenChoice { name: name.into(), times_typical: 1.0 }];
        Truth { effects, actuator: actuator.into(), ..plain("epam") }.robot().unwrap_err().to_string()
    };
    assert!(with("epam", "magic").contains("known: end_constraint"));
    assert!(with("epam", "shear_lock").contains("does not exist for a robot of actuator epam"));
    assert!(with("cpam", "end_constraint").contains("does not exist"));
    assert!(with("spam", "arm_growth").contains("does not exist"));
    assert!(with("nosuch", "creep").contains("known: spam, cpam, epam, fpam"));
}

fn plain(actuator: &str) -> Truth {
    let mut truth = Truth::draw(actuator, &mut Draw::new(7, 0)).unwrap();
    truth.runs = 2;
    truth
}

#[test]
fn a_camera_that_loses_markers_leaves_the_others_as_they_were() {
    let whole = Truth::draw("epam", &mut Draw::new(3, 1)).unwrap();
    let seen = |lost_markers: bool| {
        Truth { runs: 10, lost_markers, ..whole.clone() }.dataset("d", &standard_protocol()).unwrap()
    };
    let (all, lossy) = (seen(false), seen(true));
    assert_eq!(lossy.lost.unseen[..], [[3, 5]], "the outermost one leaves the picture at 30 kPa");
    let filled = lossy.lost.filled.len();
    assert!((5..=25).contains(&filled), "{filled} of about 300 times 0.05");
    let n = all.values_per_run();
    for (i, (a, b)) in all.coordinates_m.iter().zip(&lossy.coordinates_m).enumerate() {
        let (run, hold, marker) = (i / n, i % n / (n / 5), i / 2 % 6);
        assert!(a == b || lossy.is_lost(run, hold, marker), "{run} {hold} {marker}");
    }
}

/// Two effects with four parameters meet these data as well as the fault does with one.
#[test]
fn one_fault_is_a_simpler_answer_than_two_effects() {
    let (kind, fault, words) = ("cpam", "stuck_regulator", "the whole robot bends otherwise in hold 3 alone");
    let mut truth = Truth::draw(kind, &mut Draw::new(7, 0)).unwrap();
    truth.add(fault, 1.0);
    let truth = Truth { runs: 5, camera_sd_m: 1e-3, holds_scatter: false, ..truth };
    let data = truth.dataset("made", &standard_protocol()).unwrap();
    let options = Options::default().without_advice();
    let d = diagnose(&truth.told().unwrap(), &[Evidence::of(data, None)], &options, &mut |_, _| ()).unwrap();
    assert_eq!(d.verdict, Some(Verdict::OutOfCatalog), "{fault}: {:?}", d.summary);
    let pattern = d.pattern.as_ref().unwrap();
    assert!(pattern.words.contains(words), "{fault}: {pattern:?}");
    let either = d.summary.iter().any(|s| s.starts_with("Either ") && s.contains(" or one fault"));
    assert_eq!((either, d.is_either()), (pattern.either, pattern.either), "{:?}", d.summary);
}
