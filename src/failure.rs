//! What can go wrong in the command, as the user sees it, with its exit code.

use crate::shown::as_json;
use crate::words::printable;
use compare::CompareError;
use data::{Fault, Location};
use fem::FemError;
use fem::error::TextFault;
use ibr::pages::PageError;
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, MietteError, MietteSpanContents,
    NamedSource, Report, SourceCode, SourceSpan, SpanContents,
};
use models::Unsolved;
use serde::Serialize;

pub(crate) type Result<T, E = Failure> = std::result::Result<T, E>;

/// Exit code: a comparison missed its threshold.
pub(crate) const MISSED: u8 = 1;
pub(crate) const USAGE: u8 = 2;
/// Exit code: an input cannot be read or an output not written.
pub(crate) const BAD_INPUT: u8 = 3;
pub(crate) const UNSOLVED: u8 = 4;

/// Exit code after an interrupt, as shells have it: 128 + SIGINT.
pub(crate) const INTERRUPTED: u8 = 130;

/// A wrong argument, and what to type instead.
pub(crate) fn refuse_if(is_wrong: bool, message: impl Into<String>, help: impl Into<String>) -> Result<()> {
    if is_wrong { Err(Failure::usage(message, help)) } else { Ok(()) }
}

#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error("cannot write to {path}: {cause}")]
    Write { path: String, cause: String, help: String },
    /// A finite element run that cannot be made or was stopped.
    #[error(transparent)]
    Fem(#[from] FemError),
    /// Everything that has to do with scenarios and data.
    #[error(transparent)]
    Compare(#[from] CompareError),
    #[error(transparent)]
    Drawing(#[from] report::ReportError),
}

/// `ibr.error`: any command that fails with `--json`
#[derive(Serialize)]
struct ErrorAnswer<'a> {
    /// The fault, with its place where the message names it
    message: String,
    /// File with line or column, or the key; null where the fault has no place
    place: Option<String>,
    /// Remedy as a sentence; null where the message contains it
    help: Option<&'a str>,
    /// Exit code of the program
    exit_code: u8,
}

impl From<PageError> for Failure {
    fn from(error: PageError) -> Failure {
        match error {
            PageError::Compare(error) => error.into(),
            PageError::Report(error) => Failure::Drawing(error),
        }
    }
}

impl From<data::DataError> for Failure {
    fn from(error: data::DataError) -> Failure {
        Failure::Compare(error.into())
    }
}

impl From<sweep::SweepError> for Failure {
    fn from(error: sweep::SweepError) -> Failure {
        use sweep::SweepError::{Damaged, Run, Study, Write};
        let help = error.help();
        match error {
            Study(error) => error.into(),
            Run(error) => error.into(),
            Write { path, cause } => Failure::Write { path: path.display().to_string(), cause, help },
            Damaged { path, cause } => CompareError::Unread { path: path.display().to_string(), cause, help }.into(),
            other => Failure::usage(other.to_string(), help),
        }
    }
}

impl From<Unsolved> for Failure {
    fn from(error: Unsolved) -> Failure {
        Failure::Compare(error.into())
    }
}

impl Failure {
    pub(crate) fn usage(message: impl Into<String>, help: impl Into<String>) -> Failure {
        Failure::Compare(CompareError::refused(message, help))
    }

    pub(crate) fn code(&self) -> u8 {
        use CompareError::{BadProtocol, Refused, Unsolved as NoSolution};
        match self {
            Failure::Compare(BadProtocol { .. } | Refused { .. }) => USAGE,
            Failure::Compare(NoSolution(Unsolved::BadPressure { .. } | Unsolved::BadAim { .. })) => USAGE,
            Failure::Compare(NoSolution(_)) => UNSOLVED,
            Failure::Fem(FemError::Interrupted { .. }) => INTERRUPTED,
            Failure::Fem(FemError::Setting { .. }) => USAGE,
            Failure::Fem(error) if error.is_stop() => UNSOLVED,
            _ => BAD_INPUT,
        }
    }

    /// The error with its place in the file and what to type.
    pub(crate) fn render(&self) -> String {
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

    pub(crate) fn json(&self) -> serde_json::Value {
        let place = match self {
            Failure::Fem(error) => error.place(),
            Failure::Compare(error) => error.fault().map(|fault| fault.location.to_string()),
            _ => None,
        };
        let answer = ErrorAnswer { message: self.to_string(), place, help: self.help(), exit_code: self.code() };
        as_json("ibr.error", &answer)
    }

    pub(crate) fn help(&self) -> Option<&str> {
        match self {
            Failure::Write { help, .. } => Some(help.as_str()),
            Failure::Compare(error) => error.help(),
            Failure::Fem(error) => error.help(),
            Failure::Drawing(_) => None,
        }
        .filter(|help| !help.is_empty())
    }

    fn diagnostic(&self) -> Report {
        let base = MietteDiagnostic::new(short(&printable(&self.to_string())));
        let shown = match self.help() {
            Some(help) => base.with_help(short(&printable(help))),
            None => base,
        };
        match self {
            Failure::Fem(FemError::Refused(refused)) => {
                let TextFault { file, text, message, span, .. } = &**refused;
                in_text(file, text, message, span.clone(), shown)
            }
            Failure::Compare(error) => match error.fault() {
                Some(fault @ Fault { text, location, span, .. }) if !text.is_empty() => {
                    in_text(&location.file, text, &fault.to_string(), span.map(|(start, end)| start..end), shown)
                }
                Some(fault) => at_fault(fault, shown),
                None => Report::new(shown),
            },
            _ => Report::new(shown),
        }
    }
}

fn in_text(
    file: &str,
    text: &str,
    message: &str,
    span: Option<std::ops::Range<usize>>,
    shown: MietteDiagnostic,
) -> Report {
    // The frame around a very long line cannot be drawn.
    if let Some(at) = span.as_ref().filter(|at| line_at(text, at.start).len() > SHOWN[0]) {
        let start = text.floor_char_boundary(at.start);
        let before = text[..start].rfind('\n').map_or(0, |end| end + 1);
        let location =
            Location { file: file.into(), line: text[..start].matches('\n').count() as u64 + 1, ..Location::default() };
        let source_line = Some(line_at(text, start).to_string());
        let span = Some((start, at.end));
        let fault = Fault { location, span, source_line, source_start: before, ..Fault::default() };
        return at_fault(&fault, MietteDiagnostic { message: short(&printable(message)), ..shown });
    }
    let label = span.map(|at| vec![LabeledSpan::at(at.start..at.end.max(at.start + 1).min(text.len()), "here")]);
    let shown = MietteDiagnostic { message: short(&printable(message)), labels: label, ..shown };
    Report::new(shown).with_source_code(NamedSource::new(printable(file), printable(text)))
}

/// A message without the middle of very long words: a file's "word" may be the whole file.
fn short(message: &str) -> String {
    let word = |word: &str| match word.len() > SHOWN[0] {
        true => format!("{}…", &word[..word.floor_char_boundary(SHOWN[1])]),
        false => word.to_string(),
    };
    message.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

fn line_at(text: &str, at: usize) -> &str {
    let at = text.floor_char_boundary(at);
    let from = text[..at].rfind('\n').map_or(0, |end| end + 1);
    text[from..].lines().next().unwrap_or_default()
}

/// The offending line of a table, which may be too large a file to show whole.
struct FaultyLine {
    name: String,
    text: String,
    number: usize,
    /// Bytes of the line before the text.
    before: usize,
}

impl SourceCode for FaultyLine {
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

fn at_fault(fault: &Fault, shown: MietteDiagnostic) -> Report {
    let (Some(text), Some((start, end))) = (&fault.source_line, fault.caret()) else { return Report::new(shown) };
    let place = &fault.location;
    let (cut, before) = part(text, start);
    let (start, end) = (start.saturating_sub(before), end.saturating_sub(before));
    let end = end.max(start + 1).min(cut.len());
    let source = FaultyLine { name: printable(&place.file), text: printable(cut), number: place.line as usize, before };
    Report::new(shown.with_label(LabeledSpan::at(start.min(end)..end, "here"))).with_source_code(source)
}

/// Most bytes of a line that are shown, and most of these before the fault.
const SHOWN: [usize; 2] = [300, 60];

/// The part of a very long line around its byte `at`, and where it begins.
fn part(text: &str, at: usize) -> (&str, usize) {
    if text.len() <= SHOWN[0] {
        return (text, 0);
    }
    let from = text.floor_char_boundary(at.saturating_sub(SHOWN[1]));
    (&text[from..text.floor_char_boundary(from + SHOWN[0])], from)
}
