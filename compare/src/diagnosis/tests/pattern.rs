//! Patterns without physics: what they see, what they must not see, and how often noise is seen.

use crate::diagnosis::case::{DiagnosisCase, catalogue};
use crate::diagnosis::left_patterns::{ClearPattern, left_patterns};
use crate::diagnosis::tests::of_one;
use crate::diagnosis::*;
use crate::study::{Generator, generate, published::textbook_scenario};
use data::Dataset;

fn robot(kind: &str, bending_nm2: f64) -> Scenario {
    textbook_scenario(kind).unwrap().with_bending(bending_nm2)
}

fn measured(truth: &Scenario, runs: usize, seed: u64) -> Dataset {
    generate(truth, "made", &Generator { runs, seed, ..Generator::default() }).unwrap()
}

/// What the calibrated base leaves, as `look` sees it.
pub(crate) fn of_base<T>(scenario: &Scenario, data: &Dataset, look: impl Fn(&DiagnosisCase) -> T) -> T {
    let options = Options::default();
    let sources = [DiagnosisSource::of(scenario.clone(), data.clone(), None)];
    let (candidates, own) = catalogue(&sources, &options);
    let case = DiagnosisCase::new(&sources, (&candidates, own), &options).unwrap();
    look(&case)
}

/// A place and a time that the calibrated base leaves, and their p.
fn left_by_base(scenario: &Scenario, data: &Dataset) -> [(ClearPattern, f64); 2] {
    of_base(scenario, data, |case| {
        let look = left_patterns(case, &case.base);
        [false, true].map(|uniform| look.first(uniform).map(|seen| (seen.clone(), look.p_value(seen))).unwrap())
    })
}

#[test]
fn a_marker_that_sits_elsewhere_is_outside_the_catalogue_and_is_named() {
    let told = robot("epam", 1.35);
    let mut stations = told.markers_m.clone();
    stations[3] += 0.008;
    let mut data = measured(&told.with_markers(&stations), 5, 51);
    data.markers[3].station_m = Some(told.markers_m[3]);
    let d = of_one(&told, &data, None, &Options::default()).unwrap();
    assert_eq!(d.verdict, Some(Verdict::OutOfCatalog));
    let next = d.next_experiment.as_ref().unwrap();
    assert!(
        next.recommended.is_none() && next.tried.is_empty(),
        "names that are wrong are not to be separated: {next:?}"
    );
    assert!(
        next.sentence.contains("station of marker 4") && d.summary.last() == Some(&next.sentence),
        "{}",
        next.sentence
    );
    let pattern = d.pattern.as_ref().unwrap();
    assert!(pattern.words.contains("marker 4 sits elsewhere") && pattern.instead, "{pattern:?}");
    assert!(pattern.share > 0.9 && pattern.share <= 1.0 && pattern.p_value <= 1e-6, "{pattern:?}");
    assert!(d.summary.iter().any(|s| s.contains("It looks as if marker 4 sits elsewhere")), "{:?}", d.summary);
}

#[test]
fn one_of_sixty_markers_that_stands_alone_is_named() {
    let plain = robot("spam", 6.0);
    let told = plain.with_markers(&(0..60).map(|i| plain.length_m * (f64::from(i) + 0.5) / 60.0).collect::<Vec<_>>());
    let mut data = measured(&told, 3, 72);
    data.coordinates_m.iter_mut().skip(2 * 40 + 1).step_by(2 * 60).for_each(|y| *y += 2e-3);
    let options = Options { next_experiment: false, missing_moment: false, ..Options::default() };
    let d = of_one(&told, &data, None, &options).unwrap();
    assert_eq!(d.verdict, Some(Verdict::OutOfCatalog), "{:?}", d.summary);
    assert!(d.pattern.is_some_and(|p| p.words == "marker 41 alone is off in y" && p.p_value <= 1e-6));
}

#[test]
fn a_wrong_law_of_a_uniform_robot_leaves_a_time_and_no_place() {
    let plain = robot("spam", 6.0);
    for (effect, value, seed) in [("tail_tension", 0.9, 52), ("pressure_offset", 3e3, 53), ("friction", 0.4, 54)] {
        let [place, time] = left_by_base(&plain, &measured(&plain.with_effect(effect, &[value]), 5, seed));
        assert!(!place.0.pattern.is_uniform && time.0.pattern.is_uniform);
        assert!(time.1 <= 1e-6 && place.1 > 0.01, "{effect}: {place:?} {time:?}");
    }
}

#[test]
fn a_stiffness_that_falls_along_the_robot_is_a_place() {
    let plain = robot("epam", 1.35);
    let [(place, p_value), _] = left_by_base(&plain, &measured(&plain.with_effect("base_clamp", &[3.0, 1.5]), 5, 55));
    assert!(p_value <= 1e-6 && place.pattern.words.contains("stiffness changes steadily"), "{place:?}");
}

#[test]
fn noise_leaves_a_pattern_below_5_percent_in_about_5_percent_of_sets() {
    let mut below = 0;
    let kinds = [("spam", 6.0), ("epam", 1.35), ("cpam", 0.5), ("fpam", 0.3)];
    for seed in 0..100 {
        let (kind, bending) = kinds[seed % 4];
        let runs = [3, 5, 10][seed % 3];
        let truth = robot(kind, bending);
        let found = left_by_base(&truth, &measured(&truth, runs, 600 + seed as u64));
        below += usize::from(found.iter().any(|(_, p)| *p < 0.05));
    }
    // Of 100 sets at 5 % more than 11 are below once in 200 times.
    assert!(below <= 11, "{below} of 100");
}

/// By the whitened sum of squares alone `camera_rotation + marker_height` came first on an earlier set of the cPAM, and left 31 mm
/// of 16.
#[test]
fn an_attempt_comes_closer_in_mm_even_where_quiet_holds_ask_for_something_else() {
    let options = Options { keep_bending: true, next_experiment: false, missing_moment: false, ..Options::default() };
    for robot in ["cpam", "fpam"] {
        let (data, about) = data::load(&format!("fem-{robot}"), &mut |_, _| {}).unwrap();
        let d = of_one(&textbook_scenario(robot).unwrap().bare(), &data, about.as_ref(), &options).unwrap();
        let (before, after) = (d.base.systematic_mm, d.base.systematic_with_added_mm);
        // A known fault: a loss of pressure of another form, and a mount that turns, take nine tenths of what a bare cPAM lacks.
        if robot == "cpam" && d.verdict == Some(Verdict::Effect) {
            assert!(d.added.iter().any(|a| a.effect == "pressure_loss") && after < 0.15 * before, "{:?}", d.summary);
            continue;
        }
        assert!(d.verdict == Some(Verdict::OutOfCatalog) && !d.attempt.is_empty(), "{robot}");
        // The fPAM's markers on the wall leave more than half of their error with the best there is.
        assert!(after < if robot == "cpam" { 0.5 * before } else { before }, "{robot}: {before} to {after} mm");
        for other in d.ranked.iter().filter(|other| !other.at_bound) {
            let (name, mm) = (&other.effect, other.systematic_after_mm);
            assert!(mm > 0.8 * after, "{robot}: {name} comes to {mm} mm, {after} with {:?}", d.attempt);
        }
        // What comes as close is told beside it, and nothing that leaves the base as it was.
        let own: Vec<String> = d.attempt.iter().map(|a| a.effect.clone()).collect();
        let (attempt, others) = d.attempt_alike.split_first().unwrap();
        let told = |effects: &[String]| others.iter().any(|a| a.effects == effects);
        let most = before.min(after / 0.8);
        assert!(attempt.effects == own && (attempt.systematic_after_mm - after).abs() < 1e-9, "{robot}: {attempt:?}");
        assert!(others.iter().all(|a| a.systematic_after_mm < most) && !told(&own), "{robot}");
        for single in d.ranked.iter().filter(|r| !r.at_bound && own != [r.effect.clone()]) {
            let (name, mm) = (std::slice::from_ref(&single.effect), single.systematic_after_mm);
            assert_eq!(told(name), mm < most, "{robot}: {name:?} {mm} mm, {others:?}");
        }
    }
}

#[test]
fn what_hardly_moves_the_model_is_no_attempt() {
    let plain = robot("spam", 6.0);
    let mut data = generate(&plain, "made", &Generator { seed: 71, ..Generator::default() }).unwrap();
    // Labels of markers 3 and 4 exchanged: no law of the catalogue does that.
    for at in (0..data.coordinates_m.len()).step_by(12) {
        (4..6).for_each(|k| data.coordinates_m.swap(at + k, at + k + 2));
    }
    let options = Options { next_experiment: false, missing_moment: false, ..Options::default() };
    let d = of_one(&plain, &data, None, &options).unwrap();
    assert_eq!(d.verdict, Some(Verdict::OutOfCatalog));
    assert!(d.attempt.is_empty() && d.attempt_alike.is_empty(), "{:?}", d.attempt_alike);
    assert!(d.summary.iter().any(|s| s.contains("no effect of it takes a fifth")), "{:?}", d.summary);
    assert_eq!(d.base.systematic_with_added_mm, d.base.systematic_mm);
}
