//! Names in the header of a table: what a kind of table may hold, and which column holds it in which unit.

use crate::error::{DataError, Fault, Result};
use crate::lines::Line;
use crate::units::Measured;
use spelling::units::Unit;

/// A column that a kind of table may have.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Name without unit; the whole name of a text or of a number without unit.
    pub base: &'static str,
    /// Name as usually written.
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
    pub fn of(name: &str, fields: &[Field]) -> Meaning {
        let name = name.to_lowercase();
        let by_base = |base: &str| fields.iter().position(|field| field.base == base);
        if let Some(at) = by_base(&name) {
            return if fields[at].has_unit() { Meaning::NoUnit(at) } else { Meaning::Known(at, None) };
        }
        let Some((base, suffix)) = name.rsplit_once('_') else { return Meaning::Extra };
        match by_base(base).and_then(|at| Some((at, fields[at].dimension?))) {
            Some((at, dimension)) => match dimension.unit(suffix) {
                Some(unit) => Meaning::Known(at, Some(unit)),
                None => Meaning::OtherUnit(at),
            },
            None => Meaning::Extra,
        }
    }

    /// The field, whatever its unit.
    pub fn field(&self) -> Option<usize> {
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
///
/// # Errors
/// A field that two columns hold.
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
) -> Option<DataError> {
    names.iter().enumerate().find_map(|(index, name)| {
        let (at, trouble, convert) = match meaning(name) {
            Meaning::NoUnit(at) => (at, "has no unit in its name", ""),
            Meaning::OtherUnit(at) if is_asked(at) == Some(true) => (at, "has an unknown unit", "convert it and "),
            _ => return None,
        };
        is_asked(at)?;
        let (message, help) = (format!("column {name} {trouble}"), format!("{convert}{}", fields[at].naming()));
        Some(DataError::Column(fault(line, names, index, message, help)))
    })
}
