//! Run time against accuracy of every model present.

use super::{PublishedLadder, Rung};
use crate::error::CompareError;
use crate::study::engines::{EngineRun, as_it_is, ensemble};
use models::{Loads, Model, Scenario};
use std::time::Instant;

/// Time and error of one model.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Timing {
    /// Engine of the prediction: `reduced` or `finite elements`.
    pub engine: String,
    /// Actuator kind of the robot, such as `epam`.
    pub actuator: String,
    /// Short description of the model in words.
    pub model: String,
    /// Median time of one prediction, equilibrium and markers \[µs\].
    pub prediction_us: f64,
    /// Predicted minus published displacement of the outermost marker \[mm\].
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
pub fn tradeoff(ladders: &[PublishedLadder]) -> Result<Vec<Timing>, CompareError> {
    let mut timings = Vec::new();
    for ladder in ladders {
        for Rung { label, scenario, y_m, known, .. } in &ladder.rungs {
            let seconds = time_prediction(scenario)?;
            timings.push(timing("reduced", ladder, label, seconds, y_m - ladder.published.d_max_m, known.word()));
        }
    }
    Ok(timings)
}

/// Finite element runs of the published robots at their own body pressure, at 30 kPa, on every mesh: the mean over the seeds.
pub fn of_runs(ladders: &[PublishedLadder], runs: &[EngineRun]) -> Vec<Timing> {
    let mut timings = Vec::new();
    for ladder in ladders {
        let Some(Rung { scenario, .. }) = ladder.rungs.first() else { continue };
        let own: Vec<&EngineRun> = runs.iter().filter(|run| as_it_is(run, scenario)).collect();
        let mut meshes: Vec<f64> = own.iter().map(|run| run.mesh_mm[1]).collect();
        meshes.sort_by(|a, b| b.total_cmp(a));
        meshes.dedup();
        for mesh in meshes {
            let of_mesh = own.iter().filter(|r| r.mesh_mm[1] == mesh);
            let ensemble = ensemble(&of_mesh.map(|r| (*r).clone()).collect::<Vec<_>>(), scenario);
            let reached = ensemble.at(ladder.published.d_max_pressure_pa * 1e-3);
            let (Some(run), Some([(marker_mm, _), _])) = (ensemble.runs.first(), reached) else { continue };
            let (label, off_m) = (format!("FE {mesh} mm"), 1e-3 * marker_mm - ladder.published.d_max_m);
            timings.push(timing("finite elements", ladder, &label, ensemble.cpu_s(), off_m, &run.known));
        }
    }
    timings
}

fn timing(engine: &str, ladder: &PublishedLadder, model: &str, seconds: f64, off_m: f64, known: &str) -> Timing {
    Timing {
        engine: engine.into(),
        actuator: ladder.published.kind.clone(),
        model: model.into(),
        prediction_us: seconds * 1e6,
        error_mm: off_m * 1e3,
        error_pct: 100.0 * off_m / ladder.published.d_max_m,
        known: known.into(),
    }
}
