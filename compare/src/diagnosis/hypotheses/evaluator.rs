//! Predictions for a fit: thousands of models, one prediction each.
//!
//! A model is assembled from the scenario per parameter vector; that costs about as much as one hold. Holds at equal
//! pressures share one equilibrium, unless the model has history: then the whole protocol is walked.

use crate::error::CompareError;
use crate::study::predict::{as_in_data, coordinates, loads, protocol};
use data::Dataset;
use models::{Model, Prediction, Scenario};

/// Fills `out`, in run layout, at the given holds \[m\]; other values stay as they are. Where too few runs saw a marker, `out` gets the
/// value of the data.
pub(crate) fn positions(
    scenario: &Scenario,
    dataset: &Dataset,
    holds: &[usize],
    out: &mut [f64],
) -> Result<(), CompareError> {
    everywhere(scenario, dataset, holds, out)?;
    as_in_data(dataset, out);
    Ok(())
}

fn everywhere(scenario: &Scenario, dataset: &Dataset, holds: &[usize], out: &mut [f64]) -> Result<(), CompareError> {
    let model = Model::new(scenario);
    let width = dataset.values_per_run() / dataset.holds.len();
    if model.has_history() {
        return walked(&model, dataset, holds, out);
    }
    let mut state = model.prediction();
    for (i, &hold) in holds.iter().enumerate() {
        let at = loads(&dataset.holds[hold], 1.0);
        match holds[..i].iter().find(|&&before| loads(&dataset.holds[before], 1.0) == at) {
            Some(&twin) => out.copy_within(twin * width..(twin + 1) * width, hold * width),
            None => {
                model.predict(&at, &mut state)?;
                for sample in out[hold * width..(hold + 1) * width].chunks_exact_mut(width / dataset.samples_per_hold) {
                    sample.iter_mut().zip(coordinates(&state, dataset.axes)).for_each(|(to, value)| *to = value);
                }
            }
        }
    }
    Ok(())
}

fn walked(model: &Model, dataset: &Dataset, holds: &[usize], out: &mut [f64]) -> Result<(), CompareError> {
    let samples = dataset.samples_per_hold;
    let width = dataset.axes * dataset.markers.len();
    let mut keep = |step: usize, at: &Prediction| {
        if holds.contains(&(step / samples)) {
            let row = &mut out[step * width..(step + 1) * width];
            row.iter_mut().zip(coordinates(at, dataset.axes)).for_each(|(to, value)| *to = value);
        }
    };
    let steps = protocol(dataset, 1.0);
    model.follow(&steps, &mut model.prediction(), &mut keep)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::predict_dataset;
    use crate::study::{Generator, generate, published::textbook_scenario};

    #[test]
    fn the_fast_predictions_are_those_of_the_study() {
        for kind in ["spam", "cpam", "epam", "fpam"] {
            let plain = textbook_scenario(kind).unwrap().with_bending(1.0);
            for effect in models::effects::EFFECTS.iter().filter(|e| e.applies_to(plain.actuator.kind.family)) {
                let scenario = plain.with_effect(effect.name, &effect.typical());
                let dataset = generate(&scenario, "made", &Generator { runs: 1, ..Generator::default() }).unwrap();
                let whole = predict_dataset(&scenario, &dataset).unwrap().coordinates_m;
                let mut fast = vec![0.0; whole.len()];
                positions(&scenario, &dataset, &[1, 2], &mut fast).unwrap();
                positions(&scenario, &dataset, &[0, 3, 4], &mut fast).unwrap();
                assert_eq!(fast, whole, "{kind} {}", effect.name);
            }
        }
    }
}
