//! What can be wrong with a user's file, said once, with the place and with what to type instead.
//!
//! Every error carries the same [`Fault`]. The binary shows the offending
//! line with a caret from [`DataError::source_line`] and [`DataError::caret`], without opening the file again.

use std::fmt;

/// A place in a file, as a user counts: lines from 1, columns by their name in the header.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Location {
    /// File name or path as the user gave it, or `set:name/file` for an embedded one.
    pub file: String,
    /// Line counted from 1; 0 where the file as a whole is meant.
    pub line: u64,
    /// Name of the column or key.
    pub column_name: Option<String>,
    /// Text of the cell as in the file.
    pub cell: Option<String>,
}

/// One fault in one file: where, the mistake, what to type, and the line itself where it was at hand.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Fault {
    /// File, line and column of the fault.
    pub location: Location,
    /// The mistake, one sentence without a full stop.
    pub message: String,
    /// Remedy, as an instruction to the user.
    pub help: String,
    /// Bytes of the file that are at fault, `(start, end)`.
    pub span: Option<(usize, usize)>,
    /// The source line, without its line end.
    pub source_line: Option<String>,
    /// Byte offset of `source_line` in the file.
    pub source_start: usize,
    /// The whole file, where it is a text that people write; empty for tables.
    pub text: String,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        match &self.column_name {
            Some(column) => write!(f, ", column {column}"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.location, self.message)
    }
}

impl Fault {
    /// A fault of a file as a whole.
    pub fn of_file(file: &str, message: impl Into<String>, help: impl Into<String>) -> Fault {
        let location = Location { file: file.to_string(), ..Location::default() };
        Fault { location, message: message.into(), help: help.into(), ..Fault::default() }
    }

    /// A fault of the bytes `span` of `text`, the whole content of `file`.
    pub fn of_text(file: &str, text: &str, span: Option<(usize, usize)>, message: String, help: String) -> Fault {
        let mut fault = Fault::of_file(file, message, help);
        let Some((start, end)) = span else { return fault };
        let start = floor_boundary(text, start);
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line = text[line_start..].lines().next().unwrap_or_default();
        fault.location.line = text[..start].matches('\n').count() as u64 + 1;
        fault.span = Some((start, end.max(start)));
        fault.source_line = Some(line.to_string());
        fault.source_start = line_start;
        fault.text = text.to_string();
        fault
    }

    /// Bytes of the source line that are at fault, clipped to the line.
    pub fn caret(&self) -> Option<(usize, usize)> {
        let (length, (start, end)) = (self.source_line.as_ref()?.len(), self.span?);
        let inside = |at: usize| at.saturating_sub(self.source_start).min(length);
        Some((inside(start), inside(end)))
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Movement and pressure over the time of the log, as a refused clock puts them next to each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ClockTracks {
    /// Time \[s\] and share of the range of the movement, thinned for a picture.
    pub movement: Vec<[f64; 2]>,
    /// Time \[s\] and actuator pressure as a share of its range.
    pub pressure: Vec<[f64; 2]>,
    /// Times at which movement and pressure change \[s\].
    pub changes_s: [Vec<f64>; 2],
    /// Time of the log minus time of the camera \[s\].
    pub offset_s: f64,
}

/// What reading or writing gives, or why not.
pub type Result<T, E = DataError> = std::result::Result<T, E>;

/// Why a dataset, a description or a table could not be read or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DataError {
    /// No such file, folder or embedded set, or it cannot be opened or written.
    #[error("{0}")]
    File(Box<Fault>),
    /// A file does not hold what it should, or this build cannot read it.
    #[error("{0}")]
    Content(Box<Fault>),
    /// The clocks of camera and pressure log do not agree.
    #[error("{0}")]
    Clock(Box<Fault>, Box<ClockTracks>),
}

impl From<Fault> for DataError {
    fn from(fault: Fault) -> DataError {
        DataError::Content(Box::new(fault))
    }
}

impl DataError {
    /// A file that cannot be opened or written.
    pub fn file(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::File(Box::new(Fault::of_file(file, message, help)))
    }

    /// A file that does not hold what it should, as a whole.
    pub fn of(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
        Fault::of_file(file, message, help).into()
    }

    /// The fault inside, with place, message and remedy.
    pub fn fault(&self) -> &Fault {
        let (DataError::File(fault) | DataError::Content(fault) | DataError::Clock(fault, _)) = self;
        fault
    }

    pub(crate) fn fault_mut(&mut self) -> &mut Fault {
        let (DataError::File(fault) | DataError::Content(fault) | DataError::Clock(fault, _)) = self;
        fault
    }

    /// The same, placed in a line of its file (where the text of the line is gone).
    #[must_use]
    pub fn at_line(mut self, line: u64) -> DataError {
        self.fault_mut().location.line = line;
        self
    }

    /// The same, placed in a column, and in the text of a cell there.
    pub(crate) fn in_column(mut self, name: &str, cell: Option<&str>) -> DataError {
        let location = &mut self.fault_mut().location;
        location.column_name = Some(name.to_string());
        location.cell = cell.map(str::to_string);
        self
    }

    /// The same with more to do or type.
    #[must_use]
    pub fn with_help(mut self, more: &str) -> DataError {
        self.fault_mut().help += more;
        self
    }

    /// The mistake as one sentence, without the place.
    pub fn message(&self) -> &str {
        &self.fault().message
    }

    /// Remedy, as an instruction to the user.
    pub fn help(&self) -> &str {
        &self.fault().help
    }

    /// File, line and column of the fault.
    pub fn location(&self) -> &Location {
        &self.fault().location
    }

    /// Bytes of the file that are at fault, `(start, end)`.
    pub fn span(&self) -> Option<(usize, usize)> {
        self.fault().span
    }

    /// The line at fault, without its line end.
    pub fn source_line(&self) -> Option<&str> {
        self.fault().source_line.as_deref()
    }

    /// Bytes of [`DataError::source_line`] that are at fault, clipped to the line.
    pub fn caret(&self) -> Option<(usize, usize)> {
        self.fault().caret()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn display_names_file_line_and_column() {
        let error = DataError::of("markers.csv", "expected a number, found \"abc\"", "type a number");
        let error = error.at_line(17).in_column("x_mm", None);
        assert_eq!(error.to_string(), "markers.csv:17, column x_mm: expected a number, found \"abc\"");
        assert_eq!(error.help(), "type a number");
    }

    #[test]
    fn a_span_in_a_text_finds_its_line_and_caret() {
        let fault = Fault::of_text("a.toml", "a = 1\nbé = 2\nc = 3", Some((6, 9)), "m".into(), "h".into());
        let error = DataError::from(fault);
        assert_eq!((error.location().line, error.source_line(), error.caret()), (2, Some("bé = 2"), Some((0, 3))));
    }

    #[test]
    fn a_span_inside_a_character_or_past_the_end_does_not_panic() {
        let inside = Fault::of_text("a", "é", Some((1, 2)), String::new(), String::new());
        let past = Fault::of_text("a", "é", Some((90, 99)), String::new(), String::new());
        assert_eq!((inside.location.line, past.location.line), (1, 1));
    }
}
