//! Bench tests held against a model, in words and for JSON.

use crate::tables::table;
use compare::bench::{Held, HeldRow};
use serde_json::{Value, json};

/// A table, and how far the model is off where it was not fitted.
pub fn text(held: &Held) -> String {
    let percent = |r: &HeldRow| r.off().map_or("–".into(), |o| format!("{:+.1}", 100.0 * o));
    let row = |r: &HeldRow| {
        let model = r.model.map_or("–".into(), |m| format!("{m:.2}"));
        vec![r.at.clone(), format!("{:.2}", r.measured), model, percent(r), r.verdict()]
    };
    let quantity = &held.quantity;
    let head = [quantity.as_str(), "measured", "model", "off %", "verdict"];
    format!(
        "{} ({})\n{}{}",
        held.title,
        held.known.word(),
        table(&head, 1, held.rows.iter().map(row).collect()),
        closing(held)
    )
}

/// Rms and notes.
pub fn closing(held: &Held) -> String {
    let mut out = String::new();
    if let Some(rms) = held.rms() {
        let fitted = held.rows.iter().filter(|r| r.fitted).count();
        let least = held
            .rows
            .iter()
            .filter(|r| !r.fitted)
            .filter_map(HeldRow::off)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], o| [a.min(o), b.max(o)]);
        out.push_str(&format!(
            "rms off {:.1} % ({:+.1} to {:+.1} %) of {} rows that nothing was fitted to; {fitted} fitted\n",
            100.0 * rms,
            100.0 * least[0],
            100.0 * least[1],
            held.rows.len() - fitted
        ));
    }
    held.notes.iter().for_each(|n| out.push_str(&format!("note: {n}\n")));
    out
}

/// For JSON.
pub fn as_json(held: &Held) -> Value {
    let row = |r: &HeldRow| {
        json!({"at": r.at, "measured": r.measured, "model": r.model, "off": r.off(), "interval_half": r.half,
            "fitted": r.fitted, "verdict": r.verdict()})
    };
    json!({
        "title": held.title, "quantity": held.quantity, "how_known": held.known.word(), "rms_off": held.rms(),
        "rows": held.rows.iter().map(row).collect::<Vec<_>>(), "notes": held.notes,
    })
}
