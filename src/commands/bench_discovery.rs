//! `ibr bench discovery`: how often a diagnosis is right, on data whose hidden effects follow other laws.

use super::tables::table;
use super::{Context, Outcome};
use crate::failure::Failure;
use crate::output::machine;
use compare::diagnosis::{Options, diagnose};
use compare::hidden::bench::{Bench, BenchOptions, Row, Target, run as run_bench};
use compare::hidden::truth::{ROBOTS, standard_protocol};
use compare::hidden::{Draw, Truth};
use cpu_time::ThreadTime;
use serde_json::json;

/// Time wanted for a full diagnosis on one core \[s\].
const TIME_S: f64 = 1.0;

pub fn run(sets: usize, seed: u64, _context: &mut Context) -> Result<Outcome, Failure> {
    let options = BenchOptions { seed, sets };
    let bench = run_bench(&options, diagnose, &|_| ())?;
    let seconds = seconds(seed)?;
    let time = Row::number(
        "full diagnosis",
        "median CPU seconds on one core",
        Target::AtMost(TIME_S),
        Some(seconds),
        ROBOTS.len(),
    );
    let text = text(&bench, &time);
    let json = json!({
        "schema": "ibr.bench.discovery", "version": 1, "seed": seed, "sets": sets, "rows": bench.rows,
        "confusion": bench.confusion, "failed": bench.failed, "time": {"machine": machine(), "row": time},
    });
    Ok(Outcome::new(text, json))
}

/// Median CPU time of a diagnosis, one set with a hidden effect for every actuator.
fn seconds(seed: u64) -> Result<f64, Failure> {
    let mut times = Vec::new();
    for (index, (actuator, _)) in ROBOTS.iter().enumerate() {
        let mut truth = Truth::draw(actuator, &mut Draw::new(seed, u64::MAX - index as u64))?;
        truth.add("friction", 1.0);
        truth.add("camera_scale", 1.0);
        let (told, data) = (truth.told()?, truth.dataset("time", &standard_protocol())?);
        let start = ThreadTime::now();
        diagnose(&told, &data, None, &Options::default())?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(0.5 * (times[1] + times[2]))
}

fn text(bench: &Bench, time: &Row) -> String {
    let head = ["sets of", "figure", "wanted", "measured", "95 % interval", "sets", "met"];
    let mut out = format!("Diagnosis of data with hidden effects, seed {}\n", bench.seed);
    out.push_str(&table(&head, 2, bench.rows.iter().chain([time]).map(cells).collect()));
    out.push_str(
        "\nOne hidden effect: what was named (λ: separation of the two, below 16 the data do not hold the answer)\n",
    );
    let rows = bench.confusion.iter().map(|c| {
        let lambda = c.lambda.map_or("–".into(), |lambda| format!("{lambda:.1}"));
        vec![c.truth.clone(), c.named.clone(), c.count.to_string(), lambda]
    });
    out.push_str(&table(&["hidden", "named", "sets", "median λ"], 2, rows.collect()));
    for reason in &bench.failed {
        out.push_str(&format!("failed: {reason}\n"));
    }
    out
}

fn cells(row: &Row) -> Vec<String> {
    let number = |v: f64| if row.share { format!("{:.1} %", 100.0 * v) } else { format!("{v:.2}") };
    let wanted = match row.target {
        Target::AtLeast(v) => format!("≥ {}", number(v)),
        Target::AtMost(v) => format!("≤ {}", number(v)),
        Target::Between(low, high) => format!("{}–{}", number(low), number(high)),
    };
    let interval = row.interval.map_or("–".into(), |[low, high]| format!("{}–{}", number(low), number(high)));
    let met = row.met.map_or("–", |met| if met { "yes" } else { "no" });
    let measured = row.measured.map_or("–".into(), number);
    vec![row.case.into(), row.figure.into(), wanted, measured, interval, row.sets.to_string(), met.into()]
}
