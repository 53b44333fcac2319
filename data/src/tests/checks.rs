//! Scatter, outliers, copies and warnings that `check` reports.

use super::{read, table};
use crate::{Dataset, check};

/// Uniform numbers in −1..1 by a linear congruential generator (Knuth's MMIX constants).
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Sum of twelve uniforms: normal with unit variance, near enough for tests of thresholds.
fn normal(seed: &mut u64) -> f64 {
    (0..12).map(|_| 0.5 * noise(seed)).sum()
}

/// The good table with noise of 1 mm, run offsets of 0.5 mm and a run gain of 2 %, as a real camera set has.
fn noisy(runs: usize, mut seed: u64) -> Dataset {
    let mut data = read(&table(runs, 5)).unwrap();
    let values = data.values_per_run();
    for run in 0..runs {
        let (gain, offset) = (1.0 + 0.02 * normal(&mut seed), [0.5e-3 * normal(&mut seed), 0.5e-3 * normal(&mut seed)]);
        for i in 0..values {
            let value = &mut data.coordinates_m[run * values + i];
            *value = if i % 2 == 1 { *value * gain } else { *value } + offset[i % 2] + 1e-3 * normal(&mut seed);
        }
    }
    data
}

#[test]
fn the_report_lists_runs_holds_markers_and_pressures() {
    let report = check(&read(&table(3, 5)).unwrap(), None);
    assert_eq!((report.runs.len(), report.holds.len(), report.markers.len()), (3, 5, 2));
    assert_eq!(report.actuator_pressures_kpa, [0.0, 10.0, 20.0, 30.0]);
    assert_eq!((report.body_pressures_kpa.as_slice(), report.unloading), ([2.0].as_slice(), true));
    assert_eq!(report.holds[3].duration_s, 2.0);
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["holds"][4]["phase"], "unload");
}

#[test]
fn scatter_is_the_standard_deviation_of_hold_means_over_runs() {
    // The table shifts y by 0.1 mm per run and x not at all: sd 0.1 in y, 0 in x, rms over axes 0.1/√2.
    let report = check(&read(&table(3, 5)).unwrap(), None);
    let expected = 0.1 / 2.0_f64.sqrt();
    for scatter in report.markers.iter().map(|m| m.scatter_mm).chain(report.holds.iter().map(|h| h.scatter_mm)) {
        assert!((scatter.unwrap() - expected).abs() < 1e-9, "{scatter:?}");
    }
}

#[test]
fn one_run_is_no_error_but_has_no_noise_floor_and_says_so() {
    let report = check(&read(&table(1, 5)).unwrap(), None);
    assert!(report.markers.iter().all(|marker| marker.scatter_mm.is_none()));
    assert!(report.warnings.iter().any(|w| w.contains("no p-values can be given; at least 3 runs are needed")));
    assert!(check(&read(&table(3, 5)).unwrap(), None).warnings.iter().all(|w| !w.contains("p-values")));
}

#[test]
fn a_copied_run_is_noticed() {
    let mut data = noisy(4, 1);
    assert!(check(&data, None).identical_runs.is_empty());
    let copy = data.run(1).to_vec();
    let values = data.values_per_run();
    data.coordinates_m[3 * values..].copy_from_slice(&copy);
    assert_eq!(check(&data, None).identical_runs, [["2".to_string(), "4".to_string()]]);
}

#[test]
fn a_marker_taken_for_another_in_one_frame_is_listed() {
    // Half the distance between the two markers, against a scatter of 1 to 3 mm.
    for (runs, seed) in [3, 5, 10].into_iter().flat_map(|runs| (0..50).map(move |seed| (runs, seed))) {
        let mut data = noisy(runs, seed);
        let values = data.values_per_run();
        let one = data.offset(2, 3, 1) + 1;
        data.coordinates_m[values + one] += 0.150;
        let report = check(&data, None);
        let place =
            |o: &&crate::check::Outlier| (o.run.as_str(), o.hold, o.sample, o.marker.as_str()) == ("2", 2, 3, "2");
        let found = report.outliers.iter().find(place).unwrap();
        assert!((found.dy_mm - 150.0).abs() < 20.0, "{runs} runs, seed {seed}: {found:?}");
        assert!(report.warnings.iter().any(|warning| warning.contains("robust standard deviations")));
    }
}

#[test]
fn good_data_have_hardly_any_outlier() {
    // An even number of runs has two middle ones, whose distance to the median is small: four runs are the worst case.
    for (runs, most) in [(3, 2), (4, 8), (5, 2), (10, 2)] {
        let alarms = (0..200).filter(|seed| !check(&noisy(runs, 1000 + seed), None).outliers.is_empty()).count();
        assert!(alarms <= most, "{runs} runs: {alarms} of 200 good datasets have an outlier");
    }
}

/// The good table with the phases or times changed in the text, and what is said of it.
fn contradictions(change: impl Fn(String) -> String) -> Vec<String> {
    crate::check::contradictions(&read(&change(table(3, 5))).unwrap())
}

#[test]
fn phases_that_contradict_the_pressures_are_told_with_their_holds() {
    let told = contradictions(|text| text.replace(",load,", ",unload,"));
    let words = "markers: the column phase contradicts the actuator's pressure in 3 of 5 holds: hold 2 goes from 0.0 to 10.0 kPa \
                 and is marked unload, not load; hold 3 ";
    assert!(told.len() == 1 && told[0].starts_with(words), "{told:?}");
    let told = contradictions(|text| text.replace(",unload,", ",load,"));
    assert!(
        told[0].contains("in 1 of 5 holds: hold 5 goes from 30.0 to 0.0 kPa and is marked load, not unload."),
        "{told:?}"
    );
    let report = check(&read(&table(3, 5).replace(",unload,", ",hold,")).unwrap(), None);
    assert!(report.warnings.iter().any(|w| w.contains("is marked hold, not unload")), "{:?}", report.warnings);
}

#[test]
fn good_phases_pass_and_so_does_another_session_that_starts_over() {
    assert_eq!(contradictions(|text| text), [""; 0]);
    for set in crate::sets().into_iter().filter(crate::SetInfo::has_markers) {
        let (dataset, _) = crate::load(&set.name, &mut |_, _| ()).unwrap();
        assert_eq!(crate::check::contradictions(&dataset), [""; 0], "{}", set.name);
    }
    let mut data = read(&table(3, 5)).unwrap();
    let again = data.holds[1].clone();
    data.holds.push(crate::Hold { occurrence: 1, ..again });
    let first = crate::Hold { phase: crate::Phase::Load, ..data.holds[0].clone() };
    data.holds.insert(4, first);
    assert_eq!(crate::check::contradictions(&data), [""; 0]);
}

#[test]
fn times_that_look_like_milliseconds_are_told() {
    let mut data = read(&table(3, 5)).unwrap();
    data.holds.iter_mut().flat_map(|hold| &mut hold.t_s).for_each(|t| *t *= 1e3);
    assert!(crate::check::contradictions(&data)[0].contains("name the column t_ms"));
}
