//! What an import understood.

use data::import::Imported;
use serde_json::{Value, json};
use std::path::Path;

/// What was understood, a line each.
pub fn told(made: &Imported) -> String {
    let set = &made.dataset;
    let lines: String = made.told.iter().map(|line| format!("- {line}\n")).collect();
    let count = |n: usize, word: &str| format!("{n} {word}{}", if n == 1 { "" } else { "s" });
    let sizes = [(set.runs.len(), "run"), (set.holds.len(), "hold"), (set.markers.len(), "marker")];
    format!("{}\n{lines}", sizes.map(|(n, word)| count(n, word)).join(", "))
}

/// For programs.
pub fn to_json(made: &Imported, folder: Option<&Path>) -> Value {
    let set = &made.dataset;
    let names = set.markers.iter().map(|marker| marker.name.as_str()).collect::<Vec<_>>();
    json!({
        "schema": "ibr.data.import", "version": 1, "program": made.program, "runs": set.runs, "markers": names,
        "holds": set.holds.len(), "told": made.told, "folder": folder.map(|out| out.display().to_string()),
    })
}
