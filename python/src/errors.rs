//! Errors of the library as one Python exception.

use ibr::fem::FemError;
use ibr::pages::PageError;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

create_exception!(
    ibr,
    Error,
    PyValueError,
    "The fault, its place, and what to write instead.\n\n`where` is the file and its line or column, `help` what to do; None where there is none."
);

/// Message of an error, and where in a file it is.
#[derive(Debug, Default)]
pub(crate) struct Told {
    message: String,
    place: Option<String>,
    /// Text of the line that has the fault.
    line: Option<String>,
    help: Option<String>,
}

impl From<ibr::Error> for Told {
    fn from(error: ibr::Error) -> Told {
        let fault = error.fault();
        Told {
            message: error.to_string(),
            place: fault.map(|fault| fault.location.to_string()),
            line: fault.and_then(|fault| fault.source_line.clone()),
            help: error.help().map(str::to_string),
        }
    }
}

impl From<FemError> for Told {
    fn from(error: FemError) -> Told {
        Told { message: error.to_string(), place: error.place(), line: None, help: error.help().map(str::to_string) }
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
    let Told { message: mut text, place, line, help } = error.into();
    let help = help.filter(|help| !help.is_empty());
    line.iter().for_each(|line| text += &format!("\n    {}", line.trim()));
    help.iter().for_each(|help| text += &format!("\nhelp: {help}"));
    let exception = Error::new_err(text);
    Python::attach(|py| {
        let value = exception.value(py);
        let set = value.setattr("where", place).and_then(|()| value.setattr("help", help));
        set.map_or_else(|cause| cause, |()| exception)
    })
}
