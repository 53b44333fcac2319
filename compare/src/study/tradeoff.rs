//! Run time against accuracy of every model present.

use crate::error::CompareError;
use crate::study::engines::{EngineRun, Ensemble, as_it_is, ensemble};
use crate::study::published::{PublishedLadder, Rung};
use models::{Loads, Model, Scenario};
use std::time::Instant;

/// Time and error of one model.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Timing {
    /// Engine: `reduced` or `finite elements`.
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

/// Finite element runs of the published robots at their own body pressure, at 30 kPa, on every mesh.
pub fn of_runs(ladders: &[PublishedLadder], runs: &[EngineRun]) -> Vec<Timing> {
    let mut timings = Vec::new();
    for ladder in ladders {
        let Some(rung) = ladder.rungs.first() else { continue };
        let own: Vec<&EngineRun> = runs.iter().filter(|run| as_it_is(run, &rung.scenario)).collect();
        let mut meshes: Vec<f64> = own.iter().map(|run| run.mesh_mm[1]).collect();
        meshes.sort_by(|a, b| b.total_cmp(a));
        meshes.dedup();
        for mesh in meshes {
            let of_mesh: Vec<EngineRun> = own.iter().filter(|r| r.mesh_mm[1] == mesh).map(|r| (*r).clone()).collect();
            timings.extend(of_ensemble(ladder, &ensemble(&of_mesh, &rung.scenario), format!("FE {mesh} mm")));
        }
    }
    timings
}

/// Mean over the seeds, outermost marker.
fn of_ensemble(ladder: &PublishedLadder, ensemble: &Ensemble, model: String) -> Option<Timing> {
    let run = ensemble.runs.first()?;
    let [(marker_mm, _), _] = ensemble.at(ladder.published.d_max_pressure_pa * 1e-3)?;
    let measured_mm = ladder.published.d_max_m * 1e3;
    let error_mm = marker_mm - measured_mm;
    Some(Timing {
        engine: "finite elements".into(),
        actuator: run.actuator.clone(),
        model,
        prediction_us: ensemble.cpu_s() * 1e6,
        error_mm,
        error_pct: 100.0 * error_mm / measured_mm,
        known: run.known.clone(),
    })
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
