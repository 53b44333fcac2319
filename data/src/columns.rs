//! The grammar of a table: comments `# key: value`, a header whose names end with units, rows of cells.

use crate::about::Provenance;
use crate::cells::{no_number, with_comma};
use crate::error::{DataError, Fault, Result};
use crate::lines::{KeptLine, Line, Lines};
use crate::units::Measured;
use spelling::units::Unit;

/// A column that a kind of table may have.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Name without unit; the whole name of a text or of a number without unit.
    pub base: &'static str,
    /// Name with the unit that is usual, for remedies.
    pub expected: &'static str,
    dimension: Option<Measured>,
    /// Whether a table of this kind always has it.
    pub needed: bool,
}

/// A number with a unit in its name.
pub(crate) const fn field(base: &'static str, expected: &'static str, dimension: Measured, needed: bool) -> Field {
    Field { base, expected, dimension: Some(dimension), needed }
}

/// A text, or a number without unit.
pub(crate) const fn plain(name: &'static str, needed: bool) -> Field {
    Field { base: name, expected: name, dimension: None, needed }
}

impl Field {
    /// Whether its name has a unit.
    pub(crate) fn has_unit(&self) -> bool {
        self.dimension.is_some()
    }

    /// The unit that a name ends with, in lower case.
    pub(crate) fn unit(&self, suffix: &str) -> Option<Unit> {
        self.dimension?.unit(suffix)
    }

    /// How to name it and in which units, for a message.
    pub(crate) fn naming(&self) -> String {
        let units = self.dimension.map(|dimension| format!("; {}", dimension.sentence())).unwrap_or_default();
        format!("name it {}{units}", self.expected)
    }
}

/// What a name means among some fields.
pub(crate) enum Meaning {
    /// A field, and its unit if it has one.
    Known(usize, Option<Unit>),
    /// A field whose unit is missing.
    NoUnit(usize),
    /// A field with an unknown unit.
    OtherUnit(usize),
    Extra,
}

impl Meaning {
    /// What a name means; upper and lower case are one.
    pub(crate) fn of(name: &str, fields: &[Field]) -> Meaning {
        let name = name.to_lowercase();
        let by_base = |base: &str| fields.iter().position(|field| field.base == base);
        if let Some(at) = by_base(&name) {
            return if fields[at].has_unit() { Meaning::NoUnit(at) } else { Meaning::Known(at, None) };
        }
        let Some((base, suffix)) = name.rsplit_once('_') else { return Meaning::Extra };
        match by_base(base).filter(|at| fields[*at].has_unit()).map(|at| (at, fields[at].unit(suffix))) {
            Some((at, Some(unit))) => Meaning::Known(at, Some(unit)),
            Some((at, None)) => Meaning::OtherUnit(at),
            None => Meaning::Extra,
        }
    }

    pub(crate) fn field(&self) -> Option<usize> {
        match self {
            Meaning::Known(at, _) | Meaning::NoUnit(at) | Meaning::OtherUnit(at) => Some(*at),
            Meaning::Extra => None,
        }
    }
}

/// A column that holds a field.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    pub index: usize,
    pub unit: Option<Unit>,
}

/// Names of columns without quotes, and their separator: the one given, or the most frequent of tab, semicolon and comma.
pub(crate) fn split(text: &str, given: Option<u8>) -> (Vec<String>, u8) {
    let count = |delimiter: &u8| text.bytes().filter(|byte| byte == delimiter).count();
    let delimiter = given.or_else(|| [b'\t', b';', b','].into_iter().max_by_key(count)).unwrap_or(b',');
    let clean = |name: &str| name.trim().trim_matches('"').trim().to_string();
    (text.split(delimiter as char).map(clean).collect(), delimiter)
}

/// The column of every field; `None` for those that are not there.
pub(crate) fn find(
    line: &Line,
    names: &[String],
    fields: &[Field],
    meaning: &dyn Fn(&str) -> Meaning,
) -> Result<Vec<Option<Column>>> {
    let mut columns: Vec<Option<Column>> = vec![None; fields.len()];
    for (index, name) in names.iter().enumerate() {
        let Meaning::Known(at, unit) = meaning(name) else { continue };
        if let Some(first) = columns[at].replace(Column { index, unit }) {
            let first = &names[first.index];
            let message = if first.eq_ignore_ascii_case(name) {
                format!("column {first} is there twice")
            } else {
                format!("columns {first} and {name} hold the same quantity")
            };
            let help = format!("keep one of them, for example {}", fields[at].expected);
            return Err(DataError::Column(fault(line, names, index, message, help)));
        }
    }
    Ok(columns)
}

/// The fault of a column, shown at its name.
pub(crate) fn fault(line: &Line, names: &[String], index: usize, message: String, help: String) -> Box<Fault> {
    let mut fault = line.fault(message, help);
    fault.location.column_name = Some(names[index].clone());
    let mut from = 0;
    for name in &names[..=index] {
        let at = line.text[from..].find(name.as_str()).map_or(from, |at| from + at);
        fault.span = Some((line.start + at, line.start + at + name.len()));
        from = at + name.len();
    }
    fault
}

/// The fault of a column that names a field without a unit, or with an unknown one. `is_asked` answers for a field whether an unknown
/// unit is a fault too; `None` if none is.
pub(crate) fn without_unit(
    line: &Line,
    names: &[String],
    fields: &[Field],
    meaning: &dyn Fn(&str) -> Meaning,
    is_asked: &dyn Fn(usize) -> Option<bool>,
) -> Option<Box<Fault>> {
    names.iter().enumerate().find_map(|(index, name)| {
        let (at, trouble, convert) = match meaning(name) {
            Meaning::NoUnit(at) => (at, "has no unit in its name", ""),
            Meaning::OtherUnit(at) if is_asked(at) == Some(true) => (at, "has an unknown unit", "convert it and "),
            _ => return None,
        };
        is_asked(at)?;
        let (message, help) = (format!("column {name} {trouble}"), format!("{convert}{}", fields[at].naming()));
        Some(fault(line, names, index, message, help))
    })
}

/// A comment above the header, `# key: value` or `# key = value`.
pub(crate) struct Note {
    pub key: String,
    pub text: String,
    line: KeptLine,
}

impl Note {
    pub(crate) fn wrong(&self, message: String, help: String) -> DataError {
        DataError::Cell(self.line.line().fault(message, help))
    }
}

/// The comments above the header line, and that line; `None` at the end of the file.
pub(crate) fn notes(lines: &mut Lines) -> Result<(Vec<Note>, Option<KeptLine>)> {
    let mut notes = Vec::new();
    while let Some(line) = lines.next_filled()? {
        let Some(comment) = line.text.trim_start().strip_prefix('#') else { return Ok((notes, Some(line.keep()))) };
        let Some((key, value)) = comment.split_once([':', '=']) else { continue };
        notes.push(Note { key: key.trim().to_lowercase(), text: value.trim().to_string(), line: line.keep() });
    }
    Ok((notes, None))
}

/// What the comments give for all rows in SI units, field by field.
pub(crate) fn shared(fields: &[Field], notes: &[Note]) -> Result<Vec<Option<f64>>> {
    let mut values = vec![None; fields.len()];
    for note in notes {
        let (meaning, Note { key, text, .. }) = (Meaning::of(&note.key, fields), note);
        let Some(at) = meaning.field() else { continue };
        let value = match (meaning, text.parse::<f64>().ok().filter(|value| value.is_finite())) {
            (Meaning::Known(_, unit), Some(value)) => unit.map_or(value, |unit| unit.to_si(value)),
            (Meaning::NoUnit(_), _) => {
                let help = format!("write # {}: {text}", fields[at].expected);
                return Err(note.wrong(format!("{key} has no unit in its name"), help));
            }
            _ => {
                let help = format!("write # {}: and a number", fields[at].expected);
                return Err(note.wrong(format!("{key} must be a number with a known unit, found \"{text}\""), help));
            }
        };
        if values[at].replace(value).is_some_and(|before| before != value) {
            return Err(note.wrong(format!("{key} is there twice, here as {text}"), "keep one of the comments".into()));
        }
    }
    Ok(values)
}

/// How the numbers came to be, by `# provenance: digitised`; measured without that comment.
pub(crate) fn provenance(notes: &[Note]) -> Result<Provenance> {
    let mut all = notes.iter().filter(|note| note.key == "provenance");
    let Some(note) = all.next() else { return Ok(Provenance::Measured) };
    if let Some(again) = all.next() {
        return Err(again.wrong("provenance is there twice".into(), "keep one of the comments".into()));
    }
    let help = "write measured, digitised, synthetic or published".to_string();
    Provenance::of(&note.text).ok_or_else(|| note.wrong(format!("unknown provenance \"{}\"", note.text), help))
}

/// The header line of a table, understood.
#[derive(Debug, Clone)]
pub(crate) struct Columns {
    pub fields: &'static [Field],
    pub names: Vec<String>,
    pub delimiter: char,
    /// Decimals are written with a comma.
    pub comma: bool,
    /// The column of every field; `None` for those that are not there.
    pub at: Vec<Option<Column>>,
}

impl Columns {
    /// The column of a field as the file names it.
    pub(crate) fn name(&self, field: usize) -> &str {
        self.at[field].as_ref().map_or(self.fields[field].expected, |column| &self.names[column.index])
    }

    pub(crate) fn row<'a>(&'a self, line: Line<'a>) -> Result<TableRow<'a>> {
        let cells: Vec<&str> =
            line.text.split(self.delimiter).map(|cell| cell.trim().trim_matches('"').trim()).collect();
        let (found, names) = (cells.len(), self.names.len());
        if found == names {
            return Ok(TableRow { columns: self, line, cells });
        }
        let help = match self.delimiter == ',' && found > names {
            true => "write decimals with a point, or separate the columns with semicolons",
            false => "complete or delete the row",
        };
        Err(DataError::Layout(line.fault(format!("the row has {found} cells, the header {names}"), help)))
    }
}

pub(crate) struct TableRow<'a> {
    columns: &'a Columns,
    pub line: Line<'a>,
    cells: Vec<&'a str>,
}

impl TableRow<'_> {
    /// The text of a field; empty if it has no column.
    pub(crate) fn text(&self, field: usize) -> &str {
        self.columns.at[field].as_ref().map_or("", |column| self.cells[column.index])
    }

    /// The number of a field in SI units; `None` if it has no column.
    pub(crate) fn number(&self, field: usize) -> Result<Option<f64>> {
        self.read(field, Unit::to_si)
    }

    /// The same, with units converted by `si`.
    pub(crate) fn read(&self, field: usize, si: impl Fn(Unit, f64) -> f64) -> Result<Option<f64>> {
        let Some(column) = &self.columns.at[field] else { return Ok(None) };
        let text = self.text(field);
        let comma = || self.columns.comma.then(|| with_comma(text)).flatten();
        let value = text.parse::<f64>().ok().or_else(comma);
        let in_si = value.map(|value| column.unit.map_or(value, |unit| si(unit, value)));
        in_si.filter(|value| value.is_finite()).map(Some).ok_or_else(|| {
            let [message, help] = no_number(text, self.columns.fields[field].expected, "");
            DataError::Cell(self.fault(field, message, help))
        })
    }

    /// A fault of one cell, with the bytes of the cell in the file.
    pub(crate) fn fault(&self, field: usize, message: String, help: String) -> Box<Fault> {
        let mut fault = self.line.fault(message, help);
        let Some(Column { index, .. }) = self.columns.at[field] else { return fault };
        let cell = self.cells[index];
        fault.location.column_name = Some(self.columns.names[index].clone());
        fault.location.cell = Some(cell.to_string());
        let start = self.line.start + (cell.as_ptr() as usize - self.line.text.as_ptr() as usize);
        fault.span = Some((start, start + cell.len()));
        fault
    }
}
