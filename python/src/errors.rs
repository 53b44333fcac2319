//! Errors of the library as one Python exception.

use ibr::data::DataError;
use ibr::fem::FemError;
use ibr::pages::PageError;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::Path;

create_exception!(
    ibr,
    Error,
    PyValueError,
    "The fault, its place, and what to write instead.\n\n`where` is the file and its line or column, `help` what to do; None where there is none."
);

/// Options of the command that messages name, as Python writes them.
const OPTIONS: [(&str, &str); 10] = [
    ("--force", "force=True"),
    ("--resume", "resume=True"),
    ("--keep-bending", "keep_bending=True"),
    ("--calibrate ", "calibrate="),
    ("--calibrate", "calibrate"),
    ("--sigma", "sigma_mm"),
    ("--tolerance", "tolerance_mm"),
    ("--effect", "effects"),
    ("--also", "also"),
    ("--not", "without"),
];

/// Message of an error, and where in a file it is.
#[derive(Debug, Default)]
pub(crate) struct Told {
    message: String,
    place: Option<String>,
    /// Text of the line that has the fault.
    line: Option<String>,
    help: Option<String>,
    /// A file or a name that is not there.
    is_missing: bool,
}

impl From<ibr::Error> for Told {
    fn from(error: ibr::Error) -> Told {
        let fault = error.fault();
        let path = match &error {
            ibr::Error::Unread { path, .. } => Some(path),
            ibr::Error::Data(DataError::File(fault)) => Some(&fault.location.file),
            _ => None,
        };
        Told {
            is_missing: path.is_some_and(|path| !Path::new(path).exists()),
            message: error.to_string(),
            place: fault.map(|fault| fault.location.to_string()),
            line: fault.and_then(|fault| fault.source_line.clone()),
            help: error.help().map(str::to_string),
        }
    }
}

impl From<FemError> for Told {
    fn from(error: FemError) -> Told {
        let help = error.help().map(str::to_string);
        Told { message: error.to_string(), place: error.place(), help, ..Told::default() }
    }
}

impl From<PageError> for Told {
    fn from(error: PageError) -> Told {
        match error {
            PageError::Compare(error) => error.into(),
            PageError::Report(error) => Told { message: error.to_string(), ..Told::default() },
        }
    }
}

/// A wish that makes no sense, and what to write.
pub(crate) fn refused(message: impl Into<String>, help: impl Into<String>) -> PyErr {
    raised(ibr::Error::refused(message, help))
}

/// Makes the Python exception of an error, with its place and remedy as attributes.
pub(crate) fn raised(error: impl Into<Told>) -> PyErr {
    let Told { message: mut text, place, line, help, is_missing } = error.into();
    let help = help
        .filter(|help| !help.is_empty())
        .map(|help| OPTIONS.iter().fold(help, |help, (typed, python)| help.replace(typed, python)));
    line.iter().for_each(|line| text += &format!("\n    {}", line.trim()));
    help.iter().for_each(|help| text += &format!("\nhelp: {help}"));
    Python::attach(|py| {
        let exception = match is_missing.then(|| py.import("ibr").and_then(|ibr| ibr.getattr("NotFoundError"))) {
            Some(Ok(class)) => PyErr::from_value(
                class.call1((&text,)).unwrap_or_else(|cause| cause.into_value(py).into_bound(py).into_any()),
            ),
            _ => Error::new_err(text),
        };
        let value = exception.value(py);
        let set = value.setattr("where", place).and_then(|()| value.setattr("help", help));
        set.map_or_else(|cause| cause, |()| exception)
    })
}
