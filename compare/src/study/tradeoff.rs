//! Run time against accuracy of every model present.

use crate::error::CompareError;
use crate::study::published::{PublishedLadder, Rung};
use models::{Loads, Model, Scenario};
use std::time::Instant;

/// Time and error of one model.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Timing {
    /// Engine: `reduced` (others follow).
    pub engine: String,
    /// Actuator kind.
    pub actuator: String,
    /// Model in words.
    pub model: String,
    /// Median time of one prediction, equilibrium and markers \[µs\].
    pub prediction_us: f64,
    /// Predicted minus published displacement \[mm\].
    pub error_mm: f64,
    /// The same relative to the published displacement \[%\].
    pub error_pct: f64,
    /// `predicted`, `assumed` or `calibrated`: how the values of the model are known.
    pub known: String,
}

/// Batches timed; the median of them is reported.
const BATCHES: usize = 21;
/// Predictions per batch: long against the clock's resolution.
const PER_BATCH: usize = 500;

/// Median time of one prediction at pressures from 10 to 30 kPa \[s\].
///
/// # Errors
/// What the model returns.
pub fn time_prediction(scenario: &Scenario) -> Result<f64, CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let mut times = Vec::with_capacity(BATCHES);
    for _ in 0..BATCHES {
        let start = Instant::now();
        for i in 0..PER_BATCH {
            let p = 10e3 + 20e3 * i as f64 / PER_BATCH as f64;
            model.predict(&Loads::uniform(scenario.p_body_pa, p), &mut state)?;
            std::hint::black_box(&state);
        }
        times.push(start.elapsed().as_secs_f64() / PER_BATCH as f64);
    }
    times.sort_by(f64::total_cmp);
    Ok(times[BATCHES / 2])
}

/// Times every rung of the published ladders.
///
/// # Errors
/// What the models return.
pub fn tradeoff(ladders: &[PublishedLadder]) -> Result<Vec<Timing>, CompareError> {
    let mut timings = Vec::new();
    for ladder in ladders {
        for rung in &ladder.rungs {
            timings.push(timing(ladder, rung)?);
        }
    }
    Ok(timings)
}

fn timing(ladder: &PublishedLadder, rung: &Rung) -> Result<Timing, CompareError> {
    let error = rung.y_m - ladder.published.d_max_m;
    Ok(Timing {
        engine: "reduced".into(),
        actuator: ladder.published.kind.clone(),
        model: rung.label.clone(),
        prediction_us: time_prediction(&rung.scenario)? * 1e6,
        error_mm: error * 1e3,
        error_pct: 100.0 * error / ladder.published.d_max_m,
        known: rung.known.word().to_string(),
    })
}
