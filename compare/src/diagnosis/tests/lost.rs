//! Markers that were lost: what is left out must be as if it had never been there.

use super::{Diagnosis, Options, Ranked, Verdict};
use crate::diagnosis::tests::of_one;
use crate::study::published::textbook_scenario;
use crate::{EvaluateOptions, Evaluation, evaluate};
use data::Dataset;

fn set() -> Dataset {
    data::load("synthetic-epam", &mut |_, _| {}).unwrap().0
}

/// The set as if it never had this marker.
fn without(marker: usize) -> Dataset {
    let whole = set();
    let width = whole.markers.len();
    let kept = |(i, _): &(usize, &[f64])| i % width != marker;
    let coordinates_m =
        whole.coordinates_m.chunks(2).enumerate().filter(kept).flat_map(|(_, xy)| xy.to_vec()).collect();
    let markers = whole.markers.iter().enumerate().filter(|(m, _)| *m != marker).map(|(_, m)| m.clone()).collect();
    Dataset { markers, coordinates_m, ..whole }
}

/// The set with a marker that was lost in every hold; what stands there is far off.
fn blind(marker: usize) -> Dataset {
    let mut data = set();
    data.lost.unseen = (0..data.holds.len()).map(|hold| [hold, marker]).collect();
    let (runs, n) = (data.runs.len(), data.values_per_run());
    for i in data.unseen_values().collect::<Vec<_>>() {
        (0..runs).for_each(|run| data.coordinates_m[run * n + i] = 0.7 + i as f64);
    }
    data
}

fn diagnosed(dataset: &Dataset) -> Diagnosis {
    let options = Options { next_experiment: false, missing_moment: false, ..Options::default() };
    of_one(&textbook_scenario("epam").unwrap(), dataset, None, &options).unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * a.abs().max(b.abs()).max(1e-3)
}

#[test]
fn a_marker_lost_everywhere_is_as_if_it_were_not_there() {
    for marker in [2, 5] {
        let [found, expected] = [blind(marker), without(marker)].map(|data| diagnosed(&data));
        assert!(close(found.base.bending[0].value_nm2, expected.base.bending[0].value_nm2));
        for (a, b) in [
            (found.base.systematic_mm, expected.base.systematic_mm),
            (found.base.systematic_with_added_mm, expected.base.systematic_with_added_mm),
            (found.base.heldout_mm.unwrap(), expected.base.heldout_mm.unwrap()),
            (found.base.heldout_run_mm.unwrap(), expected.base.heldout_run_mm.unwrap()),
            (found.noise.camera_mm.unwrap(), expected.noise.camera_mm.unwrap()),
        ] {
            assert!(close(a, b), "{a} {b}");
        }
        assert_eq!(found.indistinguishable, expected.indistinguishable);
        assert_eq!((found.verdict, expected.verdict), (Some(Verdict::Effect), Some(Verdict::Effect)));
        // Fits of laws that explain a fiftieth of the best end anywhere in a flat valley: rounding moves their gain by up to a tenth.
        let best = expected.ranked[0].gain;
        let counts = |rows: &[Ranked]| rows.iter().filter(|row| row.gain > 0.02 * best).cloned().collect::<Vec<_>>();
        let (found, expected) = (counts(&found.ranked), counts(&expected.ranked));
        assert!(found.len() == expected.len() && found.len() > 10, "{}", found.len());
        for (a, b) in found.iter().zip(&expected) {
            assert_eq!(a.effect, b.effect);
            // A fit ends where a round lowers the sum of squares by less than 1e-4.
            let same = |a: f64, b: f64| close(a, b) || (a - b).abs() < 1e-4;
            assert!(same(a.gain, b.gain) && same(a.value, b.value), "{}: {} {}", a.effect, a.gain, b.gain);
            // That moves a value, and an end of its interval, by a hundredth of a standard error, a quarter of the interval.
            let width = b.hi.zip(b.lo).map_or(0.0, |(hi, lo)| hi - lo);
            for (a, b) in [(a.lo, b.lo), (a.hi, b.hi)] {
                assert!(a.zip(b).is_none_or(|(a, b)| (a - b).abs() <= 0.0025 * width), "{a:?} {b:?}");
                assert_eq!(a.is_some(), b.is_some());
            }
            assert!(same(a.bic_difference, b.bic_difference), "{}", a.effect);
        }
    }
}

fn evaluated(dataset: &Dataset) -> Evaluation {
    let scenario = textbook_scenario("epam").unwrap().with_bending(1.0);
    let (scenario, _) = crate::study::fit_scenario(&scenario, dataset, None).unwrap();
    let predicted = crate::study::predict_dataset(&scenario, dataset).unwrap();
    evaluate(dataset, &predicted.coordinates_m, &predicted.d_ln_pressure_m, &EvaluateOptions::default()).unwrap()
}

#[test]
fn a_comparison_is_that_without_the_marker() {
    let [found, expected] = [blind(5), without(5)].map(|data| evaluated(&data));
    let [a, b] = [&found, &expected].map(|e| serde_json::to_value(&e.metrics.overall).unwrap());
    for (key, value) in b.as_object().unwrap() {
        let (x, y) = (a[key].as_f64(), value.as_f64());
        assert!(x.zip(y).is_none_or(|(x, y)| close(x, y)) && x.is_some() == y.is_some(), "{key}: {x:?} {y:?}");
    }
    for (a, b) in found.metrics.holds.iter().zip(&expected.metrics.holds) {
        assert!(close(a.tip_error_mm, b.tip_error_mm) && close(a.rmse_mm, b.rmse_mm));
        assert!(close(a.reduced_chi2.unwrap(), b.reduced_chi2.unwrap()));
    }
    assert_eq!(found.where_it_fails.len(), expected.where_it_fails.len());
    assert!(found.residual_map.cells[5].iter().all(|cell| !cell.seen && cell.y.mm == 0.0));
}
