//! Bench tests compared with a model, in words and for JSON.

use crate::prelude::*;
use compare::bench::{Held, HeldRow};

/// `ibr.compare.bench`: `ibr compare TABLE`, a table of bench tests
#[derive(Serialize)]
pub(crate) struct BenchAnswer<'a> {
    /// Data as typed
    pub data: &'a str,
    /// Kind of table
    pub kind: &'a str,
    /// How its numbers came to be
    pub provenance: Provenance,
    /// The table with its model
    pub held: HeldTable<'a>,
}

#[derive(Serialize)]
pub(crate) struct HeldTable<'a> {
    /// One line
    pub title: &'a str,
    /// Quantity compared, with unit
    pub quantity: &'a str,
    /// How the model's numbers are known
    pub how_known: Known,
    /// Rms of `off` over rows that nothing was fitted to
    pub rms_off: Option<f64>,
    /// Rows
    pub rows: Vec<HeldTest<'a>>,
    /// Remarks
    pub notes: &'a [String],
}

/// A row of bench tests with its model.
#[derive(Serialize)]
pub(crate) struct HeldTest<'a> {
    /// The row
    #[serde(flatten)]
    pub row: &'a HeldRow,
    /// Model over measurement, less one
    pub off: Option<f64>,
    /// What follows
    pub verdict: String,
}

impl<'a> HeldTable<'a> {
    pub(crate) fn of(held: &'a Held) -> HeldTable<'a> {
        let rows = held.rows.iter().map(|row| HeldTest { row, off: row.off(), verdict: row.verdict() });
        let Held { title, quantity, known, notes, .. } = held;
        HeldTable { title, quantity, how_known: *known, rms_off: held.rms(), rows: rows.collect(), notes }
    }
}

/// A table, and how far the model is off where it was not fitted.
pub(crate) fn text(held: &Held) -> String {
    let table = Table::of(&held.rows)
        .words(&held.quantity, |r| &r.at)
        .number("measured", 2, |r| r.measured)
        .number("model", 2, |r| r.model)
        .signed("off %", 1, |r| r.off().map(|off| 100.0 * off))
        .right("verdict", |r| r.verdict());
    format!("{} ({})\n{}{}", held.title, held.known.word(), table.text(), closing(held))
}

pub(crate) fn closing(held: &Held) -> String {
    let mut out = String::new();
    if let Some(rms) = held.rms() {
        let fitted = held.rows.iter().filter(|r| r.fitted).count();
        let free = held.rows.iter().filter(|r| !r.fitted).filter_map(HeldRow::off);
        let [low, high] = free.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], o| [a.min(o), b.max(o)]);
        out = format!(
            "rms off {:.1} % ({:+.1} to {:+.1} %) of {} rows that nothing was fitted to; {fitted} fitted\n",
            100.0 * rms,
            100.0 * low,
            100.0 * high,
            held.rows.len() - fitted
        );
    }
    out + &lines("note: ", &held.notes)
}
