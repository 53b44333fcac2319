//! `ibr tradeoff`

use super::tables::table;
use super::{Context, Outcome};
use crate::failure::Failure;
use crate::output::{check_folder, machine, write_files};
use compare::study::pages::{Files, tradeoff_plot};
use compare::study::published::published_ladders;
use compare::study::tradeoff::tradeoff;
use serde_json::json;
use std::path::Path;

pub fn run(out: Option<&Path>, context: &mut Context) -> Result<Outcome, Failure> {
    out.map_or(Ok(()), check_folder)?;
    (context.progress)("timing", None);
    let timings = tradeoff(&published_ladders()?)?;
    let rows = timings.iter().map(|t| {
        vec![
            t.engine.clone(),
            t.actuator.clone(),
            t.model.clone(),
            t.known.clone(),
            format!("{:.2}", t.prediction_us),
            format!("{:+.1}", t.error_mm),
            format!("{:.1}", t.error_pct.abs()),
        ]
    });
    let head = ["engine", "actuator", "model", "how known", "time [µs]", "error [mm]", "error [%]"];
    let mut text =
        format!("One prediction (equilibrium, six markers) on {}; error of the published displacement\n", machine());
    text.push_str(&table(&head, 4, rows.collect()));
    if let Some(folder) = out {
        let drawn = tradeoff_plot(&timings)?;
        let mut files = Files::default();
        files.files.push(("tradeoff.svg".into(), drawn.svg.into_bytes()));
        files.files.push(("tradeoff.png".into(), drawn.png));
        write_files(folder, &files, &[], context)?;
    }
    Ok(Outcome::new(text, json!({"schema": "ibr.tradeoff", "version": 1, "machine": machine(), "models": timings})))
}
