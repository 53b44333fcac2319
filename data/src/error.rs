//! What can be wrong with a user's file, said once, with the place and with what to type instead.
//!
//! Every error carries the same [`Fault`]; the variant is only its kind. The binary shows the offending
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

    /// The same fault, placed in line `line` of its file (where the text of the line is gone).
    pub fn at_line(mut self, line: u64) -> Fault {
        self.location.line = line;
        self
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
    /// The file is not a table: empty, header only, not UTF-8, a row cut short, too large.
    #[error("{0}")]
    Layout(Box<Fault>),
    /// A column is missing, there twice, misspelt or has no unit.
    #[error("{0}")]
    Column(Box<Fault>),
    /// A cell is not what its column holds.
    #[error("{0}")]
    Cell(Box<Fault>),
    /// The numbers are of a plausible robot only in another unit or with another axis.
    #[error("{0}")]
    Unit(Box<Fault>),
    /// Runs, holds and markers do not fit together.
    #[error("{0}")]
    Runs(Box<Fault>),
    /// The clocks of camera and pressure log do not agree.
    #[error("{0}")]
    Clock(Box<Fault>, Box<ClockTracks>),
    /// A TOML description has a fault, at a line of its text.
    #[error("{0}")]
    About(Box<Fault>),
    /// The crate was built without the feature this needs.
    #[error("{0}")]
    Feature(Box<Fault>),
}

impl DataError {
    /// A file that cannot be opened or written.
    pub fn file(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::File(Box::new(Fault::of_file(file, message, help)))
    }

    /// A file that is not a table as a whole.
    pub fn layout(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::Layout(Box::new(Fault::of_file(file, message, help)))
    }

    /// Runs, holds or markers of a file that do not fit together.
    pub fn runs(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::Runs(Box::new(Fault::of_file(file, message, help)))
    }

    /// A description that is wrong as a whole.
    pub fn about(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::About(Box::new(Fault::of_file(file, message, help)))
    }

    /// The fault inside, with place, message and remedy.
    pub fn fault(&self) -> &Fault {
        use DataError::{About, Cell, Clock, Column, Feature, File, Layout, Runs, Unit};
        match self {
            File(f) | Layout(f) | Column(f) | Cell(f) | Unit(f) | Runs(f) | Clock(f, _) | About(f) | Feature(f) => f,
        }
    }

    /// The same with more to do or type.
    #[must_use]
    pub fn with_help(mut self, more: &str) -> DataError {
        use DataError::{About, Cell, Clock, Column, Feature, File, Layout, Runs, Unit};
        match &mut self {
            File(f) | Layout(f) | Column(f) | Cell(f) | Unit(f) | Runs(f) | Clock(f, _) | About(f) | Feature(f) => {
                f.help += more;
            }
        }
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
        let mut fault = Fault::of_file("markers.csv", "expected a number, found \"abc\"", "type a number").at_line(17);
        fault.location.column_name = Some("x_mm".to_string());
        let error = DataError::Cell(Box::new(fault));
        assert_eq!(error.to_string(), "markers.csv:17, column x_mm: expected a number, found \"abc\"");
        assert_eq!(error.help(), "type a number");
    }

    #[test]
    fn a_span_in_a_text_finds_its_line_and_caret() {
        let fault = Fault::of_text("a.toml", "a = 1\nbé = 2\nc = 3", Some((6, 9)), "m".into(), "h".into());
        let error = DataError::About(Box::new(fault));
        assert_eq!((error.location().line, error.source_line(), error.caret()), (2, Some("bé = 2"), Some((0, 3))));
    }

    #[test]
    fn a_span_inside_a_character_or_past_the_end_does_not_panic() {
        let inside = Fault::of_text("a", "é", Some((1, 2)), String::new(), String::new());
        let past = Fault::of_text("a", "é", Some((90, 99)), String::new(), String::new());
        assert_eq!((inside.location.line, past.location.line), (1, 1));
    }
}
