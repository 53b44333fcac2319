//! Comparisons in x, y and z.

use super::comparison::{Contender, compare};
use super::generate::{Generator, generate};
use super::in_space::{InSpace, compare_in_space};
use crate::ScenarioFile;
use crate::evidence::Evidence;
use data::Dataset;
use models::Scenario;

const TWO: &str = include_str!("../../../studies/epam-two-strips.toml");

fn robot(text: &str) -> Scenario {
    ScenarioFile::parse_in_space("robot", text).unwrap().scenario
}

fn alone(scenario: &Scenario, dataset: Dataset) -> InSpace {
    compare_in_space(&[Contender::as_given(scenario)], &Evidence::of(dataset, None), None).unwrap()
}

#[test]
fn data_made_by_the_model_have_no_bias_beyond_their_noise() {
    let truth = robot(TWO);
    let runs = 12;
    for seed in 1..=4 {
        let protocol = "0/0,10/0,20/10,20/20,0/25,0/0@2";
        let generator = Generator { runs, seed, samples: 3, ..Generator::default() }.with_protocol(protocol).unwrap();
        let found = alone(&truth, generate(&truth, "made", &generator).unwrap());
        let first = &found.variants[0];
        assert_eq!((found.axes, first.holds[2].p_act_channels_kpa.as_slice()), (3, &[20.0, 10.0][..]));
        // A shift of a run is shared by all markers and holds: 0.5 mm over the root of the runs.
        let sd_mm = 0.5 / (runs as f64).sqrt();
        assert!(first.overall.bias_mm.iter().all(|bias| bias.abs() < 4.0 * sd_mm), "{:?}", first.overall);
        assert!(first.error_mm() < 0.35 && first.overall.noise_floor_mm.unwrap() > 0.2, "{:?}", first.overall);
        // Narrower pouches miss by more than that.
        let other = robot(&TWO.replace("width_mm = 50 ", "width_mm = 45 "));
        let wrong = alone(&other, found.dataset.clone());
        assert!(wrong.variants[0].error_mm() > 2.0, "{:?}", wrong.variants[0].overall);
    }
}

#[test]
fn without_noise_there_is_no_error() {
    let truth = robot(TWO);
    let quiet =
        Generator { camera_sd_m: 0.0, pressure_sd: 0.0, alignment_sd_m: 0.0, rotation_sd: 0.0, ..Generator::default() };
    let made = generate(&truth, "made", &quiet.with_protocol("0/0,20/10,5/30@2").unwrap()).unwrap();
    let found = alone(&truth, made);
    assert!(found.variants[0].overall.rmse_mm < 1e-9, "{:?}", found.variants[0].overall);
    assert!(found.d_max_mm > 60.0);
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
    let wanted = compare(&wrong(&planar), &Evidence::of(dataset.clone(), None)).unwrap();
    let (xy, z): (Vec<f64>, Vec<f64>) = (
        dataset.xy_m.chunks_exact(2).flat_map(|p| [p[0], 0.0]).collect(),
        dataset.xy_m.chunks_exact(2).map(|p| p[1]).collect(),
    );
    let found = alone(&wrong(&turned), Dataset { xy_m: xy, z_m: Some(z), ..dataset });
    let metrics = &wanted.variants[0].evaluation.metrics;
    let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-6 * a.abs().max(1.0), "{a} {b}");
    assert!(metrics.overall.rmse_mm > 5.0);
    same(found.variants[0].overall.rms_distance_mm, 2f64.sqrt() * metrics.overall.rmse_mm);
    for (hold, wanted) in found.variants[0].holds.iter().zip(&metrics.holds) {
        same(hold.errors.rms_distance_mm, 2f64.sqrt() * wanted.rmse_mm);
        same(hold.tip_error_mm[0], wanted.tip_error_x_mm);
        same(hold.tip_error_mm[1], 0.0);
        same(hold.tip_error_mm[2], wanted.tip_error_mm);
        same(hold.tip_distance_mm, wanted.tip_distance_mm.abs());
        same(hold.errors.rmse_axes_mm[1], 0.0);
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
        compare_in_space(&[Contender::as_given(scenario)], &Evidence::of(dataset, None), None).unwrap_err().to_string()
    };
    assert!(error(&one, with("0/0,10/20@2", &two)).contains("nothing is supplied by channel 1"));
    let third = robot(&TWO.replace("channel = 1\n", "channel = 2\n"));
    assert!(error(&third, with("0/0,10/20@2", &two)).contains("the robot has supply channel 2"));
    let planar = compare(&ScenarioFile::read("epam").unwrap(), &Evidence::of(with("0/0,10/20@2", &two), None));
    assert!(planar.unwrap_err().to_string().contains("pressures of 2 supply channels"));
}
