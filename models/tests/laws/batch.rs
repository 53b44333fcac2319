//! A batch is its single predictions.

use crate::support::*;
use models::{Loads, Model};

#[test]
fn a_batch_is_identical_to_single_predictions_to_the_bit() {
    for actuator in actuators() {
        for scenario in [robot(actuator).with_bending(0.4), everything(actuator)] {
            let model = Model::new(&scenario);
            let mut random = Random(99);
            let loads: Vec<Loads> =
                (0..60).map(|_| Loads::uniform(random.between(1e3, 8e3), random.decades(500.0, 1e5))).collect();
            for threads in [0, 1, 2, 7, 100] {
                let mut batch = model.batch(3, threads);
                // Twice: what the buffers held before does not matter.
                for _ in 0..2 {
                    model.predict_batch(&loads, &mut batch).unwrap();
                }
                assert_eq!((batch.tips.len(), batch.markers.len()), (60, 360));
                for (i, item) in loads.iter().enumerate() {
                    let single = predicted(&model, item).unwrap();
                    assert_eq!(single.tip, batch.tips[i], "{actuator} {i}");
                    assert_eq!(single.markers, batch.markers[6 * i..6 * i + 6], "{actuator} {i}");
                }
            }
        }
    }
}

#[test]
fn a_batch_stops_at_the_first_state_that_cannot_be_and_keeps_those_before() {
    let model = Model::new(&robot("epam"));
    let mut loads = vec![Loads::uniform(2e3, 1e4); 20];
    loads[7] = Loads::uniform(2e3, -1.0);
    loads[15] = Loads::uniform(-1.0, 1e4);
    for threads in [1, 2, 5] {
        let mut batch = model.batch(20, threads);
        let error = model.predict_batch(&loads, &mut batch).unwrap_err();
        assert!(error.to_string().contains("actuator pressure must be from 0 to 1000 kPa, not -0.001"), "{error}");
        assert_eq!((batch.tips.len(), batch.markers.len()), (7, 42));
    }
}

#[test]
fn an_empty_batch_and_a_robot_without_markers_are_no_special_case() {
    let model = Model::new(&robot("epam").with_markers(&[]));
    for threads in [1, 3] {
        let mut batch = model.batch(0, threads);
        model.predict_batch(&[], &mut batch).unwrap();
        assert!(batch.tips.is_empty() && batch.markers.is_empty());
        model.predict_batch(&[Loads::uniform(2e3, 1e4); 2], &mut batch).unwrap();
        assert_eq!((batch.tips.len(), batch.markers.len()), (2, 0));
    }
}
