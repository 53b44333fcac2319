//! Predictions for a fit: thousands of models, one prediction each.
//!
//! A model is assembled from the scenario per parameter vector; that costs about as much as one hold. Holds at equal
//! pressures share one equilibrium.

use crate::error::CompareError;
use data::Dataset;
use models::{Loads, Model, Scenario};

/// Fills `out`, in run layout, at the given holds \[m\]; other values stay as they are.
///
/// # Errors
/// What the model returns when a hold has no equilibrium.
pub fn positions(scenario: &Scenario, dataset: &Dataset, holds: &[usize], out: &mut [f64]) -> Result<(), CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let width = dataset.values_per_run() / dataset.holds.len();
    for (i, &hold) in holds.iter().enumerate() {
        let [p_body, p_act] = pressures(dataset, hold);
        match holds[..i].iter().find(|&&before| pressures(dataset, before) == [p_body, p_act]) {
            Some(&twin) => out.copy_within(twin * width..(twin + 1) * width, hold * width),
            None => {
                model.predict(&Loads::uniform(p_body, p_act), &mut state)?;
                let row = &mut out[hold * width..(hold + 1) * width];
                for (at, xy) in row.chunks_exact_mut(2).zip(state.markers.iter().cycle()) {
                    at.copy_from_slice(xy);
                }
            }
        }
    }
    Ok(())
}

fn pressures(dataset: &Dataset, hold: usize) -> [f64; 2] {
    [dataset.holds[hold].p_body_pa, dataset.holds[hold].p_act_pa]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::predict_dataset;
    use crate::study::{Generator, generate, published::shipped_scenario};

    #[test]
    fn the_fast_predictions_are_those_of_the_study() {
        for kind in ["spam", "cpam", "epam", "fpam"] {
            let scenario = shipped_scenario(kind).unwrap().with_bending(1.0).with_effect("gravity", &[1.5]);
            let dataset = generate(&scenario, "made", &Generator { runs: 1, ..Generator::default() }).unwrap();
            let mut fast = vec![0.0; dataset.values_per_run()];
            positions(&scenario, &dataset, &[0, 1, 2, 3, 4], &mut fast).unwrap();
            assert_eq!(fast, predict_dataset(&scenario, &dataset).unwrap().xy_m);
        }
    }
}
