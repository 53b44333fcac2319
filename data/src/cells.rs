//! What people and programs write into a cell: numbers with a point or a comma, words for nothing, durations, labels.

use crate::error::{DataError, Result};
use crate::lines::{KeptLine, TextLine};
use std::collections::HashMap;
use std::path::Path;

/// What spreadsheets, pandas, R and C libraries write for a missing number.
const NOTHING: [&str; 13] =
    ["", "na", "n/a", "#n/a", "nan", "null", "none", "-", "nan(ind)", "nan(snan)", "1.#qnan", "1.#ind", "missing"];

pub(crate) fn is_nothing(text: &str) -> bool {
    let plain = text.strip_prefix(['-', '+']).filter(|rest| !rest.is_empty()).unwrap_or(text);
    NOTHING.iter().any(|word| plain.eq_ignore_ascii_case(word))
}

/// A label without the decimals of a whole number: `1.0`, as pandas writes it, is `1`.
pub(crate) fn label(text: &str) -> &str {
    match text.split_once('.') {
        Some((whole, zeros)) if digits(whole) && !zeros.is_empty() && zeros.bytes().all(|b| b == b'0') => whole,
        _ => text,
    }
}

fn digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Seconds of a clock time: `1:02.5`, `0:01:02.5`, or `0:00:01:50` with hundredths last.
pub(crate) fn clock_s(text: &str) -> Option<f64> {
    let parts: Vec<&str> = text.split(':').collect();
    let whole = |part: &str| digits(part).then(|| part.parse::<f64>().ok()).flatten();
    let (last, before) = parts.split_last().filter(|(_, before)| !before.is_empty())?;
    let before: Vec<f64> = before.iter().map(|part| whole(part)).collect::<Option<_>>()?;
    match before[..] {
        [h, m, s] => Some(3600.0 * h + 60.0 * m + s + 0.01 * whole(last)?),
        [h, m] => Some(3600.0 * h + 60.0 * m + last.parse::<f64>().ok()?),
        [m] => Some(60.0 * m + last.parse::<f64>().ok()?),
        _ => None,
    }
}

/// Seconds since midnight of a date and a clock time with seconds: `2026-03-02T10:11:12.5Z`, `3/2/2026 10:11:12 AM`; the day is not used.
pub(crate) fn day_s(text: &str) -> Option<f64> {
    let upper = text.to_ascii_uppercase();
    let (text, half) = match (upper.strip_suffix("AM"), upper.strip_suffix("PM")) {
        (Some(rest), _) => (rest.trim(), Some(0.0)),
        (_, Some(rest)) => (rest.trim(), Some(43_200.0)),
        _ => (upper.trim_end_matches('Z'), None),
    };
    let (date, clock) = text.rsplit_once([' ', 'T']).unwrap_or(("0", text));
    let clock = clock.split(['+', '-']).next().filter(|clock| clock.matches(':').count() == 2)?;
    let s = clock_s(clock).filter(|_| date.starts_with(|c: char| c.is_ascii_digit()))?;
    Some(half.map_or(s, |half| s % 43_200.0 + half))
}

/// How a file writes decimals; found while it is read.
#[derive(Debug, Clone, Default)]
pub(crate) struct Decimals {
    point: bool,
    /// A comma was read that can only be a decimal one.
    comma: bool,
    /// The first number whose comma may be of thousands.
    doubtful: Option<(KeptLine, String)>,
}

impl Decimals {
    /// The number of a cell; `allowed`: a comma may be in it (it does not separate cells).
    pub(crate) fn number(&mut self, text: &str, allowed: bool, line: &TextLine) -> Result<Option<f64>> {
        if !(allowed && text.contains(',')) {
            let value = text.parse().ok();
            self.point |= allowed && text.contains('.') && value.is_some();
            return if self.comma && self.point { Err(both(line, text)) } else { Ok(value) };
        }
        let Some(value) = with_comma(text) else { return Ok(None) };
        if self.point {
            return Err(both(line, text));
        }
        if is_certain(text) {
            self.comma = true;
        } else if self.doubtful.is_none() {
            self.doubtful = Some((line.keep(), text.to_string()));
        }
        Ok(Some(value))
    }

    pub(crate) fn finish(&self) -> Result<bool> {
        match &self.doubtful {
            Some((line, text)) if self.point => Err(both(&line.line(), text)),
            Some((line, text)) if !self.comma => Err(thousands(&line.line(), text)),
            _ => Ok(self.comma),
        }
    }
}

pub(crate) fn with_comma(text: &str) -> Option<f64> {
    let is_one = text.matches(',').count() == 1 && !text.contains('.');
    if is_one { text.replace(',', ".").parse().ok() } else { None }
}

/// Whether a comma cannot be one of thousands: not three digits after it, or a leading zero or more than three digits before it.
pub(crate) fn is_certain(text: &str) -> bool {
    let Some((before, after)) = text.trim_start_matches(['-', '+']).split_once(',') else { return false };
    after.len() != 3 || before.starts_with('0') || before.is_empty() || before.len() > 3
}

/// Message and help for a cell that is not a finite number; `expected` is the name of its column, `more` ends the help.
pub(crate) fn no_number(text: &str, expected: &str, more: &str) -> [String; 2] {
    let message = match text.parse::<f64>() {
        _ if text.is_empty() => "expected a number, the cell is empty".to_string(),
        Ok(_) => format!("expected a finite number, found \"{text}\""),
        Err(_) => format!("expected a number, found \"{text}\""),
    };
    let with_point = text.replace(',', ".");
    if with_point.parse::<f64>().is_ok_and(f64::is_finite) {
        return [message, format!("write decimals with a point: {with_point}")];
    }
    let unit = format!("the unit belongs to the column name, as in {expected}");
    [message, format!("type a plain number such as 12.5 ({unit}), or delete the row{more}")]
}

fn thousands(line: &TextLine, text: &str) -> DataError {
    let (point, whole) = (text.replace(',', "."), text.replace(',', ""));
    let message = format!(
        "\"{text}\" can be read as {point} (decimal comma) or as {whole} (comma of thousands), and so can every number with a comma here"
    );
    let help = "write decimals with a point, or at least one number with another count of decimals";
    line.fault(message, help)
}

fn both(line: &TextLine, text: &str) -> DataError {
    let (point, whole) = (text.replace(',', "."), text.replace([',', '.'], ""));
    let message = format!("points and commas both stand in numbers: \"{text}\" can be read as {point} or as {whole}");
    let help = "write all decimals alike, and no commas of thousands";
    line.fault(message, help)
}

/// The name of a file without its folder and its end.
pub(crate) fn stem(file: &str) -> String {
    Path::new(file).file_stem().map_or(file.into(), |stem| stem.to_string_lossy().into_owned())
}

pub(crate) fn quoted(label: &str) -> String {
    if label.contains([',', '"', ';', '\t', '\n', '\r']) {
        format!("\"{}\"", label.replace('"', "\"\""))
    } else {
        label.to_string()
    }
}

/// Labels numbered in order of first appearance.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    pub names: Vec<String>,
    numbers: HashMap<String, usize>,
    last: usize,
}

impl Labels {
    /// The number of a label, new or known.
    pub(crate) fn number(&mut self, name: &str) -> usize {
        // Rows come sorted, or their labels come in the same order again and again.
        let next = (self.last + 1) % self.names.len().max(1);
        let is_here = |at: &usize| self.names.get(*at).is_some_and(|known| known == name);
        self.last = match [self.last, next].into_iter().find(is_here) {
            Some(at) => at,
            None => self.numbers.get(name).copied().unwrap_or(self.names.len()),
        };
        if self.last == self.names.len() {
            self.names.push(name.to_string());
            self.numbers.insert(name.to_string(), self.last);
        }
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_nothing_labels_and_clocks() {
        for word in ["", "NA", "NaN", "-nan(ind)", "#N/A", "null", "-", "1.#QNAN"] {
            assert!(is_nothing(word), "{word}");
        }
        assert!(!is_nothing("0") && !is_nothing("-1") && !is_nothing("lost"));
        assert_eq!(
            [label("1.0"), label("12.00"), label("1.5"), label("a.0"), label("1.")],
            ["1", "12", "1.5", "a.0", "1."]
        );
        assert_eq!(clock_s("0:00:01:50"), Some(1.5));
        assert_eq!(clock_s("1:02:03.25"), Some(3723.25));
        for stamp in [
            "2026-03-02T13:02:03.25Z",
            "02.03.2026 13:02:03.25",
            "3/2/2026 1:02:03.25 PM",
            "2026-03-02 13:02:03.25+01:00",
        ] {
            assert_eq!(day_s(stamp), Some(46_923.25), "{stamp}");
        }
        assert_eq!((day_s("12:00:01 AM"), day_s("2026-03-02 10:11"), day_s("at 10:11:12")), (Some(1.0), None, None));
        assert_eq!((clock_s("2:03.5"), clock_s("1.5"), clock_s("a:b")), (Some(123.5), None, None));
    }

    #[test]
    fn a_comma_is_decimal_only_where_it_cannot_be_of_thousands() {
        let line = TextLine { file: "f", number: 3, start: 0, text: "", ended: true };
        let read = |cells: &[&str]| {
            let mut decimals = Decimals::default();
            let read = cells.iter().map(|c| decimals.number(c, true, &line)).collect::<Result<Vec<_>, _>>();
            read.and_then(|values| decimals.finish().map(|comma| (values, comma)))
        };
        assert_eq!(read(&["1,5", "1,234"]).unwrap(), (vec![Some(1.5), Some(1.234)], true));
        assert_eq!(read(&["1,234", "0,004"]).unwrap().0[0], Some(1.234));
        assert_eq!(read(&["1.5", "2"]).unwrap(), (vec![Some(1.5), Some(2.0)], false));
        let error = read(&["1,234", "5,678"]).unwrap_err();
        assert!(error.message().contains("1.234") && error.message().contains("1234"), "{error}");
        assert!(read(&["1,234", "2.5"]).is_err() && read(&["2.5", "1,5"]).is_err());
    }
}
