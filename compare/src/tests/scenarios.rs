//! Whole evaluations of datasets with a known fault: the sentence a reader gets, and what must never happen.

use crate::error::CompareError;
use crate::evaluate::{EvaluateOptions, Evaluation, evaluate};
use crate::noise::NoiseStatus;
use crate::scaling::ScalingVerdict;
use crate::tests::synthetic::{SyntheticNoise, SyntheticRobot, TYPICAL, displace};
use crate::where_it_fails::{Finding, Statement};
use data::Dataset;

/// Run-to-run scatter of a careful experiment.
const CAREFUL: SyntheticNoise = SyntheticNoise { sigma_m: 5e-4, pressure: 0.005, alignment_m: 1e-4 };

fn of(data: &Dataset, model: &SyntheticRobot) -> Evaluation {
    evaluate(data, &model.shape(1.0), &model.slope(), &EvaluateOptions::default()).unwrap()
}

fn statement(e: &Evaluation, finding: Finding) -> &Statement {
    let found = e.where_it_fails.iter().find(|s| s.finding == finding);
    found.unwrap_or_else(|| panic!("no {finding:?} in {:#?}", e.where_it_fails))
}

/// No NaN or infinity anywhere, neither in the numbers nor in the sentences.
fn assert_finite(e: &Evaluation) {
    let text = format!("{e:?}");
    let bad = ["NaN", "inf,", "inf]", "inf)", "inf }", "inf mm"].iter().find(|w| text.contains(**w));
    assert!(bad.is_none(), "{bad:?} in {text}");
    serde_json::to_string(e).unwrap();
}

#[test]
fn a_model_that_bends_too_far_is_described_by_pressure_marker_and_phase() {
    let robot = SyntheticRobot::paper();
    let model = SyntheticRobot { curvature_per_m: 2.4, ..robot.clone() };
    let e = of(&robot.measured(5, CAREFUL, 1), &model);
    let s = statement(&e, Finding::Loading);
    println!("{}\n{:#?}", s.sentence, e.where_it_fails);
    assert!(
        s.sentence.starts_with("The model bends too far at 10, 20 and 30 kPa (outermost marker +"),
        "{}",
        s.sentence
    );
    assert!(s.sentence.contains("growing towards the tip"), "{}", s.sentence);
    assert!(s.sentence.contains("at 0 kPa and after unloading it is right to within noise"), "{}", s.sentence);
    assert!(s.largest.unwrap().p_corrected.unwrap() <= 1e-6 && s.holds == [1, 2, 3]);
    let hold = &e.metrics.holds[3];
    assert!(hold.tip_error_mm > 0.0 && (hold.tip_error_mm - s.largest.unwrap().mm).abs() < 1e-9);
    assert!(hold.tip_error_x_mm < 0.0 && hold.tip_distance_mm > hold.tip_error_mm);
    assert_finite(&e);
}

#[test]
fn hysteresis_is_seen_on_unloading_only() {
    let robot = SyntheticRobot::paper();
    let mut data = robot.measured(5, CAREFUL, 2);
    displace(&mut data, |hold, _, m| [0.0, if hold == 4 { 1.5e-3 * m as f64 } else { 0.0 }]);
    let e = of(&data, &robot);
    let s = statement(&e, Finding::Unloading);
    println!("{}", s.sentence);
    assert!(
        s.sentence.starts_with("After unloading, at 0 kPa, the model is bent too little (outermost marker -7."),
        "{}",
        s.sentence
    );
    assert!(s.sentence.contains("at 0, 10, 20 and 30 kPa while loading it is right to within noise"), "{}", s.sentence);
    assert_eq!(e.where_it_fails.len(), 1, "{:#?}", e.where_it_fails);
    assert!(e.residual_map.loops[0].deviation.mm < -4.0);
    assert_eq!(e.metrics.holds[4].label.phase, "unload");
}

#[test]
fn a_loop_at_a_pressure_where_both_branches_are_off_is_named() {
    let robot =
        SyntheticRobot { pressures_kpa: [10.0, 30.0, 10.0].map(|p| (p, 2.0)).to_vec(), ..SyntheticRobot::paper() };
    let mut data = robot.measured(5, CAREFUL, 3);
    displace(&mut data, |hold, _, m| [0.0, [-1.0, 0.0, 1.0][hold] * 1e-3 * m as f64]);
    let e = of(&data, &robot);
    let s = statement(&e, Finding::Loop);
    println!("{:#?}", e.where_it_fails);
    assert!(s.sentence.starts_with("At 10 kPa the robot is bent ") && s.sentence.contains("mm more after unloading"));
    assert_eq!(s.holds, [0, 2]);
}

#[test]
fn a_bad_marker_an_x_error_and_a_drift_are_told_apart() {
    let robot = SyntheticRobot::paper();
    let mut marker = robot.measured(5, CAREFUL, 4);
    displace(&mut marker, |_, _, m| [0.0, if m == 3 { 4e-3 } else { 0.0 }]);
    let e = of(&marker, &robot);
    let s = statement(&e, Finding::Loading);
    assert!(s.sentence.contains("marker P4 -4") && s.sentence.contains("only at marker P4"), "{}", s.sentence);

    let mut lengthwise = robot.measured(5, CAREFUL, 5);
    displace(&mut lengthwise, |_, _, m| [-5e-4 * (m + 1) as f64, 0.0]);
    let e = of(&lengthwise, &robot);
    let s = statement(&e, Finding::Lengthwise);
    assert!(s.sentence.contains("x of the model is too large"), "{}", s.sentence);
    assert!(s.sentence.ends_with("y is right to within noise."), "{}", s.sentence);
    assert_eq!(e.where_it_fails.len(), 1, "{:#?}", e.where_it_fails);

    let mut creeping = robot.measured(5, CAREFUL, 6);
    displace(&mut creeping, |h, t, m| {
        [0.0, if h == 3 { 1e-3 * (t as f64 - 2.0) * (m as f64 / 5.0).powi(2) } else { 0.0 }]
    });
    let e = of(&creeping, &robot);
    let s = statement(&e, Finding::Drift);
    println!("{}", s.sentence);
    assert!(s.holds == [3] && s.sentence.contains("moves 2.5 mm further in the bending direction"), "{}", s.sentence);
}

#[test]
fn the_truth_agrees_to_within_noise_and_reads_well() {
    let robot = SyntheticRobot::paper();
    let e = of(&robot.measured(5, TYPICAL, 7), &robot);
    println!("{}\n{}\n{}", e.noise.sentence, e.where_it_fails[0].sentence, e.scaling.sentence);
    assert_eq!(e.where_it_fails[0].finding, Finding::Agrees);
    assert!(e.noise.sentence.starts_with("camera noise 1.0 mm; run-to-run pressure "), "{}", e.noise.sentence);
    assert!(e.metrics.holds[0].paper_accuracy.is_none(), "y = 0 at 0 kPa: undefined");
    assert_eq!(e.metrics.overall.holds_in_accuracy, 3);
    let [low, high] = e.metrics.overall.accuracy_interval.unwrap();
    assert!(low < e.metrics.overall.paper_accuracy.unwrap() && high <= 1.0 && low < high);
    assert_finite(&e);
}

#[test]
fn the_same_input_gives_the_same_output_to_the_byte() {
    let robot = SyntheticRobot::paper();
    let data = robot.measured(4, TYPICAL, 8);
    let json = |seed| {
        let options = EvaluateOptions { seed, ..Default::default() };
        serde_json::to_string(&evaluate(&data, &robot.shape(1.0), &robot.slope(), &options).unwrap()).unwrap()
    };
    assert_eq!(json(1), json(1));
    assert_ne!(json(1), json(2), "another seed resamples other runs");
}

#[test]
fn the_report_has_the_field_names_of_the_interface() {
    let robot = SyntheticRobot::paper();
    let value = serde_json::to_value(of(&robot.measured(3, TYPICAL, 9), &robot)).unwrap();
    let hold = &value["metrics"]["holds"][3];
    for key in ["p_act_kpa", "p_body_kpa", "paper_accuracy", "noise_ceiling", "rms_relative_pct", "rmse_mm"] {
        assert!(hold[key].is_number(), "{key}: {hold}");
    }
    for key in ["noise_floor_mm", "systematic_mm", "tip_error_mm", "reduced_chi2", "p_value"] {
        assert!(hold[key].is_number(), "{key}: {hold}");
    }
    assert_eq!((hold["phase"].as_str(), hold["p_act_kpa"].as_f64()), (Some("load"), Some(30.0)));
    assert!(value["residual_map"]["cells"][5][3]["y"]["in_noise"].is_number());
}

#[test]
fn one_run_gives_numbers_but_no_significance() {
    let robot = SyntheticRobot::paper();
    let model = SyntheticRobot { curvature_per_m: 2.4, ..robot.clone() };
    let data = robot.measured(1, CAREFUL, 10);
    let e = of(&data, &model);
    println!("{}\n{:#?}", e.noise.sentence, e.where_it_fails);
    assert_eq!(e.noise.status, NoiseStatus::Unknown);
    assert_eq!(e.where_it_fails[0].finding, Finding::NoiseUnknown);
    assert!(!statement(&e, Finding::Loading).sentence.contains("noise"));
    let hold = &e.metrics.holds[3];
    assert!(hold.paper_accuracy.is_some() && hold.rmse_mm > 1.0);
    assert!(hold.noise_ceiling.is_none() && hold.systematic_mm.is_none() && hold.p_value.is_none());
    assert!(hold.accuracy_interval.is_none() && e.metrics.overall.reduced_chi2.is_none());
    assert_finite(&e);

    let given = EvaluateOptions { sigma_m: Some(5e-4), ..Default::default() };
    let e = evaluate(&data, &model.shape(1.0), &model.slope(), &given).unwrap();
    assert_eq!(e.noise.status, NoiseStatus::Supplied);
    assert!(e.metrics.holds[3].systematic_mm.is_some() && e.metrics.holds[3].p_value.is_none());
    assert!(statement(&e, Finding::Loading).sentence.contains("times the noise"));
    let wrong = EvaluateOptions { sigma_m: Some(0.0), ..Default::default() };
    let error = evaluate(&data, &model.shape(1.0), &model.slope(), &wrong).unwrap_err();
    assert!(matches!(error, CompareError::BadOption { name: "sigma_m", .. }));
}

#[test]
fn a_hold_that_scatters_more_than_the_others_is_pointed_out() {
    let robot = SyntheticRobot::paper();
    let quiet = robot.measured(5, CAREFUL, 20);
    let mut data = quiet.clone();
    let loud = robot.measured(5, SyntheticNoise { sigma_m: 2e-3, ..CAREFUL }, 21);
    let n = data.values_per_run();
    for (i, y) in data.coordinates_m.iter_mut().enumerate().filter(|(i, _)| i % n / (n / 5) == 1) {
        *y = loud.coordinates_m[i];
    }
    let e = of(&data, &robot);
    // 240 degrees of freedom: 4 standard errors of a standard deviation are 18 %.
    assert!((e.noise_model.hold_sigma_m[1] - 2e-3).abs() < 0.18 * 2e-3, "{:?}", e.noise_model.hold_sigma_m);
    let warning = e.noise.warning.unwrap();
    assert!(warning.contains(" mm at 10 kPa, 0.5 mm at "), "{warning}");
    assert_eq!(of(&quiet, &robot).noise.warning, None);
}

#[test]
fn two_runs_or_copies_of_one_run_give_no_p_values() {
    let robot = SyntheticRobot::paper();
    let e = of(&robot.measured(2, TYPICAL, 11), &robot);
    assert!(e.noise.status == NoiseStatus::Measured && e.metrics.overall.p_value.is_none());
    assert!(e.noise.sentence.contains("no significance"), "{}", e.noise.sentence);
    let mut copies = robot.measured(1, TYPICAL, 12);
    copies.runs = ["1", "2", "3"].map(str::to_string).to_vec();
    copies.coordinates_m = copies.coordinates_m.repeat(3);
    let e = of(&copies, &robot);
    assert!(e.metrics.overall.p_value.is_none() && e.noise.sentence.contains("identical"), "{}", e.noise.sentence);
    assert_finite(&e);
}

#[test]
fn degenerate_shapes_give_finite_numbers_or_clear_errors() {
    for (holds, samples, markers) in [(1, 1, 1), (1, 1, 2), (1, 5, 1), (3, 1, 1), (1, 1, 6), (2, 2, 2)] {
        let pressures_kpa = (0..holds).map(|h| (10.0 * h as f64, 2.0)).collect();
        let robot = SyntheticRobot { pressures_kpa, samples, markers, ..SyntheticRobot::paper() };
        for runs in [1, 2, 3, 6] {
            let data = robot.measured(runs, TYPICAL, 13);
            assert_finite(&of(&data, &robot));
            let zeros = vec![0.0; data.values_per_run()];
            assert_finite(&evaluate(&data, &zeros, &zeros, &EvaluateOptions::default()).unwrap());
        }
    }
    let robot = SyntheticRobot::paper();
    let mut empty = robot.measured(3, TYPICAL, 14);
    let short = evaluate(&empty, &[0.0; 3], &robot.slope(), &EvaluateOptions::default()).unwrap_err();
    assert!(short.to_string().contains("has 3 values") && short.to_string().contains("has 300"), "{short}");
    empty.markers.clear();
    let none = evaluate(&empty, &[], &[], &EvaluateOptions::default()).unwrap_err();
    assert!(none.to_string().contains("is empty"), "{none}");
}

#[test]
fn sessions_that_differ_widen_the_noise_of_the_mean() {
    let robot = SyntheticRobot::paper();
    let mut data = robot.measured(6, CAREFUL, 15);
    let n = data.values_per_run();
    // The second session of three runs was mounted 4 mm higher.
    data.coordinates_m[3 * n..].iter_mut().skip(1).step_by(2).for_each(|y| *y += 4e-3);
    let with = |sessions: &[usize]| {
        let options = EvaluateOptions { sessions: sessions.to_vec(), ..Default::default() };
        evaluate(&data, &robot.shape(1.0), &robot.slope(), &options)
    };
    let noise = with(&[1, 1, 1, 2, 2, 2]).unwrap().noise_model;
    assert!(noise.run_sd[2].unwrap() < 5e-4, "within a session the alignment is good: {:?}", noise.run_sd);
    // Session means 4 mm apart in y only, pooled with x: b = (4²/2)/2 mm², divided by two sessions.
    assert!((1e6 * noise.mean_variance[2] - 2.0).abs() < 0.3, "{:?}", noise.mean_variance);
    let refused = |sessions: &[usize], words: &str| with(sessions).unwrap_err().to_string().contains(words);
    assert!(refused(&[1, 2], "2 session labels for 6 runs"));
    assert!(refused(&[1, 2, 3, 4, 5, 6], "one run only"));
}

#[test]
fn the_scaling_law_is_confirmed_refuted_or_the_missing_holds_are_named() {
    let both = |resistance_kpa| SyntheticRobot {
        pressures_kpa: vec![(10.0, 2.0), (20.0, 2.0), (30.0, 2.0), (0.0, 4.0), (20.0, 4.0), (40.0, 4.0), (60.0, 4.0)],
        resistance_kpa,
        ..SyntheticRobot::paper()
    };
    let (ideal, stiff) = (both(0.0), both(1.0));
    let e = of(&ideal.measured(5, CAREFUL, 16), &ideal);
    assert_eq!((e.scaling.verdict, e.scaling.pairs.len()), (ScalingVerdict::Collapses, 3), "{}", e.scaling.sentence);
    let e = of(&stiff.measured(5, CAREFUL, 17), &ideal);
    println!("{}", e.scaling.sentence);
    assert_eq!(e.scaling.verdict, ScalingVerdict::DoesNotCollapse);
    assert!(e.scaling.pairs[0].tip_mm > 2.0, "resistance matters less at higher pressure");
    let e = of(&stiff.measured(1, CAREFUL, 18), &ideal);
    assert_eq!(e.scaling.verdict, ScalingVerdict::Undecided);
    let e = of(&SyntheticRobot::paper().measured(5, CAREFUL, 19), &SyntheticRobot::paper());
    assert_eq!(e.scaling.verdict, ScalingVerdict::CannotBeChecked);
    let advice = "add holds at 4 kPa body pressure with 20, 40 and 60 kPa, or at 1 kPa with 5, 10 and 15 kPa";
    assert!(e.scaling.sentence.contains(advice), "{}", e.scaling.sentence);
}
