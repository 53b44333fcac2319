//! A sweep as text and JSON.

use crate::tables::table as printed;
use ::sweep::influence::{influences, pairs};
use ::sweep::{Found, Study};
use data::table::{Column, Table};
use serde_json::{Value, json};
use std::path::Path;

/// Failed cases by their reason, the most frequent first.
fn failures(table: &Table) -> Vec<(String, usize)> {
    let texts = |name: &str| match table.columns.iter().find(|column| column.0 == name) {
        Some((_, Column::Str(all))) => &all[..],
        _ => &[],
    };
    let mut counted: std::collections::BTreeMap<&str, usize> = std::collections::BTreeMap::new();
    for (status, reason) in texts("status").iter().zip(texts("reason")) {
        if status == "failed" {
            *counted.entry(reason).or_default() += 1;
        }
    }
    let mut found: Vec<(String, usize)> = counted.into_iter().map(|(why, n)| (why.to_string(), n)).collect();
    found.sort_by_key(|(_, n)| std::cmp::Reverse(*n));
    found
}

/// How far the engines are from each other where both have a case.
fn agreement(table: &Table, (output, what): (&str, &str)) -> String {
    let mut off: Vec<f64> = pairs(table, output).iter().map(|[model, fe]| model - fe).collect();
    off.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (Some(middle), Some(worst)) = (off.get(off.len() / 2), off.last()) else { return String::new() };
    format!(
        "\n{} cases by both: the model's {what} is {:.1} mm off in the median, {worst:+.1} mm at worst\n",
        off.len(),
        middle.abs()
    )
}

/// Reasons that are printed.
const MOST_REASONS: usize = 3;

/// What came of a sweep.
pub fn swept_text(study: &Study, found: &Found, table: &Table) -> String {
    let engines: Vec<String> =
        study.engines.iter().map(|engine| format!("{} cases by {}", study.cases(*engine), engine.word())).collect();
    let name = &study.base.scenario.name;
    let mut text = format!(
        "{}: {}; {} of {} parts were there before\n",
        if name.is_empty() { &study.base.name } else { name },
        engines.join(", "),
        found.kept,
        found.parts
    );
    for engine in &study.engines {
        for (output, what) in study.heights() {
            let rows: Vec<Vec<String>> = influences(study, table, *engine, output)
                .iter()
                .map(|i| vec![i.key.clone(), format!("{:.1}", i.range()[0]), format!("{:.1}", i.range()[1])])
                .collect();
            if !rows.is_empty() {
                text += &format!("\nMean {what} over the values of each key, {}:\n", engine.word());
                text += &printed(&["key", "lowest mm", "highest mm"], 1, rows);
            }
        }
    }
    study.heights().iter().for_each(|height| text += &agreement(table, *height));
    let failed = failures(table);
    let count: usize = failed.iter().map(|f| f.1).sum();
    if count > 0 {
        text += &format!("\n{count} rows failed:\n");
    }
    failed.iter().take(MOST_REASONS).for_each(|(why, n)| text += &format!("  - {n}: {why}\n"));
    text
}

/// The same for programs; without a table only a shard was made.
pub fn swept_json(file: &Path, study: &Study, found: &Found, table: Option<&Table>) -> Value {
    let failed = table.map_or(Vec::new(), failures);
    json!({
        "schema": "ibr.sweep", "version": 1, "study": file.display().to_string(), "scenario": study.base.name,
        "cases": study.cases(sweep::Engine::Reduced), "engines": study.engines.iter().map(|engine| engine.word()).collect::<Vec<_>>(),
        "parts": found.parts, "kept": found.kept, "missing": found.missing, "cpu_s": found.cpu_s,
        "failed": failed.iter().map(|(reason, rows)| json!({"reason": reason, "rows": rows})).collect::<Vec<_>>(),
        "columns": sweep::names(study),
    })
}
