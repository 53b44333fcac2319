//! Text to rows, for every kind.

use super::kind::{Bench, BenchKind, BenchRow};
use crate::about::Provenance;
use crate::columns::{self, Column, Meaning};
use crate::error::{DataError, Fault, Result};
use crate::lines::{Line, Lines};

/// A comment above the header, `# key: value`.
struct Note {
    key: String,
    text: String,
    fault: Box<Fault>,
}

impl Note {
    fn of(comment: &str, line: &Line) -> Option<Note> {
        let (key, value) = comment.split_once(':')?;
        Some(Note { key: key.trim().to_lowercase(), text: value.trim().to_string(), fault: line.fault("", "") })
    }

    fn wrong(&self, message: String, help: String) -> DataError {
        DataError::Cell(Box::new(Fault { message, help, ..(*self.fault).clone() }))
    }
}

/// Reads a table; `None` if its header is of no kind.
pub(super) fn parse(kinds: &'static [BenchKind], file: &str, text: &str) -> Result<Option<Bench>> {
    let mut progress = |_, _| ();
    let mut bytes = text.as_bytes();
    let mut lines = Lines::new(file, &mut bytes, text.len() as u64, &mut progress);
    let mut notes: Vec<Note> = Vec::new();
    let (table, shared) = loop {
        let Some(line) = lines.next_filled()? else { return Ok(None) };
        match line.text.trim_start().strip_prefix('#') {
            Some(comment) => notes.extend(Note::of(comment, &line)),
            None => {
                let (names, delimiter) = columns::split(line.text, None);
                let Some(kind) = kinds.iter().find(|kind| is_of(kind, &names, &notes)) else { return Ok(None) };
                let meaning = |name: &str| Meaning::of(name, kind.columns);
                if let Some(fault) = columns::without_unit(&line, &names, kind.columns, &meaning, &|_| Some(true)) {
                    return Err(fault);
                }
                let columns = columns::find(&line, &names, kind.columns, &meaning)?;
                break (BenchTable { kind, names, delimiter, columns }, shared(kind, &notes)?);
            }
        }
    };
    let mut rows = Vec::new();
    while let Some(line) = lines.next_filled()? {
        if !line.text.trim_start().starts_with('#') {
            rows.push(table.row(&shared, &line)?);
        }
    }
    let kind = table.kind;
    if rows.is_empty() {
        return Err(DataError::layout(file, "the table has no rows", wanted(kind)));
    }
    Ok(Some(Bench { kind, file: file.to_string(), provenance: provenance(&notes)?, rows, scenario: None }))
}

/// The columns of a kind, as a sentence of an error.
pub(super) fn wanted(kind: &BenchKind) -> String {
    let names = |needed: bool| kind.columns.iter().filter(move |f| f.needed == needed).map(|f| f.expected);
    let [needed, others] = [true, false].map(|needed| names(needed).collect::<Vec<_>>());
    format!("{}; if you like {}", needed.join(","), others.join(", "))
}

/// Every column of the table means something in this kind, and the table or its comments have what the kind is about.
fn is_of(kind: &BenchKind, names: &[String], notes: &[Note]) -> bool {
    let fields = |name: &str| Meaning::of(name, kind.columns).field();
    let is_there = |at: usize| names.iter().chain(notes.iter().map(|note| &note.key)).any(|n| fields(n) == Some(at));
    // A fabric's weight may be forgotten; what makes the kind may not.
    let makes_it = |at: &usize| kind.columns[*at].needed && kind.columns[*at].has_unit();
    names.iter().all(|name| fields(name).is_some()) && (0..kind.columns.len()).filter(makes_it).all(is_there)
}

/// What the comments say for all rows, by field.
fn shared(kind: &BenchKind, notes: &[Note]) -> Result<Vec<Option<f64>>> {
    let mut values = vec![None; kind.columns.len()];
    for note in notes {
        let meaning = Meaning::of(&note.key, kind.columns);
        let Some(at) = meaning.field() else { continue };
        let number = note.text.parse::<f64>().ok().filter(|v| v.is_finite());
        let value = match (meaning, number) {
            (Meaning::Known(_, unit), Some(value)) => unit.map_or(value, |unit| value * unit.to_si(1.0)),
            _ => {
                let message =
                    format!("{} must be a number with its unit in the name, found \"{}\"", note.key, note.text);
                return Err(note.wrong(message, format!("write # {}: and a number", kind.columns[at].expected)));
            }
        };
        if values[at].replace(value).is_some() {
            return Err(note.wrong(format!("{} is there twice", note.key), "keep one of the comments".into()));
        }
    }
    Ok(values)
}

/// A table whose header was read.
struct BenchTable {
    kind: &'static BenchKind,
    names: Vec<String>,
    delimiter: u8,
    columns: Vec<Option<Column>>,
}

impl BenchTable {
    fn row(&self, shared: &[Option<f64>], line: &Line) -> Result<BenchRow> {
        let BenchTable { kind, names, delimiter, columns } = self;
        let cells: Vec<&str> = line.text.split(*delimiter as char).map(str::trim).collect();
        if cells.len() != names.len() {
            let message = format!("the row has {} cells, the header {}", cells.len(), names.len());
            return Err(DataError::Layout(line.fault(message, "complete or delete the row; decimals have a point")));
        }
        let mut values = shared.to_vec();
        for (at, field) in kind.columns.iter().enumerate() {
            if let Some(Column { index, unit }) = &columns[at] {
                let cell = cells[*index];
                if cell.is_empty() && !field.needed {
                    continue;
                }
                let Some(value) = cell.parse::<f64>().ok().filter(|v| v.is_finite()) else {
                    let message = format!("expected a finite number, found \"{cell}\"");
                    let mut fault = line.fault(message, "type a plain number with a point");
                    fault.location.column_name = Some(names[*index].clone());
                    fault.location.cell = Some(cell.to_string());
                    return Err(DataError::Cell(fault));
                };
                values[at] = Some(unit.map_or(value, |unit| value * unit.to_si(1.0)));
            }
            if field.needed && values[at].is_none() {
                let help = format!("add the column, or # {}: 155 above the header", field.expected);
                return Err(DataError::Column(line.fault(format!("{} is missing", field.expected), help)));
            }
        }
        let row = BenchRow { kind, values, line: line.number };
        (kind.check)(&row).map_err(|[message, help]| DataError::Cell(line.fault(message, help)))?;
        Ok(row)
    }
}

fn provenance(notes: &[Note]) -> Result<Provenance> {
    let mut all = notes.iter().filter(|note| note.key == "provenance");
    let Some(note) = all.next() else { return Ok(Provenance::Measured) };
    if let Some(again) = all.next() {
        return Err(again.wrong("provenance is there twice".into(), "keep one of the comments".into()));
    }
    let help = "write measured, digitised, synthetic or published".to_string();
    Provenance::of(&note.text).ok_or_else(|| note.wrong(format!("unknown provenance \"{}\"", note.text), help))
}
