//! What can go wrong in the command, as the user sees it, with its exit code.

use crate::printable::printable;
use fem::FemError;
use fem::error::Refusal;
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, NamedSource, Report,
    SourceCode, SourceSpan, SpanContents,
};

/// Exit code: a comparison missed its threshold.
pub const MISSED: u8 = 1;
/// Exit code: wrong usage.
pub const USAGE: u8 = 2;
/// Exit code: an input cannot be read or an output not written.
pub const BAD_INPUT: u8 = 3;
/// Exit code: no solution.
pub const UNSOLVED: u8 = 4;

/// Exit code after an interrupt, as shells have it: 128 + SIGINT.
pub const INTERRUPTED: u8 = 130;

/// An error of the command.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A wrong argument.
    #[error("{message}")]
    Usage {
        /// What is wrong.
        message: String,
        /// What to type.
        help: String,
    },
    /// A file that cannot be read.
    #[error("cannot read {path}: {cause}")]
    Read {
        /// File.
        path: String,
        /// Why.
        cause: String,
        /// What to do.
        help: String,
    },
    /// A folder that cannot be written to.
    #[error("cannot write to {path}: {cause}")]
    Write {
        /// Folder.
        path: String,
        /// Why.
        cause: String,
        /// What to do.
        help: String,
    },
    /// A scenario that was refused.
    #[error("{error}")]
    Scenario {
        /// File or name of the scenario.
        file: String,
        /// Its text.
        text: String,
        /// Why.
        error: models::ScenarioError,
    },
    /// A finite element run that cannot be made or was stopped.
    #[error(transparent)]
    Fem(#[from] fem::FemError),
    /// Data that were refused, or a file that could not be written.
    #[error(transparent)]
    Data(#[from] data::DataError),
    /// The comparison failed.
    #[error(transparent)]
    Compare(compare::CompareError),
    /// A picture or page could not be made.
    #[error(transparent)]
    Drawing(#[from] report::ReportError),
    /// The model has no equilibrium.
    #[error(transparent)]
    Unsolved(#[from] models::Unsolved),
}

impl From<compare::CompareError> for Failure {
    fn from(error: compare::CompareError) -> Failure {
        match error {
            compare::CompareError::Data(error) => Failure::Data(error),
            compare::CompareError::Unsolved(error) => Failure::Unsolved(error),
            other => Failure::Compare(other),
        }
    }
}

impl From<ibr::pages::PageError> for Failure {
    fn from(error: ibr::pages::PageError) -> Failure {
        match error {
            ibr::pages::PageError::Compare(error) => error.into(),
            ibr::pages::PageError::Report(error) => Failure::Drawing(error),
        }
    }
}

impl Failure {
    /// A wrong argument and what to type instead.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Failure {
        Failure::Usage { message: message.into(), help: help.into() }
    }

    /// Exit code.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Usage { .. } | Failure::Compare(compare::CompareError::BadProtocol { .. }) => USAGE,
            Failure::Unsolved(models::Unsolved::BadPressure { .. }) => USAGE,
            Failure::Unsolved(_) => UNSOLVED,
            Failure::Fem(FemError::Interrupted { .. }) => INTERRUPTED,
            Failure::Fem(FemError::Setting { .. }) => USAGE,
            Failure::Fem(error) if error.is_stop() => UNSOLVED,
            Failure::Read { .. } | Failure::Write { .. } | Failure::Fem(_) => BAD_INPUT,
            Failure::Scenario { .. } | Failure::Data(_) | Failure::Compare(_) | Failure::Drawing(_) => BAD_INPUT,
        }
    }

    /// The error with its place in the file and what to type.
    pub fn render(&self) -> String {
        if let Failure::Fem(error @ FemError::Interrupted { .. }) = self {
            return format!("{error}; {}\n", error.help().unwrap_or_default());
        }
        let mut text = String::new();
        let plain = std::env::var_os("NO_COLOR").is_some() || !std::io::IsTerminal::is_terminal(&std::io::stderr());
        let theme = if plain { GraphicalTheme::unicode_nocolor() } else { GraphicalTheme::unicode() };
        let handler = GraphicalReportHandler::new_themed(theme).with_links(false).with_width(110);
        match handler.render_report(&mut text, self.diagnostic().as_ref()) {
            Ok(()) => text,
            Err(_) => printable(&format!("error: {self}\n")),
        }
    }

    fn diagnostic(&self) -> Report {
        let base = miette::MietteDiagnostic::new(printable(&self.to_string()));
        let error_help = if let Failure::Fem(error) = self { error.help().unwrap_or_default() } else { "" };
        match self {
            Failure::Usage { help, .. } | Failure::Read { help, .. } | Failure::Write { help, .. } => {
                Report::new(base.with_help(printable(help)))
            }
            Failure::Scenario { file, text, error } => {
                let help = error.help.as_deref().unwrap_or_else(|| what_to_type(&error.message));
                let span = error.span.map(|(start, end)| start..end);
                in_source(base.with_help(printable(help)), file, text, span)
            }
            Failure::Fem(FemError::Refused(refusal)) => {
                let Refusal { file, text, message, span, .. } = &**refusal;
                let base = miette::MietteDiagnostic::new(printable(message));
                in_source(with_help(base, error_help), file, text, span.clone())
            }
            Failure::Data(error) => data_report(error, base.with_help(printable(error.help()))),
            Failure::Compare(compare::CompareError::Fem { help, .. }) => Report::new(with_help(base, help)),
            Failure::Fem(_) => Report::new(with_help(base, error_help)),
            Failure::Compare(_) | Failure::Unsolved(_) | Failure::Drawing(_) => Report::new(base),
        }
    }
}

fn with_help(shown: miette::MietteDiagnostic, help: &str) -> miette::MietteDiagnostic {
    if help.is_empty() { shown } else { shown.with_help(printable(help)) }
}

/// A message with the place in a text file.
fn in_source(shown: miette::MietteDiagnostic, file: &str, text: &str, span: Option<std::ops::Range<usize>>) -> Report {
    let label = |span: std::ops::Range<usize>| {
        LabeledSpan::at(span.start..span.end.max(span.start + 1).min(text.len()), "here")
    };
    let shown = match span {
        Some(span) => shown.with_label(label(span)),
        None => shown,
    };
    Report::new(shown).with_source_code(NamedSource::new(printable(file), printable(text)))
}

/// Help for TOML errors that bring none.
fn what_to_type(message: &str) -> &'static str {
    if message.contains("expected f64") {
        "write a plain number without quotation marks; the unit is in the name of the key"
    } else if message.contains("expected i64") {
        "write a whole number without quotation marks"
    } else {
        "`ibr new epam` prints a complete scenario to compare with"
    }
}

/// The offending line of a table, which may be too large a file to show whole.
struct Line {
    name: String,
    text: String,
    number: usize,
    /// Bytes of the line before the text.
    before: usize,
}

impl SourceCode for Line {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        _before: usize,
        _after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let whole = SourceSpan::from(0..self.text.len());
        let column = self.before + span.offset();
        let line = self.number.saturating_sub(1);
        let text = self.text.as_bytes();
        Ok(Box::new(MietteSpanContents::new_named(self.name.clone(), text, whole, line, column, self.number)))
    }
}

fn data_report(error: &data::DataError, shown: miette::MietteDiagnostic) -> Report {
    let (Some(text), Some((start, end))) = (error.source_line(), error.caret()) else { return Report::new(shown) };
    let place = error.location();
    let (cut, before) = part(text, start);
    let (start, end) = (start.saturating_sub(before), end.saturating_sub(before));
    let end = end.max(start + 1).min(cut.len());
    let source = Line { name: printable(&place.file), text: printable(cut), number: place.line as usize, before };
    Report::new(shown.with_label(LabeledSpan::at(start.min(end)..end, "here"))).with_source_code(source)
}

/// Most bytes of a line that are shown, and those of them before the fault.
const SHOWN: [usize; 2] = [300, 60];

/// The part of a very long line around its byte `at`, and where it begins.
fn part(text: &str, at: usize) -> (&str, usize) {
    if text.len() <= SHOWN[0] {
        return (text, 0);
    }
    let from = text.floor_char_boundary(at.saturating_sub(SHOWN[1]));
    (&text[from..text.floor_char_boundary(from + SHOWN[0])], from)
}
