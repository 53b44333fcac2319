//! A sweep as text and JSON.

use crate::prelude::*;
use crate::tables::Table as Rows;
use ::sweep::influence::{influences, pairs};
use ::sweep::{Found, Study};
use data::table::{Column, Table};

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

pub(crate) fn swept_text(study: &Study, found: &Found, table: &Table) -> String {
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
            text += &Rows::of(influences(study, table, *engine, output))
                .words("key", |i| i.key.clone())
                .number("lowest mm", 1, |i| i.range()[0])
                .number("highest mm", 1, |i| i.range()[1])
                .under(&format!("Mean {what} over the values of each key, {}:", engine.word()));
        }
    }
    study.heights().iter().for_each(|height| text += &agreement(table, *height));
    let failed = failures(table);
    let count: usize = failed.iter().map(|f| f.1).sum();
    if count > 0 {
        text += &format!("\n{count} rows failed:\n");
    }
    text + &lines("  - ", failed.iter().take(MOST_REASONS).map(|(why, n)| format!("{n}: {why}")))
}

/// `ibr.sweep`: `ibr sweep STUDY`
#[derive(Serialize)]
pub(crate) struct SweepAnswer<'a> {
    /// The study as typed
    pub study: String,
    /// The robot
    pub scenario: &'a str,
    /// Cases of the study
    pub cases: usize,
    /// What computes the cases
    pub engines: Vec<&'static str>,
    /// What was done
    #[serde(flatten)]
    pub found: &'a Found,
    /// Rows without numbers, by their reason
    pub failed: Vec<FailedRows>,
    /// Columns of the table
    pub columns: Vec<String>,
}

/// Rows without numbers for one reason.
#[derive(Serialize)]
pub(crate) struct FailedRows {
    /// Why
    pub reason: String,
    /// How many
    pub rows: usize,
}

impl<'a> SweepAnswer<'a> {
    /// Of a study in a file; without a table only a shard was made.
    pub(crate) fn of(file: &Path, study: &'a Study, found: &'a Found, table: Option<&Table>) -> SweepAnswer<'a> {
        let failed = table.map_or(Vec::new(), failures).into_iter();
        SweepAnswer {
            study: file.display().to_string(),
            scenario: &study.base.name,
            cases: study.cases(sweep::Engine::Reduced),
            engines: study.engines.iter().map(|engine| engine.word()).collect(),
            found,
            failed: failed.map(|(reason, rows)| FailedRows { reason, rows }).collect(),
            columns: sweep::names(study),
        }
    }
}
