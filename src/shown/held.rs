//! Bench tests compared with a model, in words and for JSON.

use crate::prelude::*;
use compare::bench::{ComparedBench, HeldRow};

/// `ibr.compare.bench`: `ibr compare TABLE`, a table of bench tests
#[derive(Serialize)]
pub(crate) struct BenchAnswer<'a> {
    /// Path or name of the data as typed
    pub data: &'a str,
    /// Kind of the table of bench tests
    pub kind: &'a str,
    /// How its numbers came to be
    pub provenance: Provenance,
    /// Rows of the table next to their model
    pub held: HeldTable<'a>,
}

#[derive(Serialize)]
pub(crate) struct HeldTable<'a> {
    /// Title of the table in one line
    pub title: &'a str,
    /// Quantity that is compared, with its unit
    pub quantity: &'a str,
    /// How the model's numbers are known
    pub how_known: Known,
    /// Rms of `off` over rows that nothing was fitted to
    pub rms_off: Option<f64>,
    /// Tests of the table, each with its model
    pub rows: Vec<HeldTest<'a>>,
    /// Remarks on the tests and the model
    pub notes: &'a [String],
}

/// A row of bench tests with its model.
#[derive(Serialize)]
pub(crate) struct HeldTest<'a> {
    #[serde(flatten)]
    pub row: &'a HeldRow,
    /// Relative error of the model: model over measurement, less one
    pub off: Option<f64>,
    /// Consequence of the error, in words
    pub verdict: String,
}

impl<'a> HeldTable<'a> {
    pub(crate) fn of(held: &'a ComparedBench) -> HeldTable<'a> {
        let rows = held.rows.iter().map(|row| HeldTest { row, off: row.off(), verdict: row.verdict() });
        let ComparedBench { title, quantity, known, notes, .. } = held;
        HeldTable { title, quantity, how_known: *known, rms_off: held.rms(), rows: rows.collect(), notes }
    }
}

/// A table, and how far the model is off where it was not fitted.
pub(crate) fn text(held: &ComparedBench) -> String {
    let table = TextTable::of(&held.rows)
        .words(&held.quantity, |r| &r.at)
        .number("measured", 2, |r| r.measured)
        .number("model", 2, |r| r.model)
        .signed("off %", 1, |r| r.off().map(|off| 100.0 * off))
        .right("verdict", |r| r.verdict());
    format!("{} ({})\n{}{}", held.title, held.known.word(), table.text(), closing(held))
}

pub(crate) fn closing(held: &ComparedBench) -> String {
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
