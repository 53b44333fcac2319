//! The header line: which column holds which quantity, in which unit.

use crate::columns::{self, Column, Field, Meaning, field, plain};
use crate::error::{DataError, Fault, Result};
use crate::lines::{KeptLine, Line, Lines};
use crate::units::Measured;

pub(crate) const RUN: usize = 0;
pub(crate) const ACTUATOR: usize = 1;
pub(crate) const TIME: usize = 2;
pub(crate) const P_BODY: usize = 3;
pub(crate) const P_ACT: usize = 4;
pub(crate) const PHASE: usize = 5;
pub(crate) const MARKER: usize = 6;
pub(crate) const X: usize = 7;
pub(crate) const Y: usize = 8;
pub(crate) const STATION: usize = 9;
pub(crate) const GAUGE: usize = 10;
pub(crate) const Z: usize = 11;
/// Of supply channels 1, 2 and 3.
pub(crate) const P_MORE: [usize; 3] = [12, 13, 14];

/// Columns of the pressures by which rows fall into holds: body, actuator, and the supply channels from 1 on.
pub(crate) const PRESSURES: [usize; 2 + P_MORE.len()] = [P_BODY, P_ACT, P_MORE[0], P_MORE[1], P_MORE[2]];

/// Pressures in the order of [`PRESSURES`] \[Pa\].
pub(crate) type Pressures = [f64; PRESSURES.len()];

/// All quantities; those from `s_mm` on are optional.
pub(crate) const QUANTITIES: [Field; 15] = [
    plain("run", true),
    plain("actuator", true),
    field("t", "t_s", Measured::Time, true),
    field("p_body", "p_body_kpa", Measured::Pressure, true),
    field("p_act", "p_act_kpa", Measured::Pressure, true),
    plain("phase", true),
    plain("marker", true),
    field("x", "x_mm", Measured::Length, true),
    field("y", "y_mm", Measured::Length, true),
    field("s", "s_mm", Measured::Length, false),
    field("p_gauge", "p_gauge_kpa", Measured::Pressure, false),
    field("z", "z_mm", Measured::Length, false),
    field("p_act_1", "p_act_1_kpa", Measured::Pressure, false),
    field("p_act_2", "p_act_2_kpa", Measured::Pressure, false),
    field("p_act_3", "p_act_3_kpa", Measured::Pressure, false),
];

#[derive(Debug, Clone)]
pub(crate) struct Header {
    pub names: Vec<String>,
    /// The column of each quantity; optional ones may be absent.
    pub columns: Vec<Option<Column>>,
    /// The y column was called `y_down_…`: its sign is turned on reading.
    pub y_down: bool,
    pub delimiter: u8,
    /// The file begins with `sep=;` or the like, which names the delimiter.
    pub named: bool,
    /// The line itself, for faults of a whole column.
    pub line: KeptLine,
}

impl Header {
    /// Supply channels beyond the first that have a column.
    pub(crate) fn more_channels(&self) -> usize {
        P_MORE.iter().filter(|quantity| self.columns[**quantity].is_some()).count()
    }

    /// The fault of a whole column, shown at its name.
    pub(crate) fn fault(&self, quantity: usize, message: String, help: String) -> Box<Fault> {
        let line = self.line.line();
        match &self.columns[quantity] {
            Some(column) => columns::fault(&line, &self.names, column.index, message, help),
            None => line.fault(message, help),
        }
    }

    /// Symbol of the unit of a column; empty without one.
    pub(crate) fn unit(&self, quantity: usize) -> &'static str {
        self.columns[quantity].as_ref().and_then(|column| column.unit).map_or("", |unit| unit.symbol)
    }

    /// Whether there is a column of z.
    pub(crate) fn has_z(&self) -> bool {
        self.columns[Z].is_some()
    }
}

/// Reads comment lines and the header line of a marker table.
pub(crate) fn read_header(lines: &mut Lines) -> Result<Header> {
    let mut said = None;
    loop {
        let file = lines.file().to_string();
        let Some(line) = lines.next_filled()? else {
            let help = format!("the first line must name the columns: {}", wanted());
            return Err(DataError::layout(&file, "the file is empty", help));
        };
        let text = line.text.trim_start();
        match text.strip_prefix("sep=").map(|sign| sign.trim().as_bytes()) {
            Some([sign]) => said = Some(*sign),
            _ if text.starts_with('#') => {}
            _ => return parse_header(&line, said),
        }
    }
}

fn wanted() -> String {
    let names: Vec<_> = QUANTITIES.iter().filter(|q| q.needed).map(|q| q.expected).collect();
    names.join(",")
}

fn parse_header(line: &Line, said: Option<u8>) -> Result<Header> {
    let (names, delimiter) = columns::split(line.text, said);
    let columns = columns::find(line, &names, &QUANTITIES, &meaning)?;
    let lacks = |quantity: &usize| QUANTITIES[*quantity].needed && columns[*quantity].is_none();
    if let Some(missing) = (0..QUANTITIES.len()).find(lacks) {
        // Where more than a few are missing, it is another program's table rather than a slip in this one.
        let all = (0..QUANTITIES.len()).filter(lacks).count();
        return Err(if all > FEW_MISSING {
            foreign(line, &names, delimiter, [missing, all])
        } else {
            absent(line, &names, delimiter, missing)
        });
    }
    for quantity in [GAUGE, Z].into_iter().chain(P_MORE).filter(|q| columns[*q].is_none()) {
        // Another program's z_score or z_px is not a coordinate.
        if let Some(fault) = without_unit(line, &names, quantity, quantity != Z) {
            return Err(fault);
        }
    }
    if let Some(gap) = (1..P_MORE.len()).find(|c| columns[P_MORE[*c]].is_some() && columns[P_MORE[c - 1]].is_none()) {
        let index = columns[P_MORE[gap]].as_ref().map_or(0, |column| column.index);
        let (missing, found) = (QUANTITIES[P_MORE[gap - 1]].expected, &names[index]);
        let message = format!("column {found} is there and {missing} is not");
        let help = format!("add {missing}, 0 in every row where nothing is connected to supply channel {gap}");
        return Err(DataError::Column(columns::fault(line, &names, index, message, help)));
    }
    let y = columns[Y].as_ref().map_or(String::new(), |column| names[column.index].to_lowercase());
    let y_down = y.starts_with(Y_DOWN);
    Ok(Header { names, columns, y_down, delimiter, named: said.is_some(), line: line.keep() })
}

/// Beginning of the name of a y that points down.
const Y_DOWN: &str = "y_down";

fn meaning(name: &str) -> Meaning {
    let name = name.to_lowercase();
    let down = name.strip_prefix(Y_DOWN).filter(|rest| rest.is_empty() || rest.starts_with('_'));
    Meaning::of(&down.map_or(name.clone(), |unit| format!("y{unit}")), &QUANTITIES)
}

fn without_unit(line: &Line, names: &[String], missing: usize, is_strict: bool) -> Option<DataError> {
    let is_asked = |quantity| (quantity == missing).then_some(is_strict);
    columns::without_unit(line, names, &QUANTITIES, &meaning, &is_asked).map(DataError::Column)
}

/// Columns that a table of this kind may lack by a slip.
const FEW_MISSING: usize = 2;

fn foreign(line: &Line, names: &[String], delimiter: u8, [missing, all]: [usize; 2]) -> DataError {
    let file = line.file;
    let (first, found) = (QUANTITIES[missing].expected, listed(names, delimiter));
    let message = format!("column {first} is missing, and {} more: this is not a marker table; found {found}", all - 1);
    let help = format!(
        "`ibr data import {file} --out FOLDER` reads the tables of tracking programs and wide tables; the columns are {}",
        wanted()
    );
    DataError::Column(line.fault(message, help))
}

fn absent(line: &Line, names: &[String], delimiter: u8, missing: usize) -> DataError {
    if let Some(fault) = without_unit(line, names, missing, true) {
        return fault;
    }
    let expected = QUANTITIES[missing].expected;
    let unknown = names.iter().filter(|name| matches!(meaning(name), Meaning::Extra)).map(String::as_str);
    let found = listed(names, delimiter);
    if let Some(near) = spelling::nearest(expected, unknown).filter(|near| !near.is_empty()) {
        let index = names.iter().position(|name| name == near).unwrap_or_default();
        let message = format!("column {expected} is missing; found {found}");
        let help = format!("did you mean {expected} instead of {near}?");
        return DataError::Column(columns::fault(line, names, index, message, help));
    }
    let message = format!("column {expected} is missing; found {found}");
    DataError::Column(line.fault(message, format!("add it; the columns are {}", wanted())))
}

const MOST_LISTED: usize = 30;

/// The column names, of very many the first.
fn listed(names: &[String], delimiter: u8) -> String {
    let shown = names[..names.len().min(MOST_LISTED)].join(&format!("{} ", delimiter as char));
    match names.len() - names.len().min(MOST_LISTED) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Result<Header, DataError> {
        let mut progress = |_, _| ();
        let mut reader = text.as_bytes();
        read_header(&mut Lines::new("m.csv", &mut reader, 0, &mut progress))
    }

    const GOOD: &str = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm";

    #[test]
    fn units_case_comments_delimiter_and_extra_columns_are_understood() {
        let text = "# a\n#b,c\nnote;Run;actuator;T_ms;p_body_kPa;P_ACT_bar;phase;marker;X_m;y_cm;s_mm;x_px\n";
        let header = header(text).unwrap();
        assert_eq!(header.delimiter, b';');
        assert_eq!(header.columns[RUN].as_ref().unwrap().index, 1);
        assert_eq!(header.columns[P_ACT].as_ref().unwrap().unit.unwrap().symbol, "bar");
        assert_eq!(header.columns[STATION].as_ref().unwrap().index, 10);
        assert!(!header.y_down && super::tests::header(&GOOD.replace("y_mm", "y_down_mm")).unwrap().y_down);
        assert_eq!(super::tests::header(&GOOD.replace(',', "\t")).unwrap().delimiter, b'\t');
    }

    #[test]
    fn every_required_column_is_missed_by_name() {
        for quantity in QUANTITIES.iter().filter(|quantity| quantity.needed) {
            let left: Vec<_> = GOOD.split(',').filter(|name| *name != quantity.expected).collect();
            let error = header(&left.join(",")).unwrap_err();
            assert!(error.message().starts_with(&format!("column {} is missing", quantity.expected)), "{error}");
        }
    }

    #[test]
    fn a_misspelt_column_gets_a_suggestion_and_a_caret() {
        let error = header(&GOOD.replace("p_act_kpa", "p_atc_kpa")).unwrap_err();
        assert_eq!(error.help(), "did you mean p_act_kpa instead of p_atc_kpa?");
        let (start, end) = error.caret().unwrap();
        assert_eq!(&error.source_line().unwrap()[start..end], "p_atc_kpa");
    }

    #[test]
    fn a_quantity_without_or_with_unknown_unit_shows_the_expected_name() {
        let error = header(&GOOD.replace("x_mm", "x")).unwrap_err();
        assert_eq!(error.to_string(), "m.csv:1, column x: column x has no unit in its name");
        assert_eq!(error.help(), "name it x_mm; lengths are in mm, cm, m");
        let error = header(&GOOD.replace("p_act_kpa", "p_act_torr")).unwrap_err();
        assert!(error.message().contains("unknown unit") && error.help().contains("psi"), "{error}");
        assert!(header(&GOOD.replace("p_act_kpa", "p_act")).unwrap_err().help().starts_with("name it p_act_kpa"));
    }

    #[test]
    fn the_same_quantity_twice_is_refused() {
        let error = header(&format!("{GOOD},x_mm")).unwrap_err();
        assert_eq!(error.message(), "column x_mm is there twice");
        let error = header(&format!("{GOOD},x_m")).unwrap_err();
        assert_eq!(error.message(), "columns x_mm and x_m hold the same quantity");
        assert_eq!(error.caret(), Some((GOOD.len() + 1, GOOD.len() + 4)));
        assert!(header(&format!("{GOOD},y_down_mm")).is_err());
    }

    #[test]
    fn an_empty_file_says_which_columns_to_write() {
        for text in ["", "\n\n", "# only a comment\n"] {
            let error = header(text).unwrap_err();
            assert!(matches!(error, DataError::Layout(_)) && error.help().contains(GOOD), "{error}");
        }
    }
}
