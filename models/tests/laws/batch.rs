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
            let mut batch = model.batch(3);
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

#[test]
fn a_batch_stops_at_the_first_state_that_cannot_be_and_keeps_those_before() {
    let model = Model::new(&robot("epam"));
    let loads = [Loads::uniform(2e3, 1e4), Loads::uniform(2e3, 2e4), Loads::uniform(2e3, -1.0)];
    let mut batch = model.batch(3);
    assert!(model.predict_batch(&loads, &mut batch).is_err());
    assert_eq!((batch.tips.len(), batch.markers.len()), (2, 12));
}
