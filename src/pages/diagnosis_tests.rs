//! What the pictures and words of a diagnosis put first.

use super::diagnosis::{Diagnosed, diagnosis_page};
use super::diagnosis_figures::{Rank, ranking_rows, shown, supply, waited_s, witness_cases};
use super::{Maker, figures, residual_figure};
use compare::Evidence;
use compare::diagnosis::{Diagnosis, GaugeFit, Group, Options, Standing, Verdict, diagnose};
use compare::evaluate::EvaluateOptions;
use compare::extension::error_steps;
use compare::study::calibrate::Knob;
use compare::study::engines::stored;
use compare::study::{Contender, Generator, compare, compare_all, generate, published::textbook_scenario};
use compare::witness::witness;
use data::Dataset;
use models::Scenario;

#[test]
fn every_body_pressure_has_its_shapes_points_and_curves() {
    let (dataset, _) = data::load("synthetic-epam-two-bodies", &mut |_, _| {}).unwrap();
    let scenario = textbook_scenario("epam").unwrap();
    let drawn = figures::shapes("both", &scenario, &dataset, 1).unwrap();
    for label in ["30 kPa, body 2", "20 kPa, body 2", "20 kPa, body 4", "60 kPa, body 4"] {
        assert!(drawn.svg.contains(label), "{label}");
    }
    let bare = Contender { label: "bare".into(), ..Contender::as_given(&scenario) };
    let evidence = Evidence::of(dataset, None);
    let study = compare_all(&[bare], &evidence, &EvaluateOptions::default(), Some(Knob::Bending)).unwrap();
    let map = residual_figure::map("both", &study.variants[0].evaluation.residual_map, &study.dataset).unwrap();
    let curve = figures::pressure_curve("both", &study).unwrap();
    for body in ["body 2 kPa", "body 4 kPa"] {
        assert!(map.svg.contains(body) && curve.svg.contains(&format!("bare, {body}")), "{body}");
        assert!(curve.svg.contains(&format!("measured, loading, {body}")), "{body}");
    }
    assert!(figures::at_highest(&study.dataset).unwrap().0.ends_with("60 kPa, body 4 kPa"));
}

#[test]
fn a_marker_that_slid_along_the_body_is_seen_in_the_residual_map() {
    let scenario = textbook_scenario("epam").unwrap().with_bending(1.0);
    let mut slid = scenario.clone();
    slid.markers_m[2] += 0.005;
    let mut dataset = generate(&slid, "slid", &Generator { runs: 5, seed: 4, ..Generator::default() }).unwrap();
    dataset.markers[2].station_m = Some(scenario.markers_m[2]);
    let study = compare(&scenario, &Evidence::of(dataset, None)).unwrap();
    let (evaluation, straight) = (&study.variants[0].evaluation, 0);
    let cell = evaluation.residual_map.cells[2][straight];
    assert!((cell.x.mm + 5.0).abs() < 1.0 && cell.y.mm.abs() < 1.0, "{cell:?}");
    let svg = residual_figure::map("slid", &evaluation.residual_map, &study.dataset).unwrap().svg;
    for shown in
        ["y, across the robot", "x, along the straight robot", &format!("−{:.1}", cell.x.in_noise.unwrap().abs())]
    {
        assert!(svg.contains(shown), "{shown}");
    }
}

fn page(diagnosis: &Diagnosis, scenario: &Scenario, dataset: &Dataset) -> String {
    let typed = ["S", "D"];
    let found = Diagnosed { diagnosis, scenario, dataset, about: None, witness: None, typed, more: String::new() };
    let mut files = diagnosis_page(&found, &Maker::default(), &mut |_, _| ()).unwrap().files;
    String::from_utf8(files.pop().unwrap().1).unwrap()
}

/// A diagnosis of data with two effects that the scenario lacks, and the scenario.
fn of_two() -> (Diagnosis, Scenario, Dataset) {
    let plain = textbook_scenario("spam").unwrap().with_bending(6.0);
    let truth = plain.with_effect("seam_stiffness", &[0.6]).with_effect("camera_scale", &[0.03]);
    let data = generate(&truth, "two", &Generator { runs: 5, seed: 7, ..Generator::default() }).unwrap();
    let options = Options::default().without_advice();
    let evidence = [Evidence::of(data.clone(), None)];
    (diagnose(&plain, &evidence, &options, &mut |_, _| ()).unwrap(), plain, data)
}

#[test]
fn stated_pairs_come_first_with_the_values_of_their_own_fit() {
    let (d, scenario, dataset) = of_two();
    println!("{:?} {:?}", d.verdict, d.indistinguishable);
    assert!(!d.pairs.is_empty() && !d.indistinguishable.is_empty(), "{:?}", d.summary);
    let drawn = shown(&d);
    let stated = d.indistinguishable.len().min(drawn.len());
    let names: Vec<String> = drawn.iter().map(|a| a.name()).collect();
    assert_eq!(names[..stated], d.indistinguishable[..stated]);
    assert!(
        drawn.len() == 7 || drawn.last().is_some_and(|a| a.standing == Standing::Other),
        "something to compare with"
    );
    for (answer, pair) in drawn.iter().zip(d.pairs.iter().filter(|p| p.in_set)) {
        let values: Vec<_> = answer.effects.iter().flat_map(|(_, values)| values.iter().cloned()).collect();
        assert_eq!((answer.name(), values), (pair.effects.join(" + "), pair.parameters.clone()));
        let on = answer.on(&scenario, 0);
        assert_eq!((on.effects.len(), on.bending_stiffness), (scenario.effects.len() + 2, pair.bending_nm2[0]));
    }
    let found = |effect: &str| d.indistinguishable.iter().any(|entry| entry.split(" + ").any(|part| part == effect));
    assert!(d.undetectable.iter().all(|u| !found(&u.effect)), "what is stated was found: {:?}", d.undetectable);
    let told = page(&d, &scenario, &dataset);
    for entry in d.indistinguishable.iter().take(6) {
        assert!(told.contains(&format!("<strong>{}</strong>", entry.replace('_', " "))), "{entry} in {told}");
    }
    for effect in d.ranked.iter().filter(|r| found(&r.effect)) {
        assert!(told.contains(&effect.sentence.replace('\'', "&#39;")), "what {} is", effect.effect);
    }
}

#[test]
fn bars_of_a_ranking_fall_within_each_block_and_the_set_is_on_top() {
    let (d, ..) = of_two();
    let rows = ranking_rows(&d).unwrap();
    let alike = rows.iter().take_while(|row| row.1 == Rank::Alike).count();
    assert_eq!(alike, d.indistinguishable.len());
    for block in rows.chunk_by(|a, b| a.1 == b.1) {
        assert!(block.windows(2).all(|pair| pair[0].2 >= pair[1].2), "{block:?}");
    }
}

#[test]
fn an_attempt_has_a_bar_that_says_it_is_not_enough() {
    let (mut d, scenario, dataset) = of_two();
    (d.verdict, d.attempt) = (Some(Verdict::OutOfCatalog), std::mem::take(&mut d.added));
    d.indistinguishable.clear();
    d.rule_out_first.clear();
    let rungs = error_steps(&d, &scenario);
    assert!(rungs.len() == 3 && rungs[2].label().ends_with("(attempt, not enough)"), "{rungs:?}");
    assert_eq!(shown(&d)[0].standing, Standing::Attempt);
    let told = page(&d, &scenario, &dataset);
    assert!(told.contains("</strong>, attempt, not enough: "), "{told}");
}

#[test]
fn the_ledgers_beside_finite_elements_begin_with_the_whole_stated_set() {
    let (dataset, about) = data::load("synthetic-epam", &mut |_, _| {}).unwrap();
    let scenario = textbook_scenario("epam").unwrap();
    let options = Options::default().without_advice();
    let evidence = [Evidence::of(dataset.clone(), about.clone())];
    let d = diagnose(&scenario, &evidence, &options, &mut |_, _| ()).unwrap();
    assert_eq!(d.indistinguishable, ["end_constraint", "self_contact", "pressure_loss"]);
    let w = witness(&d, &scenario, &dataset, about.as_ref(), &stored().unwrap()).unwrap().unwrap();
    let labels: Vec<String> = witness_cases(&w, &d).into_iter().map(|case| case.0).collect();
    assert_eq!(labels[..3], ["base", "end_constraint", "self_contact"]);
    assert!(labels[3..labels.len() - 1].iter().all(|l| l.ends_with("(fits worse)")), "{labels:?}");
    assert_eq!(labels.last().unwrap(), "finite elements");
}

#[test]
fn a_gauge_has_bars_in_kilopascal() {
    let (mut d, ..) = of_two();
    assert!(supply(&d).unwrap().is_none());
    let gauge = GaugeFit {
        dataset: "read".into(),
        set_kpa: vec![30.0],
        held_s: vec![5.0],
        read_kpa: vec![27.0],
        with_added_kpa: vec![27.1],
        before_kpa: 3.0,
        after_kpa: 0.1,
    };
    d.gauges.push(gauge);
    d.added[0].group = Group::Supply;
    let drawn = supply(&d).unwrap().unwrap();
    assert!(drawn.svg.contains("rms [kPa]") && drawn.svg.contains("gauge in read"), "{}", drawn.svg);
}

/// A leak acts in the hold: its curve is that of the samples, not that of the moment in which the pressure is set.
#[test]
fn samples_have_waited_in_their_own_holds() {
    let scenario = textbook_scenario("spam").unwrap();
    let generator = Generator { runs: 1, ..Generator::default() };
    let mut dataset = generate(&scenario, "made", &generator).unwrap();
    for (h, hold) in dataset.holds.iter_mut().enumerate() {
        hold.t_s = vec![10.0 * h as f64 + 2.0, 10.0 * (h + 1) as f64];
    }
    dataset.samples_per_hold = 2;
    assert!((waited_s(&dataset) - 6.0).abs() < 1e-12, "{}", waited_s(&dataset));
    // The next session begins at time 0 again.
    dataset.holds.iter_mut().for_each(|hold| hold.t_s = vec![2.0, 10.0]);
    assert!((waited_s(&dataset) - 6.0).abs() < 1e-12, "{}", waited_s(&dataset));
}
