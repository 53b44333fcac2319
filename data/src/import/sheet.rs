//! A text of cells whatever its dialect: separator, decimal sign and line ends are found, not asked for.

use crate::cells::{Decimals, clock_s, day_s, is_nothing, with_comma};
use crate::error::{DataError, Result};
use crate::lines::TextLine;
use spelling::units::Range;

/// Lines looked at to find separator and decimal sign.
const LOOKED_AT: usize = 400;
/// Share of the lines in which a separator must stand.
const MOST_LINES: f64 = 0.7;

#[derive(Debug)]
pub(crate) struct CellText<'a> {
    pub file: &'a str,
    /// Everything in it, without byte order mark and `sep=` line.
    pub text: &'a str,
    pub delimiter: char,
    /// Decimals are written with a comma.
    pub comma: bool,
    before: u64,
}

impl<'a> CellText<'a> {
    pub(crate) fn new(file: &'a str, text: &'a str) -> Result<CellText<'a>> {
        if text.contains('\0') {
            let help = "export it as text: CSV, TXT or XML";
            return Err(DataError::of(file, "the file is not text", help));
        }
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (first, rest) = text.split_once('\n').unwrap_or((text, ""));
        let named = first.trim().strip_prefix("sep=").and_then(|sign| sign.chars().next());
        let text = if named.is_some() { rest } else { text };
        let delimiter = named.unwrap_or_else(|| delimiter(text));
        let mut sheet = CellText { file, text, delimiter, comma: false, before: u64::from(named.is_some()) };
        sheet.comma = delimiter != ',' && sheet.has_decimal_comma()?;
        Ok(sheet)
    }

    /// Lines that are not blank, each with its number from 1.
    pub(crate) fn lines(&self) -> impl Iterator<Item = (u64, &'a str)> + '_ {
        let numbered = self.text.split('\n').zip(self.before + 1..);
        numbered.map(|(text, number)| (number, text.trim_end_matches('\r'))).filter(|(_, text)| !self.is_blank(text))
    }

    fn is_blank(&self, line: &str) -> bool {
        line.bytes().all(|byte| byte.is_ascii_whitespace() || byte == self.delimiter as u8 || byte == b'"')
    }

    pub(crate) fn head(&self, count: usize) -> Vec<Vec<&'a str>> {
        self.lines().take(count).map(|(_, line)| self.split(line)).collect()
    }

    /// The cells of a line, without the quotes around them.
    pub(crate) fn split(&self, line: &'a str) -> Vec<&'a str> {
        let mut cells = Vec::new();
        self.split_into(line, &mut cells);
        cells
    }

    /// The same into a vector that is used again.
    pub(crate) fn split_into(&self, line: &'a str, cells: &mut Vec<&'a str>) {
        cells.clear();
        if !line.contains('"') {
            cells.extend(line.split(self.delimiter).map(str::trim));
            return;
        }
        let mut quoted = false;
        let parts = line.split(|c: char| {
            quoted ^= c == '"';
            c == self.delimiter && !quoted
        });
        cells.extend(parts.map(|cell| cell.trim().trim_matches('"').trim()));
    }

    /// The number of a cell; NaN for a word for none.
    pub(crate) fn number(&self, text: &str) -> Option<f64> {
        match text.parse() {
            Ok(value) => Some(value),
            Err(_) if self.comma && text.contains(',') => with_comma(text),
            Err(_) => is_nothing(text).then_some(f64::NAN),
        }
    }

    /// The number of a cell of line `number`.
    pub(crate) fn expect(&self, text: &str, number: u64, column: &str) -> Result<f64> {
        self.finite(text).ok_or_else(|| self.no_number(text, number, column))
    }

    /// The number of a cell but for infinity.
    pub(crate) fn finite(&self, text: &str) -> Option<f64> {
        self.number(text).filter(|value| !value.is_infinite())
    }

    /// The fault of a cell without a number.
    pub(crate) fn no_number(&self, text: &str, number: u64, column: &str) -> DataError {
        self.bad_cell(text, number, column, "type a number, or leave the cell empty")
    }

    pub(crate) fn whole_row(&self, cells: &[&str], names: usize, number: u64) -> Result<()> {
        if cells.len() == names {
            return Ok(());
        }
        let message = format!("the row has {} cells, the header {names}", cells.len());
        let help = "export it again, or complete or delete the row";
        Err(self.fault(number, message, help))
    }

    /// Seconds of a number of `second` each, a clock time, or a number of seconds with its unit (`1 sec`). Larger numbers than a time can
    /// be are milli-, micro- or nanoseconds since 1970.
    pub(crate) fn time(&self, text: &str, second: f64, number: u64, column: &str) -> Result<f64> {
        let finite = |text: &str| self.number(text).filter(|t| t.is_finite());
        let plain = || ["seconds", "secs", "sec", "s"].iter().find_map(|unit| text.strip_suffix(unit));
        let counted = finite(text).map(|t| second * t);
        let found = counted.or_else(|| finite(plain()?.trim())).or_else(|| clock_s(text)).or_else(|| day_s(text));
        let help = "a time is a number, or hours:minutes:seconds, with a date before it or without";
        let t = found.ok_or_else(|| self.bad_cell(text, number, column, help))?;
        let mut since_1970 = [1.0, 1e-3, 1e-6, 1e-9].into_iter().map(|unit| unit * t);
        Ok(since_1970.find(|t| Range::TIME.contains(t.abs())).unwrap_or(t))
    }

    fn bad_cell(&self, text: &str, number: u64, column: &str, help: &str) -> DataError {
        self.fault(number, format!("expected a number, found \"{text}\""), help).in_column(column, Some(text))
    }

    /// A fault of a line, or of the whole file for line 0.
    pub(crate) fn fault(&self, number: u64, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::of(self.file, message, help).at_line(number)
    }

    fn has_decimal_comma(&self) -> Result<bool> {
        let mut decimals = Decimals::default();
        for (number, text) in self.lines().take(LOOKED_AT) {
            let line = TextLine { file: self.file, number, start: 0, text, ended: true };
            for cell in self.split(text).into_iter().filter(|cell| with_comma(cell).is_some()) {
                decimals.number(cell, true, &line)?;
            }
        }
        decimals.finish()
    }
}

/// The rarest sign that is in most lines: a tab or a semicolon separates cells where there is one, else a comma.
fn delimiter(text: &str) -> char {
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).take(LOOKED_AT).collect();
    let has = |sign: char| lines.iter().filter(|line| line.contains(sign)).count() as f64;
    let often = |sign: &char| has(*sign) >= MOST_LINES * lines.len() as f64;
    ['\t', ';', ','].into_iter().find(often).unwrap_or(',')
}
