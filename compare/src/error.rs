//! What can go wrong when a prediction is held against measurements.

use data::Fault;

/// Errors of this crate; each says where and what is wrong, and in the message or as [`CompareError::help`] what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompareError {
    /// A wish that cannot be met.
    #[error("{message}")]
    Refused {
        /// What is wrong.
        message: String,
        /// What to type.
        help: String,
    },
    /// A file that cannot be read.
    #[error("cannot read {path}: {cause}")]
    Unread {
        /// File.
        path: String,
        /// Why.
        cause: String,
        /// What to do.
        help: String,
    },
    /// A scenario with a fault.
    #[error("{0}")]
    Scenario(Box<Fault>),
    /// The dataset has no run, hold, marker or sample.
    #[error("the dataset `{name}` is empty: it needs at least one run, one hold, one marker and one sample")]
    Empty {
        /// Name of the dataset.
        name: String,
    },
    /// A table of bench tests cannot be held against what was given.
    #[error("{file}: {problem}: {help}")]
    Bench {
        /// The table.
        file: String,
        /// What is wrong.
        problem: String,
        /// What to do.
        help: String,
    },
    /// An array does not have the shape of one run.
    #[error(
        "{what} has {found} values, one run of the data has {expected} ({holds} holds x {samples} samples x {markers} \
         markers x 2): predict at the holds, sample times and markers of the dataset"
    )]
    WrongLength {
        /// Which array.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length of one run.
        expected: usize,
        /// Holds per run.
        holds: usize,
        /// Samples per hold.
        samples: usize,
        /// Markers.
        markers: usize,
    },
    /// An array holds NaN, infinity or more than a kilometre.
    #[error(
        "{what} is not a usable number at hold {hold}, marker {marker} (counted from 1): check the model or the file \
         there (finite, below 1 km)"
    )]
    NotFinite {
        /// Which array.
        what: &'static str,
        /// Hold, counted from 1.
        hold: usize,
        /// Marker, counted from 1.
        marker: usize,
    },
    /// The list of sessions does not fit the runs.
    #[error("{found} session labels for {runs} runs: give one label per run, or none if all runs are one session")]
    WrongSessions {
        /// Labels given.
        found: usize,
        /// Runs in the data.
        runs: usize,
    },
    /// Every session has a single run, so nothing repeats.
    #[error(
        "every session has one run only, so run-to-run scatter cannot be told from session differences: repeat at \
         least one session, or leave the session labels out"
    )]
    SessionsWithoutRepeats,
    /// Data beside others say too little of their own noise.
    #[error(
        "{name} has {runs} run(s); data that are diagnosed beside others need {needed} of their own to know their noise: \
         measure more, or diagnose them alone"
    )]
    TooFewRunsBeside {
        /// Dataset.
        name: String,
        /// Runs it has.
        runs: usize,
        /// Runs it needs.
        needed: usize,
    },
    /// `about.toml` measures what cannot be of this robot.
    #[error("{place}: [measured] {problem}")]
    WrongMeasured {
        /// File and line.
        place: String,
        /// What is wrong, and what to write.
        problem: String,
    },
    /// A setting is outside its range.
    #[error("{name} = {value} is not possible: {expected}")]
    BadOption {
        /// Name of the setting.
        name: &'static str,
        /// Value given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
    /// A matrix decomposition did not converge.
    #[error("the noise covariance could not be decomposed: check the marker positions for extreme values")]
    Decomposition,
    /// The model found no equilibrium.
    #[error("{0}")]
    Unsolved(#[from] models::Unsolved),
    /// Scenario and data are of different robots.
    #[error(
        "the data `{dataset}` are of actuator {data}, the scenario is of actuator {scenario}: use the matching scenario"
    )]
    WrongActuator {
        /// Name of the dataset.
        dataset: String,
        /// Actuator kind in the data.
        data: String,
        /// Actuator kind in the scenario.
        scenario: String,
    },
    /// Marker stations are known nowhere.
    #[error(
        "the station of marker `{marker}` is not known: add an s_mm column to the data, [markers] names and s_mm to \
         about.toml, or {needed} stations to [markers] s_mm of the scenario (it has {found})"
    )]
    NoStation {
        /// First marker without station.
        marker: String,
        /// Markers in the data.
        needed: usize,
        /// Stations in the scenario.
        found: usize,
    },
    /// A marker sits beyond the robot's end.
    #[error("marker `{marker}` at s = {s_mm} mm is beyond the robot's end at {length_mm} mm: check units and scenario")]
    OffTheBody {
        /// Marker label.
        marker: String,
        /// Its station \[mm\].
        s_mm: f64,
        /// Body length \[mm\].
        length_mm: f64,
    },
    /// Runs with different known tip forces cannot share one mean.
    #[error(
        "the runs have different known tip forces ({first} and {second}): put each force into a dataset of its own, \
         because runs are averaged"
    )]
    MixedTipForces {
        /// A run and its force.
        first: String,
        /// Another.
        second: String,
    },
    /// A protocol text that cannot be read.
    #[error("protocol `{text}`: {problem}; write pressures in kPa, for example \"0,10,20,30,0@2; 0,20,40,60,0@4\"")]
    BadProtocol {
        /// The text.
        text: String,
        /// What is wrong.
        problem: String,
    },
    /// Data that cannot be read.
    #[error("{0}")]
    Data(#[from] data::DataError),
    /// A finite element run cannot be made, or its record not be read.
    #[error("{message}")]
    Fem {
        /// What is wrong, and where.
        message: String,
        /// What to do.
        help: String,
    },
    /// The generator of hidden-effect data cannot make this robot or this run.
    #[error("the data cannot be generated: {problem}")]
    NotSimulated {
        /// Why.
        problem: String,
    },
    /// No scenario comes with the library for this actuator, or it is damaged.
    #[error("no shipped scenario of actuator `{kind}`: {problem}")]
    NoScenario {
        /// Actuator kind.
        kind: String,
        /// Why.
        problem: String,
    },
    /// Nothing to hold against the data.
    #[error("no model is given to hold against the data: give at least one")]
    NoModel,
    /// A fit broke off.
    #[error("the fit of {what} broke off: {problem}")]
    Fit {
        /// What was fitted.
        what: &'static str,
        /// Why.
        problem: String,
    },
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

    /// What to do, where the message does not say it.
    pub fn help(&self) -> Option<&str> {
        use CompareError::{Fem, Refused, Unread};
        match self {
            Refused { help, .. } | Unread { help, .. } | Fem { help, .. } => Some(help),
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
