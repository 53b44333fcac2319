//! Laws of the study: what is put in comes out, and what cannot be is said.

use super::*;
use crate::evaluate::EvaluateOptions;
use crate::evidence::Evidence;
use crate::study::published::{shipped_scenario, textbook_scenario};
use data::{About, AboutRun, Dataset, Direct, Provenance};

fn quiet(runs: usize) -> Generator {
    Generator {
        runs,
        camera_sd_m: 1e-9,
        pressure_sd: 0.0,
        alignment_sd_m: 0.0,
        rotation_sd: 0.0,
        ..Generator::default()
    }
}

pub(crate) fn about(tip_forces: &[[f64; 2]]) -> About {
    let run = |(i, f): (usize, &[f64; 2])| AboutRun { id: (i + 1).to_string(), tip_force_n: *f, session: None };
    About {
        title: "test".into(),
        provenance: Provenance::Synthetic,
        source: "test".into(),
        licence: "CC0-1.0".into(),
        actuator: None,
        geometry: None,
        markers: vec![],
        gravity_direction: None,
        direct: Direct::default(),
        bending_nm2: None,
        measured: Vec::new(),
        runs: tip_forces.iter().enumerate().map(run).collect(),
        notes: None,
    }
}

#[test]
fn a_model_meets_the_data_it_made() {
    for kind in ["spam", "cpam", "epam", "fpam"] {
        let scenario = textbook_scenario(kind).unwrap();
        let dataset = generate(&scenario, "made", &quiet(3)).unwrap();
        let predicted = predict_dataset(&scenario, &dataset).unwrap();
        let worst = dataset
            .mean_over_runs()
            .iter()
            .zip(&predicted.coordinates_m)
            .fold(0.0, |w: f64, (y, f)| w.max((y - f).abs()));
        assert!(worst < 1e-8, "{kind}: {worst}");
    }
}

#[test]
fn a_model_with_history_meets_the_data_it_made_sample_by_sample() {
    let generator = Generator { protocol: [0.0, 10e3, 30e3, 10e3, 0.0].map(|p| [2e3, p]).to_vec(), ..quiet(3) };
    for kind in ["spam", "cpam", "epam", "fpam"] {
        let base = textbook_scenario(kind).unwrap().with_bending(1.0);
        for (effect, values) in
            [("friction", vec![0.3]), ("creep", vec![0.5, 2.0]), ("plastic_set", vec![0.2]), ("leak", vec![0.02])]
        {
            let scenario = base.with_effect(effect, &values);
            let dataset = generate(&scenario, "made", &generator).unwrap();
            let apart = |scenario| -> f64 {
                let predicted = predict_dataset(scenario, &dataset).unwrap();
                let mean = dataset.mean_over_runs();
                mean.iter().zip(&predicted.coordinates_m).map(|(y, f)| (y - f).abs()).fold(0.0, f64::max)
            };
            assert!(apart(&scenario) < 1e-8, "{kind} {effect}: {:e}", apart(&scenario));
            assert!(apart(&base) > 1e-4, "{kind} {effect} leaves its mark: {:e}", apart(&base));
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_data_and_another_seed_does_not() {
    let scenario = textbook_scenario("epam").unwrap();
    let made = |seed| generate(&scenario, "made", &Generator { seed, ..Generator::default() }).unwrap();
    assert_eq!(made(3), made(3));
    assert_ne!(made(3).coordinates_m, made(4).coordinates_m);
}

#[test]
fn the_scatter_put_in_is_the_scatter_found() {
    let scenario = textbook_scenario("epam").unwrap();
    let generator = Generator { runs: 400, ..Generator::default() };
    let dataset = generate(&scenario, "made", &generator).unwrap();
    let tip = |run| dataset.xy(run, 0, 0, 5)[1];
    let mean = (0..400).map(tip).sum::<f64>() / 400.0;
    let variance = (0..400).map(|r| (tip(r) - mean).powi(2)).sum::<f64>() / 399.0;
    // Camera 1 mm, alignment 0.5 mm, roll 0.5 mrad on 330 mm; at zero pressure the gain does nothing.
    let expected = 1.0 + 0.25 + 0.165_f64.powi(2);
    assert!((variance * 1e6 / expected - 1.0).abs() < 4.0 * (2.0_f64 / 399.0).sqrt(), "{variance}");
}

#[test]
fn calibration_returns_the_stiffness_that_made_the_data() {
    for (kind, stiffness) in [("epam", 0.7), ("spam", 3.0), ("fpam", 0.2)] {
        let bare = textbook_scenario(kind).unwrap();
        let generator =
            Generator { pressure_sd: 0.003, camera_sd_m: 1e-4, alignment_sd_m: 1e-4, ..Generator::default() };
        let dataset = generate(&bare.with_bending(stiffness), "made", &generator).unwrap();
        let fit = calibrate(&bare, &dataset, &EvaluateOptions::default(), Knob::Bending).unwrap();
        let [low, high] = fit.interval.unwrap();
        assert!(!fit.at_bound && low < fit.value && fit.value < high);
        assert!((fit.value / stiffness - 1.0).abs() < 0.05, "{kind}: {fit:?}");
    }
}

#[test]
fn calibration_returns_the_body_pressure_that_made_the_data() {
    let scenario = textbook_scenario("epam").unwrap().with_bending(0.7);
    let generator = Generator { pressure_sd: 0.003, camera_sd_m: 1e-4, alignment_sd_m: 1e-4, ..Generator::default() };
    let made = scenario.with_effect("body_pressure_offset", &[600.0]);
    let dataset = generate(&made, "made", &generator).unwrap();
    let fit = calibrate(&scenario, &dataset, &EvaluateOptions::default(), Knob::BodyPressure).unwrap();
    let [low, high] = fit.interval.unwrap();
    assert!(!fit.at_bound && low < 1.4 && 1.4 < high && high - low < 0.1, "{fit:?}");
}

#[test]
fn a_stiffness_that_is_not_there_is_at_its_bound() {
    let scenario = textbook_scenario("epam").unwrap();
    // More bend than the bare model: any stiffness makes it worse.
    let generator = Generator { pressure_sd: 0.003, ..Generator::default() };
    let dataset = generate(&scenario.with_effect("pressure_offset", &[-4e3]), "made", &generator).unwrap();
    let fit = calibrate(&scenario, &dataset, &EvaluateOptions::default(), Knob::Bending).unwrap();
    assert!(fit.at_bound && fit.value == 0.0, "{fit:?}");
}

/// Stiffer than any wall: the fit ends where it stops looking.
#[test]
fn no_stiffness_above_200_is_looked_for() {
    let rigid = textbook_scenario("epam").unwrap().with_bending(400.0);
    let data = generate(&rigid, "made", &quiet(3)).unwrap();
    let found = calibrate(&rigid.with_bending(1.0), &data, &EvaluateOptions::default(), Knob::Bending).unwrap();
    assert!(found.at_bound && (found.value - 200.0).abs() < 1.0, "{found:?}");
}

#[test]
fn a_known_tip_force_enters_the_model_and_mixed_ones_are_refused() {
    let scenario = textbook_scenario("epam").unwrap();
    let dataset = generate(&scenario, "made", &quiet(2)).unwrap();
    let (loaded, _) = fit_scenario(&scenario, &dataset, Some(&about(&[[0.0, -0.2], [0.0, -0.2]]))).unwrap();
    assert_eq!(loaded.effects.iter().find(|e| e.name == "tip_load").unwrap().values, [0.0, -0.2, 0.0]);
    let mixed = fit_scenario(&scenario, &dataset, Some(&about(&[[0.0, -0.2], [0.0, 0.2]])));
    assert!(matches!(mixed, Err(crate::CompareError::MixedTipForces { .. })));
}

#[test]
fn sessions_of_the_description_reach_the_noise_model() {
    let scenario = textbook_scenario("epam").unwrap();
    let dataset = generate(&scenario, "made", &Generator { runs: 4, ..Generator::default() }).unwrap();
    let labelled = |labels: [&str; 4]| {
        let mut about = about(&[[0.0; 2]; 4]);
        about.runs.iter_mut().zip(labels).for_each(|(run, label)| run.session = Some(label.into()));
        compare(&scenario, &Evidence::of(dataset.clone(), Some(about)))
    };
    let two = labelled(["a", "b", "a", "b"]).unwrap();
    assert_eq!(two.variants[0].evaluation.noise.sessions, 2);
    assert!(labelled(["a", "b", "c", "d"]).unwrap_err().to_string().contains("one run only"));
}

#[test]
fn nothing_to_compare_is_said_and_every_shipped_actuator_has_a_ladder() {
    let scenario = textbook_scenario("epam").unwrap();
    let dataset = generate(&scenario, "made", &quiet(2)).unwrap();
    let none = compare_all(&[], &Evidence::of(dataset, None), &EvaluateOptions::default(), Some(Knob::Bending));
    assert_eq!(none.unwrap_err(), crate::CompareError::NoModel);
    for (kind, _) in models::scenario::SHIPPED {
        assert!(!published::model_ladder(kind).unwrap().is_empty(), "{kind}");
    }
    assert!(published::model_ladder("xpam").unwrap_err().to_string().contains("`xpam`"));
}

#[test]
fn data_of_another_actuator_or_with_unknown_stations_are_refused() {
    let scenario = textbook_scenario("epam").unwrap();
    let dataset = generate(&scenario, "made", &quiet(2)).unwrap();
    let other = fit_scenario(&textbook_scenario("fpam").unwrap(), &dataset, None);
    assert!(other.unwrap_err().to_string().contains("matching scenario"));
    let mut lost = dataset.clone();
    lost.markers.iter_mut().for_each(|m| m.station_m = None);
    assert!(fit_scenario(&scenario, &lost, None).is_ok());
    let error = fit_scenario(&scenario.with_markers(&[0.1]), &lost, None).unwrap_err();
    assert!(error.to_string().contains("6 stations"), "{error}");
    let far = Dataset {
        markers: lost.markers.iter().cloned().map(|m| data::Marker { station_m: Some(3.0), ..m }).collect(),
        ..dataset
    };
    assert!(fit_scenario(&scenario, &far, None).unwrap_err().to_string().contains("beyond"));
}

#[test]
fn protocols_are_read_or_refused_with_an_example() {
    let holds = parse_protocol("0,10@2; 0,20@4").unwrap();
    assert_eq!(holds, [[2e3, 0.0], [2e3, 10e3], [4e3, 0.0], [4e3, 20e3]]);
    for wrong in ["", "10", "a@2", "10@x", "-1@2", "9999@2"] {
        assert!(parse_protocol(wrong).unwrap_err().to_string().contains("for example"), "{wrong}");
    }
}

#[test]
fn the_published_ladders_go_effect_by_effect() {
    let ladders = published_ladders().unwrap();
    let epam = ladders.iter().find(|l| l.published.kind == "epam").unwrap();
    let names = [
        "weld_width",
        "chord_arm",
        "displaced_gas",
        "sealed_sides",
        "fold_energy",
        "crimped_sides",
        "wrinkled_sheets",
        "fabric_stretch",
    ];
    let labels: Vec<String> = names.iter().map(|name| format!("+ {name}")).collect();
    assert_eq!(epam.rungs[1..=names.len()].iter().map(|r| r.label.clone()).collect::<Vec<_>>(), labels);
    // A wider weld bends less, none is the bare model.
    let [least, most] = epam.rungs[1].range_m.unwrap();
    assert!(least < epam.rungs[1].y_m && (most - epam.rungs[0].y_m).abs() < 1e-12, "{least} {most}");
}

#[test]
fn the_shipped_robots_are_the_top_of_their_ladders() {
    for kind in ["spam", "cpam", "epam", "fpam"] {
        let mut shipped = shipped_scenario(kind).unwrap();
        // An axis in the wall does not rise.
        shipped.effects.retain(|e| kind != "fpam" || e.name != "arm_growth");
        let top = published::model_ladder(kind).unwrap().pop().unwrap().scenario;
        assert_eq!(shipped.effects.len(), top.effects.len(), "{kind}");
        for (own, rung) in shipped.effects.iter().zip(top.effects.iter()) {
            let close = (own.values[0] / rung.values[0] - 1.0).abs() < 5e-3;
            assert!(own.name == rung.name && close, "{kind}: {own:?} {rung:?}");
        }
    }
}

#[test]
fn a_calibrated_rung_meets_the_number_it_was_fitted_to_and_says_so() {
    for ladder in published_ladders().unwrap() {
        let calibrated = ladder.rungs.iter().find(|r| r.known == models::Known::Calibrated);
        let last = ladder.rungs.iter().rfind(|r| r.known != models::Known::Calibrated).unwrap();
        assert_eq!(calibrated.is_some(), last.y_m > ladder.published.d_max_m);
        if let Some(rung) = calibrated {
            assert!((rung.y_m - ladder.published.d_max_m).abs() < 1e-6 && rung.why.contains("fitted"));
        }
    }
}

/// A law that misses fits another stiffness at every pressure; an interval of noise alone would hold one of them.
#[test]
fn the_interval_of_a_stiffness_that_misses_holds_what_each_pressure_asks_for() {
    let (whole, about) = data::load("synthetic-epam", &mut |_, _| {}).unwrap();
    let (scenario, _) = fit_scenario(&textbook_scenario("epam").unwrap(), &whole, about.as_ref()).unwrap();
    let fit = |dataset: &Dataset| calibrate(&scenario, dataset, &EvaluateOptions::default(), Knob::Bending).unwrap();
    let width = whole.values_per_run() / whole.holds.len();
    let at = |pressure_pa: f64| {
        let is_kept =
            |h: &usize| whole.holds[*h].p_act_pa == 0.0 || (whole.holds[*h].p_act_pa - pressure_pa).abs() < 1.0;
        let kept: Vec<usize> = (0..whole.holds.len()).filter(is_kept).collect();
        let rows = |run: usize| kept.iter().flat_map(move |h| h * width..(h + 1) * width).map(move |i| (run, i));
        let coordinates_m = (0..whole.runs.len()).flat_map(|run| rows(run).collect::<Vec<_>>());
        let coordinates_m = coordinates_m.map(|(run, i)| whole.run(run)[i]).collect();
        let holds = kept.iter().map(|h| whole.holds[*h].clone()).collect();
        fit(&Dataset { holds, coordinates_m, ..whole.clone() }).value
    };
    let alone = [10e3, 20e3, 30e3].map(at);
    let of_all = fit(&whole);
    let [low, high] = of_all.interval.unwrap();
    assert!(of_all.misses && alone.iter().all(|b| (low..=high).contains(b)), "{alone:?} in {low} to {high}");
    for (found, told) in alone.into_iter().chain([of_all.value]).zip([0.60, 0.87, 1.15, 0.97]) {
        assert!((found - told).abs() < 0.01, "{alone:?} {}, as docs/guide.md says", of_all.value);
    }
}
