//! Text to rows, for every kind.

use super::{Bench, BenchKind, BenchRow, Field, KINDS};
use crate::about::Provenance;
use crate::error::{DataError, Fault};
use crate::lines::{Line, Lines};

/// A number of a comment above the header.
struct Note {
    key: String,
    text: String,
    fault: Box<Fault>,
}

/// Reads a table; `None` if its header is of no kind.
pub(super) fn parse(file: &str, text: &str) -> Result<Option<Bench>, DataError> {
    let mut progress = |_, _| ();
    let mut bytes = text.as_bytes();
    let mut lines = Lines::new(file, &mut bytes, text.len() as u64, &mut progress);
    let mut notes: Vec<Note> = Vec::new();
    let (kind, header) = loop {
        let Some(line) = lines.next_filled()? else { return Ok(None) };
        let Some(comment) = line.text.trim_start().strip_prefix('#') else {
            let header = BenchHeader::new(&line);
            let Some(kind) = KINDS.iter().find(|kind| header.is_of(kind, &notes)) else { return Ok(None) };
            header.units(kind, &line)?;
            break (kind, header);
        };
        if let Some((key, value)) = comment.split_once(':') {
            let (key, text) = (key.trim().to_lowercase(), value.trim().to_string());
            notes.push(Note { key, text, fault: line.fault("", "") });
        }
    };
    let shared = shared(kind, &notes)?;
    let mut rows = Vec::new();
    while let Some(line) = lines.next_filled()? {
        if !line.text.trim_start().starts_with('#') {
            rows.push(row(kind, &header, &shared, &line)?);
        }
    }
    if rows.is_empty() {
        return Err(DataError::Layout(Box::new(Fault::of_file(file, "the table has no rows", wanted(kind)))));
    }
    let provenance = provenance(&notes)?;
    Ok(Some(Bench { kind, file: file.to_string(), provenance, rows, scenario: None }))
}

/// The columns of a kind, as a sentence of an error.
pub(super) fn wanted(kind: &BenchKind) -> String {
    let names = |needed: bool| kind.columns.iter().filter(move |f| f.needed == needed).map(|f| f.expected);
    format!(
        "{}; if you like {}",
        names(true).collect::<Vec<_>>().join(","),
        names(false).collect::<Vec<_>>().join(", ")
    )
}

struct BenchHeader {
    names: Vec<String>,
    delimiter: char,
}

impl BenchHeader {
    fn new(line: &Line) -> BenchHeader {
        let most = |&d: &char| line.text.chars().filter(|c| *c == d).count();
        let delimiter = ['\t', ';', ','].into_iter().max_by_key(most).unwrap_or(',');
        let names = line.text.split(delimiter).map(|name| name.trim().trim_matches('"').to_lowercase()).collect();
        BenchHeader { names, delimiter }
    }

    /// Every column of the table means something in this kind, and what it lacks is said by no other kind.
    fn is_of(&self, kind: &BenchKind, notes: &[Note]) -> bool {
        let all = self.names.iter().all(|name| kind.columns.iter().any(|f| f.base == base(name, f)));
        let noted = |f: &Field| notes.iter().any(|note| base(&note.key, f) == f.base);
        let there = |f: &Field| self.names.iter().any(|name| base(name, f) == f.base) || noted(f);
        // A fabric's weight may be forgotten; what makes the kind may not.
        all && kind.columns.iter().filter(|f| f.needed && f.dimension.is_some()).all(there)
    }

    /// Names with a unit that is missing or unknown.
    fn units(&self, kind: &BenchKind, line: &Line) -> Result<(), DataError> {
        for name in &self.names {
            let Some(field) = kind.columns.iter().find(|f| f.base == base(name, f)) else { continue };
            if let Some(dimension) = field.dimension
                && factor(name, field).is_none()
            {
                let trouble = if *name == field.base { "has no unit in its name" } else { "has an unknown unit" };
                let help = format!("name it {}; {}", field.expected, dimension.sentence());
                return Err(DataError::Column(line.fault(format!("column {name} {trouble}"), help)));
            }
        }
        Ok(())
    }
}

/// A name without its unit, as far as this field has one.
fn base<'a>(name: &'a str, field: &Field) -> &'a str {
    match name.rsplit_once('_') {
        Some((base, _)) if field.dimension.is_some() && name != field.base => base,
        _ => name,
    }
}

/// To SI; none for an unknown unit.
fn factor(name: &str, field: &Field) -> Option<f64> {
    let Some(dimension) = field.dimension else { return Some(1.0) };
    Some(dimension.unit(name.rsplit_once('_')?.1)?.to_si(1.0))
}

/// What the comments say for all rows.
fn shared(kind: &BenchKind, notes: &[Note]) -> Result<Vec<Option<f64>>, DataError> {
    let of = |field: &Field| {
        let Some(note) = notes.iter().rfind(|note| base(&note.key, field) == field.base) else { return Ok(None) };
        let value = note.text.parse::<f64>().ok().filter(|v| v.is_finite()).zip(factor(&note.key, field));
        let wrong = || {
            let message = format!("{} must be a number with its unit in the name, found \"{}\"", note.key, note.text);
            let help = format!("write # {}: and a number", field.expected);
            DataError::Cell(Box::new(Fault { message, help, ..(*note.fault).clone() }))
        };
        value.map(|(v, factor)| Some(v * factor)).ok_or_else(wrong)
    };
    kind.columns.iter().map(of).collect()
}

fn row(
    kind: &'static BenchKind,
    header: &BenchHeader,
    shared: &[Option<f64>],
    line: &Line,
) -> Result<BenchRow, DataError> {
    let cells: Vec<&str> = line.text.split(header.delimiter).map(str::trim).collect();
    if cells.len() != header.names.len() {
        let message = format!("the row has {} cells, the header {}", cells.len(), header.names.len());
        return Err(DataError::Layout(line.fault(message, "complete or delete the row; decimals have a point")));
    }
    let mut values = shared.to_vec();
    for (name, cell) in header.names.iter().zip(&cells) {
        let Some(i) = kind.columns.iter().position(|f| f.base == base(name, f)) else { continue };
        if cell.is_empty() && !kind.columns[i].needed {
            continue;
        }
        let Some(value) = cell.parse::<f64>().ok().filter(|v| v.is_finite()) else {
            let mut fault =
                line.fault(format!("expected a finite number, found \"{cell}\""), "type a plain number with a point");
            fault.location.column_name = Some(name.clone());
            fault.location.cell = Some((*cell).to_string());
            return Err(DataError::Cell(fault));
        };
        values[i] = factor(name, &kind.columns[i]).map(|factor| value * factor);
    }
    if let Some(i) = (0..values.len()).find(|&i| kind.columns[i].needed && values[i].is_none()) {
        let name = kind.columns[i].expected;
        let help = format!("add the column, or # {name}: 155 above the header");
        return Err(DataError::Column(line.fault(format!("{name} is missing"), help)));
    }
    let row = BenchRow { kind, values, line: line.number };
    (kind.check)(&row).map_err(|[message, help]| DataError::Cell(line.fault(message, help)))?;
    Ok(row)
}

fn provenance(notes: &[Note]) -> Result<Provenance, DataError> {
    let Some(note) = notes.iter().rfind(|note| note.key == "provenance") else { return Ok(Provenance::Measured) };
    let all = [Provenance::Measured, Provenance::Digitised, Provenance::Synthetic, Provenance::Published];
    let wrong = || {
        let message = format!("unknown provenance \"{}\"", note.text);
        let help = "write measured, digitised, synthetic or published".into();
        DataError::Cell(Box::new(Fault { message, help, ..(*note.fault).clone() }))
    };
    all.into_iter().find(|p| p.word() == note.text.to_lowercase()).ok_or_else(wrong)
}
