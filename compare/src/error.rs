//! What can go wrong when a prediction is compared with measurements.

use data::Fault;

/// Errors of this crate; each names place and fault, and in the message or as [`CompareError::help`] the remedy.
#[expect(missing_docs, reason = "fields have the words and units of their message")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompareError {
    /// A wish that cannot be met.
    #[error("{message}")]
    Refused { message: String, help: String },
    /// A file that cannot be read.
    #[error("cannot read {path}: {cause}")]
    Unread { path: String, cause: String, help: String },
    /// A scenario whose text has a fault, with its line and the remedy.
    #[error("{0}")]
    Scenario(Box<Fault>),
    /// A table, a description or arrays that cannot be used together, with place and remedy.
    #[error("{0}")]
    Unfit(String),
    /// A setting is outside its range.
    #[error("{name} = {value} is not possible: {expected}")]
    BadOption { name: &'static str, value: f64, expected: &'static str },
    /// A matrix decomposition did not converge.
    #[error("the noise covariance could not be decomposed: check the marker positions for extreme values")]
    Decomposition,
    /// The balance of moments has no solution at some place and pressures.
    #[error("{0}")]
    Unsolved(#[from] models::Unsolved),
    /// Scenario and data are of different robots.
    #[error(
        "the data `{dataset}` are of actuator {data}, the scenario is of actuator {scenario}: use the matching scenario"
    )]
    WrongActuator { dataset: String, data: String, scenario: String },
    /// Neither the data nor the scenario states where a marker is on the body.
    #[error(
        "the station of marker `{marker}` is not known: add an s_mm column to the data, [markers] names and s_mm to \
         about.toml, or {needed} stations to [markers] s_mm of the scenario (it has {found})"
    )]
    NoStation {
        marker: String,
        /// How many markers the data have.
        needed: usize,
        /// How many stations the scenario has in `[markers] s_mm`.
        found: usize,
    },
    /// A marker sits beyond the robot's end.
    #[error("marker `{marker}` at s = {s_mm} mm is beyond the robot's end at {length_mm} mm: check units and scenario")]
    OffTheBody { marker: String, s_mm: f64, length_mm: f64 },
    /// Runs with different known tip forces cannot share one mean.
    #[error(
        "the runs have different known tip forces ({first} and {second}): put each force into a separate dataset, \
         because runs are averaged"
    )]
    MixedTipForces {
        /// A run and its tip force, in words.
        first: String,
        /// A run with another tip force, in words.
        second: String,
    },
    /// A protocol text that cannot be read.
    #[error("protocol `{text}`: {problem}; write pressures in kPa, for example \"0,10,20,30,0@2; 0,20,40,60,0@4\"")]
    BadProtocol { text: String, problem: String },
    /// A fault that reading the data found, with file, line and remedy.
    #[error("{0}")]
    Data(#[from] data::DataError),
    /// A finite element run cannot be made, or its record not be read.
    #[error("{message}")]
    Fem { message: String, help: String },
    /// The generator of hidden-effect data cannot make this robot or this run.
    #[error("the data cannot be generated: {problem}")]
    NotSimulated { problem: String },
    /// No scenario comes with the library for this actuator, or it is damaged.
    #[error("no shipped scenario of actuator `{kind}`: {problem}")]
    NoScenario { kind: String, problem: String },
    /// Nothing to hold against the data.
    #[error("no model is given to hold against the data: give at least one")]
    NoModel,
    /// A search that ended without a minimum.
    #[error("the fit of {what} broke off: {problem}")]
    Fit { what: &'static str, problem: String },
}

impl From<fem::FemError> for CompareError {
    fn from(error: fem::FemError) -> CompareError {
        CompareError::Fem { message: error.to_string(), help: error.help().unwrap_or_default().into() }
    }
}

impl CompareError {
    /// A wish that cannot be met, and what to type instead.
    pub fn refused(message: impl Into<String>, help: impl Into<String>) -> CompareError {
        CompareError::Refused { message: message.into(), help: help.into() }
    }

    pub(crate) fn told(message: impl Into<String>) -> CompareError {
        CompareError::Unfit(message.into())
    }

    pub(crate) fn bad_option(name: &'static str, value: f64, expected: &'static str) -> CompareError {
        CompareError::BadOption { name, value, expected }
    }

    /// What to do, where the message does not say it.
    pub fn help(&self) -> Option<&str> {
        use CompareError::{Fem, Refused, Unread};
        match self {
            Refused { help, .. } | Unread { help, .. } | Fem { help, .. } => Some(help),
            CompareError::Unsolved(models::Unsolved::NotConverged { .. }) => {
                Some("take smaller loads, or a higher body pressure")
            }
            _ => self.fault().map(|fault| fault.help.as_str()),
        }
    }

    /// The fault of a file, with its place and the line itself.
    pub fn fault(&self) -> Option<&Fault> {
        match self {
            CompareError::Scenario(fault) => Some(fault),
            CompareError::Data(error) => Some(error.fault()),
            _ => None,
        }
    }
}
