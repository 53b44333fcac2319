//! `ibr tradeoff`

use super::tables::table;
use super::{Context, Outcome};
use crate::cli::TradeoffArgs;
use crate::failure::Failure;
use crate::output::{check_folder, machine, write_files};
use compare::study::engines::known_runs;
use compare::study::published::published_ladders;
use compare::study::tradeoff::{of_runs, tradeoff};
use ibr::pages::{Files, tradeoff_plot};
use serde_json::json;

pub fn run(args: &TradeoffArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let out = args.out.as_deref();
    out.map_or(Ok(()), check_folder)?;
    (context.progress)("timing", None);
    let ladders = published_ladders()?;
    let mut timings = tradeoff(&ladders)?;
    timings.extend(of_runs(&ladders, &known_runs(args.runs.as_deref())?));
    let rows = timings.iter().map(|t| {
        vec![
            t.engine.clone(),
            t.actuator.clone(),
            t.model.clone(),
            t.known.clone(),
            time(t.prediction_us),
            format!("{:+.1}", t.error_mm),
            format!("{:.1}", t.error_pct.abs()),
        ]
    });
    let head = ["engine", "actuator", "model", "how known", "time", "error [mm]", "error [%]"];
    let mut text = format!(
        "One prediction of the reduced model (equilibrium, six markers) on {}, one finite element run to 30 kPa \
        (processor time); error of the published displacement: outermost marker, finite elements mean of seeds\n",
        machine()
    );
    text.push_str(&table(&head, 4, rows.collect()));
    if let Some(folder) = out {
        let mut files = Files::default();
        files.plot("tradeoff", tradeoff_plot(&timings)?);
        write_files(folder, &files, &[], context)?;
    }
    Ok(Outcome::new(text, json!({"schema": "ibr.tradeoff", "version": 1, "machine": machine(), "models": timings})))
}

/// Microseconds to minutes.
fn time(us: f64) -> String {
    match us {
        us if us < 1e3 => format!("{us:.2} µs"),
        us => format!("{:.1} s", us * 1e-6),
    }
}
