//! Text to rows, for every kind.

use super::kind::{Bench, BenchKind, BenchRow};
use crate::columns::{self, Head, Note, TableRow, meaning, needed};
use crate::error::{DataError, Result};
use crate::lines::LineReader;

/// Reads a table; `None` if its header is of no kind.
pub(super) fn parse(kinds: &'static [BenchKind], file: &str, text: &str) -> Result<Option<Bench>> {
    let mut lines = LineReader::of_text(file, text);
    let (notes, head) = Head::read(&mut lines)?;
    let Some(head) = head else { return Ok(None) };
    let Some(kind) = kinds.iter().find(|kind| is_of(kind, &head.names, &notes)) else { return Ok(None) };
    let is_other = |name: &String| meaning(name, kind.columns).is_none() && !name.eq_ignore_ascii_case(LABEL);
    if let Some(other) = head.names.iter().position(is_other) {
        let message = format!("a {} table has no column {}", kind.name, head.names[other]);
        return Err(head.fault(other, message, format!("delete it; the columns are {}", wanted(kind))));
    }
    head.without_unit(kind.columns, |_| Some(true))?;
    let sheet = head.sheet(kind.columns)?;
    let shared = columns::shared(kind.columns, &notes)?;
    let mut rows = Vec::new();
    sheet.each_row(&mut lines, |found| {
        rows.push(row(kind, &shared, found)?);
        Ok(())
    })?;
    if rows.is_empty() {
        return Err(DataError::of(file, "the table has no rows", wanted(kind)));
    }
    let provenance = columns::provenance(&notes)?;
    Ok(Some(Bench { kind, file: file.to_string(), provenance, rows, scenario: None }))
}

/// The columns of a kind, as a sentence of an error.
pub(super) fn wanted(kind: &BenchKind) -> String {
    let others = kind.columns.iter().filter(|field| !field.needed).map(|field| field.expected);
    format!("{}; if you like {}", needed(kind.columns), others.collect::<Vec<_>>().join(", "))
}

/// A column that names the specimen of a row.
const LABEL: &str = "specimen";

/// The table has a quantity of the kind and no markers, and it or its comments have what the kind is about.
fn is_of(kind: &BenchKind, names: &[String], notes: &[Note]) -> bool {
    let field = |name: &String| meaning(name, kind.columns).map(|(at, _)| at);
    let is_there =
        |at: usize| names.iter().chain(notes.iter().map(|note| &note.key)).any(|name| field(name) == Some(at));
    // A fabric's weight may be forgotten; what makes the kind may not.
    let makes_it = |at: &usize| kind.columns[*at].needed && kind.columns[*at].has_unit();
    let has_unit = |name: &String| field(name).is_some_and(|at| kind.columns[at].has_unit());
    let of_bench = names.iter().any(has_unit) && !names.iter().any(|name| name.eq_ignore_ascii_case("marker"));
    of_bench && (0..kind.columns.len()).filter(makes_it).all(is_there)
}

fn row(kind: &'static BenchKind, shared: &[Option<f64>], row: &TableRow) -> Result<BenchRow> {
    let mut values = shared.to_vec();
    for (at, field) in kind.columns.iter().enumerate() {
        if field.needed || !row.text(at).is_empty() {
            // Stored results rest on these bits: a product of the factor, not a quotient.
            values[at] = row.read(at, |unit, value| value * unit.factor())?.or(values[at]);
        }
        if field.needed && values[at].is_none() {
            let help = format!("add the column, or # {}: 155 above the header", field.expected);
            return Err(row.line.fault(format!("{} is missing", field.expected), help));
        }
    }
    let found = BenchRow { kind, values, line: row.line.number };
    (kind.check)(&found).map_err(|[message, help]| row.line.fault(message, help))?;
    Ok(found)
}
