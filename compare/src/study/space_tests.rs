//! Comparisons in x, y and z.

use super::comparison::{Comparison, compare};
use super::generate::{Generator, generate};
use super::{Contender, Knob, compare_all};
use crate::diagnosis::{Options, pressure_slip};
use crate::evidence::Evidence;
use crate::{EvaluateOptions, ScenarioFile};
use data::Dataset;
use models::Scenario;

const TWO: &str = include_str!("../../../studies/epam-two-strips.toml");
const PROTOCOL: &str = "0/0,10/0,20/10,20/20,0/25,0/0@2";

fn robot(text: &str) -> Scenario {
    ScenarioFile::parse("robot", text).unwrap().scenario
}

fn alone(scenario: &Scenario, dataset: Dataset) -> Comparison {
    compare(scenario, &Evidence::of(dataset, None)).unwrap()
}

fn made(scenario: &Scenario, seed: u64) -> Dataset {
    let generator = Generator { runs: 5, seed, samples: 3, ..Generator::default() }.with_protocol(PROTOCOL).unwrap();
    generate(scenario, "made", &generator).unwrap()
}

/// p is uniform for the right robot, and small for one with narrower pouches.
#[test]
fn a_right_robot_agrees_and_a_wrong_one_does_not() {
    let (truth, other) = (robot(TWO), robot(&TWO.replace("width_mm = 50 ", "width_mm = 45 ")));
    for seed in 1..=6 {
        let found = alone(&truth, made(&truth, seed));
        let evaluation = &found.variants[0].evaluation;
        let all = &evaluation.metrics.overall;
        assert!(all.p_value.unwrap() > 1e-3 && found.error_mm() < 0.35, "{seed}: {all:?}");
        assert!((evaluation.noise.camera_mm.unwrap() - 1.0).abs() < 0.1, "{:?}", evaluation.noise);
        assert_eq!(evaluation.where_it_fails.len(), 1, "{seed}: {:?}", evaluation.where_it_fails);
        let [hold, cell] = [&evaluation.metrics.holds[2], &evaluation.metrics.holds[0]];
        assert_eq!((hold.label.p_act_channels_kpa.as_slice(), cell.paper_accuracy), (&[20.0, 10.0][..], None));
        assert!(hold.tip_error_z_mm.is_some() && evaluation.residual_map.cells[0][0].z.is_some());
        let wrong = alone(&other, found.dataset.clone());
        let evaluation = &wrong.variants[0].evaluation;
        assert!(
            wrong.error_mm() > 2.0 && evaluation.metrics.overall.p_value.unwrap() < 1e-5,
            "{:?}",
            evaluation.metrics
        );
        let told: String = evaluation.where_it_fails.iter().map(|s| s.sentence.as_str()).collect();
        assert!(told.contains("y of the model is too") && told.contains("z of the model is too"), "{told}");
    }
}

#[test]
fn without_noise_there_is_no_error_and_the_stiffness_comes_back() {
    let truth = robot(TWO).with_bending(0.7);
    let quiet =
        Generator { camera_sd_m: 0.0, pressure_sd: 0.0, alignment_sd_m: 0.0, rotation_sd: 0.0, ..Generator::default() };
    let made = generate(&truth, "made", &quiet.with_protocol("0/0,20/10,5/30@2").unwrap()).unwrap();
    let found = alone(&truth, made.clone());
    let all = &found.variants[0].evaluation.metrics.overall;
    assert!(all.rmse_mm < 1e-9 && all.d_max_mm > 20.0, "{all:?}");
    let models = [Contender::as_given(&truth.with_bending(0.2))];
    let evidence = Evidence::of(made, None);
    let fitted = compare_all(&models, &evidence, &EvaluateOptions::default(), Some(Knob::Bending)).unwrap();
    let bending = fitted.variants[1].scenario.bending_stiffness;
    assert!((bending - 0.7).abs() < 1e-3, "{bending}");
}

#[test]
fn a_turned_robot_has_the_errors_of_the_planar_one() {
    let upright = TWO
        .replace("[[strip]]\nazimuth_deg = 90               # towards z; all other sizes as above\nchannel = 1\n", "");
    assert!(!upright.contains("[[strip]]"));
    let planar = robot(&upright);
    assert!(!planar.is_spatial());
    let turned = robot(&upright.replace("azimuth_deg = 0 ", "azimuth_deg = 90 "));
    let dataset = generate(&planar, "made", &Generator { runs: 4, ..Generator::default() }).unwrap();
    // The model is another one than that of the data.
    let wrong = |scenario: &Scenario| Scenario { p_body_pa: 2e3, bending_stiffness: 0.6, ..scenario.clone() };
    let planar = alone(&wrong(&planar), dataset.clone());
    let places = dataset.coordinates_m.chunks_exact(2).flat_map(|p| [p[0], 0.0, p[1]]).collect();
    let found = alone(&wrong(&turned), Dataset { axes: 3, coordinates_m: places, ..dataset });
    let [found, wanted] = [&found, &planar].map(|of| &of.variants[0].evaluation.metrics);
    let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-6 * a.abs().max(1.0), "{a} {b}");
    assert!(wanted.overall.rmse_mm > 5.0);
    same(3f64.sqrt() * found.overall.rmse_mm, 2f64.sqrt() * wanted.overall.rmse_mm);
    same(found.overall.d_max_mm, wanted.overall.d_max_mm);
    same(found.overall.largest_tip_error_mm, found.holds.iter().map(|h| h.tip_distance_mm).fold(0.0, f64::max));
    for (hold, wanted) in found.holds.iter().zip(&wanted.holds) {
        same(3f64.sqrt() * hold.rmse_mm, 2f64.sqrt() * wanted.rmse_mm);
        same(hold.tip_error_x_mm, wanted.tip_error_x_mm);
        same(hold.tip_error_mm, 0.0);
        same(hold.tip_error_z_mm.unwrap(), wanted.tip_error_mm);
        same(hold.tip_distance_mm, wanted.tip_distance_mm.abs());
    }
}

#[test]
fn channels_that_do_not_fit_are_refused_and_one_pressure_for_all_is_told() {
    let (two, one) = (robot(TWO), robot(&TWO.replace("channel = 1\n", "")));
    let with = |protocol: &str, scenario: &Scenario| {
        generate(scenario, "made", &Generator::default().with_protocol(protocol).unwrap()).unwrap()
    };
    let told = alone(&two, with("0,10,20@2", &two)).warnings;
    assert!(told.iter().any(|w| w.contains("supply channels 0 and 1") && w.contains("p_act_1_kpa")), "{told:?}");
    let error = |scenario: &Scenario, dataset: Dataset| {
        compare(scenario, &Evidence::of(dataset, None)).unwrap_err().to_string()
    };
    assert!(error(&one, with("0/0,10/20@2", &two)).contains("nothing is supplied by channel 1"));
    let third = robot(&TWO.replace("channel = 1\n", "channel = 2\n"));
    assert!(error(&third, with("0/0,10/20@2", &two)).contains("the robot has supply channel 2"));
    let planar = compare(&ScenarioFile::read("epam").unwrap(), &Evidence::of(with("0/0,10/20@2", &two), None));
    assert!(planar.unwrap_err().to_string().contains("and the robot is planar"));
}

/// Strips of unequal width: no exchange of axes does what an exchange of channels does.
const UNEQUAL: [&str; 2] = ["channel = 1\n", "channel = 1\nwidth_mm = 40\n"];

#[test]
fn exchanged_axes_and_channels_and_a_turned_axis_are_named_and_a_right_table_is_not() {
    let robot = robot(&TWO.replace(UNEQUAL[0], UNEQUAL[1]));
    let right = made(&robot, 3);
    let found = |dataset: &Dataset| {
        pressure_slip(&robot, &Evidence::of(dataset.clone(), None), &Options::default()).unwrap().map(|slip| slip.words)
    };
    assert_eq!(found(&right), None);
    let swapped = |one: usize, other: usize| {
        let mut dataset = right.clone();
        dataset.coordinates_m.chunks_exact_mut(3).for_each(|place| place.swap(one, other));
        dataset
    };
    let mut turned = right.clone();
    turned.coordinates_m.iter_mut().skip(2).step_by(3).for_each(|z| *z = -*z);
    let mut channels = right.clone();
    channels.holds.iter_mut().for_each(|hold| std::mem::swap(&mut hold.p_act_pa, &mut hold.more_act_pa[0]));
    for (slipped, words, column) in [
        (turned, "z looks turned over", "change the sign of the column z"),
        (swapped(1, 2), "y and z look exchanged", "the columns y and z"),
        (swapped(0, 1), "x and y look exchanged", "the columns x and y"),
        (channels, "the supply channels 0 and 1 look exchanged", "the columns p_act and p_act_1"),
    ] {
        let told = found(&slipped).unwrap_or_default();
        assert!(told.split(". As good").next().unwrap().contains(words) && told.contains(column), "{words}: {told}");
    }
}
