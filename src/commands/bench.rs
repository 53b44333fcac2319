//! `ibr bench`: speed of the model on this machine, beside what a controller needs.

use super::tables::table;
use super::{Context, Outcome};
use crate::failure::Failure;
use crate::output::machine;
use compare::study::published::shipped_scenario;
use models::{Loads, Model, Scenario, Target};
use serde_json::{Value, json};
use std::time::Instant;

/// Median over this many batches.
const BATCHES: usize = 31;

/// Predictions in one batch, in an order without pattern.
const BATCH: usize = 10_000;

struct Figure {
    id: String,
    median_us: f64,
    target_us: f64,
}

pub fn run(context: &mut Context) -> Result<Outcome, Failure> {
    let mut figures = Vec::new();
    for kind in models::actuators::ACTUATORS.iter().map(|a| a.name) {
        (context.progress)(kind, None);
        // The model without its mechanics beside it, in the same run.
        for name in [format!("{kind}-textbook"), kind.to_string()] {
            figures.extend(measure(&name, &shipped_scenario(&name)?)?);
        }
    }
    let rows = figures.iter().map(|f| {
        let met = if f.median_us <= f.target_us { "yes" } else { "no" };
        vec![f.id.clone(), format!("{:.3}", f.median_us), format!("{:.1}", f.target_us), met.into()]
    });
    let mut text = format!("Median time on one core of {}\n", machine());
    text.push_str(&table(&["what", "median [µs]", "wanted [µs]", "met"], 1, rows.collect()));
    let list: Vec<Value> = figures
        .iter()
        .map(|f| json!({"id": f.id, "median_us": f.median_us, "target_us": f.target_us, "met": f.median_us <= f.target_us}))
        .collect();
    Ok(Outcome::new(text, json!({"schema": "ibr.bench", "version": 1, "machine": machine(), "figures": list})))
}

fn measure(kind: &str, scenario: &Scenario) -> Result<Vec<Figure>, Failure> {
    let plain = Model::new(scenario);
    let loaded = Model::new(&scenario.with_effect("gravity", &[1.5]).with_effect("tip_load", &[0.0, -0.1]));
    let (mut a, mut b, mut c) = (plain.prediction(), loaded.prediction(), plain.prediction());
    let pressure = |i: usize, n: usize| 10e3 + 20e3 * i as f64 / n as f64;
    let p_body = scenario.p_body_pa;
    let single = median(500, |i, n| plain.predict(&Loads::uniform(p_body, pressure(i, n)), &mut a))?;
    let coupled = median(30, |i, n| loaded.predict(&Loads::uniform(p_body, pressure(i, n)), &mut b))?;
    plain.predict(&Loads::uniform(p_body, 10e3), &mut c)?;
    let low = c.tip.y_m;
    plain.predict(&Loads::uniform(p_body, 30e3), &mut c)?;
    let high = c.tip.y_m;
    let wanted = |i: usize, n: usize| Target::TipHeight(low + (high - low) * i as f64 / n as f64);
    let inverse = median(50, |i, n| plain.pressure_for(wanted(i, n), p_body, &mut c).map(|_| ()))?;
    let all: Vec<Loads> = (0..BATCH).map(|i| Loads::uniform(p_body, pressure(i * 7919 % BATCH, BATCH))).collect();
    let mut batch = plain.batch(all.len(), 1);
    let whole = median(1, |_, _| plain.predict_batch(&all, &mut batch))?;
    let figure =
        |what: &str, median_us: f64, target_us: f64| Figure { id: format!("{what}/{kind}"), median_us, target_us };
    Ok(vec![
        figure("predict", single, 1.0),
        figure("batch of 10 000, each", whole / BATCH as f64, 0.4),
        figure("predict with gravity and tip load, 12 segments", coupled, 20.0),
        figure("inverse", inverse, 10.0),
    ])
}

/// Median over batches of the time per call \[µs\].
fn median(calls: usize, mut call: impl FnMut(usize, usize) -> Result<(), models::Unsolved>) -> Result<f64, Failure> {
    let mut times = Vec::with_capacity(BATCHES);
    for _ in 0..BATCHES {
        let start = Instant::now();
        for i in 0..calls {
            std::hint::black_box(call(i, calls))?;
        }
        times.push(start.elapsed().as_secs_f64() * 1e6 / calls as f64);
    }
    times.sort_by(f64::total_cmp);
    Ok(times[BATCHES / 2])
}
