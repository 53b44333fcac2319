//! The header line: which column holds which quantity, in which unit.

use crate::columns::{Field, Head, TableSheet, field, meaning, needed, plain};
use crate::error::{DataError, Result};
use crate::lines::LineReader;
use crate::units::MeasuredQuantity;

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
pub(crate) type RowPressures = [f64; PRESSURES.len()];

/// All quantities; those from `s_mm` on are optional.
pub(crate) const QUANTITIES: [Field; 15] = [
    plain("run", true),
    plain("actuator", true),
    field("t", "t_s", MeasuredQuantity::Time, true),
    field("p_body", "p_body_kpa", MeasuredQuantity::Pressure, true),
    field("p_act", "p_act_kpa", MeasuredQuantity::Pressure, true),
    plain("phase", true),
    plain("marker", true),
    field("x", "x_mm", MeasuredQuantity::Length, true),
    field("y", "y_mm", MeasuredQuantity::Length, true),
    field("s", "s_mm", MeasuredQuantity::Length, false),
    field("p_gauge", "p_gauge_kpa", MeasuredQuantity::Pressure, false),
    field("z", "z_mm", MeasuredQuantity::Length, false),
    field("p_act_1", "p_act_1_kpa", MeasuredQuantity::Pressure, false),
    field("p_act_2", "p_act_2_kpa", MeasuredQuantity::Pressure, false),
    field("p_act_3", "p_act_3_kpa", MeasuredQuantity::Pressure, false),
];

/// Supply channels beyond the first that have a column.
pub(crate) fn more_channels(sheet: &TableSheet) -> usize {
    P_MORE.iter().filter(|quantity| sheet.has(**quantity)).count()
}

/// Reads comment lines and the header line of a marker table.
pub(crate) fn read_header(lines: &mut LineReader) -> Result<TableSheet> {
    let Some(head) = Head::read(lines)?.1 else {
        let help = format!("the first line must name the columns: {}", needed(&QUANTITIES));
        return Err(DataError::of(lines.file(), "the file is empty", help));
    };
    let sheet = head.sheet(&QUANTITIES)?;
    if let Some(missing) = sheet.missing() {
        let all = (0..QUANTITIES.len()).filter(|quantity| QUANTITIES[*quantity].needed && !sheet.has(*quantity));
        return Err(absent(&sheet.head, missing, all.count()));
    }
    for quantity in [GAUGE, Z].into_iter().chain(P_MORE).filter(|q| !sheet.has(*q)) {
        // Another program's z_score or z_px is not a coordinate.
        sheet.head.without_unit(&QUANTITIES, |asked| (asked == quantity).then_some(quantity != Z))?;
    }
    if let Some(gap) = (1..P_MORE.len()).find(|c| sheet.has(P_MORE[*c]) && !sheet.has(P_MORE[c - 1])) {
        let (missing, found) = (QUANTITIES[P_MORE[gap - 1]].expected, sheet.name(P_MORE[gap]));
        let message = format!("column {found} is there and {missing} is not");
        let help = format!("add {missing}, 0 in every row where nothing is connected to supply channel {gap}");
        return Err(sheet.fault(P_MORE[gap], message, help));
    }
    Ok(sheet)
}

/// Columns that a table of this kind may lack by a slip.
const FEW_MISSING: usize = 2;

/// The fault of a table that lacks a column, and `all` in all.
fn absent(head: &Head, missing: usize, all: usize) -> DataError {
    let line = head.line.line();
    let (expected, found) = (QUANTITIES[missing].expected, listed(head));
    // Where more than a few are missing, it is another program's table rather than a slip in this one.
    if all > FEW_MISSING {
        let others = format!("and {} more: this is not a marker table; found {found}", all - 1);
        let help = format!(
            "`ibr data import {} --out FOLDER` reads the tables of tracking programs and wide tables; the columns are {}",
            line.file,
            needed(&QUANTITIES)
        );
        return line.fault(format!("column {expected} is missing, {others}"), help);
    }
    if let Err(fault) = head.without_unit(&QUANTITIES, |asked| (asked == missing).then_some(true)) {
        return fault;
    }
    let message = format!("column {expected} is missing; found {found}");
    let is_unknown = |name: &&str| meaning(name, &QUANTITIES).is_none();
    let unknown = head.names.iter().map(String::as_str).filter(is_unknown);
    match spelling::nearest(expected, unknown).filter(|near| !near.is_empty()) {
        Some(near) => {
            let index = head.names.iter().position(|name| name == near).unwrap_or_default();
            let help = format!("did you mean {expected} instead of {near}?");
            head.fault(index, message, help)
        }
        None => line.fault(message, format!("add it; the columns are {}", needed(&QUANTITIES))),
    }
}

const MOST_LISTED: usize = 30;

/// The column names, of very many the first.
fn listed(Head { names, delimiter, .. }: &Head) -> String {
    let first = names.len().min(MOST_LISTED);
    let shown = names[..first].join(&format!("{delimiter} "));
    match names.len() - first {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Result<TableSheet, DataError> {
        read_header(&mut LineReader::of_text("m.csv", text))
    }

    const GOOD: &str = "run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm";

    #[test]
    fn units_case_comments_delimiter_and_extra_columns_are_understood() {
        let text = "# a\n#b,c\nnote;Run;actuator;T_ms;p_body_kPa;P_ACT_bar;phase;marker;X_m;y_cm;s_mm;x_px\n";
        let header = header(text).unwrap();
        assert_eq!(header.head.delimiter, ';');
        assert_eq!(header.at[RUN].as_ref().unwrap().index, 1);
        assert_eq!(header.unit(P_ACT), "bar");
        assert_eq!(header.at[STATION].as_ref().unwrap().index, 10);
        let down = super::tests::header(&GOOD.replace("y_mm", "y_down_mm")).unwrap();
        assert_eq!([header, down].map(|sheet| sheet.at[Y].as_ref().unwrap().turned), [false, true]);
        assert_eq!(super::tests::header(&GOOD.replace(',', "\t")).unwrap().head.delimiter, '\t');
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
            assert!(matches!(error, DataError::Content(_)) && error.help().contains(GOOD), "{error}");
        }
    }
}
