//! The grammar of a table: comments `# key: value`, a header whose names end with units, rows of cells.

use crate::about::Provenance;
use crate::cells::{no_number, with_comma};
use crate::error::{DataError, Result};
use crate::lines::{KeptLine, LineReader, TextLine};
use crate::units::MeasuredQuantity;
use spelling::units::Unit;

/// A column that a kind of table may have.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Name without unit; the whole name of a text or of a number without unit.
    pub base: &'static str,
    /// Name with the unit that is usual, for remedies.
    pub expected: &'static str,
    dimension: Option<MeasuredQuantity>,
    /// Whether a table of this kind always has it.
    pub needed: bool,
}

/// A number with a unit in its name.
pub(crate) const fn field(
    base: &'static str,
    expected: &'static str,
    dimension: MeasuredQuantity,
    needed: bool,
) -> Field {
    Field { base, expected, dimension: Some(dimension), needed }
}

/// A text, or a number without unit.
pub(crate) const fn plain(name: &'static str, needed: bool) -> Field {
    Field { base: name, expected: name, dimension: None, needed }
}

impl Field {
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

/// The names of fields that a table always has, as they are usual.
pub(crate) fn needed(fields: &[Field]) -> String {
    let names: Vec<&str> = fields.iter().filter(|field| field.needed).map(|field| field.expected).collect();
    names.join(",")
}

/// The end of a name as the unit of its field.
pub(crate) enum Ending {
    /// A unit, or none of a field without.
    Known(Option<Unit>),
    Missing,
    Unknown,
}

/// Beginning of the name of a y that points down.
const Y_DOWN: &str = "y_down";

fn is_down(name: &str) -> bool {
    name.strip_prefix(Y_DOWN).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
}

/// The field that a name means, and its unit; upper and lower case are one.
pub(crate) fn meaning(name: &str, fields: &[Field]) -> Option<(usize, Ending)> {
    let mut name = name.to_lowercase();
    if is_down(&name) {
        name.replace_range(1..Y_DOWN.len(), "");
    }
    let by_base = |base: &str| fields.iter().position(|field| field.base == base);
    if let Some(at) = by_base(&name) {
        return Some((at, if fields[at].has_unit() { Ending::Missing } else { Ending::Known(None) }));
    }
    let (base, suffix) = name.rsplit_once('_')?;
    let at = by_base(base).filter(|at| fields[*at].has_unit())?;
    Some((at, fields[at].unit(suffix).map_or(Ending::Unknown, |unit| Ending::Known(Some(unit)))))
}

#[derive(Debug, Clone)]
pub(crate) struct SheetColumn {
    pub index: usize,
    pub unit: Option<Unit>,
    /// It is called `y_down_…`: the sign of its numbers is turned on reading.
    pub turned: bool,
}

impl SheetColumn {
    /// A number of the column, with its unit converted by `si` and its sign turned; `None` if it is not finite.
    pub(crate) fn si(&self, value: f64, si: impl Fn(Unit, f64) -> f64) -> Option<f64> {
        let si = self.unit.map_or(value, |unit| si(unit, value));
        Some(if self.turned { -si } else { si }).filter(|si| si.is_finite())
    }
}

/// A comment above the header, `# key: value` or `# key = value`.
pub(crate) struct Note {
    pub key: String,
    pub text: String,
    line: KeptLine,
}

impl Note {
    pub(crate) fn wrong(&self, message: impl Into<String>, help: impl Into<String>) -> DataError {
        self.line.line().fault(message, help)
    }
}

/// The header line of a table, taken apart.
#[derive(Debug, Clone)]
pub(crate) struct Head {
    pub line: KeptLine,
    /// Names of the columns, without quotes.
    pub names: Vec<String>,
    /// The sign that a first line `sep=;` gives, or the most frequent of tab, semicolon and comma.
    pub delimiter: char,
    /// The file begins with `sep=;` or the like.
    pub named: bool,
}

impl Head {
    /// The comments above the header line, and that line; `None` at the end of the file.
    pub(crate) fn read(lines: &mut LineReader) -> Result<(Vec<Note>, Option<Head>)> {
        let (mut notes, mut said) = (Vec::new(), None);
        while let Some(line) = lines.next_filled()? {
            let text = line.text.trim_start();
            if let Some(comment) = text.strip_prefix('#') {
                let Some((key, value)) = comment.split_once([':', '=']) else { continue };
                notes.push(Note { key: key.trim().to_lowercase(), text: value.trim().to_string(), line: line.keep() });
            } else if let Some([sign]) = text.strip_prefix("sep=").map(|sign| sign.trim().as_bytes()) {
                said = Some(*sign);
            } else {
                return Ok((notes, Some(Head::of(&line, said))));
            }
        }
        Ok((notes, None))
    }

    fn of(line: &TextLine, said: Option<u8>) -> Head {
        let count = |delimiter: &u8| line.text.bytes().filter(|byte| byte == delimiter).count();
        let found = || [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',');
        let delimiter = said.unwrap_or_else(found).into();
        let clean = |name: &str| name.trim().trim_matches('"').trim().to_string();
        Head {
            line: line.keep(),
            names: line.text.split(delimiter).map(clean).collect(),
            delimiter,
            named: said.is_some(),
        }
    }

    /// The fault of a column, shown at its name.
    pub(crate) fn fault(&self, index: usize, message: impl Into<String>, help: impl Into<String>) -> DataError {
        let line = self.line.line();
        let mut error = line.fault(message, help).in_column(&self.names[index], None);
        let mut from = 0;
        for name in &self.names[..=index] {
            let at = line.text[from..].find(name.as_str()).map_or(from, |at| from + at);
            error.fault_mut().span = Some((line.start + at, line.start + at + name.len()));
            from = at + name.len();
        }
        error
    }

    /// The fault of a column that names a field without a unit, or with an unknown one. `is_asked` answers for a field whether an
    /// unknown unit is a fault too; `None` if none is.
    pub(crate) fn without_unit(&self, fields: &[Field], is_asked: impl Fn(usize) -> Option<bool>) -> Result<()> {
        for (index, name) in self.names.iter().enumerate() {
            let Some((at, ending)) = meaning(name, fields) else { continue };
            let (trouble, convert) = match (ending, is_asked(at)) {
                (Ending::Missing, Some(_)) => ("has no unit in its name", ""),
                (Ending::Unknown, Some(true)) => ("has an unknown unit", "convert it and "),
                _ => continue,
            };
            let help = format!("{convert}{}", fields[at].naming());
            return Err(self.fault(index, format!("column {name} {trouble}"), help));
        }
        Ok(())
    }

    /// The table with its columns by field.
    pub(crate) fn sheet(self, fields: &'static [Field]) -> Result<TableSheet> {
        let mut at: Vec<Option<SheetColumn>> = vec![None; fields.len()];
        for (index, name) in self.names.iter().enumerate() {
            let Some((field, Ending::Known(unit))) = meaning(name, fields) else { continue };
            let turned = is_down(&name.to_lowercase());
            if let Some(first) = at[field].replace(SheetColumn { index, unit, turned }) {
                let first = &self.names[first.index];
                let message = if first.eq_ignore_ascii_case(name) {
                    format!("column {first} is there twice")
                } else {
                    format!("columns {first} and {name} hold the same quantity")
                };
                let help = format!("keep one of them, for example {}", fields[field].expected);
                return Err(self.fault(index, message, help));
            }
        }
        Ok(TableSheet { fields, head: self, comma: false, at })
    }
}

/// What the comments give for all rows in SI units, field by field.
pub(crate) fn shared(fields: &[Field], notes: &[Note]) -> Result<Vec<Option<f64>>> {
    let mut values = vec![None; fields.len()];
    for note in notes {
        let Note { key, text, .. } = note;
        let Some((at, ending)) = meaning(key, fields) else {
            let near = || spelling::nearest(key, fields.iter().map(|field| field.expected));
            match text.parse::<f64>().ok().and_then(|_| near()) {
                Some(near) => {
                    return Err(note.wrong(format!("unknown {key}"), format!("did you mean # {near}: {text}?")));
                }
                None => continue,
            }
        };
        let expected = fields[at].expected;
        let value = match (ending, text.parse::<f64>().ok().filter(|value| value.is_finite())) {
            (Ending::Known(unit), Some(value)) => unit.map_or(value, |unit| unit.to_si(value)),
            (Ending::Missing, _) => {
                let message = format!("{key} has no unit in its name");
                return Err(note.wrong(message, format!("write # {expected}: {text}")));
            }
            _ => {
                let message = format!("{key} must be a number with a known unit, found \"{text}\"");
                return Err(note.wrong(message, format!("write # {expected}: and a number")));
            }
        };
        if values[at].replace(value).is_some_and(|before| before != value) {
            let message = format!("{key} is there twice, here as {text}");
            return Err(note.wrong(message, "keep one of the comments"));
        }
    }
    Ok(values)
}

/// How the numbers came to be, by `# provenance: digitised`; measured without that comment.
pub(crate) fn provenance(notes: &[Note]) -> Result<Provenance> {
    let mut all = notes.iter().filter(|note| note.key == "provenance");
    let Some(note) = all.next() else { return Ok(Provenance::Measured) };
    if let Some(again) = all.next() {
        return Err(again.wrong("provenance is there twice", "keep one of the comments"));
    }
    let help = "write measured, digitised, synthetic or published";
    Provenance::of(&note.text).ok_or_else(|| note.wrong(format!("unknown provenance \"{}\"", note.text), help))
}

#[derive(Debug, Clone)]
pub(crate) struct TableSheet {
    pub fields: &'static [Field],
    pub head: Head,
    /// Decimals may be written with a comma.
    pub comma: bool,
    /// The column of every field; `None` for those that are not there.
    pub at: Vec<Option<SheetColumn>>,
}

impl TableSheet {
    pub(crate) fn has(&self, field: usize) -> bool {
        self.at[field].is_some()
    }

    /// A needed field without a column.
    pub(crate) fn missing(&self) -> Option<usize> {
        (0..self.fields.len()).find(|field| self.fields[*field].needed && !self.has(*field))
    }

    /// The column of a field as the file names it.
    pub(crate) fn name(&self, field: usize) -> &str {
        self.at[field].as_ref().map_or(self.fields[field].expected, |column| &self.head.names[column.index])
    }

    /// Symbol of the unit of a column; empty without one.
    pub(crate) fn unit(&self, field: usize) -> &'static str {
        self.at[field].as_ref().and_then(|column| column.unit).map_or("", |unit| unit.symbol)
    }

    /// The fault of a whole column, shown at its name.
    pub(crate) fn fault(&self, field: usize, message: impl Into<String>, help: impl Into<String>) -> DataError {
        match &self.at[field] {
            Some(column) => self.head.fault(column.index, message, help),
            None => self.head.line.line().fault(message, help),
        }
    }

    /// Hands the rows below the header to `take`; comments are passed over.
    pub(crate) fn each_row(&self, lines: &mut LineReader, mut take: impl FnMut(&TableRow) -> Result<()>) -> Result<()> {
        while let Some(line) = lines.next_filled()? {
            if !line.text.trim_start().starts_with('#') {
                take(&self.row(line)?)?;
            }
        }
        Ok(())
    }

    fn row<'a>(&'a self, line: TextLine<'a>) -> Result<TableRow<'a>> {
        let delimiter = self.head.delimiter;
        let cells: Vec<&str> = line.text.split(delimiter).map(|cell| cell.trim().trim_matches('"').trim()).collect();
        let (found, names) = (cells.len(), self.head.names.len());
        if found == names {
            return Ok(TableRow { sheet: self, line, cells });
        }
        let help = match delimiter == ',' && found > names {
            true => "write decimals with a point, or separate the columns with semicolons",
            false => "complete or delete the row",
        };
        Err(line.fault(format!("the row has {found} cells, the header {names}"), help))
    }
}

pub(crate) struct TableRow<'a> {
    pub sheet: &'a TableSheet,
    pub line: TextLine<'a>,
    cells: Vec<&'a str>,
}

impl TableRow<'_> {
    /// The text of a field; empty if it has no column.
    pub(crate) fn text(&self, field: usize) -> &str {
        self.sheet.at[field].as_ref().map_or("", |column| self.cells[column.index])
    }

    /// The number of a field in SI units; `None` if it has no column.
    pub(crate) fn number(&self, field: usize) -> Result<Option<f64>> {
        self.read(field, Unit::to_si)
    }

    pub(crate) fn read(&self, field: usize, si: impl Fn(Unit, f64) -> f64) -> Result<Option<f64>> {
        let Some(column) = &self.sheet.at[field] else { return Ok(None) };
        let text = self.text(field);
        let comma = || self.sheet.comma.then(|| with_comma(text)).flatten();
        let value = text.parse::<f64>().ok().or_else(comma);
        value.and_then(|value| column.si(value, si)).map(Some).ok_or_else(|| {
            let [message, help] = no_number(text, self.sheet.fields[field].expected, "");
            self.fault(field, message, help)
        })
    }

    /// A fault of one cell, with the bytes of the cell in the file.
    pub(crate) fn fault(&self, field: usize, message: impl Into<String>, help: impl Into<String>) -> DataError {
        let error = self.line.fault(message, help);
        let Some(SheetColumn { index, .. }) = self.sheet.at[field] else { return error };
        let cell = self.cells[index];
        let mut error = error.in_column(&self.sheet.head.names[index], Some(cell));
        let start = self.line.start + (cell.as_ptr() as usize - self.line.text.as_ptr() as usize);
        error.fault_mut().span = Some((start, start + cell.len()));
        error
    }
}
